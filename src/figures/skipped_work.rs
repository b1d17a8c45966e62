//! Skipped work and the time it saved: as measured by a run, and by caching since the start.

use chromascope_figure::{Anchor, Axis, Cell, Figure, InkRole, Mark, Panel, Rect, Shape, Table, Tag, TextSize, Ticks};
use chromascope_measure::pareto::duration;

use super::FigureInput;
use crate::format::capitalized;
use crate::profiler::{LOCI, Measured, PATCHES, SkippedWork};
use crate::results::Count;

/// The width of a saved figure, and the heights of a row and of the margins, in points.
const WIDTH: f64 = 640.0;
const ROW: f64 = 24.0;
const AROUND: f64 = 60.0;

/// Note that holds for all rows.
pub const OVERLAP: &str = "Rows overlap: their times do not add up.";

const SINCE_THE_START: &str = "counted since the start";

/// Rows that were found alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Period that the rows cover.
    pub when: &'static str,
    /// True if it is of the scene as it was.
    pub is_old: bool,
    /// The rows.
    pub rows: Vec<SkippedWork>,
}

/// Sections: work skipped in the last run, and work saved by caching since the start. Sections without rows are omitted.
pub fn sections(measured: &Measured) -> Vec<Section> {
    let at_the_run = if measured.is_current { "measured by Run" } else { "measured by Run for an earlier scene" };
    let run = measured.run.as_ref().map_or_else(Vec::new, |run| run.skipped_work.clone());
    let sections = [
        Section { when: at_the_run, is_old: !measured.is_current, rows: run },
        Section { when: SINCE_THE_START, is_old: false, rows: measured.remembered.clone() },
    ];
    sections.into_iter().filter(|section| !section.rows.is_empty()).collect()
}

/// As bars over time; none before anything was measured or remembered.
pub fn figure(input: &FigureInput<'_>) -> Option<Figure> {
    let sections = sections(input.measured);
    let rows = || sections.iter().flat_map(|section| &section.rows);
    let lines = rows().count() + sections.len();
    if sections.is_empty() {
        return None;
    }
    let mut figure = Figure::new(
        "Time saved by skipped work",
        [input.view.room.width.unwrap_or(WIDTH), AROUND + ROW * lines as f64],
    );
    let saved = |row: &SkippedWork| row.saved.max(1e-9).log10();
    let timed = rows().filter(|row| row.saved > 0.0).map(saved);
    let (low, high) = timed.fold((-6.0_f64, -3.0_f64), |(low, high), s| (low.min(s), high.max(s)));
    let (low, high) = (low.floor(), high.ceil() + 4.0);
    let ticks = (low as i32..=high as i32).map(|e| (f64::from(e), duration(10_f64.powi(e)))).collect();
    let x = Axis::new("time saved", [low, high]).with_ticks(Ticks::At(ticks));
    let y = Axis::new("", [lines as f64, 0.0]).with_ticks(Ticks::None).with_grid(false);
    let mut panel = Panel::new("skipped", Rect::from_min_size([0.0, 0.0], figure.size), x, y);
    let text = |name: &str, at: [f64; 2], text: String| {
        let text = Mark::text(text, at, Anchor::LEFT, TextSize::Small, InkRole::Text);
        Mark { name: name.to_owned(), ..text.with_offset([6.0, 0.0]).with_halo(InkRole::Plot) }
    };
    let mut middle = 0.5;
    for section in &sections {
        panel.marks.push(text(section.when, [low, middle], capitalized(section.when)));
        for row in &section.rows {
            middle += 1.0;
            let mut end = low;
            if row.saved > 0.0 {
                end = saved(row);
                let bar = Shape::Rect { min: [low, middle - 0.3], max: [end, middle + 0.3] };
                panel.marks.push(Mark::new(Tag::default(), row.what.as_ref(), bar).with_fill(InkRole::Weak));
            }
            panel.marks.push(text(&row.what, [end, middle], format!("{}, {}", row.what, time(row))));
        }
        middle += 1.0;
    }
    figure.panels.push(panel);
    figure.caption = format!("Skipped work, and the time that computing it would take. {OVERLAP}");
    figure.table = table(&sections);
    Some(figure)
}

