//! Mounts the laboratory into the page.

fn main() {
    quadtank::app::mount();
}
