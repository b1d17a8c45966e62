//! Layout of formulas: a tree of nodes becomes glyphs and rules at places relative to a baseline.

use std::sync::Arc;

use egui::text::LayoutJob;
use egui::{Color32, FontId, Galley, Painter, Pos2, Stroke, TextFormat, Vec2};

use crate::help::formula::{Node, SymbolKind};

/// Height of the math axis, on which fractions and operators are centered, in em.
const AXIS: f32 = 0.32;
const SCRIPT: f32 = 0.74;
const SMALLEST: f32 = 8.5;
const RULE: f32 = 1.0;

/// A laid-out formula or part of one. The origin is the left end of the baseline; y points down.
#[derive(Clone, Default)]
pub(super) struct Typeset {
    pub(super) width: f32,
    pub(super) ascent: f32,
    pub(super) descent: f32,
    items: Vec<(Vec2, Item)>,
}

#[derive(Clone)]
enum Item {
    Text(Arc<Galley>),
    Line(Vec<Vec2>),
}

impl Typeset {
    /// Paints with the baseline's left end at a place.
    pub(super) fn paint(&self, painter: &Painter, origin: Pos2, color: Color32) {
        for (offset, item) in &self.items {
            match item {
                Item::Text(galley) => painter.galley_with_override_text_color(origin + *offset, galley.clone(), color),
                Item::Line(points) => {
                    let points = points.iter().map(|point| origin + *offset + *point).collect();
                    painter.line(points, Stroke::new(RULE, color));
                }
            }
        }
    }

    /// Adds a part with its baseline's left end at an offset; extents grow, the width does not.
    fn place(&mut self, part: Self, at: Vec2) {
        self.ascent = self.ascent.max(part.ascent - at.y);
        self.descent = self.descent.max(part.descent + at.y);
        self.items.extend(part.items.into_iter().map(|(offset, item)| (offset + at, item)));
    }

    fn append(&mut self, part: Self, gap: f32) {
        let width = part.width;
        self.place(part, Vec2::new(self.width + gap, 0.0));
        self.width += gap + width;
    }

    fn height(&self) -> f32 {
        self.ascent + self.descent
    }
}

pub(super) fn typeset(painter: &Painter, root: &Node, size: f32, display: bool) -> Typeset {
    Setter { painter }.set(root, size, display)
}

pub(super) fn baseline(galley: &Galley) -> f32 {
    galley.rows.first().map_or(0.0, |row| row.pos.y + row.row.glyphs.first().map_or(0.0, |glyph| glyph.pos.y))
}

struct Setter<'a> {
    painter: &'a Painter,
}

