//! Camera settings: the red, green and blue curves, and their response basis.

use egui::Ui;
use spectral_file::{Certainty, Role};

use super::{Closed, caption, list};
use crate::document::imported::ImportOverrides;
use crate::figures::curves::ImportSelection;
use crate::panes::widgets::segmented;
use crate::theme::{Theme, UNIT};

const LISTED: usize = 500;

/// Responses per energy and per photon.
pub(super) const RESPONSES: [(bool, &str, &str); 2] = [
    (false, "per energy", "To equal power at each wavelength"),
    (true, "per photon", "To equal numbers of photons, as quantum efficiencies are given"),
];

pub(super) fn show(ui: &mut Ui, shown: &ImportSelection, overrides: &mut ImportOverrides, theme: &Theme) {
    let Some(table) = shown.table().filter(|table| table.role.value == Role::Camera) else { return };
    let found = table.reading.camera_columns;
    let mut channels = overrides.channels.or(found).unwrap_or([0, 1, 2]);
    let width = ((ui.available_width() - 2.0 - 4.0 * UNIT) / 3.0).floor();
    let mut chosen = None;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0 * UNIT;
        for (channel, color) in ["Red", "Green", "Blue"].into_iter().enumerate() {
            let name = table.curves.get(channels[channel]).map_or("missing", |curve| curve.name.as_str());
            let guess = overrides.channels.is_none() && found.is_none();
            let how = if guess { "guess" } else { "" };
            let why = if overrides.channels.is_some() {
                "Chosen by hand"
            } else {
                "From the names or the peaks of the curves"
            };
            let closed = Closed { value: name.to_owned(), how: how.to_owned(), guess, why: why.to_owned() };
            let entries: Vec<(String, bool)> = table
                .curves
                .iter()
                .take(LISTED)
                .enumerate()
                .map(|(place, curve)| (curve.name.clone(), place == channels[channel]))
                .collect();
            if let Some(place) = list(ui, theme, color, &closed, &entries, width) {
                chosen = Some((channel, place));
            }
        }
    });
    if let Some((channel, place)) = chosen {
        // Two channels change places rather than being the same curve.
        if let Some(other) = channels.iter().position(|known| *known == place) {
            channels[other] = channels[channel];
        }
        channels[channel] = place;
        overrides.channels = Some(channels).filter(|channels| Some(*channels) != found);
        let mut taken = shown.taken();
        if !taken.contains(&place) {
            taken.push(place);
            taken.sort_unstable();
            overrides.taken = Some(taken);
        }
    }
    let said = table.reading.per_photon.as_ref();
    let before = || shown.set.as_ref().is_some_and(|set| set.per_photon);
    let per_photon = overrides.per_photon.or(said.map(|said| said.value)).unwrap_or_else(before);
    let guess = overrides.per_photon.is_none() && said.is_none_or(|said| said.certainty == Certainty::Guess);
    ui.horizontal(|ui| {
        caption(ui, theme, if guess { "Response (guess)" } else { "Response" }, guess);
        ui.add_space(3.0 * UNIT);
        if let Some(per_photon) = segmented(ui, &RESPONSES, per_photon) {
            overrides.per_photon = Some(per_photon);
        }
    });
}
