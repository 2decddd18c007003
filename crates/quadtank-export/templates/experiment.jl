#=
One experiment on the quadruple-tank process: linear analysis, and the nonlinear plant with two sampled PI loops.

The plant is that of K. H. Johansson, "The Quadruple-Tank Process: A Multivariable Laboratory Process with an Adjustable
Zero", IEEE Transactions on Control Systems Technology 8(3), 2000, with the tapering tank, the loss coefficients and the
power module of J. A. N. Cocota Jr., master's dissertation, COPPE/UFRJ, 2009, whose equations the comments number.
Tanks 1 and 2 are the lower ones; tank 3 drains into tank 1, tank 4 into tank 2. Pump 1 feeds tanks 1 and 4, pump 2
tanks 2 and 3. All units are SI, signals and voltages are in volts.

Exported by Quadtank. Everything is computed here from the parameters and then held against the figures of Quadtank:

    julia experiment.jl           prints a line for each group of figures, then "agrees"
    julia experiment.jl --plot    draws the run as well (needs Plots)

Needs ControlSystems: import Pkg; Pkg.add("ControlSystems")

The exports to Python and Octave are run whenever Quadtank is changed. This one is written along their lines and is NOT
checked: the authors have no Julia where they test. Please report what does not work.
=#

using ControlSystems, LinearAlgebra, Printf

# {{ data }}

# Largest difference from an expected figure, as a share of the scale that is given with it.
const TOLERANCE = 1e-6

# ---------------------------------------------------------------- the plant

"Cross-section of each tank (m^2) at its level (Cocota eq. 2.28; constant for tanks with upright walls)."
area(level) = TANK_AREA .+ TANK_AREA_SLOPE .* max.(level, 0.0)

"Flow through each outlet (m^3/s): Torricelli's law with a loss coefficient (Cocota eqs. 2.26 and 2.32)."
outflow(level) = LOSS_COEFFICIENT .* OUTLET_AREA .* sqrt.(2 * GRAVITY .* max.(level, 0.0))

"What acts on the rig: flows (m^3/s) added to pumps and tanks, holes (m^2), and changes of pumps, valves and outlets."
no_loads() = (pump_flow = zeros(2), tank_flow = zeros(4), leak_area = zeros(4),
              pump_gain = zeros(2), valve = zeros(2), outlet = zeros(4))

"Flow of each pump (m^3/s): a straight line (Cocota eq. 2.25) that may have a dead zone, an offset and an end."
pump_flow(voltage) = ifelse.(voltage .< PUMP_START, 0.0, clamp.(PUMP_GAIN .* voltage .+ PUMP_OFFSET, 0.0, PUMP_FLOW_MAX))

"Share of the flow of each pump (m^3/s) that goes to its lower tank; it may grow with the flow."
fraction(gamma, flow) = clamp.(gamma .+ GAMMA_SLOPE .* flow, 0.0, 1.0)

"Share of a small change of the flow of each pump (m^3/s) that goes to its lower tank, d(gamma q)/dq."
function incremental_fraction(flow)
    gamma = fraction(GAMMA, flow)
    return gamma .+ (0.0 .< gamma .< 1.0) .* GAMMA_SLOPE .* flow
end

"Flow from the pumps into each tank (m^3/s). A load adds to the flow of a pump ahead of its valve; no pump sucks."
function valve_flows(voltage, loads)
    q1, q2 = max.(max.(1 .+ loads.pump_gain, 0.0) .* pump_flow(voltage) .+ loads.pump_flow, 0.0)
    gamma1, gamma2 = fraction(clamp.(GAMMA .+ loads.valve, 0.0, 1.0), [q1, q2])
    return [gamma1 * q1, gamma2 * q2, (1 - gamma2) * q2, (1 - gamma1) * q1]
end

"Flow into each tank from outside of the rig (m^3/s). A load adds to it; nothing is drawn that way."
outside_flows(loads) = max.(INFLOW .+ loads.tank_flow, 0.0)

"What each outlet has of its area."
outlet_share(loads) = max.(1 .+ loads.outlet, 0.0)

