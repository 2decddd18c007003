function quadtank_experiment(option)
% One experiment on the quadruple-tank process: linear analysis, and the nonlinear plant with two sampled PI loops.
%
% The plant is that of K. H. Johansson, "The Quadruple-Tank Process: A Multivariable Laboratory Process with an
% Adjustable Zero", IEEE Transactions on Control Systems Technology 8(3), 2000, with the tapering tank, the loss
% coefficients and the power module of J. A. N. Cocota Jr., master's dissertation, COPPE/UFRJ, 2009, whose equations the
% comments number. Tanks 1 and 2 are the lower ones; tank 3 drains into tank 1, tank 4 into tank 2. Pump 1 feeds tanks 1
% and 4, pump 2 tanks 2 and 3. All units are SI, signals and voltages are in volts.
%
% Exported by Quadtank. Everything is computed here from the parameters and then held against the figures of Quadtank:
%
%   quadtank_experiment            prints a line for each group of figures, then "agrees"; the file has this name
%   quadtank_experiment('plot')    draws the run as well
%
% Needs MATLAB with the Control System Toolbox, or GNU Octave (7 or later) with the package control.

  if nargin < 1
    option = '';
  end
  if is_octave()
    pkg('load', 'control');
  end
  p = parameters();
  [level, voltage] = operating_point(p);
  agree('levels of the operating point', level, p.expected_level, p.tank_height);
  agree('voltages of the operating point', voltage, p.expected_voltage, max(p.pump_max, abs(p.expected_voltage)));
  check_linear_analysis(p, level, voltage);
  run = simulate(p, level, voltage);
  [~, rows] = min(abs(run.time - p.check_time), [], 1);
  agree('levels of the run', run.level(rows, :), p.expected_run, p.tank_height);
  disp('agrees');
  if strcmp(option, 'plot')
    draw(run);
  end
end

function p = parameters()
% Rig, operating point, controller, experiment, and the figures of Quadtank. Indices count from 1.
% {{ data }}
end

function share = tolerance()
% Largest difference from an expected figure, as a share of the scale that is given with it.
  share = 1e-6;
end

function answer = is_octave()
  answer = exist('OCTAVE_VERSION', 'builtin') ~= 0;
end

% ---------------------------------------------------------------- the plant

function section = area(p, level)
% Cross-section of each tank (m^2) at its level (Cocota eq. 2.28; constant for tanks with upright walls).
  section = p.tank_area + p.tank_area_slope .* max(level, 0);
end

function loads = no_loads()
% What acts on the rig: flows (m^3/s) added to pumps and tanks, holes (m^2), and changes of pumps, valves and outlets.
  loads = struct('pump_flow', zeros(1, 2), 'tank_flow', zeros(1, 4), 'leak_area', zeros(1, 4), ...
                 'pump_gain', zeros(1, 2), 'valve', zeros(1, 2), 'outlet', zeros(1, 4));
end

function flow = pump_flow(p, voltage)
% Flow of each pump (m^3/s): a straight line (Cocota eq. 2.25) that may have a dead zone, an offset and an end.
  flow = min(max(p.pump_gain .* voltage + p.pump_offset, 0), p.pump_flow_max);
  flow(voltage < p.pump_start) = 0;
end

function gamma = fraction(p, gamma, flow)
% Share of the flow of each pump (m^3/s) that goes to its lower tank; it may grow with the flow.
  gamma = min(max(gamma + p.gamma_slope .* flow, 0), 1);
end

function gamma = incremental_fraction(p, flow)
% Share of a small change of the flow of each pump (m^3/s) that goes to its lower tank, d(gamma q)/dq.
  gamma = fraction(p, p.gamma, flow);
  gamma = gamma + (gamma > 0 & gamma < 1) .* p.gamma_slope .* flow;
end

