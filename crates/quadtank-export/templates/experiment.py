#!/usr/bin/env python3
"""One experiment on the quadruple-tank process: linear analysis, and the nonlinear plant with two sampled PI loops.

The plant is that of K. H. Johansson, "The Quadruple-Tank Process: A Multivariable Laboratory Process with an Adjustable
Zero", IEEE Transactions on Control Systems Technology 8(3), 2000, with the tapering tank, the loss coefficients and the
power module of J. A. N. Cocota Jr., master's dissertation, COPPE/UFRJ, 2009, whose equations the comments number.
Tanks 1 and 2 are the lower ones; tank 3 drains into tank 1, tank 4 into tank 2. Pump 1 feeds tanks 1 and 4, pump 2
tanks 2 and 3. All units are SI, signals and voltages are in volts.

Exported by Quadtank. Everything is computed here from the parameters and then held against the figures of Quadtank:

    python experiment.py           prints a line for each group of figures, then "agrees"
    python experiment.py --plot    draws the run as well (needs Matplotlib)

Needs NumPy, SciPy and python-control (0.10 or later): pip install numpy scipy control
"""

import sys

import control as ct
import numpy as np
from scipy.integrate import solve_ivp

# {{ data }}

# Largest difference from an expected figure, as a share of the scale that is given with it.
TOLERANCE = 1e-6


# ---------------------------------------------------------------- the plant

def area(level):
    """Cross-section of each tank (m^2) at its level (Cocota eq. 2.28; constant for tanks with upright walls)."""
    return TANK_AREA + TANK_AREA_SLOPE * np.maximum(level, 0.0)


def outflow(level):
    """Flow through each outlet (m^3/s): Torricelli's law with a loss coefficient (Cocota eqs. 2.26 and 2.32)."""
    return LOSS_COEFFICIENT * OUTLET_AREA * np.sqrt(2.0 * GRAVITY * np.maximum(level, 0.0))


class Loads:
    """What acts on the rig: flows (m^3/s) added to pumps and tanks, holes (m^2), and changes of pumps, valves and outlets."""

    def __init__(self):
        self.pump_flow, self.tank_flow, self.leak_area = np.zeros(2), np.zeros(4), np.zeros(4)
        self.pump_gain, self.valve, self.outlet = np.zeros(2), np.zeros(2), np.zeros(4)


def pump_flow(voltage):
    """Flow of each pump (m^3/s): a straight line (Cocota eq. 2.25) that may have a dead zone, an offset and an end."""
    line = np.clip(PUMP_GAIN * voltage + PUMP_OFFSET, 0.0, PUMP_FLOW_MAX)
    return np.where(voltage < PUMP_START, 0.0, line)


def fraction(gamma, flow):
    """Share of the flow of each pump (m^3/s) that goes to its lower tank; it may grow with the flow."""
    return np.clip(gamma + GAMMA_SLOPE * flow, 0.0, 1.0)


def incremental_fraction(flow):
    """Share of a small change of the flow of each pump (m^3/s) that goes to its lower tank, d(gamma q)/dq."""
    gamma = fraction(GAMMA, flow)
    return np.where((gamma > 0.0) & (gamma < 1.0), gamma + GAMMA_SLOPE * flow, gamma)


def valve_flows(voltage, loads):
    """Flow from the pumps into each tank (m^3/s). A load adds to the flow of a pump ahead of its valve; no pump sucks."""
    q1, q2 = np.maximum(np.maximum(1.0 + loads.pump_gain, 0.0) * pump_flow(voltage) + loads.pump_flow, 0.0)
    gamma1, gamma2 = fraction(np.clip(GAMMA + loads.valve, 0.0, 1.0), np.array([q1, q2]))
    return np.array([gamma1 * q1, gamma2 * q2, (1.0 - gamma2) * q2, (1.0 - gamma1) * q1])


def outside_flows(loads):
    """Flow into each tank from outside of the rig (m^3/s). A load adds to it; nothing is drawn that way."""
    return np.maximum(INFLOW + loads.tank_flow, 0.0)


def flows(level, pumped, loads):
    """Flow into each tank, and flow out of it through outlet and leak (m^3/s): Cocota eqs. 3.1 to 3.4, Johansson eq. (1)."""
    out = np.maximum(1.0 + loads.outlet, 0.0) * outflow(level)
    leak = loads.leak_area * np.sqrt(2.0 * GRAVITY * np.maximum(level, 0.0))
    return pumped + np.array([out[2], out[3], 0.0, 0.0]), out + leak


