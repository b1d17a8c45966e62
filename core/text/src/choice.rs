//! Named alternatives: one enum holds the words of its alternatives for lists, flags, help, tables and sessions.

/// Words of one alternative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Words {
    /// Name on the command line, in tables and exported files.
    pub key: &'static str,
    /// Name in a list.
    pub label: &'static str,
    /// Reason to choose it, for hover and help text.
    pub why: &'static str,
    /// Other names that the command line takes.
    pub aliases: &'static [&'static str],
}

impl Words {
    /// Words without other names.
    pub const fn new(key: &'static str, label: &'static str, why: &'static str) -> Self {
        Self { key, label, why, aliases: &[] }
    }

    /// The first sentence of the reason, without its full stop.
    pub fn brief(&self) -> &'static str {
        self.why.split_once(". ").map_or(self.why, |(first, _)| first).trim_end_matches('.')
    }
}

/// A closed set of named alternatives. Made by `choices!`.
pub trait Choice: Copy + PartialEq + Send + Sync + 'static {
    /// All alternatives, in the order in which they are listed.
    const ALL: &'static [Self];

    /// Words of the alternative.
    fn words(self) -> &'static Words;

    /// The alternative of a key or another of its names.
    fn parse(name: &str) -> Option<Self> {
        let is_named = |words: &Words| words.key == name || words.aliases.contains(&name);
        Self::ALL.iter().copied().find(|choice| is_named(choice.words()))
    }
}

/// Declares an enum with the words of its alternatives: key and other names, label, and the reason to choose it.
///
/// ```
/// chromascope_text::choices! {
///     /// Unit of lengths.
///     #[derive(Clone, Copy, Debug, PartialEq)]
///     pub enum LengthUnit {
///         /// Millimeters.
///         Millimeter = "mm" | "millimeter", "Millimeters", "As journals state widths";
///         /// Inches.
///         Inch = "in", "Inches", "As some printers do";
///     }
/// }
/// use chromascope_text::Choice as _;
/// assert_eq!(LengthUnit::parse("millimeter"), Some(LengthUnit::Millimeter));
/// assert_eq!(LengthUnit::ALL.map(LengthUnit::label), ["Millimeters", "Inches"]);
/// ```
#[macro_export]
macro_rules! choices {
    ($(#[$outer:meta])* $vis:vis enum $Name:ident {
        $($(#[$inner:meta])* $Variant:ident = $key:literal $(| $alias:literal)*, $label:expr, $why:expr;)+
    }) => {
        $(#[$outer])*
        $vis enum $Name {
            $($(#[$inner])* $Variant,)+
        }

        #[allow(dead_code, reason = "not every enum needs all of its words")]
        impl $Name {
            /// All alternatives, in the order in which they are listed.
            $vis const ALL: [Self; [$($key),+].len()] = [$(Self::$Variant),+];

            /// Name on the command line, in tables and exported files.
            $vis const fn key(self) -> &'static str {
                self.words().key
            }

            /// Name in a list.
            $vis const fn label(self) -> &'static str {
                self.words().label
            }

            /// Reason to choose it, for hover and help text.
            $vis const fn why(self) -> &'static str {
                self.words().why
            }

            /// Words of the alternative.
            $vis const fn words(self) -> &'static $crate::choice::Words {
                match self {
                    $(Self::$Variant => {
                        &$crate::choice::Words { key: $key, label: $label, why: $why, aliases: &[$($alias),*] }
                    })+
                }
            }
        }

        impl $crate::choice::Choice for $Name {
            const ALL: &'static [Self] = &[$(Self::$Variant),+];

            fn words(self) -> &'static $crate::choice::Words {
                self.words()
            }
        }
    };
}
