"""One tick of the home bench in python-control and SciPy, for `make bench PEER=1`.

    python benches/peer_tick.py 0.66 0.67 0.68 …

Each argument is a position of the slider of γ1. Prints as JSON the median and the 95th percentile (ms) of the parts of a tick over
these positions, the versions, and the answers at the first position, to be held against those of the laboratory.

A tick is what the page computes anew when γ1 of its first experiment moves (`analyse` and `run` in `crates/quadtank-scenario`):

- `theory`: equilibrium, exact linearisation, steady-state gain, poles, transmission zeros with their directions, relative gain and
  Niederlinski index; poles of the sampled closed loop and the peak Ms of its sensitivity;
- `linear`: 3000 s of the sampled closed loop, 3001 rows of levels and controller outputs;
- `nonlinear`: the same of the tanks themselves, with voltage limits and anti-windup;
- `metrics`: the figures of both loops in both runs.

The nonlinear run is the largest part, and there are three ways to it:

- `odeint`: the same computation. Two PI laws act once a second, SciPy integrates from sample to sample. `solve_ivp` is what SciPy
  recommends, but `odeint` is ten times as quick over such short intervals.
- `runge_kutta`: the same computation without SciPy: one step of the classical Runge-Kutta method per sample, written out in Python.
- `continuous`: another computation, the quickest. The laws are continuous, and one call of `solve_ivp` goes from one set-point step to the
  next. Levels differ by 3 % of the step.

Where four levels as an array would be slower than four numbers, they are numbers: the peer is written to be quick.
"""

import json
import sys
import time
from importlib.metadata import version
from math import sqrt

import control as ct
import numpy as np
from scipy.integrate import odeint, solve_ivp

WARM_UP = 2

# Johansson (2000), minimum-phase setting, with its controllers; SI units. The experiment is that of `presets.rs`.
AREA = np.array([28.0, 32.0, 28.0, 32.0]) * 1e-4
OUTLET = np.array([0.071, 0.057, 0.071, 0.057]) * 1e-4
PUMP_GAIN = np.array([3.33, 3.35]) * 1e-6
GAMMA_2 = 0.6
REST_VOLTAGE = 3.0
VOLTAGE_MIN, VOLTAGE_MAX = 0.0, 10.0
SENSOR_GAIN = 50.0
GRAVITY = 9.81

GAIN = np.array([3.0, 2.7])
INTEGRAL_TIME = np.array([30.0, 40.0])
TRACKING_TIME = 0.5 * INTEGRAL_TIME
SAMPLING_TIME = 1.0

SAMPLES = 3000
TIME = np.arange(SAMPLES + 1) * SAMPLING_TIME
STEP_SAMPLES = (100, 1500)
RELATIVE_STEP = 0.05

# As many frequencies as the laboratory looks at for Ms: its grid, the poles, and a search around the highest.
FREQUENCIES = 119
# A few digits beyond 1e-6 of the step, which is the bar of the laboratory.
TOLERANCES = {"rtol": 1e-8, "atol": 1e-10}


class Rig:
    """The tanks with γ1 in its place, at the equilibrium of the published voltages."""

    def __init__(self, gamma_1):
        direct = np.array([gamma_1, GAMMA_2]) * PUMP_GAIN
        above = PUMP_GAIN - direct
        # Flow into each tank (rows) per volt of each pump.
        self.valve_flow = np.array([[direct[0], 0.0], [0.0, direct[1]], [0.0, above[1]], [above[0], 0.0]])
        self.drain = OUTLET * sqrt(2.0 * GRAVITY)
        inflow = self.valve_flow.sum(axis=1) * REST_VOLTAGE
        inflow[:2] += inflow[2:]
        self.levels = (inflow / self.drain) ** 2
        # References of both loops, a row per sample (m).
        stepped = TIME[:, None] >= np.array(STEP_SAMPLES) * SAMPLING_TIME
        self.references = self.levels[:2] * (1.0 + RELATIVE_STEP * stepped)

    def linearise(self):
        """A, B and C; inputs are pump voltages, outputs measured signals (V)."""
        slope = self.drain / (2.0 * np.sqrt(self.levels))
        a = np.diag(-slope / AREA)
        a[0, 2], a[1, 3] = slope[2] / AREA[0], slope[3] / AREA[1]
        return a, self.valve_flow / AREA[:, None], SENSOR_GAIN * np.eye(2, 4)

    def equations(self):
        """The rates of change of the levels (m/s) as a function of levels and pump voltages, all of them plain numbers."""
        d1, d2, d3, d4 = self.drain.tolist()
        a1, a2, a3, a4 = AREA.tolist()
        (b1, _), (_, b2), (_, b3), (b4, _) = self.valve_flow.tolist()

        def slopes(levels, u1, u2):
            h1, h2, h3, h4 = levels
            q3, q4 = d3 * sqrt(max(h3, 0.0)), d4 * sqrt(max(h4, 0.0))
            return (
                (b1 * u1 + q3 - d1 * sqrt(max(h1, 0.0))) / a1,
                (b2 * u2 + q4 - d2 * sqrt(max(h2, 0.0))) / a2,
                (b3 * u2 - q3) / a3,
                (b4 * u1 - q4) / a4,
            )

        return slopes


