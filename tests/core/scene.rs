//! The tests of scene.
