//! PID controllers in their three forms, and two loops of them, with or without what couples them.

use nalgebra::Matrix2;

use crate::linear::{Complex, LinearError, TransferFunction, TransferMatrix};

/// The derivative filter is this many times quicker than the derivative time.
const FILTER: f64 = 100.0;
/// Rounding of `4 Td/Ti` around 1, where rules like to be.
const EQUAL: f64 = 1e-12;

/// A parallel PID controller `kp + ki/s + kd s` (Campestrini 2006, §5). Times are in the unit of the plant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ParallelPid {
    /// Proportional gain kp (plant input per plant output).
    pub proportional: f64,
    /// Integral gain ki (input per output and unit of time of the plant).
    pub integral: f64,
    /// Derivative gain kd (input per output times unit of time); 0 for PI.
    pub derivative: f64,
    /// Time constant of the derivative filter where it is not that of [`filter_time`](Self::filter_time).
    pub filter: Option<f64>,
}

/// A PID controller without interaction of its actions, `K (1 + 1/(Ti s) + Td s)` (Campestrini 2006, eq. 9).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IsaPid {
    /// Gain K (input per output).
    pub gain: f64,
    /// Integral time Ti (unit of time of the plant); infinite without integral action.
    pub integral_time: f64,
    /// Derivative time Td (unit of time of the plant); 0 without derivative action.
    pub derivative_time: f64,
}

/// A PID controller in series, `K′ (1 + 1/(Ti′ s)) (1 + Td′ s)` (Campestrini 2006, eq. 10).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeriesPid {
    /// Gain K′ (input per output).
    pub gain: f64,
    /// Integral time Ti′ (unit of time of the plant).
    pub integral_time: f64,
    /// Derivative time Td′ (unit of time of the plant).
    pub derivative_time: f64,
}

impl ParallelPid {
    /// Time constant of the derivative filter: 0 without a derivative, else that which is set, else `Tf = |kd/kp|/100`, which is 0
    /// without a proportional part.
    pub fn filter_time(&self) -> f64 {
        match self.filter {
            _ if self.derivative == 0.0 => 0.0,
            Some(filter) => filter,
            None if self.proportional == 0.0 => 0.0,
            None => (self.derivative / self.proportional).abs() / FILTER,
        }
    }

    /// `C(jω)` with an ideal derivative.
    pub fn ideal_at(&self, frequency: f64) -> Complex {
        Complex::new(self.proportional, self.derivative * frequency - self.integral / frequency)
    }

    /// `C(jω)` with the derivative filter, `kd s/(Tf s + 1)`: what is simulated.
    pub fn at(&self, frequency: f64) -> Complex {
        let derivative = Complex::new(0.0, self.derivative * frequency);
        let filter = Complex::new(1.0, self.filter_time() * frequency);
        Complex::new(self.proportional, -self.integral / frequency) + derivative / filter
    }

    /// As a transfer function with the derivative filter, `(ki + (kp + ki Tf) s + (kp Tf + kd) s²)/(s (Tf s + 1))`.
    ///
    /// # Errors
    /// [`LinearError::OutOfRange`] for gains whose products are not finite.
    pub fn transfer_function(&self) -> Result<TransferFunction, LinearError> {
        let (kp, ki, kd, filter) = (self.proportional, self.integral, self.derivative, self.filter_time());
        if ki == 0.0 {
            return TransferFunction::new(vec![kp, kp * filter + kd], vec![1.0, filter], 0.0);
        }
        TransferFunction::new(vec![ki, kp + ki * filter, kp * filter + kd], vec![0.0, 1.0, filter], 0.0)
    }

    fn scaled(self, factor: f64) -> Self {
        Self {
            proportional: factor * self.proportional,
            integral: factor * self.integral,
            derivative: factor * self.derivative,
            filter: self.filter.filter(|_| factor != 0.0),
        }
    }
}

impl From<IsaPid> for ParallelPid {
    fn from(pid: IsaPid) -> Self {
        Self {
            proportional: pid.gain,
            integral: pid.gain / pid.integral_time,
            // Without derivative action a negative gain would leave −0.
            derivative: pid.gain * pid.derivative_time + 0.0,
            filter: None,
        }
    }
}

impl IsaPid {
    /// `C(jω)` with an ideal derivative.
    pub fn ideal_at(&self, frequency: f64) -> Complex {
        ParallelPid::from(*self).ideal_at(frequency)
    }

    /// Made slower and weaker by a factor f: gain K/f, times f T (Campestrini 2006, eqs. 92 and 93, for Kc and Tc).
    #[must_use]
    pub fn detuned(self, factor: f64) -> Self {
        Self {
            gain: self.gain / factor,
            integral_time: self.integral_time * factor,
            derivative_time: self.derivative_time * factor,
        }
    }

    /// The same controller in parallel form as ISA form; `None` without a proportional part.
    pub fn from_parallel(pid: ParallelPid) -> Option<Self> {
        (pid.proportional != 0.0).then(|| Self {
            gain: pid.proportional,
            integral_time: if pid.integral == 0.0 { f64::INFINITY } else { pid.proportional / pid.integral },
            derivative_time: pid.derivative / pid.proportional,
        })
    }
}

impl From<SeriesPid> for IsaPid {
    /// `K = K′ (Ti′ + Td′)/Ti′`, `Ti = Ti′ + Td′`, `Td = Ti′ Td′/(Ti′ + Td′)` (Campestrini 2006, eq. 11).
    fn from(series: SeriesPid) -> Self {
        let sum = series.integral_time + series.derivative_time;
        Self {
            gain: series.gain * sum / series.integral_time,
            integral_time: sum,
            derivative_time: series.integral_time * series.derivative_time / sum,
        }
    }
}