def pump_flows_for(needed):
    """Flows of the pumps (m^3/s) that bring the lower tanks what they need, by Newton's method; one step where gamma is constant."""
    flow = np.full(2, needed.sum() / 2.0)
    for _ in range(50):
        gamma1, gamma2 = incremental_fraction(flow)
        mixing = np.array([[gamma1, 1.0 - gamma2], [1.0 - gamma1, gamma2]])
        straight_down = fraction(GAMMA, flow) * flow
        flow = flow + np.linalg.solve(mixing, needed - straight_down - (flow - straight_down)[::-1])
    return flow


def operating_point():
    """Levels (m) and pump voltages (V): as given, or at rest by the flow balance of each tank (Cocota section 3.2.1); no walls, no limits."""
    if STATE_LEVEL is not None:
        return STATE_LEVEL, STATE_VOLTAGE
    if REST_VOLTAGE is not None:
        voltage = REST_VOLTAGE
    else:
        needed = outflow(np.append(REST_LEVEL, [0.0, 0.0]))[:2] - INFLOW[:2] - INFLOW[2:]
        voltage = (pump_flows_for(needed) - PUMP_OFFSET) / PUMP_GAIN
    pumped = valve_flows(voltage, Loads()) + INFLOW
    inflow = pumped + np.array([pumped[2], pumped[3], 0.0, 0.0])
    level = (inflow / (LOSS_COEFFICIENT * OUTLET_AREA)) ** 2 / (2.0 * GRAVITY)
    if REST_LEVEL is not None:
        level[:2] = REST_LEVEL
    return level, voltage


# ---------------------------------------------------------------- linear analysis

def time_constants(level):
    """T1 to T4 (s) of upright walls, T = A/(k_l a) sqrt(2 h/g) (Cocota eqs. 3.14 to 3.17, Johansson section II); 0 for a dry tank."""
    return area(level) / (LOSS_COEFFICIENT * OUTLET_AREA) * np.sqrt(2.0 * level / GRAVITY)


def has_state(level):
    """Which tanks have a state. One without water follows its inflow at once, and so does an upper one with next to none."""
    time = time_constants(level)
    return (time > 0.0) & ((np.arange(4) < 2) | (time > 1e-8 * time.max()))


def drains(level, voltage):
    """1 + T_j delta_j: how much faster a tank drains whose walls taper and whose level is not at rest (Cocota eqs. 3.14 to 3.17)."""
    inflow, out = flows(level, valve_flows(voltage, Loads()) + INFLOW, Loads())
    return 1.0 + time_constants(level) * TANK_AREA_SLOPE / area(level) ** 2 * (inflow - out)


def linear_model(level, voltage):
    """The model dx/dt = A x + B u, y = C x around the operating point: levels (m), pump voltages (V), measured signals (V)."""
    time, wet, size, drain = time_constants(level), has_state(level), area(level), drains(level, voltage)
    gamma = incremental_fraction(pump_flow(voltage))
    a, b, c = np.zeros((4, 4)), np.zeros((4, 2)), np.zeros((2, 4))
    for lower in (0, 1):
        upper, other = lower + 2, 1 - lower
        from_above = (1.0 - gamma[other]) * PUMP_GAIN[other]
        if wet[upper]:
            a[upper, upper] = -drain[upper] / time[upper]
            b[upper, other] = from_above / size[upper]
        if wet[lower]:
            a[lower, lower] = -drain[lower] / time[lower]
            b[lower, lower] = gamma[lower] * PUMP_GAIN[lower] / size[lower]
            c[lower, lower] = SENSOR_GAIN
            if wet[upper]:
                a[lower, upper] = size[upper] / (size[lower] * time[upper])
            else:
                b[lower, other] = from_above / size[lower]
    return ct.ss(a[np.ix_(wet, wet)], b[wet], c[:, wet], np.zeros((2, 2)))


def transfer_matrix(level, voltage):
    """G(s) from pump voltages to measured signals, in the factored form of Johansson, eq. (4)."""
    wet, gamma = has_state(level), incremental_fraction(pump_flow(voltage))
    time, drain = np.where(wet, time_constants(level), 0.0), np.where(wet, drains(level, voltage), 1.0)

    def element(output, pump):
        gain = time[output] * SENSOR_GAIN * PUMP_GAIN[pump] / area(level)[output]
        if output == pump:
            return [gamma[pump] * gain], [time[output], drain[output]]
        return [(1.0 - gamma[pump]) * gain], np.polymul([time[output + 2], drain[output + 2]], [time[output], drain[output]])

    elements = [[element(i, j) for j in (0, 1)] for i in (0, 1)]
    return ct.tf([[num for num, _ in row] for row in elements], [[den for _, den in row] for row in elements])