"Flow into each tank, and out of it through outlet and leak (m^3/s): Cocota eqs. 3.1 to 3.4, Johansson eq. (1)."
function flows(level, pumped, loads)
    out = outlet_share(loads) .* outflow(level)
    leak = loads.leak_area .* sqrt.(2 * GRAVITY .* max.(level, 0.0))
    return pumped .+ [out[3], out[4], 0.0, 0.0], out .+ leak
end

"Flows of the pumps (m^3/s) that bring the lower tanks what they need, by Newton's method; one step where gamma is constant."
function pump_flows_for(needed)
    flow = fill(sum(needed) / 2, 2)
    for _ in 1:50
        gamma1, gamma2 = incremental_fraction(flow)
        mixing = [gamma1 (1-gamma2); (1-gamma1) gamma2]
        straight_down = fraction(GAMMA, flow) .* flow
        flow = flow .+ mixing \ (needed .- straight_down .- reverse(flow .- straight_down))
    end
    return flow
end

"Levels (m) and pump voltages (V): as given, or at rest by the flow balance of each tank (Cocota section 3.2.1); no walls, no limits."
function operating_point()
    if !isnothing(STATE_LEVEL)
        return STATE_LEVEL, STATE_VOLTAGE
    end
    voltage = REST_VOLTAGE
    if isnothing(voltage)
        needed = outflow([REST_LEVEL; 0.0; 0.0])[1:2] .- INFLOW[1:2] .- INFLOW[3:4]
        voltage = (pump_flows_for(needed) .- PUMP_OFFSET) ./ PUMP_GAIN
    end
    pumped = valve_flows(voltage, no_loads()) .+ INFLOW
    inflow = pumped .+ [pumped[3], pumped[4], 0.0, 0.0]
    level = (inflow ./ (LOSS_COEFFICIENT .* OUTLET_AREA)) .^ 2 ./ (2 * GRAVITY)
    if !isnothing(REST_LEVEL)
        level[1:2] = REST_LEVEL
    end
    return level, voltage
end

# ---------------------------------------------------------------- linear analysis

"""
T1 to T4 (s) of upright walls, T = A/(k_l a) sqrt(2 h/g) (Cocota eqs. 3.14 to 3.17, Johansson section II), and which tanks have a
state. One without water follows its inflow at once, and so does an upper one with next to none; its time constant is 0.
"""
function time_constants(level)
    time = area(level) ./ (LOSS_COEFFICIENT .* OUTLET_AREA) .* sqrt.(2 .* level ./ GRAVITY)
    wet = [time[j] > 0 && (j <= 2 || time[j] > 1e-8 * maximum(time)) for j in 1:4]
    return time .* wet, wet
end

"1 + T_j delta_j: how much faster a tank drains whose walls taper and whose level is not at rest (Cocota eqs. 3.14 to 3.17)."
function drains(level, voltage)
    time, _ = time_constants(level)
    inflow, out = flows(level, valve_flows(voltage, no_loads()) .+ INFLOW, no_loads())
    return 1 .+ time .* TANK_AREA_SLOPE ./ area(level) .^ 2 .* (inflow .- out)
end

"The model dx/dt = A x + B u, y = C x around the operating point: levels (m), pump voltages (V), measured signals (V)."
function linear_model(level, voltage)
    time, wet = time_constants(level)
    section, drain = area(level), drains(level, voltage)
    gamma = incremental_fraction(pump_flow(voltage))
    a, b, c = zeros(4, 4), zeros(4, 2), zeros(2, 4)
    for lower in 1:2
        upper, other = lower + 2, 3 - lower
        from_above = (1 - gamma[other]) * PUMP_GAIN[other]
        if wet[upper]
            a[upper, upper] = -drain[upper] / time[upper]
            b[upper, other] = from_above / section[upper]
        end
        if wet[lower]
            a[lower, lower] = -drain[lower] / time[lower]
            b[lower, lower] = gamma[lower] * PUMP_GAIN[lower] / section[lower]
            c[lower, lower] = SENSOR_GAIN
            if wet[upper]
                a[lower, upper] = section[upper] / (section[lower] * time[upper])
            else
                b[lower, other] = from_above / section[lower]
            end
        end
    end
    return ss(a[wet, wet], b[wet, :], c[:, wet], zeros(2, 2))
