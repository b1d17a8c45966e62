//! Formulas in the subset of TeX that the help pages use: a parser to a tree, which the window lays out.
//!
//! Greek letters, operators, sub- and superscripts, fractions, roots, accents, sums and integrals with limits, named functions,
//! upright text, spaces, matrices in parentheses and aligned lines.

use std::iter::Peekable;
use std::vec::IntoIter;

use thiserror::Error;

#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    pub root: Node,
    /// The formula in one line of text, for search and screen readers.
    pub words: String,
    /// True for display style, on a separate line.
    pub display: bool,
}

/// A part of a formula. Scripts stand below and above a large operator; a space is horizontal, in em; what is fenced stands between
/// delimiters of its height; columns of an array are centered or, where it is aligned, alternate between right and left without a gap.
#[derive(Clone, Debug, PartialEq)]
pub enum Node {
    Row(Vec<Node>),
    Symbol { text: String, kind: SymbolKind },
    Fraction(Box<Node>, Box<Node>),
    Root(Box<Node>),
    Scripts { base: Box<Node>, lower: Option<Box<Node>>, upper: Option<Box<Node>> },
    Accent(Box<Node>, char),
    Space(f32),
    Fenced(char, Box<Node>, char),
    Array { rows: Vec<Vec<Node>>, aligned: bool },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SymbolKind {
    /// A variable: slanted.
    Variable,
    /// Upright: digits, brackets, capital Greek, text.
    Upright,
    Function,
    /// A binary operator or relation: space on both sides.
    Relation,
    Punctuation,
    Large,
}

#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum FormulaError {
    #[error("unknown command \\{0}")]
    Command(String),
    #[error("missing {0}")]
    Missing(&'static str),
}

impl Formula {
    /// Parses TeX. `display` selects display style.
    pub fn parse(tex: &str, display: bool) -> Result<Self, FormulaError> {
        let mut parser = Reader { tokens: tokens(tex).into_iter().peekable() };
        let root = parser.row(&[])?;
        let mut words = String::new();
        root.say(&mut words);
        Ok(Self { root, words, display })
    }
}

impl Node {
    fn say(&self, out: &mut String) {
        match self {
            Self::Row(parts) => parts.iter().for_each(|part| part.say(out)),
            Self::Symbol { text, kind: SymbolKind::Relation } => {
                out.push(' ');
                out.push_str(text);
                out.push(' ');
            }
            Self::Symbol { text, kind: SymbolKind::Function | SymbolKind::Punctuation } => {
                out.push_str(text);
                out.push(' ');
            }
            Self::Symbol { text, .. } => out.push_str(text),
            Self::Fraction(over, under) => {
                say_grouped(over, out);
                out.push('/');
                say_grouped(under, out);
            }
            Self::Root(inner) => {
                out.push('√');
                say_grouped(inner, out);
            }
            Self::Scripts { base, lower, upper } => {
                base.say(out);
                for (mark, script) in [('_', lower), ('^', upper)] {
                    if let Some(script) = script {
                        out.push(mark);
                        say_grouped(script, out);
                    }
                }
            }
            Self::Accent(base, _) => base.say(out),
            Self::Space(_) => out.push(' '),
            Self::Fenced(open, inner, close) => {
                out.push(*open);
                inner.say(out);
                out.push(*close);
            }
            Self::Array { rows, .. } => {
                for (index, row) in rows.iter().enumerate() {
                    out.push_str(if index > 0 { "; " } else { "" });
                    for (index, cell) in row.iter().enumerate() {
                        out.push_str(if index > 0 { " " } else { "" });
                        cell.say(out);
                    }
                }
            }
        }
    }
}

/// Text of a part, in parentheses unless it is one symbol.
fn say_grouped(node: &Node, out: &mut String) {
    let mut words = String::new();
    node.say(&mut words);
    let words = words.trim();
    let single = words.chars().count() == 1 || words.chars().all(char::is_alphanumeric);
    let parentheses = if single { ["", ""] } else { ["(", ")"] };
    out.extend([parentheses[0], words, parentheses[1]]);
}

#[derive(Clone, Debug, PartialEq)]
enum Token {
    Command(String),
    Char(char),
}

fn tokens(tex: &str) -> Vec<Token> {
    let mut found = Vec::new();
    let mut letters = tex.chars().peekable();
    while let Some(letter) = letters.next() {
        if letter != '\\' {
            found.push(Token::Char(letter));
            continue;
        }
        let mut name = String::new();
        while let Some(letter) = letters.next_if(char::is_ascii_alphabetic) {
            name.push(letter);
        }
        if name.is_empty() {
            name.extend(letters.next());
        }
        found.push(Token::Command(name));
    }
    found
}

struct Reader {
    tokens: Peekable<IntoIter<Token>>,
}

/// Ends of a row: a closing brace, a cell's end, a row's end, or a command.
const BRACE: Token = Token::Char('}');
const CELL: Token = Token::Char('&');

impl Reader {
    /// Parts up to one of the ends, which is not consumed; up to the formula's end without ends.
    fn row(&mut self, ends: &[Token]) -> Result<Node, FormulaError> {
        let mut parts: Vec<Node> = Vec::new();
        loop {
            let Some(token) = self.tokens.peek() else {
                return if ends.is_empty() { Ok(joined(parts)) } else { Err(FormulaError::Missing("end of a group")) };
            };
            if ends.contains(token) {
                return Ok(joined(parts));
            }
            match *token {
                Token::Char(' ' | '\n') => {
                    self.tokens.next();
                }
                Token::Char(mark @ ('_' | '^' | '\'')) => {
                    self.tokens.next();
                    let script = if mark == '\'' { upright("′") } else { self.argument()? };
                    let base = parts.pop().ok_or(FormulaError::Missing("base of a script"))?;
                    parts.push(scripted(base, mark, script));
                }
                _ => parts.push(self.atom()?),
            }
        }
    }

