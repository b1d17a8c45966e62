//! The setting of the system for animations.

use super::turns_off;

#[test]
fn settings_files_turn_animations_off() {
    assert!(turns_off("[Settings]\ngtk-enable-animations = 0\n"));
    assert!(turns_off("[KDE]\nAnimationDurationFactor=0\nSingleClick=false\n"));
    assert!(!turns_off("[KDE]\nAnimationDurationFactor=0.5\n[Settings]\ngtk-enable-animations=true\n"));
    assert!(!turns_off(""));
}