end

"G(s) from pump voltages to measured signals, in the factored form of Johansson, eq. (4)."
function transfer_matrix(level, voltage)
    time, _ = time_constants(level)
    section, drain = area(level), drains(level, voltage)
    gamma = incremental_fraction(pump_flow(voltage))
    s = tf("s")
    gain(output, pump) = time[output] * SENSOR_GAIN * PUMP_GAIN[pump] / section[output]
    lag(tank) = time[tank] * s + drain[tank]
    g11 = gamma[1] * gain(1, 1) / lag(1)
    g12 = (1 - gamma[2]) * gain(1, 2) / (lag(3) * lag(1))
    g21 = (1 - gamma[1]) * gain(2, 1) / (lag(4) * lag(2))
    g22 = gamma[2] * gain(2, 2) / lag(2)
    return [g11 g12; g21 g22]
end

"Finite transmission zeros (1/s), by rising real part."
function transmission_zeros(plant)
    largest = 1e4 * maximum(abs.(poles(plant)))
    return sort(filter(z -> abs(z) < largest, tzeros(plant)); by = real)
end

"G(0) times the transpose of its inverse, element by element (Bristol 1966)."
relative_gain_array(gain) = gain .* transpose(inv(gain))

"The plant under zero-order hold with both PI laws by Tustin's rule, in automatic mode and away from their limits."
function closed_loop(plant)
    acting = findall(!iszero, GAIN)  # a loop of gain 0 does nothing
    share = SAMPLING_TIME ./ INTEGRAL_TIME
    to_pumps = zeros(2, 2)
    for i in 1:2
        to_pumps[PUMP_OF_LOOP[i], i] = POWER_GAIN
    end
    # c = K (1 + Ts/(2 Ti)) e + s and s+ = s + K Ts/Ti e, by loops 1 and 2; then to the pumps that they drive.
    a = Matrix{Float64}(I, length(acting), length(acting))
    b = diagm(GAIN .* share)[acting, :]
    d = diagm(GAIN .* (1 .+ share ./ 2))
    law = ss(a, b, to_pumps[:, acting], to_pumps * d, SAMPLING_TIME)
    return feedback(c2d(plant, SAMPLING_TIME, :zoh) * law)
end

# ---------------------------------------------------------------- the controller

"A sampled PI loop with limits, back-calculation and manual mode (Cocota eq. 4.2 and section 4.4)."
mutable struct Pi
    gain::Float64
    weight::Float64
    integral_gain::Float64
    tracking_gain::Float64  # Ts/Tt with Tt = ratio Ti: the share of the excess that a sample takes back from the integral
    manual_output::Float64
    manual_until::Float64
    lowest::Float64
    highest::Float64
    signal_at_rest::Float64
    integral::Float64
    previous_error::Union{Nothing, Float64}
end

"Loop i at rest, with its output and its signal there (V)."
function Pi(i, output_at_rest, signal_at_rest)
    pump = PUMP_OF_LOOP[i]
    tracking_time = max(TRACKING_RATIO[i] * INTEGRAL_TIME[i], SAMPLING_TIME)
    return Pi(GAIN[i], SET_POINT_WEIGHT[i], GAIN[i] * SAMPLING_TIME / (2 * INTEGRAL_TIME[i]),
        ANTI_WINDUP[i] ? SAMPLING_TIME / tracking_time : 0.0, MANUAL_OUTPUT[i], MANUAL_UNTIL[i],
        PUMP_MIN[pump] / POWER_GAIN, PUMP_MAX[pump] / POWER_GAIN, signal_at_rest, output_at_rest, nothing)
end

limited(law::Pi, output) = min(max(output, law.lowest), law.highest)