def directions(plant, zero):
    """Input and output direction of a transmission zero: null vectors of its pencil."""
    n = plant.nstates
    pencil = np.block([[plant.A - zero * np.eye(n), plant.B], [plant.C, plant.D]])
    left, _, right = np.linalg.svd(pencil)
    u, y = right[-1, n:].conj(), left[n:, -1].conj()
    return u / np.linalg.norm(u), y / np.linalg.norm(y)


def theory(gamma_1):
    """The rig, what linear theory says of it, and the sampled parts that the linear run needs: tanks, laws and sensors."""
    rig = Rig(gamma_1)
    a, b, c = rig.linearise()
    plant = ct.ss(a, b, c, np.zeros((2, 2)))
    gain = plant.dcgain()
    zeros = plant.zeros()
    answers = {
        "levels": rig.levels,
        "poles": plant.poles(),
        "zeros": zeros,
        "directions": [directions(plant, zero) for zero in zeros],
        "rga_11": (gain * np.linalg.inv(gain).T)[0, 0],
        "niederlinski": np.linalg.det(gain) / np.prod(np.diag(gain)),
    }
    tanks = ct.ss(a, b, np.eye(4), np.zeros((4, 2))).sample(SAMPLING_TIME, "zoh")
    # Tustin's rule: output K (1 + Ts/(2 Ti)) e + s, next state s + K Ts/Ti e.
    share = SAMPLING_TIME / INTEGRAL_TIME
    laws = ct.ss(np.eye(2), np.diag(GAIN * share), np.eye(2), np.diag(GAIN * (1.0 + share / 2.0)), SAMPLING_TIME)
    sensor = ct.ss([], [], [], c, SAMPLING_TIME)
    loop = sensor * tanks * laws
    unit = ct.ss([], [], [], np.eye(2), SAMPLING_TIME)
    sensitivity = ct.feedback(unit, loop)
    poles_z = sensitivity.poles()
    poles_s = np.log(poles_z) / SAMPLING_TIME
    frequencies = np.geomspace(0.1 * np.abs(poles_s).min(), np.pi / SAMPLING_TIME, FREQUENCIES, endpoint=False)
    over_frequency = sensitivity(np.exp(1j * frequencies * SAMPLING_TIME))
    peak = np.linalg.svd(np.moveaxis(over_frequency, -1, 0), compute_uv=False).max()
    answers |= {"closed_loop_poles_z": poles_z, "sensitivity_peak": peak}
    return rig, answers, (tanks, laws, sensor)


def linear_run(rig, parts):
    """Levels (m) and controller outputs (V) of the sampled loop, a column per sample. The limits are not met here."""
    tanks, laws, sensor = parts
    signals = SENSOR_GAIN * (rig.references - rig.levels[:2]).T
    closed = ct.feedback(tanks * laws, sensor)
    levels = ct.forced_response(closed, TIME, signals).outputs
    error = signals - SENSOR_GAIN * levels[:2]
    increment = (GAIN * SAMPLING_TIME / INTEGRAL_TIME)[:, None] * error
    proportional = (GAIN * (1.0 + SAMPLING_TIME / (2.0 * INTEGRAL_TIME)))[:, None] * error
    output = REST_VOLTAGE + proportional + np.cumsum(increment, axis=1) - increment
    return rig.levels[:, None] + levels, output


