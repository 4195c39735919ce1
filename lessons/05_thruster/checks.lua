-- The checks of lesson 5. `a` contains the answers, `b` the answers of a run on the data of another thruster.

local Ts, neutral, rest, amplitudes = 0.002, 1500, 250, {100, 200, 300}
local function fact(a) return truth(a, "thruster") end

local function judge(message) return {share = 0, message = message} end
local function low_pass(v) return idfilt(v, {0, 2*math.pi*8}, {zero_phase = true, Ts = Ts}) end

-- Simulated thrust of the submitted model; outside its breakpoints, the static curve is constant.
local function simulated(model, pwm)
    local y = lsim(model.G, interp1(model.width, model.level, pwm - neutral, {outside = "hold"}), Ts)
    return model.root and y*abs(y) or y
end
-- Fit below 8 Hz over the three data sets of a shape.
local function fit_on(records, shape, model)
    local errors, swings = {}, {}
    for k, amplitude in ipairs(amplitudes) do
        local r = records[shape .. "_" .. amplitude]
        local y = low_pass(r.force - mean(r.force:range(1, rest)))
        errors[k], swings[k] = y - low_pass(simulated(model, r.pwm)), y - mean(y)
    end
    return 100*(1 - norm(vector(errors))/norm(vector(swings)))
end
local function static_at_300(facts) return interp1(facts.pwm - facts.neutral, facts.thrust, vector{300, -300}) end

local official = load("thruster")
local known = {}  -- fits of the model to the official data; one run of the checks grades one submission
local function own_fit(model, shape)
    known[shape] = known[shape] or fit_on(official, shape, model)
    return known[shape]
end
local function with(model, changes)
    local other = {width = model.width, level = model.level, G = model.G, root = model.root}
    for name, value in pairs(changes) do other[name] = value end
    return other
end

check { id = "ring_frequency", points = 1, about = "The ringing frequency of the square chirp",
    -- The lines of a smoothed spectrum are 0.1 Hz apart; the resonance of the beam is 2 Hz wide.
    test = function(a) return near(a.ring_frequency, fact(a).cell_frequency, {rel = 0.05, half = 0.1}) end,
    mistakes = {
        {when = function(a) return near(a.ring_frequency, 2*math.pi*fact(a).cell_frequency, {rel = 0.06}) end,
         say = "This is in rad/s; use Hz."},
    },
    hint = "Use etfe with some smoothing for a square chirp, and find the peak above the bandwidth of the thruster." }

check { id = "dead_band", points = 2, about = "The ends of the dead band",
    -- A parabola through noisy bins of 10 µs is accurate to about 3 µs, a reading to one bin.
    test = function(a)
        if #a.dead_band ~= 2 then return judge("The answer must have two numbers: the forward and the reverse end.") end
        return near(a.dead_band, vector{fact(a).dead_band, -fact(a).dead_band}, {abs = 8, half = 15})
    end,
    mistakes = {
        {when = function(a) return min(a.dead_band) > 1000 end, say = "The neutral width is not subtracted: measure widths from 1500 µs."},
        {when = function(a) return a.dead_band[1] < a.dead_band[2] end, say = "The order is forward end, reverse end."},
        {when = function(a) return min(a.dead_band) > 0 end, say = "The reverse end is below neutral, so it is negative."},
        {when = function(a) return a.dead_band[1] - a.dead_band[2] < 20 end,
         say = "The dead band is almost zero: a linear model has no dead band, but the thruster has one."},
    },
    hint = "Plot the square root of the thrust versus the pulse width. At which widths does it reach zero?" }

check { id = "delay", points = 2, about = "The delay of the thruster",
    -- Models with a static curve and one lag, estimated from the sine chirps, were accurate to 4 ms on six thrusters.
    test = function(a) return near(a.delay, fact(a).delay, {abs = 0.006, half = 0.01}) end,
    mistakes = {
        {when = function(a) return near(a.delay, 1000*fact(a).delay, {rel = 0.35}) end, say = "This is in ms; use seconds."},
        {when = function(a) return near(a.delay, fact(a).delay/Ts, {rel = 0.35}) end,
         say = "This is counted in samples; use seconds."},
        {when = function(a) return a.delay < 0.024 end,
         say = "The delay is too short: a linear model of the sine chirps starts too early because it has no dead band."},
    },
    hint = "Estimate the delay together with the static curve, or inspect the mean response to a switching." }