impl Setter<'_> {
    fn set(&self, node: &Node, size: f32, display: bool) -> Typeset {
        match node {
            Node::Row(parts) => self.row(parts, size, display),
            Node::Symbol { text, kind: SymbolKind::Large } => self.large(text, size, display),
            Node::Symbol { text, kind } => self.glyphs(text, size, *kind == SymbolKind::Variable),
            Node::Fraction(over, under) => self.fraction(over, under, size, display),
            Node::Root(inner) => self.root(inner, size, display),
            Node::Scripts { base, lower, upper } => {
                self.scripts(base, lower.as_deref(), upper.as_deref(), size, display)
            }
            Node::Accent(base, accent) => self.accent(base, *accent, size),
            Node::Space(em) => Typeset { width: em * size, ..Typeset::default() },
            Node::Fenced(open, inner, close) => self.fenced(*open, inner, *close, size, display),
            Node::Array { rows, aligned } => self.array(rows, *aligned, size, display),
        }
    }

    fn glyphs(&self, text: &str, size: f32, italics: bool) -> Typeset {
        let format = TextFormat { italics, font_id: FontId::proportional(size), ..TextFormat::default() };
        let mut job = LayoutJob::single_section(text.to_owned(), format);
        job.wrap.max_width = f32::INFINITY;
        let galley = self.painter.layout_job(job);
        let ink = galley.rows.iter().flat_map(|row| &row.row.glyphs).filter(|glyph| glyph.uv_rect.size.y > 0.0);
        let (mut ascent, mut descent) = (f32::NEG_INFINITY, f32::NEG_INFINITY);
        for glyph in ink {
            ascent = ascent.max(-glyph.uv_rect.offset.y);
            descent = descent.max(glyph.uv_rect.offset.y + glyph.uv_rect.size.y);
        }
        if !ascent.is_finite() {
            (ascent, descent) = (0.0, 0.0);
        }
        let top = Vec2::new(0.0, -baseline(&galley));
        Typeset { width: galley.size().x, ascent, descent, items: vec![(top, Item::Text(galley))] }
    }

    fn row(&self, parts: &[Node], size: f32, display: bool) -> Typeset {
        let mut row = Typeset::default();
        let mut before: Option<SymbolKind> = None;
        for (index, part) in parts.iter().enumerate() {
            let mut kind = kind_of(part);
            // A sign at the beginning or after another operator belongs to what follows.
            if kind == Some(SymbolKind::Relation)
                && (index == 0 || matches!(before, Some(SymbolKind::Relation | SymbolKind::Punctuation)))
            {
                kind = Some(SymbolKind::Upright);
            }
            let gap = if index == 0 { 0.0 } else { gap(before, kind) * size };
            row.append(self.set(part, size, display), gap);
            before = kind;
        }
        row
    }

    fn large(&self, text: &str, size: f32, display: bool) -> Typeset {
        let glyph = self.glyphs(text, (size * if display { 1.6 } else { 1.15 }).round(), false);
        centered(glyph, size)
    }

    fn fraction(&self, over: &Node, under: &Node, size: f32, display: bool) -> Typeset {
        let inner = if display { size } else { smaller(size, 0.82) };
        let [over, under] = [over, under].map(|part| self.set(part, inner, false));
        let (axis, gap, margin) = (-AXIS * size, 0.16 * size, 0.12 * size);
        let bar = over.width.max(under.width) + margin;
        let mut fraction = Typeset { width: bar + 2.0 * margin, ..Typeset::default() };
        let left = |part: &Typeset| margin + (bar - part.width) / 2.0;
        let (above, below) =
            (Vec2::new(left(&over), axis - gap - over.descent), Vec2::new(left(&under), axis + gap + under.ascent));
        fraction.place(over, above);
        fraction.place(under, below);
        fraction.items.push((Vec2::new(margin, axis), Item::Line(vec![Vec2::ZERO, Vec2::new(bar, 0.0)])));
        fraction
    }

    fn root(&self, inner: &Node, size: f32, display: bool) -> Typeset {
        let inner = self.set(inner, size, display);
        let (top, bottom, sign) = (inner.ascent + 0.18 * size, inner.descent + 0.05 * size, 0.6 * size);
        let mut root = Typeset { width: sign + inner.width + 0.1 * size, ascent: top + RULE, ..Typeset::default() };
        let points = [
            (0.0, -0.35 * size),
            (0.15 * size, -0.42 * size),
            (0.35 * size, bottom),
            (sign - 0.05 * size, -top),
            (root.width, -top),
        ];
        root.items.push((Vec2::ZERO, Item::Line(points.map(|(x, y)| Vec2::new(x, y)).to_vec())));
        root.place(inner, Vec2::new(sign, 0.0));
        root
    }

    fn scripts(&self, base: &Node, lower: Option<&Node>, upper: Option<&Node>, size: f32, display: bool) -> Typeset {
        let set = |part: &Node| self.set(part, smaller(size, SCRIPT), false);
        let (lower, upper) = (lower.map(set), upper.map(set));
        let mut all = self.set(base, size, display);
        let is_sum = matches!(base, Node::Symbol { text, kind: SymbolKind::Large } if text != "∫");
        if display && is_sum {
            return with_limits(all, lower, upper, size);
        }
        let (ascent, descent) = (all.ascent, all.descent);
        let start = all.width + 0.04 * size;
        let mut width = all.width;
        if let Some(upper) = upper {
            let raise = (0.36 * size).max(ascent - 0.34 * size);
            width = width.max(start + upper.width);
            all.place(upper, Vec2::new(start, -raise));
        }
        if let Some(lower) = lower {
            let drop = (0.2 * size).max(descent + 0.02 * size);
            width = width.max(start + lower.width);
            all.place(lower, Vec2::new(start, drop));
        }
        all.width = width;
        all
    }

    fn accent(&self, base: &Node, accent: char, size: f32) -> Typeset {
        let mut all = self.set(base, size, false);
        let mark = self.glyphs(&accent.to_string(), size, false);
        let raise = all.ascent + 0.06 * size + mark.descent;
        let x = (all.width - mark.width) / 2.0 + 0.06 * size;
        all.place(mark, Vec2::new(x, -raise));
        all
    }

    fn fenced(&self, open: char, inner: &Node, close: char, size: f32, display: bool) -> Typeset {
        let inner = self.set(inner, size, display);
        let fence = |mark: char| {
            let usual = self.glyphs(&mark.to_string(), size, false);
            let scale = inner.height() / usual.height().max(1.0);
            if mark == ' ' || scale <= 1.1 {
                return usual;
            }
            let large = self.glyphs(&mark.to_string(), (size * scale * 1.05).round(), false);
            let [upper, lower] = [large.ascent - inner.ascent, large.descent - inner.descent];
            let shift = 0.5 * (upper - lower);
            let mut fence = Typeset { width: large.width, ..Typeset::default() };
            fence.place(large, Vec2::new(0.0, shift));
            fence
        };
        let (open, close) = (fence(open), fence(close));
        let mut all = open;
        all.append(inner, 0.0);
        all.append(close, 0.0);
        all
    }

    fn array(&self, rows: &[Vec<Node>], aligned: bool, size: f32, display: bool) -> Typeset {
        let cells: Vec<Vec<Typeset>> =
            rows.iter().map(|row| row.iter().map(|cell| self.set(cell, size, display && aligned)).collect()).collect();
        let columns = cells.iter().map(Vec::len).max().unwrap_or(0);
        let width =
            |column: usize| cells.iter().filter_map(|row| row.get(column)).map(|cell| cell.width).fold(0.0, f32::max);
        let widths: Vec<f32> = (0..columns).map(width).collect();
        let gap = if aligned { 0.25 * size } else { 0.9 * size };
        let mut array = Typeset::default();
        let mut y = 0.0;
        for (index, row) in cells.into_iter().enumerate() {
            let ascent = row.iter().fold(0.7 * size, |most, cell| most.max(cell.ascent));
            let descent = row.iter().fold(0.2 * size, |most, cell| most.max(cell.descent));
            y += ascent + if index > 0 { 0.45 * size } else { 0.0 };
            let mut x = 0.0;
            for (column, cell) in row.into_iter().enumerate() {
                let room = widths[column] - cell.width;
                let indent = match (aligned, column % 2) {
                    (true, 0) => room,
                    (true, _) => 0.0,
                    (false, _) => room / 2.0,
                };
                array.place(cell, Vec2::new(x + indent, y));
                x += widths[column] + gap;
            }
            y += descent;
        }
        array.width = widths.iter().sum::<f32>() + gap * columns.saturating_sub(1) as f32;
        centered(array, size)
    }
}