    /// One symbol, group or command with its arguments.
    fn atom(&mut self) -> Result<Node, FormulaError> {
        match self.tokens.next().ok_or(FormulaError::Missing("argument"))? {
            Token::Char('{') => {
                let inner = self.row(&[BRACE])?;
                self.tokens.next();
                Ok(inner)
            }
            Token::Char('}') => Err(FormulaError::Missing("opening brace")),
            Token::Char(letter) => Ok(character(letter)),
            Token::Command(name) => self.command(&name),
        }
    }

    fn argument(&mut self) -> Result<Node, FormulaError> {
        while self.tokens.next_if(|token| matches!(token, Token::Char(' ' | '\n'))).is_some() {}
        self.atom()
    }

    fn command(&mut self, name: &str) -> Result<Node, FormulaError> {
        Ok(match name {
            "frac" | "tfrac" | "dfrac" => Node::Fraction(Box::new(self.argument()?), Box::new(self.argument()?)),
            "sqrt" => Node::Root(Box::new(self.argument()?)),
            "hat" => Node::Accent(Box::new(self.argument()?), 'ˆ'),
            "bar" | "overline" => Node::Accent(Box::new(self.argument()?), '¯'),
            "tilde" => Node::Accent(Box::new(self.argument()?), '˜'),
            "text" | "mathrm" | "operatorname" => {
                let text = self.raw_group()?;
                let kind = if name == "operatorname" { SymbolKind::Function } else { SymbolKind::Upright };
                Node::Symbol { text, kind }
            }
            "left" => self.fenced()?,
            "begin" => self.array()?,
            "," => Node::Space(0.17),
            ":" => Node::Space(0.22),
            ";" | " " => Node::Space(0.28),
            "!" => Node::Space(-0.17),
            "quad" => Node::Space(1.0),
            "qquad" => Node::Space(2.0),
            _ => symbol(name).ok_or_else(|| FormulaError::Command(name.to_owned()))?,
        })
    }

    /// The text between braces as it is.
    fn raw_group(&mut self) -> Result<String, FormulaError> {
        self.tokens.next_if_eq(&Token::Char('{')).ok_or(FormulaError::Missing("opening brace"))?;
        let mut text = String::new();
        loop {
            match self.tokens.next() {
                Some(BRACE) => return Ok(text),
                Some(Token::Char(letter)) => text.push(letter),
                Some(Token::Command(name)) => return Err(FormulaError::Command(name)),
                None => return Err(FormulaError::Missing("closing brace")),
            }
        }
    }