def transmission_zeros(plant):
    """Finite transmission zeros (1/s), by rising real part. Infinite ones come out as very large numbers and are left out."""
    zeros = plant.zeros()
    return np.sort_complex(zeros[np.abs(zeros) < 1e4 * np.abs(plant.poles()).max()])


def relative_gain_array(gain):
    """G(0) times the transpose of its inverse, element by element (Bristol 1966)."""
    return gain * np.linalg.inv(gain).T


def closed_loop(plant):
    """The plant under zero-order hold with both PI laws by Tustin's rule, in automatic mode and away from their limits."""
    acting = np.flatnonzero(GAIN)  # a loop of gain 0 does nothing
    share = SAMPLING_TIME / INTEGRAL_TIME
    # c = K (1 + Ts/(2 Ti)) e + s and s+ = s + K Ts/Ti e, by loops 1 and 2.
    law = ct.ss(np.eye(len(acting)), np.diag(GAIN * share)[acting], np.eye(2)[:, acting], np.diag(GAIN * (1.0 + share / 2.0)),
                SAMPLING_TIME)
    to_pumps = np.zeros((2, 2))
    to_pumps[PUMP_OF_LOOP, [0, 1]] = POWER_GAIN
    return ct.feedback(ct.c2d(plant, SAMPLING_TIME, method="zoh") * to_pumps * law, np.eye(2))


# ---------------------------------------------------------------- the controller

class Pi:
    """A sampled PI loop with limits, back-calculation and manual mode, at rest to begin with (Cocota eq. 4.2, section 4.4)."""

    def __init__(self, i, output_at_rest, signal_at_rest):
        self.gain, self.weight = GAIN[i], SET_POINT_WEIGHT[i]
        self.integral_gain = GAIN[i] * SAMPLING_TIME / (2.0 * INTEGRAL_TIME[i])
        # Ts/Tt with Tt = ratio Ti: the share of the excess that a sample takes back from the integral; 0 without anti-windup.
        self.tracking_gain = 0.0
        if ANTI_WINDUP[i]:
            tracking_time = TRACKING_RATIO[i] * INTEGRAL_TIME[i]
            self.tracking_gain = SAMPLING_TIME / max(tracking_time, SAMPLING_TIME)
        self.manual_output, self.manual_until = MANUAL_OUTPUT[i], MANUAL_UNTIL[i]
        pump = PUMP_OF_LOOP[i]
        self.lowest, self.highest = PUMP_MIN[pump] / POWER_GAIN, PUMP_MAX[pump] / POWER_GAIN
        self.integral, self.signal_at_rest, self.previous_error = output_at_rest, signal_at_rest, None

    def limited(self, output):
        return min(max(output, self.lowest), self.highest)

    def step(self, time, reference, measured):
        """One sample: the output (V) that holds until the next one, from reference and measured signal (V)."""
        error = reference - measured
        proportional = self.gain * (error - (1.0 - self.weight) * (reference - self.signal_at_rest))
        if time < self.manual_until:
            output = self.limited(self.manual_output)
            self.integral = output - proportional  # so that the controller takes over without a bump
        else:
            before = error if self.previous_error is None else self.previous_error
            self.integral += self.integral_gain * (error + before)
            unlimited = proportional + self.integral
            output = self.limited(unlimited)
            self.integral += self.tracking_gain * (output - unlimited)
        self.previous_error = error
        return output


def measure(level):
    """Signals of the sensors (V) at the levels of tanks 1 and 2 (m); with range and resolution where the experiment has them."""
    signal = SENSOR_GAIN * level
    if QUANTISED:
        signal = np.clip(signal, 0.0, SENSOR_GAIN * SENSOR_RANGE)
        if SENSOR_RESOLUTION > 0.0:
            signal = np.floor(signal / SENSOR_RESOLUTION + 0.5) * SENSOR_RESOLUTION
    return signal


# ---------------------------------------------------------------- the run

def slopes(_, level, pumped, loads, full):
    """dh/dt of each tank (m/s); a full tank stays full while more comes in than drains, and the excess leaves the plant."""
    inflow, drain = flows(level, pumped, loads)
    return np.where(full, 0.0, (inflow - drain) / area(level))