check { id = "thrust_300", points = 2, about = "Steady thrust forward and in reverse",
    test = function(a)
        if #a.thrust_300 ~= 2 then return judge("The answer must have two numbers: the thrust at +300 µs and at -300 µs.") end
        return near(a.thrust_300/static_at_300(fact(a)), ones(2), {rel = 0.08, half = 0.16})
    end,
    mistakes = {
        {when = function(a) return a.thrust_300[2] > 0 and a.thrust_300[1] > 0 end, say = "Reverse thrust is negative."},
        {when = function(a) return near(a.thrust_300[1], -a.thrust_300[2], {rel = 0.02}) end,
         say = "Forward and reverse thrust are equal, but the propeller is more efficient forward."},
        {when = function(a) return near(a.thrust_300*abs(a.thrust_300)/static_at_300(fact(a)), ones(2), {rel = 0.2}) end,
         say = "These are the square roots of the thrust: square them."},
    },
    hint = "Read the load cell when the response to a switching has settled, or use the ends of the static curve." }

check { id = "model", points = 4, about = "The recommended model on the square chirps",
    -- Fits of models from the sine chirps: linear 70 %, static curve with one lag 87 %, root model 90 %.
    test = function(a) return points_between(own_fit(a.model, "square"), 62, 85) end,
    mistakes = {
        {when = function(a) return min(a.model.width) > 500 end, say = "The neutral width is not subtracted: measure widths from 1500 µs."},
        {when = function(a) return a.model.G.IODelay >= 1 end, say = "The delay of G is not in seconds."},
        {when = function(a) return fit_on(official, "square", with(a.model, {root = not a.model.root})) > 80 end,
         say = "The field root contradicts the output of this model."},
        {when = function(a) return fit_on(official, "square", with(a.model, {level = -a.model.level})) > 50 end,
         say = "The sign is wrong: wider pulses push forward."},
        {when = function(a) return max(abs(diff(a.model.level)/diff(a.model.width)*diff(a.model.width)[1]/diff(a.model.level)[1] - 1)) < 1e-6 end,
         say = "This model is linear: it describes neither the dead band nor the difference between forward and reverse."},
        {when = function(a) return a.model.G.IODelay < 0.01 end, say = "The model responds without a delay."},
    },
    hint = "Use a static curve with a dead band, then a lag and a delay. How does the thrust depend on the propeller speed?" }

check { id = "fit", points = 1, about = "The fit of the model to the square chirps",
    test = function(a) return near(a.fit, own_fit(a.model, "square"), {abs = 1.5, half = 3}) end,
    mistakes = {
        {when = function(a) return near(a.fit, own_fit(a.model, "sine"), {abs = 0.5}) end,
         say = "This is the fit to the sine chirps, from which the model was estimated."},
        {when = function(a) return a.fit <= 1 end, say = "The result must be in percent."},
    },
    hint = "Compute 100 (1 - |error|/|y - mean|) over the three square chirps together, with both signals filtered below 8 Hz." }

check { id = "figures", points = 1, about = "Figures of the static curve and of the validation",
    test = function() return all_of(has_figure("curve"), has_figure("validation")) end,
    hint = "report.figure(\"curve\", fig, \"...\") and report.figure(\"validation\", fig, \"...\")." }

-- Static curve including the gain of G, because equivalent models can distribute a gain differently.
local function gains(model) return model.level*dcgain(model.G) end

local typed = {
    {when = function(a, b) return near(a.thrust_300, b.thrust_300, {rel = 1e-9}) end,
     say = "The results do not change with the data: compute them; do not type them in."},
}

check { id = "statics_follow", points = 3, rerun = "thruster", about = "Another thruster: its thrust and its delay",
    test = function(a, b)
        local other = truth(b)
        return all_of(differs(a.thrust_300, b.thrust_300), differs(a.delay, b.delay),
                      near(b.thrust_300/static_at_300(other), ones(2), {rel = 0.1, half = 0.18}),
                      near(b.delay, other.delay, {abs = 0.006, half = 0.01}))
    end,
    mistakes = typed,
    hint = "Compute the numbers in the script; do not read them off a figure." }

check { id = "model_follows", points = 5, rerun = "thruster",
    about = "Another thruster: your model simulates hidden square chirps",
    test = function(a, b)
        return all_of(differs(gains(a.model), gains(b.model)), points_between(fit_on(hidden("thruster"), "square", b.model), 62, 84))
    end,
    mistakes = {
        {when = function(a, b) return near(gains(a.model), gains(b.model), {rel = 1e-9}) end,
         say = "The model does not change with the data: estimate it; do not type it in."},
    },
    hint = "Estimate the static curve and the dynamics from the data that load(\"thruster\") returns." }