"One sample: the output (V) that holds until the next one, from reference and measured signal (V)."
function step!(law::Pi, time, reference, measured)
    fault = reference - measured
    proportional = law.gain * (fault - (1 - law.weight) * (reference - law.signal_at_rest))
    if time < law.manual_until
        output = limited(law, law.manual_output)
        law.integral = output - proportional  # so that the controller takes over without a bump
    else
        law.integral += law.integral_gain * (fault + something(law.previous_error, fault))
        unlimited = proportional + law.integral
        output = limited(law, unlimited)
        law.integral += law.tracking_gain * (output - unlimited)
    end
    law.previous_error = fault
    return output
end

"Signals of the sensors (V) at the levels of tanks 1 and 2 (m); with range and resolution where the experiment has them."
function measure(level)
    signal = SENSOR_GAIN .* level
    if QUANTISED
        signal = clamp.(signal, 0.0, SENSOR_GAIN * SENSOR_RANGE)
        if SENSOR_RESOLUTION > 0
            signal = floor.(signal ./ SENSOR_RESOLUTION .+ 0.5) .* SENSOR_RESOLUTION
        end
    end
    return signal
end

# ---------------------------------------------------------------- the run

"""
dh/dt of each tank (m/s) but for those that are held: a full tank stays full while more comes in than drains, and the
excess leaves the plant.
"""
function slopes(level, pumped, loads, held)
    inflow, drain = flows(level, pumped, loads)
    return ifelse.(held, 0.0, (inflow .- drain) ./ area(level))
end

"One step of the classical method of Runge and Kutta."
function runge_kutta(level, pumped, loads, held, step)
    k1 = slopes(level, pumped, loads, held)
    k2 = slopes(level .+ step / 2 .* k1, pumped, loads, held)
    k3 = slopes(level .+ step / 2 .* k2, pumped, loads, held)
    k4 = slopes(level .+ step .* k3, pumped, loads, held)
    return level .+ step / 6 .* (k1 .+ 2 .* k2 .+ 2 .* k3 .+ k4)
end

"Whether a tank has become higher than its wall, or one that was full would fall."
function meets_wall(level, pumped, loads, full)
    inflow, drain = flows(level, pumped, loads)
    above = .!full .& (level .> TANK_HEIGHT .* (1 + 1e-12))
    return any(above) || any(full .& (inflow .< drain))
end

"Level (m) at which each tank would lose just what it gets."
function level_at_rest(inflow, loads)
    drains = outlet_share(loads) .* LOSS_COEFFICIENT .* OUTLET_AREA .+ loads.leak_area
    return (inflow ./ drains) .^ 2 ./ (2 * GRAVITY)
end

"Levels (m) after a duration (s) in which nothing is changed from outside. A step ends where a tank fills up or begins to fall."
function advance(level, pumped, loads, duration)
    left = duration
    while left > 0
        inflow, drain = flows(level, pumped, loads)
        if all(abs.(inflow .- drain) .<= 8 * eps() .* inflow)
            return level  # at rest, apart from rounding
        end
        full = (level .>= TANK_HEIGHT) .& (inflow .> drain)
        longest, still = longest_step(level, inflow, drain, loads, full)
        step = min(left, longest)
        next = part_of_step(level, pumped, loads, full, still, step)
        if meets_wall(next, pumped, loads, full)
            # By bisection: the time of the first change, from its later side.
            early = 0.0
            while step - early > 1e-12 * duration
                middle = (early + step) / 2
                there = part_of_step(level, pumped, loads, full, still, middle)
                if meets_wall(there, pumped, loads, full)
                    step, next = middle, there
                else
                    early = middle
                end
            end
        end
        level = clamp.(next, 0.0, TANK_HEIGHT)
        left -= step
    end
    return level
end

