//! Differences of the cameras from the reference, in their pane and below the diagram.

use chromascope_figure::Panel;
use egui::{Id, Rect, Ui, Vec2};

use crate::figures::chromaticity;
use crate::figures::differences::{self, Built};
use crate::figures::look::{DifferencePlane, FigureLook};
use crate::paint::{self, PlotOptions};
use crate::panes::context::PaneContext;
use crate::plot_item::PlotItem;
use crate::workspaces::PaneKind;

const REACH: f32 = 8.0;

/// The plots of a plane in a rectangle, or why there are none.
pub fn plots(ui: &mut Ui, rect: Rect, plane: DifferencePlane, context: &mut PaneContext<'_>) {
    let size = [f64::from(rect.width()), f64::from(rect.height())];
    let look = FigureLook { difference_plane: plane, ..context.view.look(PaneKind::DIFFERENCES) };
    match differences::build(&context.scene, &look, size) {
        Ok(built) => built.panels.iter().for_each(|panel| one(ui, rect, (plane, panel), &built, context)),
        Err(why) => super::say(ui, rect, &why, context.theme.weak),
    }
}

fn one(
    ui: &mut Ui,
    rect: Rect,
    (plane, panel): (DifferencePlane, &Panel),
    built: &Built,
    context: &mut PaneContext<'_>,
) {
    let corner = |at: [f64; 2]| rect.min + Vec2::new(at[0] as f32, at[1] as f32);
    let place = Rect::from_min_max(corner(panel.area.min), corner(panel.area.max));
    let reference = context.scene.document.reference.clone();
    let shown = {
        let view = &*context.view;
        let emphasis = |tag| view.emphasis_of(&built.things, tag, &reference);
        let id = Id::unique(("differences", &panel.name));
        if panel.framed {
            let options = PlotOptions { zoomable: false, reset: view.reset_plots, emphasis: &emphasis };
            paint::plot(ui, id, panel, &context.theme, place, options)
        } else {
            paint::board(ui, id, panel, &context.theme, place, &emphasis)
        }
    };
    let hit = shown.response.hover_pos().and_then(|at| paint::nearest(panel, &shown.view, at, REACH));
    let thing = hit.and_then(|hit| built.things.get(hit.tag)).cloned();
    context.view.hover(thing.as_ref());
    if shown.response.clicked() {
        context.view.click(thing.as_ref());
    }
    if let Some(thing) = thing {
        let mut lines = chromaticity::brief(&context.scene, &thing);
        if let PlotItem::Sensor(sensor) = &thing {
            lines.extend(differences::explained(&context.scene, plane, sensor));
        }
        super::read_at_pointer(&shown.response, &lines);
    }
}
