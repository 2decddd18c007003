use crate::plant::level::{LevelPlant, LevelSignals};

/// An element of a level loop that has a static curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Element {
    /// Level (m) to transmitter signal.
    Transmitter,
    /// Controller output to the pressure of the converter.
    Converter,
    /// Pressure to travel.
    Actuator,
    /// Travel to opening.
    Valve,
    /// Level (m) to outflow (m³/s) at the opening of the moment.
    Outlet,
}

/// A static curve with the point at which the element stands.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementCurve {
    /// What goes in.
    pub input: Vec<f64>,
    /// What comes out; of the length of `input`.
    pub output: Vec<f64>,
    /// Where the element stands.
    pub at: (f64, f64),
}

/// Points of a curve, both ends included.
const POINTS: u32 = 81;

impl Element {
    /// All of them, in the order of the signal path.
    pub const ALL: [Self; 5] = [Self::Transmitter, Self::Converter, Self::Actuator, Self::Valve, Self::Outlet];

    /// The curve over all that can go in, around the signals of a moment; `None` for a loop without such an element.
    pub fn curve(self, plant: &LevelPlant, signals: &LevelSignals) -> Option<ElementCurve> {
        let height = plant.tank.height;
        Some(match self {
            Self::Transmitter => curve((0.0, height), (signals.level, signals.measured), |level| {
                plant.transmitter.sent(plant.transmitter.signal_of(level))
            }),
            Self::Converter => {
                let converter = plant.converter?;
                let range = (converter.input.low, converter.input.high);
                curve(range, (signals.output, signals.pressure), |output| converter.convert(output))
            }
            Self::Actuator => {
                let points = &plant.actuator.curve;
                let (first, last) = (points.0.first()?, points.0.last()?);
                let at = (signals.actuator_pressure, signals.travel);
                curve((first[0], last[0]), at, |pressure| points.travel(pressure))
            }
            Self::Valve => {
                let characteristic = plant.valve.characteristic;
                curve((0.0, 1.0), (signals.travel, signals.opening), |travel| characteristic.opening(travel))
            }
            Self::Outlet => {
                let outflow = |level| plant.flows(level, signals.opening)[1];
                curve((0.0, height), (signals.level, signals.outflow), outflow)
            }
        })
    }
}

fn curve((low, high): (f64, f64), at: (f64, f64), output: impl Fn(f64) -> f64) -> ElementCurve {
    let share = |k: u32| f64::from(k) / f64::from(POINTS - 1);
    let input: Vec<f64> = (0..POINTS).map(|k| low + share(k) * (high - low)).collect();
    let output = input.iter().map(|&x| output(x)).collect();
    ElementCurve { input, output, at }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::literature::{andreis, level_slides};

    #[test]
    fn the_point_of_every_element_lies_on_its_curve() {
        for (plant, inflow) in [(andreis::plant(), 0.017), (level_slides::plant(), 0.0011)] {
            let rest = plant.rest(0.7, inflow).unwrap();
            for element in Element::ALL {
                let Some(curve) = element.curve(&plant, &rest) else { continue };
                let (x, y) = curve.at;
                let after = curve.input.partition_point(|&input| input < x).clamp(1, curve.input.len() - 1);
                let (low, high) = (curve.output[after - 1], curve.output[after]);
                let slack = 1e-9 * (1.0 + y.abs());
                assert!(y >= low.min(high) - slack && y <= low.max(high) + slack, "{element:?}: {y} in {low}, {high}");
            }
        }
    }

    #[test]
    fn a_loop_without_converter_has_no_curve_of_it() {
        let plant = level_slides::plant();
        let rest = plant.rest(0.3, 0.0).unwrap();
        assert_eq!(Element::Converter.curve(&plant, &rest), None);
        let curve = Element::Actuator.curve(&plant, &rest).unwrap();
        assert_relative_eq!(curve.output[40], 0.5);
    }
}