"""
Length of a step (s) that is short against how fast levels change, as shares of themselves. A tank that is almost dry, and
so a hundred times as quick as another, holds so little that longer steps do. Once it is at rest it is still: it follows
its inflow.
"""
function longest_step(level, inflow, drain, loads, full)
    speed = max.(inflow, drain) ./ (2 .* area(level))
    quick = speed ./ max.(level, level_at_rest(inflow, loads))
    stiff = .!full .& (inflow .> 0) .& (quick .> 100 * minimum(quick[speed .> 0]))
    still = stiff .& (abs.(inflow .- drain) .<= 1e-8 .* inflow)
    slow = .!full .& .!stiff .& (speed .> 0)
    longest = max(1e-3, 0.05 / maximum(speed[slow] ./ level[slow]; init = 0.0))
    return minimum(0.5 ./ quick[stiff .& .!still]; init = longest), still
end

"Levels (m) after a part of a step (s)."
function part_of_step(level, pumped, loads, full, still, time)
    level = runge_kutta(level, pumped, loads, full .| still, time)
    inflow, _ = flows(level, pumped, loads)
    return ifelse.(still, level_at_rest(inflow, loads), level)
end

"Adds all changes that are due to what they change. Returns those that are not."
function act!(values, changes, until)
    due = changes[:, 1] .<= until
    for row in findall(due)
        values[Int(changes[row, 2])] += changes[row, 3]
    end
    return changes[.!due, :]
end

"The run from rest: times (s), levels (m), references (m) and pump voltages (V), a row for each sample and for the end."
function simulate(level, voltage)
    slack = 1e-9 * SAMPLING_TIME
    reference = level[1:2]
    loops = [Pi(i, voltage[PUMP_OF_LOOP[i]] / POWER_GAIN, SENSOR_GAIN * level[i]) for i in 1:2]
    loads = no_loads()
    level, voltage = min.(isnothing(INITIAL_LEVEL) ? level : INITIAL_LEVEL, TANK_HEIGHT), copy(voltage)
    steps = SET_POINT_STEPS
    changes = [PUMP_LOADS, TANK_FLOWS, LEAKS, PUMP_GAIN_CHANGES, VALVE_CHANGES, OUTLET_CHANGES]
    acting = [loads.pump_flow, loads.tank_flow, loads.leak_area, loads.pump_gain, loads.valve, loads.outlet]
    hand = copy(voltage)
    # What the pumps did before: a sequence that begins with the run has filled the hoses.
    flowing, under_way = copy(voltage), [Tuple{Float64, Float64}[] for _ in 1:2]
    for move in eachrow(PUMP_MOVES)
        pump = Int(move[2])
        move[1] <= 0 && (flowing[pump] = clamp(move[3], PUMP_MIN[pump], PUMP_MAX[pump]))
    end
    sent = copy(flowing)
    rows = Vector{Float64}[]
    for k in 0:floor(Int, END_TIME / SAMPLING_TIME + 1e-9)
        time, last = k * SAMPLING_TIME, min((k + 1) * SAMPLING_TIME, END_TIME)
        steps = act!(reference, steps, time + slack)
        measured = measure(level[1:2])
        for i in 1:2
            voltage[PUMP_OF_LOOP[i]] = POWER_GAIN * step!(loops[i], time, SENSOR_GAIN * reference[i], measured[i])
        end
        for move in eachrow(PUMP_MOVES)  # of pumps that no controller moves
            move[1] <= time + slack && (hand[Int(move[2])] = move[3])
        end
        for pump in unique(Int.(PUMP_MOVES[:, 2]))
            voltage[pump] = clamp(hand[pump], PUMP_MIN[pump], PUMP_MAX[pump])
        end
        push!(rows, [time; level; reference; voltage])
        for pump in 1:2
            if voltage[pump] != sent[pump] || PUMP_DELAY[pump] == 0
                push!(under_way[pump], (time + PUMP_DELAY[pump], voltage[pump]))
            end
        end
        sent = copy(voltage)
        # Loads begin, and flows arrive, at their exact times, between samples too.
        due = time + slack
        while time < last
            changes = [act!(values, pending, due) for (values, pending) in zip(acting, changes)]
            for pump in 1:2
                while !isempty(under_way[pump]) && under_way[pump][1][1] <= due
                    flowing[pump] = popfirst!(under_way[pump])[2]
                end
            end
            arrivals = [arrival for pending in under_way for (arrival, _) in pending]
            coming = filter(begins -> begins < last - slack, vcat([pending[:, 1] for pending in changes]..., arrivals))
            next = minimum([coming; last])
            fed = valve_flows(flowing, loads) .+ outside_flows(loads)
            level = advance(level, fed, loads, next - time)
            time = due = next
        end
        if time > rows[end][1] && last == END_TIME
            push!(rows, [time; level; reference; voltage])
        end
    end
    table = permutedims(reduce(hcat, rows))
    return (time = table[:, 1], level = table[:, 2:5], reference = table[:, 6:7], voltage = table[:, 8:9])