function pumped = valve_flows(p, voltage, loads)
% Flow from the pumps into each tank (m^3/s). A load adds to the flow of a pump ahead of its valve; no pump sucks.
  q = max(max(1 + loads.pump_gain, 0) .* pump_flow(p, voltage) + loads.pump_flow, 0);
  gamma = fraction(p, min(max(p.gamma + loads.valve, 0), 1), q);
  pumped = [gamma(1) * q(1), gamma(2) * q(2), (1 - gamma(2)) * q(2), (1 - gamma(1)) * q(1)];
end

function outside = outside_flows(p, loads)
% Flow into each tank from outside of the rig (m^3/s). A load adds to it; nothing is drawn that way.
  outside = max(p.inflow + loads.tank_flow, 0);
end

function share = outlet_share(loads)
% What each outlet has of its area.
  share = max(1 + loads.outlet, 0);
end

function [inflow, drain] = flows(p, level, pumped, loads)
% Flow into each tank, and out of it through outlet and leak (m^3/s), by Torricelli's law with a loss coefficient: Cocota
% eqs. 2.32 and 3.1 to 3.4, Johansson eq. (1).
  speed = sqrt(2 * p.gravity * max(level, 0));
  out = outlet_share(loads) .* p.loss_coefficient .* p.outlet_area .* speed;
  inflow = pumped + [out(3), out(4), 0, 0];
  drain = out + loads.leak_area .* speed;
end

