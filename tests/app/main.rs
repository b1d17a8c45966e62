mod look3;
mod architecture;
mod cpu_renderer;
mod figure;
mod screenshots;
mod theme;
#[test]
fn t() {}