def by_odeint(slopes):
    def right_hand_side(levels, _time, u1, u2):
        return slopes(levels.tolist(), u1, u2)

    def advance(levels, u1, u2):
        return odeint(right_hand_side, levels, (0.0, SAMPLING_TIME), args=(u1, u2), **TOLERANCES)[-1].tolist()

    return advance


def by_runge_kutta(slopes):
    def advance(levels, u1, u2):
        def from_here(k, by):
            return [h + by * slope for h, slope in zip(levels, k)]

        k1 = slopes(levels, u1, u2)
        k2 = slopes(from_here(k1, SAMPLING_TIME / 2.0), u1, u2)
        k3 = slopes(from_here(k2, SAMPLING_TIME / 2.0), u1, u2)
        k4 = slopes(from_here(k3, SAMPLING_TIME), u1, u2)
        return [h + SAMPLING_TIME / 6.0 * (a + 2.0 * (b + c) + d) for h, a, b, c, d in zip(levels, k1, k2, k3, k4)]

    return advance


def sampled_run(rig, method):
    """Levels (m) and controller outputs (V) of the tanks under laws that act once per sampling time."""
    advance = method(rig.equations())
    rows, outputs = [], []
    levels = rig.levels.tolist()
    integral, previous = [REST_VOLTAGE, REST_VOLTAGE], None
    trapezium = (GAIN * SAMPLING_TIME / (2.0 * INTEGRAL_TIME)).tolist()
    tracking = (SAMPLING_TIME / TRACKING_TIME).tolist()
    gains = GAIN.tolist()
    for reference in rig.references.tolist():
        error = [SENSOR_GAIN * (r - h) for r, h in zip(reference, levels)]
        output = []
        for i in (0, 1):
            integral[i] += trapezium[i] * (error[i] + (previous or error)[i])
            unlimited = gains[i] * error[i] + integral[i]
            limited = min(max(unlimited, VOLTAGE_MIN), VOLTAGE_MAX)
            integral[i] += tracking[i] * (limited - unlimited)
            output.append(limited)
        previous = error
        rows.append(levels)
        outputs.append(output)
        if len(rows) <= SAMPLES:
            levels = advance(levels, *output)
    return np.array(rows).T, np.array(outputs).T


def continuous_run(rig):
    """The same with continuous laws, whose integrals are two more states."""
    slopes = rig.equations()
    (g1, g2), (t1, t2), (b1, b2) = GAIN.tolist(), INTEGRAL_TIME.tolist(), TRACKING_TIME.tolist()

    def laws(state, r1, r2):
        e1, e2 = SENSOR_GAIN * (r1 - state[0]), SENSOR_GAIN * (r2 - state[1])
        v1, v2 = g1 * e1 + state[4], g2 * e2 + state[5]
        u1, u2 = min(max(v1, VOLTAGE_MIN), VOLTAGE_MAX), min(max(v2, VOLTAGE_MIN), VOLTAGE_MAX)
        return u1, u2, g1 / t1 * e1 + (u1 - v1) / b1, g2 / t2 * e2 + (u2 - v2) / b2

    def right_hand_side(_time, state, r1, r2):
        state = state.tolist()
        u1, u2, *integrals = laws(state, r1, r2)
        return [*slopes(state[:4], u1, u2), *integrals]

    state = np.array([*rig.levels, REST_VOLTAGE, REST_VOLTAGE])
    pieces = []
    edges = (0, *STEP_SAMPLES, SAMPLES)
    for begin, end in zip(edges, edges[1:]):
        span = (TIME[begin], TIME[end])
        found = solve_ivp(right_hand_side, span, state, args=rig.references[begin], t_eval=TIME[begin : end + 1], rtol=1e-6, atol=1e-8)
        pieces.append(found.y[:, :-1])
        state = found.y[:, -1]
    states = np.column_stack([*pieces, state])
    unlimited = GAIN[:, None] * SENSOR_GAIN * (rig.references.T - states[:2]) + states[4:]
    return states[:4], np.clip(unlimited, VOLTAGE_MIN, VOLTAGE_MAX)