    fn fenced(&mut self) -> Result<Node, FormulaError> {
        let open = self.delimiter()?;
        let inner = self.row(&[Token::Command("right".to_owned())])?;
        self.tokens.next();
        Ok(Node::Fenced(open, Box::new(inner), self.delimiter()?))
    }

    fn delimiter(&mut self) -> Result<char, FormulaError> {
        match self.tokens.next() {
            Some(Token::Char('.')) => Ok(' '),
            Some(Token::Char(mark @ ('(' | ')' | '[' | ']' | '|'))) => Ok(mark),
            Some(Token::Command(name)) if name == "{" || name == "}" => Ok(if name == "{" { '{' } else { '}' }),
            _ => Err(FormulaError::Missing("delimiter")),
        }
    }

    fn array(&mut self) -> Result<Node, FormulaError> {
        let name = self.raw_group()?;
        if !matches!(name.as_str(), "pmatrix" | "aligned" | "matrix") {
            return Err(FormulaError::Command(format!("begin{{{name}}}")));
        }
        let (row, end) = (Token::Command("\\".to_owned()), Token::Command("end".to_owned()));
        let mut rows = vec![Vec::new()];
        loop {
            let cell = self.row(&[CELL, row.clone(), end.clone()])?;
            let last = rows.len() - 1;
            rows[last].push(cell);
            match self.tokens.next() {
                Some(token) if token == row => rows.push(Vec::new()),
                Some(token) if token == end => break,
                _ => {}
            }
        }
        self.raw_group()?;
        let array = Node::Array { rows, aligned: name == "aligned" };
        Ok(if name == "pmatrix" { Node::Fenced('(', Box::new(array), ')') } else { array })
    }
}

fn joined(mut parts: Vec<Node>) -> Node {
    if parts.len() == 1 { parts.remove(0) } else { Node::Row(parts) }
}

fn upright(text: &str) -> Node {
    Node::Symbol { text: text.to_owned(), kind: SymbolKind::Upright }
}

fn scripted(base: Node, mark: char, script: Node) -> Node {
    let script = Some(Box::new(script));
    match base {
        Node::Scripts { base, lower: None, upper } if mark == '_' => Node::Scripts { base, lower: script, upper },
        Node::Scripts { base, lower, upper: None } if mark != '_' => Node::Scripts { base, lower, upper: script },
        base if mark == '_' => Node::Scripts { base: Box::new(base), lower: script, upper: None },
        base => Node::Scripts { base: Box::new(base), lower: None, upper: script },
    }
}

fn character(letter: char) -> Node {
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

/// Commands and their symbols, by kind.
const SYMBOLS: [(SymbolKind, &str); 5] = [
    (
        SymbolKind::Variable,
        "alpha α beta β gamma γ delta δ varepsilon ε eta η theta θ kappa κ lambda λ mu μ nu ν xi ξ pi π rho ρ sigma σ tau τ \
         varphi φ chi χ psi ψ omega ω",
    ),
    (
        SymbolKind::Relation,
        "cdot · times × pm ± le ≤ leq ≤ ge ≥ geq ≥ ne ≠ ll ≪ gg ≫ approx ≈ sim ∼ propto ∝ to → in ∈ lt < gt > mapsto ↦",
    ),
    (
        SymbolKind::Upright,
        "Gamma Γ Delta Δ Lambda Λ Sigma Σ Phi Φ Psi Ψ Omega Ω infty ∞ partial ∂ ldots … dots … ell ℓ circ ° prime ′ % % \
         { { } } lvert | rvert | lVert ‖ rVert ‖ lbrace { rbrace }",
    ),
    (SymbolKind::Large, "sum ∑ prod ∏ int ∫"),
    (SymbolKind::Function, "sin sin cos cos tan tan exp exp ln ln log log min min max max arcsin arcsin"),
];

fn symbol(name: &str) -> Option<Node> {
    SYMBOLS.into_iter().find_map(|(kind, pairs)| {
        let mut words = pairs.split(' ');
        let text = std::iter::from_fn(|| words.next().zip(words.next())).find(|(command, _)| *command == name)?.1;
        Some(Node::Symbol { text: text.to_owned(), kind })
    })
}
