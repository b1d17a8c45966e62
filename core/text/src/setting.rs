//! Settings as data: one entry holds all that control, flag, palette, undo, session and range check need to know.

use crate::choice::{Choice, Words};

/// A setting of `D`.
#[derive(Debug)]
pub struct Setting<D: 'static> {
    /// Name in a session.
    pub key: &'static str,
    /// Name of its control, of its undo step and of its line in the palette.
    pub name: &'static str,
    /// Meaning, for hover and help text, without a full stop.
    pub help: &'static str,
    /// Other words that find it.
    pub found_by: &'static str,
    /// Head of its group in the window.
    pub group: &'static str,
    /// True if its control stands beside the one before.
    pub beside: bool,
    /// Reading, writing and range.
    pub value: Value<D>,
    /// Flag on the command line.
    pub flag: Flag,
    /// Reason that it has no effect now; empty where its control shows why.
    pub idle: fn(&D) -> Option<&'static str>,
}

impl<D> Setting<D> {
    /// An entry to begin with.
    pub const DEFAULT: Self = Self {
        key: "",
        name: "",
        help: "",
        found_by: "",
        group: "",
        beside: false,
        value: Value::Own,
        flag: Flag::NONE,
        idle: |_| None,
    };

    /// Name by which its control is sought: of two numbers, that of the first.
    pub fn sought(&self) -> &'static str {
        if let Value::Pair([(name, ..), _]) = &self.value { name } else { self.name }
    }
}

/// Data with a list of settings.
pub trait Settings: Default + 'static {
    /// All settings, in the order of their controls.
    const ALL: &'static [Setting<Self>];

    /// Flag that excludes those of settings idle with it, with settings as it makes them.
    fn idle_with() -> Option<(&'static str, Self)> {
        None
    }

    /// Brings numbers of a spoiled session within their ranges: to the nearest in range, or to the usual one.
    fn mend(&mut self) {
        let usual = Self::default();
        for number in Self::ALL.iter().flat_map(|setting| setting.value.numbers()) {
            let [low, high] = number.valid.or(number.typed).unwrap_or(number.slider);
            let value = (number.get)(self);
            if !(low..=high).contains(&value) {
                let is_near = number.clamps && value.is_finite();
                (number.set)(self, if is_near { value.clamp(low, high) } else { (number.get)(&usual) });
            }
        }
    }
}

/// Value of a setting.
#[derive(Debug)]
pub enum Value<D: 'static> {
    /// A number.
    Number(Number<D>),
    /// Two numbers with their names and meanings.
    Pair(&'static [(&'static str, &'static str, Number<D>); 2]),
    /// On or off, by a function that reads it and one that sets it.
    Switch(fn(&D) -> bool, fn(&mut D, bool)),
    /// One of some alternatives.
    Choice(Pick<D>),
    /// A set, a file or a place, with a control and a flag of its own.
    Own,
}

/// Words of a switch.
static SWITCH: [Words; 2] = [Words::new("off", "off", ""), Words::new("on", "on", "")];

impl<D> Value<D> {
    /// Numbers of the value.
    pub fn numbers(&self) -> Vec<&Number<D>> {
        match self {
            Self::Number(number) => vec![number],
            Self::Pair([(.., a), (.., b)]) => vec![a, b],
            Self::Switch(..) | Self::Choice(_) | Self::Own => Vec::new(),
        }
    }

    /// Words of its alternatives: those of a choice, off and on for a switch.
    pub fn alternatives(&self) -> Vec<&'static Words> {
        match self {
            Self::Switch(..) => SWITCH.iter().collect(),
            Self::Choice(pick) => (pick.all)(),
            Self::Number(_) | Self::Pair(_) | Self::Own => Vec::new(),
        }
    }

    /// Takes one of its alternatives, by place.
    pub fn choose(&self, of: &mut D, place: usize) {
        match self {
            Self::Switch(_, set) => set(of, place > 0),
            Self::Choice(pick) => (pick.set)(of, place),
            Self::Number(_) | Self::Pair(_) | Self::Own => {}
        }
    }
}