def settling_time(time, progress, band):
    """When the response enters its band for good (s after the step); NaN if it never does."""
    outside = np.flatnonzero(np.abs(progress - 1.0) > band)
    entry = outside[-1] + 1 if outside.size else 0
    return time[entry] - time[0] if entry < len(time) else np.nan


def metrics(rig, levels, outputs):
    """Figures of the step response of each loop until the next step, and sums over the run."""
    figures = []
    for i, (first, end) in enumerate(zip(STEP_SAMPLES, (*STEP_SAMPLES[1:], SAMPLES))):
        window = slice(first, end + 1)
        time, other, output = TIME[window], levels[1 - i, window], outputs[i]
        progress = (levels[i, window] - rig.levels[i]) / (RELATIVE_STEP * rig.levels[i])
        error = np.abs(rig.references[:-1, i] - levels[i, :-1])
        figures.append(
            {
                "rise_time_s": time[np.argmax(progress >= 0.9)] - time[np.argmax(progress >= 0.1)],
                "settling_2_percent_s": settling_time(time, progress, 0.02),
                "settling_5_percent_s": settling_time(time, progress, 0.05),
                "overshoot": max(progress.max() - 1.0, 0.0),
                "undershoot": max(-progress.min(), 0.0),
                "other_peak": np.abs(other - other[0]).max(),
                "iae": error.sum() * SAMPLING_TIME,
                "ise": (error**2).sum() * SAMPLING_TIME,
                "itae": (np.maximum(TIME[:-1] - time[0], 0.0) * error).sum() * SAMPLING_TIME,
                "total_variation": np.abs(np.diff(output)).sum(),
                "saturated_s": ((output <= VOLTAGE_MIN) | (output >= VOLTAGE_MAX)).sum() * SAMPLING_TIME,
            }
        )
    return figures


NONLINEAR = {
    "odeint": lambda rig: sampled_run(rig, by_odeint),
    "runge_kutta": lambda rig: sampled_run(rig, by_runge_kutta),
    "continuous": continuous_run,
}


def tick(gamma_1):
    """A tick with each of the nonlinear runs: milliseconds of its parts, and the answers."""
    times = {}

    def timed(name, work, *inputs):
        # Time of the processor: a long tick would suffer more than a short one from what else runs on the machine.
        start = time.thread_time()
        result = work(*inputs)
        times[name] = 1e3 * (time.thread_time() - start)
        return result

    rig, answers, parts = timed("theory", theory, gamma_1)
    linear = timed("linear", linear_run, rig, parts)
    runs = {name: timed(name, run, rig) for name, run in NONLINEAR.items()}
    figures = timed("metrics", lambda: [metrics(rig, *run) for run in (linear, runs["odeint"])])
    shared = times["theory"] + times["linear"] + times["metrics"]
    ticks = {f"tick_{name}": shared + times[name] for name in NONLINEAR}
    step = RELATIVE_STEP * rig.levels[0]
    differences = {name: np.abs(levels - runs["odeint"][0]).max() / step for name, (levels, _) in runs.items()}
    return times | ticks, answers | {"metrics": figures, "difference_of_step": differences}


def plain(value):
    """Numbers of NumPy as JSON has them; complex ones as pairs."""
    if isinstance(value, np.ndarray):
        return value.tolist() if not np.iscomplexobj(value) else [[z.real, z.imag] for z in value]
    return value.item()


def main():
    positions = [float(argument) for argument in sys.argv[1:]]
    for position in positions[:WARM_UP]:
        tick(position)
    ticks = [tick(position) for position in positions]
    columns = {name: [times[name] for times, _ in ticks] for name in ticks[0][0]}
    figures = {name: {"median_ms": np.median(column), "p95_ms": np.quantile(column, 0.95)} for name, column in columns.items()}
    versions = {"python": sys.version.split()[0], **{name: version(name) for name in ("control", "scipy", "numpy")}}
    print(json.dumps({"versions": versions, "ticks": len(ticks), "times": figures, "answers": ticks[0][1]}, default=plain))


if __name__ == "__main__":
    main()