def wall_event(tank):
    """Ends an integration where a tank fills up, or where a full tank begins to fall."""
    def event(_, level, pumped, loads, full):
        if full[tank]:
            inflow, drain = flows(level, pumped, loads)
            return drain[tank] - inflow[tank]
        return level[tank] - TANK_HEIGHT[tank] * (1.0 + 1e-12)  # what rounding lifts is no overflow
    event.terminal, event.direction = True, 1.0
    return event


WALL_EVENTS = [wall_event(tank) for tank in range(4)]


def advance(level, pumped, loads, duration):
    """Levels (m) after a duration (s) in which nothing is changed from outside."""
    left = duration
    while left > 0.0:
        inflow, drain = flows(level, pumped, loads)
        if np.all(np.abs(inflow - drain) <= 8.0 * np.finfo(float).eps * inflow):
            return level  # at rest, apart from rounding
        full = (level >= TANK_HEIGHT) & (inflow > drain)
        moving = ~full & (np.maximum(inflow, drain) > 0.0)
        with np.errstate(divide="ignore", invalid="ignore"):  # of tanks that are dry
            rate = (np.maximum(inflow, drain) / (2.0 * area(level) * level))[moving].max(initial=0.0)
        # A tank that is almost dry makes the equations stiff.
        method = "DOP853" if left * rate < 50.0 else "Radau"
        part = solve_ivp(slopes, (0.0, left), level, method, args=(pumped, loads, full), events=WALL_EVENTS,
                         first_step=left, rtol=1e-10, atol=1e-13)
        if not part.success:
            raise RuntimeError(part.message)
        level, left = np.clip(part.y[:, -1], 0.0, TANK_HEIGHT), left - part.t[-1]
        for tank in range(4):
            if part.t_events[tank].size:
                level[tank] = TANK_HEIGHT[tank]
    return level


def simulate(level, voltage):
    """The run from the operating point: times (s), levels (m), references (m) and pump voltages (V), a row for each sample and for the end."""
    slack = 1e-9 * SAMPLING_TIME
    reference = level[:2].copy()
    loops = [Pi(i, voltage[PUMP_OF_LOOP[i]] / POWER_GAIN, SENSOR_GAIN * level[i]) for i in (0, 1)]
    loads = Loads()
    level, voltage = np.minimum(level if INITIAL_LEVEL is None else INITIAL_LEVEL, TANK_HEIGHT), np.array(voltage)
    steps = list(SET_POINT_STEPS)
    outside = [
        (list(PUMP_LOADS), loads.pump_flow), (list(TANK_FLOWS), loads.tank_flow), (list(LEAKS), loads.leak_area),
        (list(PUMP_GAIN_CHANGES), loads.pump_gain), (list(VALVE_CHANGES), loads.valve), (list(OUTLET_CHANGES), loads.outlet),
    ]
    moves, hand = list(PUMP_MOVES), voltage.copy()
    # What the pumps did before: a sequence that begins with the run has filled the hoses.
    acting, under_way = voltage.copy(), [[], []]
    for time, pump, value in moves:
        if time <= 0.0:
            acting[int(pump)] = min(max(value, PUMP_MIN[int(pump)]), PUMP_MAX[int(pump)])
    sent = acting.copy()
    by_hand = sorted({int(pump) for _, pump, _ in PUMP_MOVES})
    rows = []

    def take(pending, until, values):
        """Adds all changes that are due to what they change."""
        while pending and pending[0][0] <= until:
            _, index, size = pending.pop(0)
            values[int(index)] += size

    def arrive(until):
        """Lets the voltages act whose flows have passed the hoses."""
        for pump, pending in enumerate(under_way):
            while pending and pending[0][0] <= until:
                acting[pump] = pending.pop(0)[1]

    for k in range(int(END_TIME / SAMPLING_TIME + 1e-9) + 1):
        time, end = k * SAMPLING_TIME, min((k + 1) * SAMPLING_TIME, END_TIME)
        take(steps, time + slack, reference)
        measured = measure(level[:2])
        for i, loop in enumerate(loops):
            voltage[PUMP_OF_LOOP[i]] = POWER_GAIN * loop.step(time, SENSOR_GAIN * reference[i], measured[i])
        while moves and moves[0][0] <= time + slack:
            _, pump, value = moves.pop(0)
            hand[int(pump)] = value
        for pump in by_hand:  # no controller moves such a pump
            voltage[pump] = min(max(hand[pump], PUMP_MIN[pump]), PUMP_MAX[pump])
        rows.append((time, *level, *reference, *voltage))
        for pump in (0, 1):
            if voltage[pump] != sent[pump] or PUMP_DELAY[pump] == 0.0:
                under_way[pump].append((time + PUMP_DELAY[pump], voltage[pump]))
        sent = voltage.copy()
        # Loads begin, and flows arrive, at their exact times, between samples too.
        for pending, values in outside:
            take(pending, time + slack, values)
        arrive(time + slack)
        while time < end:
            coming = [pending[0][0] for pending in [*under_way, *(pending for pending, _ in outside)] if pending]
            following = min([begin for begin in coming if begin < end - slack], default=end)
            level = advance(level, valve_flows(acting, loads) + outside_flows(loads), loads, following - time)
            time = following
            if time < end:
                for pending, values in outside:
                    take(pending, time, values)
                arrive(time)
    if time > rows[-1][0]:
        rows.append((time, *level, *reference, *voltage))
    table = np.array(rows)
    return table[:, 0], table[:, 1:5], table[:, 5:7], table[:, 7:9]