/// A number with its unit and ranges.
#[derive(Debug)]
pub struct Number<D: 'static> {
    /// The value in the unit of its control.
    pub get: fn(&D) -> f64,
    /// Sets it.
    pub set: fn(&mut D, f64),
    /// Unit after the number, with the space before it.
    pub unit: &'static str,
    /// Range of the control.
    pub slider: [f64; 2],
    /// For a slider over powers of ten: the least value above zero.
    pub log_from: Option<f64>,
    /// Range of typed values, where it goes beyond the slider's.
    pub typed: Option<[f64; 2]>,
    /// Step of the control.
    pub step: Option<f64>,
    /// Least value of the control now.
    pub floor: fn(&D) -> f64,
    /// True if it is only typed, at full precision.
    pub field: bool,
    /// Range in a session, where it goes beyond the others.
    pub valid: Option<[f64; 2]>,
    /// True if a session's value out of range becomes the nearest one in range, false if the usual one.
    pub clamps: bool,
}

impl<D> Number<D> {
    /// A number to begin with.
    pub const DEFAULT: Self = Self {
        get: |_| 0.0,
        set: |_, _| (),
        unit: "",
        slider: [0.0, 1.0],
        log_from: None,
        typed: None,
        step: None,
        floor: |_| f64::MIN,
        field: false,
        valid: None,
        clamps: false,
    };

    /// A value of the control within range and step.
    pub fn rounded(&self, value: f64) -> f64 {
        let value = self.step.map_or(value, |step| (value / step).round() / step.recip());
        self.typed.map_or(value, |[low, high]| value.clamp(low, high))
    }
}

/// One of some alternatives, by place.
#[derive(Debug)]
pub struct Pick<D: 'static> {
    /// Place of the alternative that is chosen.
    pub get: fn(&D) -> usize,
    /// Chooses one by its place.
    pub set: fn(&mut D, usize),
    /// Words of all of them.
    pub all: fn() -> Vec<&'static Words>,
    /// Form of the control.
    pub look: Look,
}

/// Form of the control of a choice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// A list that drops down.
    List,
    /// Buttons side by side.
    Row,
    /// Round switches side by side.
    Radio,
}

/// Place of an alternative among all of its kind.
pub fn place<T: Choice>(choice: T) -> usize {
    T::ALL.iter().position(|other| *other == choice).unwrap_or_default()
}

/// Words of all alternatives.
pub fn words_of<T: Choice>() -> Vec<&'static Words> {
    T::ALL.iter().map(|choice| choice.words()).collect()
}

/// A list of settings, each as `"key" "name" in entry, by "other words", "help", value, flag;`. A flag is `flag(others, "name",
/// "value", "end of help"; more)` with fields of [`Flag`], `elsewhere("name")` or `none()`. A value is one of
///
/// - `field(field, unit, range; more)`: a field that is a number; what follows are fields of [`Number`]
/// - `number(get, set, unit, range; more)`: a number that is read and set by functions
/// - `pair(name, help, name, help; field, unit, range)`: two numbers of a field that are typed
/// - `switch(get, set)`: on or off
/// - `pick(field: Choice, look)`, and with `, or words` a field that is an optional choice
/// - `choice(pick)`: a [`Pick`]
/// - `own()`: a value with a control and a flag of its own
#[macro_export]
macro_rules! settings {
    ($($key:literal $name:literal in $base:expr, by $by:literal, $help:expr, $kind:ident($($value:tt)*), $flag:ident($($of_flag:tt)*);)+) => {
        &[$($crate::Setting {
            key: $key,
            name: $name,
            help: $help,
            found_by: $by,
            value: $crate::settings!(@$kind $($value)*),
            flag: $crate::settings!(@$flag $($of_flag)*),
            ..$base
        }),+]
    };
    (@field $field:ident, $($more:tt)*) => {
        $crate::settings!(@number |of| of.$field, |of, to| of.$field = to, $($more)*)
    };
    (@number $get:expr, $set:expr, $unit:expr, $range:expr; $($more:ident: $to:expr),*) => {
        $crate::Value::Number($crate::Number {
            get: $get,
            set: $set,
            unit: $unit,
            slider: $range,
            $($more: $to,)*
            ..$crate::Number::DEFAULT
        })
    };
    (@pair $a:expr, $about:expr, $b:expr, $of_b:expr; $field:ident, $unit:expr, $range:expr) => {
        $crate::Value::Pair(&[
            ($a, $about, $crate::settings!(@one $field[0], $unit, $range)),
            ($b, $of_b, $crate::settings!(@one $field[1], $unit, $range)),
        ])
    };
    (@one $field:ident[$index:literal], $unit:expr, $range:expr) => {
        $crate::Number {
            get: |of| of.$field[$index],
            set: |of, to| of.$field[$index] = to,
            unit: $unit,
            slider: $range,
            field: true,
            ..$crate::Number::DEFAULT
        }
    };
    (@switch $get:expr, $set:expr) => { $crate::Value::Switch($get, $set) };
    (@pick $field:ident: $Kind:ty, $look:ident) => {
        $crate::Value::Choice($crate::Pick {
            get: |of| $crate::place(of.$field),
            set: |of, to| of.$field = <$Kind as $crate::Choice>::ALL[to],
            all: $crate::words_of::<$Kind>,
            look: $crate::Look::$look,
        })
    };
    (@pick $field:ident: $Kind:ty, $look:ident, or $none:expr) => {
        $crate::Value::Choice($crate::Pick {
            get: |of| of.$field.map_or(0, |choice| 1 + $crate::place(choice)),
            set: |of, to| of.$field = to.checked_sub(1).map(|to| <$Kind as $crate::Choice>::ALL[to]),
            all: || [&$none].into_iter().chain($crate::words_of::<$Kind>()).collect(),
            look: $crate::Look::$look,
        })
    };
    (@choice $pick:expr) => { $crate::Value::Choice($pick) };
    (@own) => { $crate::Value::Own };
    (@flag $others:expr, $long:expr, $value:expr, $note:expr; $($more:ident: $to:expr),*) => {
        $crate::Flag { long: $long, value: $value, note: $note, $($more: $to,)* ..$others }
    };
    (@elsewhere $long:expr) => { $crate::Flag { long: $long, elsewhere: true, ..$crate::Flag::NONE } };
    (@none) => { $crate::Flag::NONE };
}

