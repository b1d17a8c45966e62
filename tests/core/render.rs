//! Pictures of meshes: each stage against a second way, skipping against not skipping, one thread against many.

mod diffuse;
mod diffusion;
mod drawn;
mod fixture;
mod ground;
mod images;
mod shadow;
mod skipping;
mod sky;
mod smooth;
mod visibility;
