//! Text for display on a terminal: without control sequences.

use std::borrow::Cow;
use std::io::{self, IsTerminal as _, Write};

use spectral_file::turns_text;

use crate::format::{Tally, listed};
use crate::hosted;

/// A text as it may go to a terminal. Names come from files, and control characters in them could change what the terminal does or
/// shows: all but line feeds and tabs become escapes such as `\u{1b}`, and so do characters that turn the direction of text.
pub fn shown(text: &str) -> Cow<'_, str> {
    escaped(text, |c| c.escape_unicode().to_string())
}

/// JSON as it may go to a terminal: C1 control characters in its strings become escapes too, as C0 are by its rules.
pub fn shown_json(text: &str) -> Cow<'_, str> {
    escaped(text, |c| format!("\\u{:04x}", u32::from(c)))
}

fn escaped(text: &str, escape: impl Fn(char) -> String) -> Cow<'_, str> {
    let orders = |c: char| (c.is_control() && c != '\n' && c != '\t') || turns_text(c);
    if !text.contains(orders) {
        return Cow::Borrowed(text);
    }
    let plain = |c: char| if orders(c) { escape(c) } else { c.to_string() };
    Cow::Owned(text.chars().map(plain).collect())
}

pub fn say(text: &str) {
    if hosted::hold(|streams| streams.remarks.push(shown(text).into_owned())) {
        return;
    }
    // No message can be written once the terminal is closed.
    let _gone = io::stderr().lock().write_all(shown(text).as_bytes());
}

/// Remarks on files, said when all of them are read and used: those of one kind in one line.
#[derive(Debug, Default)]
pub struct Remarks(pub Tally);

impl Drop for Remarks {
    fn drop(&mut self) {
        for (words, files) in &self.0.0 {
            let more = match files.len() - 1 {
                0 => String::new(),
                count => format!("; likewise {count} more: {}", listed(&files[1..], 3, String::clone)),
            };
            say(&format!("chromascope: {}: {words}{more}\n", files[0]));
        }
    }
}

/// Draws a bar of progress on standard error, over the one before; at the end it is wiped. Only for terminals: none elsewhere.
pub fn draw_progress(done: usize, of: usize, what: &str) {
    const WIDTH: usize = 24;
    let mut error = io::stderr().lock();
    if !error.is_terminal() {
        return;
    }
    let full = WIDTH * done / of.max(1);
    let bar = if done < of {
        format!("\r{}{} {done}/{of} {}\u{1b}[K", "█".repeat(full), "░".repeat(WIDTH - full), shown(what))
    } else {
        "\r\u{1b}[K".to_owned()
    };
    // Nothing can be drawn once the terminal is closed.
    let _gone = error.write_all(bar.as_bytes()).and_then(|()| error.flush());
}

/// Standard error for logs, a whole record at a time.
#[derive(Debug, Default)]
pub struct StandardError;

impl Write for StandardError {
    fn write(&mut self, record: &[u8]) -> io::Result<usize> {
        io::stderr().lock().write_all(shown(&String::from_utf8_lossy(record)).as_bytes())?;
        Ok(record.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        io::stderr().lock().flush()
    }
}

/// Reports a panic in one line, with the file name alone: the build directory is private.
pub fn report_panic(info: &std::panic::PanicHookInfo<'_>) {
    let thread = std::thread::current();
    let place = info.location().map_or_else(String::new, |place| {
        let file = place.file().rsplit(['/', '\\']).next().unwrap_or_default();
        format!(" at {file}:{}:{}", place.line(), place.column())
    });
    let words = info.payload_as_str().unwrap_or("no message");
    say(&format!("chromascope: thread {} panicked{place}: {words}\n", thread.name().unwrap_or("without a name")));
    // A backtrace names source files where they are known, in builds for debugging.
    if cfg!(debug_assertions) {
        say(&format!("{}\n", std::backtrace::Backtrace::capture()));
    }
}