/// Flag of a setting. A text that is empty is none.
#[derive(Clone, Copy, Debug)]
pub struct Flag {
    /// Its name without dashes. A switch whose flag begins with `no-` is turned off by it.
    pub long: &'static str,
    /// Its name before.
    pub alias: &'static str,
    /// Name of its value in help; a switch without one takes none.
    pub value: &'static str,
    /// End of its help after that of the setting: unit, default.
    pub note: &'static str,
    /// Default that help states.
    pub usual: &'static str,
    /// Head of its group in help.
    pub heading: &'static str,
    /// Numbers of the control for one of the flag.
    pub scale: f64,
    /// Range of its numbers.
    pub range: [f64; 2],
    /// Unit of the range.
    pub unit: &'static str,
    /// True if its number is whole.
    pub whole: bool,
    /// Units of length, one of which it requires, with the millimeters of each.
    pub lengths: &'static [(&'static str, f64)],
    /// Key of an alternative that it does not take.
    pub except: &'static str,
    /// Flag that it needs.
    pub needs: &'static str,
    /// Flag that it excludes.
    pub excludes: &'static str,
    /// True if it is declared elsewhere, as reading its value takes more than the value.
    pub elsewhere: bool,
}

impl Flag {
    /// No flag.
    pub const NONE: Self = Self {
        long: "",
        alias: "",
        value: "",
        note: "",
        usual: "",
        heading: "",
        scale: 1.0,
        range: [f64::MIN, f64::MAX],
        unit: "",
        whole: false,
        lengths: &[],
        except: "",
        needs: "",
        excludes: "",
        elsewhere: false,
    };

    /// A number of a text in the flag's unit, as the control has it.
    ///
    /// # Errors
    /// Reason that the text is not taken, with the remedy.
    pub fn number(&self, text: &str) -> Result<f64, String> {
        let (digits, factor) = match self.lengths {
            [] => (text, 1.0),
            units => {
                let found = units.iter().find_map(|(unit, mm)| Some((text.trim().strip_suffix(unit)?, *mm)));
                found.ok_or("a length needs a unit, such as 85mm or 3.35in")?
            }
        };
        // The window and papers write a minus sign of their own.
        let number = digits.trim().replace('\u{2212}', "-").parse::<f64>().ok().filter(|number| number.is_finite());
        let number =
            number.ok_or_else(|| format!("\"{digits}\" is not a number; write one like 0.5 or 5e-6"))? * factor;
        let [low, high] = self.range;
        if (low..=high).contains(&number) {
            return Ok(number * self.scale);
        }
        if low == f64::MIN_POSITIVE {
            return Err(format!("\"{text}\" is not above 0"));
        }
        let [low, high] =
            self.range.map(|end| if low != 0.0 && low.abs() < 1e-3 { format!("{end:e}") } else { end.to_string() });
        Err(format!("must be from {low} to {high} {}", self.unit).trim_end().to_owned())
    }
}
