//! How marks are painted.

use super::paint::Brush;
use super::trace::Px;
use super::{Marker, Rgb, Shape};

/// How far the disc under a mark reaches beyond it (CSS px).
const HALO: f64 = 1.3;

/// How far a mark reaches (CSS px).
fn radius(shape: Shape) -> f64 {
    match shape {
        Shape::Ring => 6.0,
        Shape::Cross => 5.0,
        Shape::Diamond => 4.5,
        Shape::Point => 4.4,
        Shape::Dot => 2.0,
        // They are large, or at the edge.
        Shape::Handle | Shape::Arrow => 0.0,
    }
}

impl Brush<'_> {
    pub(super) fn marker(&self, marker: &Marker) {
        let color = self.style.palette.color(marker.role);
        let point = self.frame.to_px(marker.at);
        if point.0.is_nan() || point.1.is_nan() {
            return;
        }
        let edge = self.inside(marker.at);
        // Half a pixel of rounding is not outside.
        if (point.0 - edge.0).abs().max((point.1 - edge.1).abs()) < 0.5 {
            self.mark(marker.shape, edge, color);
        } else if marker.points_beyond {
            self.arrow(edge, point, color);
        }
    }

    pub(super) fn mark(&self, shape: Shape, (x, y): Px, color: Rgb) {
        let background = self.style.palette.background;
        if self.has_cells {
            self.disc((x, y), radius(shape) + HALO, background);
        }
        match shape {
            Shape::Cross => {
                let arm = 4.0;
                self.path(&[(x - arm, y - arm), (x + arm, y + arm)], color, 1.9);
                self.path(&[(x - arm, y + arm), (x + arm, y - arm)], color, 1.9);
            }
            Shape::Ring => {
                self.disc((x, y), 5.0, background);
                self.circle((x, y), 5.0, color, 2.0);
            }
            Shape::Diamond => self.polygon(&[(x - 4.5, y), (x, y - 4.5), (x + 4.5, y), (x, y + 4.5)], color),
            Shape::Point => {
                self.disc((x, y), 3.6, background);
                self.circle((x, y), 3.6, color, 1.5);
            }
            Shape::Arrow => self.arrow((x + 4.5, y), (x + 9.0, y), color),
            Shape::Dot => self.disc((x, y), 2.0, color),
            Shape::Handle => {
                self.disc((x, y), 8.0, background);
                self.disc((x, y), 6.0, color);
            }
        }
    }

    /// A small arrow at the edge of the plot towards a point outside.
    fn arrow(&self, (x, y): Px, target: Px, color: Rgb) {
        let (dx, dy) = (target.0 - x, target.1 - y);
        let (u, v) = if dx.abs() >= dy.abs() { (dx.signum(), 0.0) } else { (0.0, dy.signum()) };
        let back = |along: f64, across: f64| (x - u * along - v * across, y - v * along + u * across);
        self.polygon(&[back(1.0, 0.0), back(9.0, 5.0), back(9.0, -5.0)], color);
    }
}