fn smaller(size: f32, factor: f32) -> f32 {
    (size * factor).max(SMALLEST.min(size))
}

/// Moves a part vertically so that its middle is on the axis.
fn centered(part: Typeset, size: f32) -> Typeset {
    let shift = (part.ascent - part.descent) / 2.0 - AXIS * size;
    let mut moved =
        Typeset { width: part.width, ascent: part.ascent - shift, descent: part.descent + shift, items: Vec::new() };
    moved.place(part, Vec2::new(0.0, shift));
    moved
}

fn with_limits(base: Typeset, lower: Option<Typeset>, upper: Option<Typeset>, size: f32) -> Typeset {
    let width = [&lower, &upper].into_iter().flatten().fold(base.width, |most, limit| most.max(limit.width));
    let (ascent, descent, gap) = (base.ascent, base.descent, 0.15 * size);
    let mut all = Typeset { width, ..Typeset::default() };
    let x = (width - base.width) / 2.0;
    all.place(base, Vec2::new(x, 0.0));
    if let Some(upper) = upper {
        let at = Vec2::new((width - upper.width) / 2.0, -(ascent + gap + upper.descent));
        all.place(upper, at);
    }
    if let Some(lower) = lower {
        let at = Vec2::new((width - lower.width) / 2.0, descent + gap + lower.ascent);
        all.place(lower, at);
    }
    all
}

/// Kind of a part for the spacing around it.
fn kind_of(node: &Node) -> Option<SymbolKind> {
    match node {
        Node::Symbol { kind, .. } => Some(*kind),
        Node::Scripts { base, .. } => kind_of(base),
        _ => None,
    }
}

fn gap(before: Option<SymbolKind>, after: Option<SymbolKind>) -> f32 {
    use SymbolKind::{Function, Large, Punctuation, Relation};
    match (before, after) {
        (Some(Relation), _) | (_, Some(Relation)) => 0.24,
        (Some(Punctuation), _) => 0.2,
        (Some(Function | Large), _) | (_, Some(Function | Large)) => 0.14,
        _ => 0.02,
    }
}
