mod architecture;
mod theme;
mod figure;
mod cpu_renderer;
#[test] fn t(){}