end

# ---------------------------------------------------------------- expected figures

"An error where a figure differs from the expected one by more than the tolerance times its scale."
function agree(what, found, expected, scale)
    length(found) == length(expected) || error("$what: $(length(found)) figures instead of $(length(expected))")
    if isempty(expected)
        println("$what: none")
        return
    end
    difference = maximum(abs.(found .- expected) ./ scale)
    difference <= TOLERANCE || error("$what: $found instead of $expected")
    @printf("%s: figures %d, largest difference %.1e of the scale\n", what, length(expected), difference)
end

"Everything that linear theory says."
function check_linear_analysis(level, voltage)
    if isempty(EXPECTED_POLES)
        println("linear model: none, every tank is dry")
        return
    end
    plant = linear_model(level, voltage)
    rate = maximum(abs.(EXPECTED_POLES))
    agree("poles", sort(real.(poles(plant))), EXPECTED_POLES, rate)
    if DEGENERATE
        println("transmission zeros: none, the plant is singular at every frequency")
    else
        agree("transmission zeros", transmission_zeros(plant), EXPECTED_ZEROS, rate)
    end
    gain = dcgain(plant)
    agree("steady-state gain", gain, EXPECTED_GAIN, maximum(abs.(EXPECTED_GAIN)))
    response = evalfr(plant, im * rate)
    agree("transfer matrix", evalfr(transfer_matrix(level, voltage), im * rate), response, maximum(abs.(response)))
    if isnothing(EXPECTED_LAMBDA)
        println("relative gain: none, the steady-state gain is singular")
    else
        agree("relative gain", relative_gain_array(gain)[1, 1], EXPECTED_LAMBDA, max(1.0, abs(EXPECTED_LAMBDA)))
    end
    if any(PUMP_DELAY .> 0)
        println("closed-loop poles: none, with dead time there is one more for each sample of the delay")
        return
    end
    moduli = sort(abs.(poles(closed_loop(plant))))
    agree("closed-loop poles, moduli", moduli, EXPECTED_MODULI, max(1.0, maximum(EXPECTED_MODULI)))
end

"Levels with their references, and pump voltages."
function draw(run)
    levels = plot(run.time, run.level; label = ["level 1" "level 2" "level 3" "level 4"], ylabel = "level (m)")
    plot!(levels, run.time, run.reference; label = "", color = :black, linestyle = :dash, linetype = :steppost)
    voltages = plot(run.time, run.voltage; label = ["pump 1" "pump 2"], linetype = :steppost, xlabel = "time (s)", ylabel = "voltage (V)")
    display(plot(levels, voltages; layout = (2, 1)))
    println("press Enter to end")
    readline()
end

function main()
    level, voltage = operating_point()
    agree("levels of the operating point", level, EXPECTED_LEVEL, TANK_HEIGHT)
    agree("voltages of the operating point", voltage, EXPECTED_VOLTAGE, max.(PUMP_MAX, abs.(EXPECTED_VOLTAGE)))
    check_linear_analysis(level, voltage)
    run = simulate(level, voltage)
    rows = [argmin(abs.(run.time .- moment)) for moment in CHECK_TIME]
    agree("levels of the run", run.level[rows, :], EXPECTED_RUN, TANK_HEIGHT')
    println("agrees")
    return run
end

result = main()

if "--plot" in ARGS
    using Plots
end
if "--plot" in ARGS
    draw(result)
end
