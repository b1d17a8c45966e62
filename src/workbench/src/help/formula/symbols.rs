//! Symbols of formulas: characters and commands, and how they are set.

use super::{Node, SymbolKind};

/// Symbol of a character.
pub(super) fn character(letter: char) -> Node {
    let (text, kind) = match letter {
        '-' => ("−".to_owned(), SymbolKind::Relation),
        '=' | '+' | '<' | '>' => (letter.to_string(), SymbolKind::Relation),
        '*' => ("∗".to_owned(), SymbolKind::Upright),
        ',' | ';' => (letter.to_string(), SymbolKind::Punctuation),
        _ if letter.is_alphabetic() => (letter.to_string(), SymbolKind::Variable),
        _ => (letter.to_string(), SymbolKind::Upright),
    };
    Node::Symbol { text, kind }
}

/// Commands for lower-case Greek letters, which are variables.
const GREEK: [(&str, &str); 20] = [
    ("alpha", "α"),
    ("beta", "β"),
    ("gamma", "γ"),
    ("delta", "δ"),
    ("varepsilon", "ε"),
    ("eta", "η"),
    ("theta", "θ"),
    ("kappa", "κ"),
    ("lambda", "λ"),
    ("mu", "μ"),
    ("nu", "ν"),
    ("xi", "ξ"),
    ("pi", "π"),
    ("rho", "ρ"),
    ("sigma", "σ"),
    ("tau", "τ"),
    ("varphi", "φ"),
    ("chi", "χ"),
    ("psi", "ψ"),
    ("omega", "ω"),
];

/// Commands for operators and relations.
const RELATIONS: [(&str, &str); 18] = [
    ("cdot", "·"),
    ("times", "×"),
    ("pm", "±"),
    ("le", "≤"),
    ("leq", "≤"),
    ("ge", "≥"),
    ("geq", "≥"),
    ("ne", "≠"),
    ("ll", "≪"),
    ("gg", "≫"),
    ("approx", "≈"),
    ("sim", "∼"),
    ("propto", "∝"),
    ("to", "→"),
    ("in", "∈"),
    ("lt", "<"),
    ("gt", ">"),
    ("mapsto", "↦"),
];

/// Commands for upright symbols.
const UPRIGHT: [(&str, &str); 23] = [
    ("Gamma", "Γ"),
    ("Delta", "Δ"),
    ("Lambda", "Λ"),
    ("Sigma", "Σ"),
    ("Phi", "Φ"),
    ("Psi", "Ψ"),
    ("Omega", "Ω"),
    ("infty", "∞"),
    ("partial", "∂"),
    ("ldots", "…"),
    ("dots", "…"),
    ("ell", "ℓ"),
    ("circ", "°"),
    ("prime", "′"),
    ("%", "%"),
    ("{", "{"),
    ("}", "}"),
    ("lvert", "|"),
    ("rvert", "|"),
    ("lVert", "‖"),
    ("rVert", "‖"),
    ("lbrace", "{"),
    ("rbrace", "}"),
];

/// Commands for sums and integrals.
const LARGE: [(&str, &str); 3] = [("sum", "∑"), ("prod", "∏"), ("int", "∫")];

const FUNCTIONS: [&str; 9] = ["sin", "cos", "tan", "exp", "ln", "log", "min", "max", "arcsin"];

/// Symbol of a command, if it is in the subset.
pub(super) fn symbol(name: &str) -> Option<Node> {
    let from = |table: &[(&str, &str)], kind| {
        let text = table.iter().find(|(command, _)| *command == name)?.1.to_owned();
        Some(Node::Symbol { text, kind })
    };
    from(&GREEK, SymbolKind::Variable)
        .or_else(|| from(&RELATIONS, SymbolKind::Relation))
        .or_else(|| from(&UPRIGHT, SymbolKind::Upright))
        .or_else(|| from(&LARGE, SymbolKind::Large))
        .or_else(|| {
            let text = FUNCTIONS.contains(&name).then(|| name.to_owned())?;
            Some(Node::Symbol { text, kind: SymbolKind::Function })
        })
}
