//! Mounts the laboratory into the page.

fn main() {
    quadtank_lab::mount();
}
