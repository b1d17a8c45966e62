mod screenshots;
mod architecture;
mod cpu_renderer;
mod figure;
mod theme;
#[test]
fn t() {}
