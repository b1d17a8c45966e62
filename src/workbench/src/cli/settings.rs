//! Flags made from choices and lists of settings.

use std::marker::PhantomData;

use chromascope_text::{Choice, Setting, Settings, Value, Words};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches};

pub(super) fn choice<T: Choice>() -> impl TypedValueParser<Value = T> {
    choice_of(T::ALL)
}

/// Parser of some alternatives of a choice by key.
pub(super) fn choice_of<T: Choice>(all: &[T]) -> impl TypedValueParser<Value = T> + use<T> {
    keys(all.iter().map(|choice| choice.words()))
        .try_map(|key| T::parse(&key).ok_or_else(|| format!("{key} is no alternative")))
}

/// Keys of alternatives with their reasons; one without a key is none of the command line.
fn keys(all: impl IntoIterator<Item = &'static Words>) -> PossibleValuesParser {
    let value = |words: &'static Words| {
        let why = words.why.trim_end_matches('.').to_owned();
        PossibleValue::new(words.key).help(why).aliases(words.aliases)
    };
    PossibleValuesParser::new(all.into_iter().filter(|words| !words.key.is_empty()).map(value).collect::<Vec<_>>())
}

/// Settings given on the command line.
#[derive(Clone, Debug)]
pub(super) struct Given<D> {
    given: Vec<(usize, To)>,
    of: PhantomData<D>,
}

#[derive(Clone, Debug)]
enum To {
    Numbers(Vec<f64>),
    /// An alternative, by place.
    Place(usize),
}

impl<D: Settings> Given<D> {
    /// Settings with those given in place of theirs.
    pub(super) fn applied_to(&self, mut to: D) -> D {
        for (index, value) in &self.given {
            let setting = &D::ALL[*index].value;
            match value {
                To::Place(place) => setting.choose(&mut to, *place),
                To::Numbers(numbers) => {
                    for (number, typed) in setting.numbers().into_iter().zip(numbers) {
                        (number.set)(&mut to, *typed);
                    }
                }
            }
        }
        to
    }

    pub(super) fn has(&self, key: &str) -> bool {
        self.given.iter().any(|(index, _)| D::ALL[*index].key == key)
    }
}

/// Settings with flags made here, by place.
fn flagged<D: Settings>() -> impl Iterator<Item = (usize, &'static Setting<D>)> {
    D::ALL.iter().enumerate().filter(|(_, setting)| !setting.flag.long.is_empty() && !setting.flag.elsewhere)
}

fn argument<D: Settings>(setting: &'static Setting<D>) -> Arg {
    let flag = &setting.flag;
    let arg = Arg::new(flag.long).long(flag.long).help(format!("{}{}", setting.help, flag.note));
    let arg = arg.help_heading(flag.heading).action(ArgAction::Set);
    let arg = match &setting.value {
        Value::Switch(..) if flag.value.is_empty() => arg.action(ArgAction::SetTrue),
        Value::Switch(..) => arg.num_args(0..=1).default_missing_value("true").value_parser(clap::value_parser!(bool)),
        Value::Choice(pick) => {
            arg.value_parser(keys((pick.all)().into_iter().filter(|words| words.key != flag.except)))
        }
        _ if flag.whole => {
            let [low, high] = flag.range.map(|end| end as i64);
            arg.value_parser(clap::value_parser!(u32).range(low..=high))
        }
        value => {
            let count = value.numbers().len();
            arg.allow_hyphen_values(true).value_parser(move |text: &str| numbers(setting, text, count))
        }
    };
    let given = |text: &'static str| Some(text).filter(|text| !text.is_empty()).into_iter();
    let arg = given(flag.value).fold(arg, Arg::value_name);
    let arg = given(flag.alias).fold(arg, Arg::alias);
    let arg = given(flag.usual).fold(arg, Arg::default_value);
    let arg = given(flag.needs).fold(arg, Arg::requires);
    let arg = given(flag.excludes).fold(arg, Arg::conflicts_with);
    match D::idle_with() {
        Some((other, settings)) if (setting.idle)(&settings).is_some() => arg.conflicts_with(other),
        _ => arg,
    }
}

/// Numbers of a flag as their controls have them.
fn numbers<D>(setting: &Setting<D>, text: &str, count: usize) -> Result<Vec<f64>, String> {
    if count == 1 {
        return setting.flag.number(text).map(|number| vec![number]);
    }
    let numbers: Vec<f64> = text.split(',').map(|part| setting.flag.number(part)).collect::<Result<_, _>>()?;
    let found = numbers.len();
    let wrong = || format!("expected {count} numbers separated by commas, such as 50e-6,50e-6; found {found}");
    (found == count).then_some(numbers).ok_or_else(wrong)
}

impl<D: Settings> Args for Given<D> {
    fn augment_args(command: Command) -> Command {
        command.args(flagged::<D>().map(|(_, setting)| argument(setting)))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<D: Settings> FromArgMatches for Given<D> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let is_given = |long: &str| matches.value_source(long) == Some(ValueSource::CommandLine);
        let given = flagged::<D>().filter(|(_, setting)| is_given(setting.flag.long)).filter_map(|(index, setting)| {
            let long = setting.flag.long;
            let to = match &setting.value {
                Value::Switch(..) => To::Place(usize::from(*matches.get_one::<bool>(long)? != long.starts_with("no-"))),
                Value::Choice(pick) => {
                    let key = matches.get_one::<String>(long)?.as_str();
                    let is_named = |words: &&Words| words.key == key || words.aliases.contains(&key);
                    To::Place((pick.all)().iter().position(is_named)?)
                }
                _ if setting.flag.whole => To::Numbers(vec![f64::from(*matches.get_one::<u32>(long)?)]),
                _ => To::Numbers(matches.get_one::<Vec<f64>>(long)?.clone()),
            };
            Some((index, to))
        });
        Ok(Self { given: given.collect(), of: PhantomData })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}
