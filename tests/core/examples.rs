//! The examples run.

#[path = "../../core/examples/cct.rs"]
mod cct;
#[path = "../../core/examples/locus.rs"]
mod locus;
#[path = "../../core/examples/patches.rs"]
mod patches;

#[test]
fn examples_run_without_error() {
    locus::main().unwrap();
    patches::main().unwrap();
    cct::main().unwrap();
}