fn time(row: &SkippedWork) -> String {
    if row.saved > 0.0 { duration(row.saved) } else { "time not measured".to_owned() }
}

/// As numbers.
pub fn table(sections: &[Section]) -> Table {
    let mut table = Table::new(["skipped", "time saved (ms)", "measured by", "count", "of", "share (%)", "when"]);
    for section in sections {
        for row in &section.rows {
            table.push([
                row.what.as_ref().into(),
                (row.saved > 0.0).then_some(row.saved * 1e3).into(),
                row.how.as_str().into(),
                Cell::Number(row.count as f64),
                row.of.map(|of| of as f64).into(),
                row.of.filter(|of| *of > 0).map(|of| 100.0 * row.count as f64 / of as f64).into(),
                section.when.into(),
            ]);
        }
    }
    table
}

/// Work saved by caching since the start, by kind of query. Times are those that `run` measured without a cache.
pub fn remembered(counts: &[(&'static str, Count)], run: &[SkippedWork]) -> Vec<SkippedWork> {
    let reused = |&(name, count): &(&'static str, Count)| {
        let what = STAGES.iter().find(|(stage, _)| *stage == name)?.1;
        let made = format!("computed {}×", count.misses);
        let (each, how) = match FROM_NOTHING.iter().find(|(stage, _)| *stage == name) {
            None => {
                let each = count.own_time.as_secs_f64() / count.misses.max(1) as f64;
                (each, format!("{made}, {} each, with inputs cached", duration(each)))
            }
            Some((_, row)) => match run.iter().find(|measured| measured.what == *row) {
                Some(measured) => {
                    let each = measured.saved / measured.count.max(1) as f64;
                    (each, format!("{made}, {} each, measured by Run without cached inputs", duration(each)))
                }
                None => (0.0, format!("{made}; Run measures the time")),
            },
        };
        (count.hits > 0).then(|| SkippedWork {
            what: what.into(),
            count: count.hits,
            of: Some(count.hits + count.misses),
            saved: each * count.hits as f64,
            how,
        })
    };
    counts.iter().filter_map(reused).collect()
}

/// Stages that a run measures from nothing, with its rows.
const FROM_NOTHING: [(&str, &str); 2] = [("locus", LOCI), ("patch colors", PATCHES)];

/// Stages whose answers are worth telling of when they are remembered.
const STAGES: [(&str, &str); 11] = [
    ("mesh", "meshes"),
    ("shadow tree", "shadow trees"),
    ("visibility", "visibilities of a mesh"),
    ("geometry", "angles and shadows"),
    ("shading", "surfaces at all samples"),
    ("plan", "integration methods of a camera"),
    ("camera image", "signals of a camera"),
    ("picture", "pixels of a picture"),
    ("locus", "loci"),
    ("radiator signals", "blackbodies through a sensor"),
    ("patch colors", "patches of a sensor"),
];

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn a_locus_takes_one_time_whoever_tells() {
        let time = Duration::from_micros(100);
        let counts = [
            ("locus", Count { hits: 10, misses: 2, time, own_time: time, ..Count::default() }),
            ("patch colors", Count::default()),
        ];
        let run = SkippedWork { what: LOCI.into(), count: 4, of: None, saved: 0.02, how: String::new() };
        let rows = remembered(&counts, &[run]);
        assert_eq!(rows.len(), 1, "what was not asked for again saved nothing");
        assert!((rows[0].saved - 0.05).abs() < 1e-12, "10 times 5 ms: {}", rows[0].saved);
        assert_eq!(remembered(&counts, &[])[0].saved, 0.0, "not known before a run");
    }
}