function flow = pump_flows_for(p, needed)
% Flows of the pumps (m^3/s) that bring the lower tanks what they need, by Newton's method; one step where gamma is constant.
  flow = sum(needed) / 2 * [1, 1];
  for k = 1:50
    gamma = incremental_fraction(p, flow);
    mixing = [gamma(1), 1 - gamma(2); 1 - gamma(1), gamma(2)];
    straight_down = fraction(p, p.gamma, flow) .* flow;
    flow = flow + (mixing \ (needed - straight_down - fliplr(flow - straight_down)).').';
  end
end

function [level, voltage] = operating_point(p)
% Levels (m) and pump voltages (V): as given, or at rest by the flow balance of each tank (Cocota section 3.2.1); no walls, no
% limits.
  if ~isempty(p.state_level)
    level = p.state_level; voltage = p.state_voltage;
    return;
  end
  voltage = p.rest_voltage;
  if isempty(voltage)
    [~, needed] = flows(p, [p.rest_level, 0, 0], zeros(1, 4), no_loads());
    voltage = (pump_flows_for(p, needed(1:2) - p.inflow(1:2) - p.inflow(3:4)) - p.pump_offset) ./ p.pump_gain;
  end
  pumped = valve_flows(p, voltage, no_loads()) + p.inflow;
  inflow = pumped + [pumped(3), pumped(4), 0, 0];
  level = (inflow ./ (p.loss_coefficient .* p.outlet_area)) .^ 2 / (2 * p.gravity);
  if ~isempty(p.rest_level)
    level(1:2) = p.rest_level;
  end
end

% ---------------------------------------------------------------- linear analysis

function [time, wet] = time_constants(p, level)
% T1 to T4 (s) of upright walls, T = A/(k_l a) sqrt(2 h/g) (Cocota eqs. 3.14 to 3.17, Johansson section II), and which tanks have a
% state. One without water follows its inflow at once, and so does an upper one with next to none.
  time = area(p, level) ./ (p.loss_coefficient .* p.outlet_area) .* sqrt(2 * level / p.gravity);
  wet = time > 0 & (time > 1e-8 * max(time) | [true, true, false, false]);
  time(~wet) = 0;
end

function drain = drains(p, level, voltage)
% 1 + T_j delta_j: how much faster a tank drains whose walls taper and whose level is not at rest (Cocota eqs. 3.14 to 3.17).
  [inflow, out] = flows(p, level, valve_flows(p, voltage, no_loads()) + p.inflow, no_loads());
  drain = 1 + time_constants(p, level) .* p.tank_area_slope ./ area(p, level) .^ 2 .* (inflow - out);
end

function plant = linear_model(p, level, voltage)
% The model dx/dt = A x + B u, y = C x around the operating point: levels (m), pump voltages (V), measured signals (V).
  [time, wet] = time_constants(p, level);
  section = area(p, level); drain = drains(p, level, voltage);
  gamma = incremental_fraction(p, pump_flow(p, voltage));
  a = zeros(4); b = zeros(4, 2); c = zeros(2, 4);
  for lower = 1:2
    upper = lower + 2; other = 3 - lower;
    from_above = (1 - gamma(other)) * p.pump_gain(other);
    if wet(upper)
      a(upper, upper) = -drain(upper) / time(upper);
      b(upper, other) = from_above / section(upper);
    end
    if wet(lower)
      a(lower, lower) = -drain(lower) / time(lower);
      b(lower, lower) = gamma(lower) * p.pump_gain(lower) / section(lower);
      c(lower, lower) = p.sensor_gain;
      if wet(upper)
        a(lower, upper) = section(upper) / (section(lower) * time(upper));
      else
        b(lower, other) = from_above / section(lower);
      end
    end
  end
  plant = ss(a(wet, wet), b(wet, :), c(:, wet), zeros(2));
end

function g = transfer_matrix(p, level, voltage)
% G(s) from pump voltages to measured signals, in the factored form of Johansson, eq. (4).
  time = time_constants(p, level);
  section = area(p, level); drain = drains(p, level, voltage);
  gamma = incremental_fraction(p, pump_flow(p, voltage));
  s = tf('s');
  gain = @(output, pump) time(output) * p.sensor_gain * p.pump_gain(pump) / section(output);
  lag = @(tank) time(tank) * s + drain(tank);
  g = [gamma(1) * gain(1, 1) / lag(1), (1 - gamma(2)) * gain(1, 2) / (lag(3) * lag(1));
       (1 - gamma(1)) * gain(2, 1) / (lag(4) * lag(2)), gamma(2) * gain(2, 2) / lag(2)];
end

function zeros_of_plant = transmission_zeros(plant)
% Finite transmission zeros (1/s), by rising real part.
  if is_octave()
    zeros_of_plant = zero(plant);
  else
    zeros_of_plant = tzero(plant);
  end
  zeros_of_plant = zeros_of_plant(abs(zeros_of_plant) < 1e4 * max(abs(pole(plant))));
  [~, order] = sort(real(zeros_of_plant));
  zeros_of_plant = reshape(zeros_of_plant(order), 1, []);
end

function loop = closed_loop(p, plant)
% The plant under zero-order hold with both PI laws by Tustin's rule, in automatic mode and away from their limits.
  acting = find(p.gain);  % a loop of gain 0 does nothing
  share = p.sampling_time ./ p.integral_time;
  % c = K (1 + Ts/(2 Ti)) e + s and s+ = s + K Ts/Ti e, by loops 1 and 2.
  b = diag(p.gain .* share); c = eye(2);
  law = ss(eye(numel(acting)), b(acting, :), c(:, acting), diag(p.gain .* (1 + share / 2)), p.sampling_time);
  to_pumps = zeros(2);
  to_pumps(p.pump_of_loop(1), 1) = p.power_gain;
  to_pumps(p.pump_of_loop(2), 2) = p.power_gain;
  loop = feedback(c2d(plant, p.sampling_time, 'zoh') * to_pumps * law, eye(2));
end

% ---------------------------------------------------------------- the controller

function loop = pi_at_rest(p, i, output, signal)
% A sampled PI loop with limits, back-calculation and manual mode, at rest (Cocota eq. 4.2 and section 4.4).
  pump = p.pump_of_loop(i);
  loop.gain = p.gain(i); loop.weight = p.set_point_weight(i);
  loop.integral_gain = p.gain(i) * p.sampling_time / (2 * p.integral_time(i));
  % Ts/Tt with Tt = ratio Ti: the share of the excess that a sample takes back from the integral; 0 without anti-windup.
  loop.tracking_gain = 0;
  if p.anti_windup(i)
    loop.tracking_gain = p.sampling_time / max(p.tracking_ratio(i) * p.integral_time(i), p.sampling_time);
  end
  loop.manual_output = p.manual_output(i); loop.manual_until = p.manual_until(i);
  loop.lowest = p.pump_min(pump) / p.power_gain;
  loop.highest = p.pump_max(pump) / p.power_gain;
  loop.integral = output;
  loop.signal_at_rest = signal;
  loop.previous_error = [];
end

function [output, loop] = pi_step(loop, time, reference, measured)
% One sample: the output (V) that holds until the next one, from reference and measured signal (V).
  fault = reference - measured;
  proportional = loop.gain * (fault - (1 - loop.weight) * (reference - loop.signal_at_rest));
  if time < loop.manual_until
    output = min(max(loop.manual_output, loop.lowest), loop.highest);
    loop.integral = output - proportional;  % so that the controller takes over without a bump
  else
    before = loop.previous_error;
    if isempty(before)
      before = fault;
    end
    loop.integral = loop.integral + loop.integral_gain * (fault + before);
    unlimited = proportional + loop.integral;
    output = min(max(unlimited, loop.lowest), loop.highest);
    loop.integral = loop.integral + loop.tracking_gain * (output - unlimited);
  end
  loop.previous_error = fault;
end

function signal = measure(p, level)
% Signals of the sensors (V) at the levels of tanks 1 and 2 (m); with range and resolution where the experiment has them.
  signal = p.sensor_gain * level;
  if p.quantised
    signal = min(max(signal, 0), p.sensor_gain * p.sensor_range);
    if p.sensor_resolution > 0
      signal = floor(signal / p.sensor_resolution + 0.5) * p.sensor_resolution;
    end
  end
end

% ---------------------------------------------------------------- the run

function slope = slopes(p, level, pumped, loads, held)
% dh/dt of each tank (m/s) but for those that are held: a full tank stays full while more comes in than drains, and the
% excess leaves the plant.
  [inflow, drain] = flows(p, level, pumped, loads);
  slope = (inflow - drain) ./ area(p, level);
  slope(held) = 0;
end

function level = runge_kutta(p, level, pumped, loads, held, step)
% One step of the classical method of Runge and Kutta.
  k1 = slopes(p, level, pumped, loads, held);
  k2 = slopes(p, level + step / 2 * k1, pumped, loads, held);
  k3 = slopes(p, level + step / 2 * k2, pumped, loads, held);
  k4 = slopes(p, level + step * k3, pumped, loads, held);
  level = level + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
end

function yes = meets_wall(p, level, pumped, loads, full)
% Whether a tank has become higher than its wall, or one that was full would fall.
  [inflow, drain] = flows(p, level, pumped, loads);
  yes = any(~full & level > p.tank_height * (1 + 1e-12)) || any(full & inflow < drain);
end

function level = level_at_rest(p, inflow, loads)
% Level (m) at which each tank would lose just what it gets.
  drains = outlet_share(loads) .* p.loss_coefficient .* p.outlet_area + loads.leak_area;
  level = (inflow ./ drains) .^ 2 / (2 * p.gravity);
end

function level = advance(p, level, pumped, loads, duration)
% Levels (m) after a duration (s) in which nothing is changed from outside. A step ends where a tank fills up or begins to fall.
  left = duration;
  while left > 0
    [inflow, drain] = flows(p, level, pumped, loads);
    if all(abs(inflow - drain) <= 8 * eps * inflow)
      return;  % at rest, apart from rounding
    end
    full = level >= p.tank_height & inflow > drain;
    [longest, still] = longest_step(p, level, inflow, drain, loads, full);
    step = min(left, longest);
    part = @(time) part_of_step(p, level, pumped, loads, full | still, still, time);
    next = part(step);
    if meets_wall(p, next, pumped, loads, full)
      % By bisection: the time of the first change, from its later side.
      early = 0;
      while step - early > 1e-12 * duration
        middle = (early + step) / 2;
        there = part(middle);
        if meets_wall(p, there, pumped, loads, full)
          step = middle; next = there;
        else
          early = middle;
        end
      end
    end
    level = min(max(next, 0), p.tank_height);
    left = left - step;
  end
end

function [longest, still] = longest_step(p, level, inflow, drain, loads, full)
% Length of a step (s) that is short against how fast levels change, as shares of themselves. A tank that is almost dry, and so
% a hundred times as quick as another, holds so little that longer steps do. Once it is at rest it is still: it follows its inflow.
  speed = max(inflow, drain) ./ (2 * area(p, level));
  quick = speed ./ max(level, level_at_rest(p, inflow, loads));
  stiff = ~full & inflow > 0 & quick > 100 * min(quick(speed > 0));
  still = stiff & abs(inflow - drain) <= 1e-8 * inflow;
  slow = ~full & ~stiff & speed > 0;
  longest = min([max(1e-3, 0.05 / max([speed(slow) ./ level(slow), 0])), 0.5 ./ quick(stiff & ~still)]);
end

function level = part_of_step(p, level, pumped, loads, held, still, time)
% Levels (m) after a part of a step (s).
  level = runge_kutta(p, level, pumped, loads, held, time);
  if any(still)
    rest = level_at_rest(p, flows(p, level, pumped, loads), loads);
    level(still) = rest(still);
  end
end

function run = simulate(p, level, voltage)
% The run from rest: time (s), level (m), reference (m) and pump voltage (V), a row for each sample and for the end.
  slack = 1e-9 * p.sampling_time;
  for i = 1:2
    loops(i) = pi_at_rest(p, i, voltage(p.pump_of_loop(i)) / p.power_gain, p.sensor_gain * level(i));
  end
  loads = no_loads();
  kinds = {'pump_flow', 'tank_flow', 'leak_area', 'pump_gain', 'valve', 'outlet'};
  changes = {p.pump_loads, p.tank_flows, p.leaks, p.pump_gain_changes, p.valve_changes, p.outlet_changes};
  steps = p.set_point_steps; reference = level(1:2);
  moves = p.pump_moves; hand = voltage;
  % What the pumps did before: a sequence that begins with the run has filled the hoses.
  acting = voltage; under_way = {zeros(0, 2), zeros(0, 2)};
  for row = 1:size(moves, 1)
    if moves(row, 1) <= 0
      pump = moves(row, 2);
      acting(pump) = min(max(moves(row, 3), p.pump_min(pump)), p.pump_max(pump));
    end
  end
  sent = acting;
  if ~isempty(p.initial_level)
    level = p.initial_level;
  end
  level = min(level, p.tank_height);
  samples = floor(p.end_time / p.sampling_time + 1e-9);
  rows = zeros(samples + 2, 9);
  for k = 0:samples
    time = k * p.sampling_time;
    last = min((k + 1) * p.sampling_time, p.end_time);
    [steps, reference] = take(steps, reference, time + slack);
    measured = measure(p, level(1:2));
    for i = 1:2
      [output, loops(i)] = pi_step(loops(i), time, p.sensor_gain * reference(i), measured(i));
      voltage(p.pump_of_loop(i)) = p.power_gain * output;
    end
    [moves, hand] = move_pumps(moves, hand, time + slack);
    for pump = 1:2
      if any(p.pump_moves(:, 2) == pump)  % no controller moves such a pump
        voltage(pump) = min(max(hand(pump), p.pump_min(pump)), p.pump_max(pump));
      end
    end
    rows(k + 1, :) = [time, level, reference, voltage];
    for pump = 1:2
      if voltage(pump) ~= sent(pump) || p.pump_delay(pump) == 0
        under_way{pump}(end + 1, :) = [time + p.pump_delay(pump), voltage(pump)];
      end
    end
    sent = voltage;
    % Loads begin, and flows arrive, at their exact times, between samples too.
    due = time + slack;
    while time < last
      next = last;
      for pump = 1:2
        [under_way{pump}, acting(pump)] = arrive(under_way{pump}, acting(pump), due);
        coming = under_way{pump}(:, 1);
        next = min([next; coming(coming < last - slack)]);
      end
      for kind = 1:numel(kinds)
        [changes{kind}, loads.(kinds{kind})] = take(changes{kind}, loads.(kinds{kind}), due);
        coming = changes{kind}(:, 1);
        next = min([next; coming(coming < last - slack)]);
      end
      level = advance(p, level, valve_flows(p, acting, loads) + outside_flows(p, loads), loads, next - time);
      time = next;
      due = time;
    end
  end
  rows(end, :) = [time, level, reference, voltage];
  run = struct('time', rows(:, 1), 'level', rows(:, 2:5), 'reference', rows(:, 6:7), 'voltage', rows(:, 8:9));
end

function [moves, hand] = move_pumps(moves, hand, time)
% Takes the moves that are due: the voltages (V) that a hand has set.
  while ~isempty(moves) && moves(1, 1) <= time
    hand(moves(1, 2)) = moves(1, 3);
    moves(1, :) = [];
  end
end

function [under_way, voltage] = arrive(under_way, voltage, time)
% Lets the voltage (V) act whose flow has passed the hose.
  while ~isempty(under_way) && under_way(1, 1) <= time
    voltage = under_way(1, 2);
    under_way(1, :) = [];
  end
end

function [changes, values] = take(changes, values, time)
% Adds all changes that are due to what they change.
  while ~isempty(changes) && changes(1, 1) <= time
    values(changes(1, 2)) = values(changes(1, 2)) + changes(1, 3);
    changes(1, :) = [];
  end
end

% ---------------------------------------------------------------- expected figures

function agree(what, found, expected, scale)
% An error where a figure differs from the expected one by more than the tolerance times its scale.
  assert(numel(found) == numel(expected), '%s: %d figures instead of %d', what, numel(found), numel(expected));
  if isempty(expected)
    fprintf('%s: none\n', what);
    return;
  end
  difference = max(max(abs(found - expected) ./ scale));
  assert(difference <= tolerance(), '%s: %s instead of %s', what, mat2str(found, 17), mat2str(expected, 17));
  fprintf('%s: figures %d, largest difference %.1e of the scale\n', what, numel(expected), difference);
end

function check_linear_analysis(p, level, voltage)
% Everything that linear theory says.
  if isempty(p.expected_poles)
    disp('linear model: none, every tank is dry');
    return;
  end
  plant = linear_model(p, level, voltage);
  rate = max(abs(p.expected_poles));
  agree('poles', reshape(sort(real(pole(plant))), 1, []), p.expected_poles, rate);
  if p.degenerate
    disp('transmission zeros: none, the plant is singular at every frequency');
  else
    agree('transmission zeros', transmission_zeros(plant), p.expected_zeros, rate);
  end
  gain = dcgain(plant);
  agree('steady-state gain', gain, p.expected_gain, max(abs(p.expected_gain(:))));
  response = freqresp(plant, rate);
  agree('transfer matrix', freqresp(transfer_matrix(p, level, voltage), rate), response, max(abs(response(:))));
  if isempty(p.expected_lambda)
    disp('relative gain: none, the steady-state gain is singular');
  else
    array = gain .* inv(gain).';  % Bristol 1966
    agree('relative gain', array(1, 1), p.expected_lambda, max(1, abs(p.expected_lambda)));
  end
  if any(p.pump_delay > 0)
    disp('closed-loop poles: none, with dead time there is one more for each sample of the delay');
    return;
  end
  moduli = reshape(sort(abs(pole(closed_loop(p, plant)))), 1, []);
  agree('closed-loop poles, moduli', moduli, p.expected_moduli, max(1, max(p.expected_moduli)));
end

function draw(run)
% Levels with their references, and pump voltages.
  subplot(2, 1, 1);
  plot(run.time, run.level);
  hold('on');
  stairs(run.time, run.reference(:, 1), 'k--');
  stairs(run.time, run.reference(:, 2), 'k--');
  ylabel('level (m)');
  legend('level 1', 'level 2', 'level 3', 'level 4');
  subplot(2, 1, 2);
  stairs(run.time, run.voltage(:, 1));
  hold('on');
  stairs(run.time, run.voltage(:, 2));
  xlabel('time (s)');
  ylabel('voltage (V)');
  legend('pump 1', 'pump 2');
end