# ---------------------------------------------------------------- expected figures

def agree(what, found, expected, scale):
    """Raises an AssertionError where a figure differs from the expected one by more than the tolerance times its scale."""
    found, expected = np.asarray(found), np.asarray(expected)
    if found.shape != expected.shape:
        raise AssertionError(f"{what}: {found.size} figures instead of {expected.size}")
    difference = np.max(np.abs(found - expected) / scale, initial=0.0)
    if not difference <= TOLERANCE:
        raise AssertionError(f"{what}: {found} instead of {expected}")
    print(f"{what}: figures {expected.size}, largest difference {difference:.1e} of the scale" if expected.size else f"{what}: none")


def check_linear_analysis(level, voltage, plant):
    """Everything that linear theory says."""
    if EXPECTED_POLES.size == 0:
        print("linear model: none, every tank is dry")
        return
    rate = np.abs(EXPECTED_POLES).max()
    agree("poles", np.sort(plant.poles().real), EXPECTED_POLES, rate)
    if DEGENERATE:
        print("transmission zeros: none, the plant is singular at every frequency")
    else:
        agree("transmission zeros", transmission_zeros(plant), EXPECTED_ZEROS, rate)
    gain = plant.dcgain()
    agree("steady-state gain", gain, EXPECTED_GAIN, np.abs(EXPECTED_GAIN).max())
    agree("transfer matrix", transfer_matrix(level, voltage)(1j * rate), plant(1j * rate), np.abs(plant(1j * rate)).max())
    if EXPECTED_LAMBDA is None:
        print("relative gain: none, the steady-state gain is singular")
    else:
        agree("relative gain", relative_gain_array(gain)[0, 0], EXPECTED_LAMBDA, max(1.0, abs(EXPECTED_LAMBDA)))
    if np.any(PUMP_DELAY > 0.0):
        print("closed-loop poles: none, with dead time there is one more for each sample of the delay")
        return
    moduli = np.sort(np.abs(closed_loop(plant).poles()))
    agree("closed-loop poles, moduli", moduli, EXPECTED_MODULI, max(1.0, EXPECTED_MODULI.max()))


def plot(time, levels, references, voltages):
    """Levels with their references, and pump voltages."""
    import matplotlib.pyplot as plt

    figure, (upper, lower) = plt.subplots(2, 1, sharex=True)
    for tank in range(4):
        upper.plot(time, levels[:, tank], label=f"level {tank + 1}")
    for loop in (0, 1):
        upper.step(time, references[:, loop], "k--", where="post", linewidth=0.8)
        lower.step(time, voltages[:, loop], where="post", label=f"pump {loop + 1}")
    upper.set_ylabel("level (m)")
    lower.set(xlabel="time (s)", ylabel="voltage (V)")
    upper.legend()
    lower.legend()
    plt.show()


def main():
    level, voltage = operating_point()
    agree("levels of the operating point", level, EXPECTED_LEVEL, TANK_HEIGHT)
    agree("voltages of the operating point", voltage, EXPECTED_VOLTAGE, np.maximum(PUMP_MAX, np.abs(EXPECTED_VOLTAGE)))
    check_linear_analysis(level, voltage, linear_model(level, voltage))
    run = time, levels, _, _ = simulate(level, voltage)
    rows = [np.abs(time - moment).argmin() for moment in CHECK_TIME]
    agree("levels of the run", levels[rows], EXPECTED_RUN, TANK_HEIGHT)
    print("agrees")
    if "--plot" in sys.argv[1:]:
        plot(*run)


if __name__ == "__main__":
    main()
