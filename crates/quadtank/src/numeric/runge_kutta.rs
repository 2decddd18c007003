/// One step of length h of the classical Runge-Kutta method of order 4 for dx/dt = f(x).
pub fn runge_kutta_step<const N: usize>(f: impl Fn([f64; N]) -> [f64; N], x: [f64; N], h: f64) -> [f64; N] {
    let ahead = |k: [f64; N], by: f64| std::array::from_fn(|i| x[i] + by * k[i]);
    let k1 = f(x);
    let k2 = f(ahead(k1, 0.5 * h));
    let k3 = f(ahead(k2, 0.5 * h));
    let k4 = f(ahead(k3, h));
    std::array::from_fn(|i| x[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_of_a_linear_equation_is_its_series_up_to_the_fourth_power() {
        // dx/dt = −x: x(h) = 1 − h + h²/2 − h³/6 + h⁴/24.
        let h = 0.5;
        let [x] = runge_kutta_step(|[x]| [-x], [1.0], h);
        let series = 1.0 - h + h * h / 2.0 - h.powi(3) / 6.0 + h.powi(4) / 24.0;
        assert!((x - series).abs() < 1e-15, "{x}");
    }
}