impl SeriesPid {
    /// The same controller in series; `None` for `Ti < 4 Td`, whose zeros are complex. The longer of both times is Ti′.
    pub fn from_isa(isa: IsaPid) -> Option<Self> {
        let discriminant = 1.0 - 4.0 * isa.derivative_time / isa.integral_time;
        if !(discriminant >= -EQUAL && isa.integral_time.is_finite()) {
            return None;
        }
        let integral_time = isa.integral_time * 0.5 * (1.0 + discriminant.max(0.0).sqrt());
        let derivative_time = isa.integral_time - integral_time;
        Some(Self { gain: isa.gain * integral_time / isa.integral_time, integral_time, derivative_time })
    }
}

/// Controllers from both control errors to both inputs, row by input.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PidMatrix(pub [[ParallelPid; 2]; 2]);

impl PidMatrix {
    /// Two loops that know nothing of each other: error 1 to input 1, error 2 to input 2.
    pub fn decentralised([first, second]: [ParallelPid; 2]) -> Self {
        let none = ParallelPid::default();
        Self([[first, none], [none, second]])
    }

    /// Two PI controllers of the gains kp and ki between constant matrices, `K = A diag(p1, p2) B` (Campestrini 2006, eq. 83). A sum
    /// of filtered derivatives would be no PID controller: each has a filter time of its own.
    pub fn between(a: &Matrix2<f64>, [first, second]: [(f64, f64); 2], b: &Matrix2<f64>) -> Self {
        let product = |one: f64, other: f64| a * Matrix2::new(one, 0.0, 0.0, other) * b;
        let (proportional, integral) = (product(first.0, second.0), product(first.1, second.1));
        let entry = |row: usize, column: usize| ParallelPid {
            proportional: proportional[(row, column)],
            integral: integral[(row, column)],
            ..ParallelPid::default()
        };
        Self([[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]])
    }

    /// Two loops behind a static decoupler `u1 = v1 + K_I1 v2`, `u2 = v2 + K_I2 v1` (Campestrini 2006, eq. 72).
    pub fn decoupled([first, second]: [ParallelPid; 2], [one, two]: [f64; 2]) -> Self {
        Self([[first, second.scaled(one)], [first.scaled(two), second]])
    }

    /// Value at a frequency, with derivative filters.
    pub fn at(&self, frequency: f64) -> Matrix2<Complex> {
        Matrix2::from_fn(|row, column| self.0[row][column].at(frequency))
    }

    /// As transfer functions, with derivative filters.
    ///
    /// # Errors
    /// As [`ParallelPid::transfer_function`].
    pub fn transfer_matrix(&self) -> Result<TransferMatrix, LinearError> {
        let [[k11, k12], [k21, k22]] = &self.0;
        let of = ParallelPid::transfer_function;
        Ok(TransferMatrix([[of(k11)?, of(k12)?], [of(k21)?, of(k22)?]]))
    }

    /// The integral gains.
    pub fn integral(&self) -> Matrix2<f64> {
        Matrix2::from_fn(|row, column| self.0[row][column].integral)
    }

    /// How many integrators it takes: the rank of the integral gains.
    pub fn integrators(&self) -> u32 {
        let gains = self.integral();
        let size = gains.norm();
        if size == 0.0 {
            0
        } else if gains.determinant().abs() <= f64::EPSILON * size * size {
            1
        } else {
            2
        }
    }

    /// At rest and ready to take samples, one every `sampling_time` (unit of time of the plant).
    pub fn start(&self, sampling_time: f64) -> RunningPidMatrix {
        let running = |pid: ParallelPid| RunningPid { pid, sampling_time, integral: 0.0, derivative: 0.0, error: 0.0 };
        RunningPidMatrix(self.0.map(|row| row.map(running)))
    }
}

/// A sampled controller: the integral by trapezia, the filtered derivative by backward differences.
#[derive(Clone, Copy, Debug, PartialEq)]
struct RunningPid {
    pid: ParallelPid,
    sampling_time: f64,
    integral: f64,
    derivative: f64,
    error: f64,
}

impl RunningPid {
    fn step(&mut self, error: f64) -> f64 {
        let (pid, ts) = (self.pid, self.sampling_time);
        self.integral += pid.integral * ts * 0.5 * (error + self.error);
        let filter = pid.filter_time();
        self.derivative = (filter * self.derivative + pid.derivative * (error - self.error)) / (filter + ts);
        self.error = error;
        pid.proportional * error + self.integral + self.derivative
    }
}

/// The controllers of a [`PidMatrix`] with their states.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunningPidMatrix([[RunningPid; 2]; 2]);

impl RunningPidMatrix {
    /// Outputs of the next sample as a function of its errors e, `u₀ + K e`, without taking it: u₀ (by input) and K
    /// (row by input, column by error).
    pub fn at_once(&self) -> ([f64; 2], Matrix2<f64>) {
        let of = |errors: [f64; 2]| Self::step(&mut self.clone(), errors);
        let (offset, first, second) = (of([0.0; 2]), of([1.0, 0.0]), of([0.0, 1.0]));
        let change = |row: usize, column: usize| if column == 0 { first[row] } else { second[row] } - offset[row];
        (offset, Matrix2::from_fn(change))
    }

    /// One sample: from both errors (r − y) to both inputs, the integral by the trapezoidal rule, the filtered
    /// derivative by backward differences.
    pub fn step(&mut self, errors: [f64; 2]) -> [f64; 2] {
        self.0.each_mut().map(|[first, second]| first.step(errors[0]) + second.step(errors[1]))
    }
}

#[cfg(test)]
mod tests;
