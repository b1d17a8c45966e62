//! The system's wish that nothing moves by itself.

use std::path::Path;
use std::process::{Command, Stdio};

/// True if the desktop is set to show no animations: GNOME's and macOS's switch by their own programs, GTK's and KDE's in
/// their files. Where none of them says so, things may move.
pub fn reduces_motion() -> bool {
    if cfg!(target_os = "macos") {
        return says("defaults", &["read", "com.apple.universalaccess", "reduceMotion"], "1");
    }
    let Some(home) = std::env::var_os("HOME") else { return false };
    let config = std::env::var_os("XDG_CONFIG_HOME").map_or_else(|| Path::new(&home).join(".config"), Into::into);
    let files = ["gtk-4.0/settings.ini", "gtk-3.0/settings.ini", "kdeglobals"];
    let read = |file: &str| std::fs::read_to_string(config.join(file)).is_ok_and(|text| turns_off(&text));
    files.into_iter().any(read)
        || says("gsettings", &["get", "org.gnome.desktop.interface", "enable-animations"], "false")
}

fn turns_off(text: &str) -> bool {
    let mut pairs = text.lines().filter_map(|line| line.split_once('=')).map(|(key, value)| (key.trim(), value.trim()));
    pairs.any(|(key, value)| match key {
        "gtk-enable-animations" => matches!(value, "0" | "false"),
        "AnimationDurationFactor" => value.parse() == Ok(0.0),
        _ => false,
    })
}

fn says(program: &str, arguments: &[&str], word: &str) -> bool {
    let output = Command::new(program).args(arguments).stdin(Stdio::null()).stderr(Stdio::null()).output();
    output.is_ok_and(|output| output.stdout.trim_ascii() == word.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::turns_off;

    #[test]
    fn settings_files_turn_animations_off() {
        assert!(turns_off("[Settings]\ngtk-enable-animations = 0\n"));
        assert!(turns_off("[KDE]\nAnimationDurationFactor=0\nSingleClick=false\n"));
        assert!(!turns_off("[KDE]\nAnimationDurationFactor=0.5\n[Settings]\ngtk-enable-animations=true\n"));
        assert!(!turns_off(""));
    }
}
