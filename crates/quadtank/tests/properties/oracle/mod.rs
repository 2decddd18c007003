//! Figures of an independent computation: `data/quadruple-tank.json`, and closed forms.

mod linear;
mod plant;
mod reference;
mod sim;
