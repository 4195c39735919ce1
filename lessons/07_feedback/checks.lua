-- The checks of lesson 7. `a` contains the answers, `b` the answers of a run on the data of another drive or heater.

local Ts, lambda = 0.01, 10
local official = load("drive").tracking
local data = iddata(official.y, official.u, Ts)
local function plant(a) return truth(a, "drive").G end
local function heater(a) return truth(a, "drifting_process") end
local function judge(message) return {share = 0, message = message} end

-- The regression of question 5, with instruments from the reference through a filter of this order, or with least squares.
local function regression(record, instruments)
    local Y = svf(record.y, 2, lambda, {Ts = Ts, hold = "foh"})
    local U = svf(record.u, 2, lambda, {Ts = Ts, hold = "zoh"})
    local Phi = matrix{-Y:col(2), -Y:col(3), U:col(3)}
    if not instruments then return solve(Phi:t()*Phi, Phi:t()*Y:col(1)) end
    local R, n = svf(record.r, instruments, lambda, {Ts = Ts, hold = "zoh"}), instruments
    local Z = matrix{R:col(n - 1), R:col(n), R:col(n + 1)}
    return solve(Z:t()*Phi, Z:t()*Y:col(1))
end
local wanted, second_order, least_squares = regression(official, 4), regression(official, 2), regression(official)
local from_rest = {InitialState = "none", Offset = "none"}
local direct = srivc(data, {1, 2, 0}, from_rest)
local opened = load("drive").open_loop
local in_the_open = srivc(iddata(opened.y, opened.u, Ts), {1, 2, 0}, from_rest)

check { id = "direct", points = 1, about = "The direct method",
    test = function(a) return near(a.G_direct.param, direct.param, {rel = 1e-2}) end,
    mistakes = {
        {when = function(a) return near(a.G_direct.param, lssvf(data, {2, 1, 0}, lambda).param, {rel = 1e-2}) end,
         say = "This is the model of LSSVF; use the direct method with SRIVC."},
        {when = function(a) return near(a.G_direct.param, in_the_open.param, {rel = 1e-2}) end,
         say = "This model is not biased: check that you estimated it from tracking, not from open_loop."},
    },
    hint = "Use srivc with the voltage and the speed of tracking, as if there were no feedback." }

check { id = "own_instruments", points = 3, about = "Instruments from the reference",
    test = function(a)
        if #a.own_instruments ~= 3 then return judge("The answer must have three numbers: a1, a2, b0.") end
        return near(a.own_instruments, wanted, {rel = 1e-2, half = 5e-2})
    end,
    mistakes = {
        {when = function(a) return near(a.own_instruments, least_squares, {rel = 1e-2}) end,
         say = "This is the least-squares estimate: the instruments must not be the regressors."},
        {when = function(a) return near(a.own_instruments, second_order, {rel = 1e-2}) end,
         say = "You used a second-order filter for the reference, whose second derivative jumps; use a fourth-order filter."},
        {when = function(a) return near(a.own_instruments, wanted*vector{-1, -1, 1}, {rel = 1e-2}) end,
         say = "a1 and a2 have the wrong sign: the regressors are -p y_f and -y_f."},
        {when = function(a) return near(a.own_instruments, wanted*vector{-1, -1, -1}, {rel = 1e-2}) end,
         say = "All parameters have the wrong sign."},
    },
    hint = "Use solve(Z:t()*Phi, Z:t()*Y) with the last three columns of svf(r, 4, 10, ...) as Z." }

-- The gain of the direct method is 20 % too small; the scatter of the unbiased methods is about 8 %. CLSRIVC has the largest
-- scatter: for one drive in several hundred, the error of a1 exceeds 60 %, but not two standard errors.
local function cured(G, facts)
    return all_of(near(dcgain(G), dcgain(facts), {rel = 0.45, half = 0.6}), near(G.den[2]/G.den[1], facts.den[2], {rel = 0.75, half = 0.95}))
end
local function says_direct(a, name)
    return near(a[name].param, a.G_direct.param, {rel = 1e-6})
end

check { id = "two_stage", points = 2, about = "Two stages",
    test = function(a) return all_of(differs(a.G_two_stage.param, a.G_direct.param), cured(a.G_two_stage, plant(a))) end,
    mistakes = {
        {when = function(a) return says_direct(a, "G_two_stage") end, say = "This is the direct method: the second stage needs the simulated voltage of the first stage."},
        {when = function(a) return dcgain(a.G_two_stage) < 0.4*dcgain(plant(a)) end,
         say = "This is the closed loop from reference to speed: use the simulated voltage as the input of the second stage."},
    },
    hint = "First estimate the model from r to u, then the model from the simulated voltage to y." }

check { id = "final_model", points = 4, about = "The recommended model of the drive",
    test = function(a)
        if a.G_final.Ts > 0 then return judge("The model must be a continuous-time model, but it is a discrete-time model.") end
        return all_of(differs(a.G_final.param, a.G_direct.param), cured(a.G_final, plant(a)))
    end,
    mistakes = {
        {when = function(a) return says_direct(a, "G_final") end, say = "The feedback biases the direct method; recommend another model."},
    },
    hint = "Use a method with instruments from the reference." }

check { id = "final_is_estimated", points = 1, about = "The recommended model contains its standard errors",
    test = function(a)
        local facts = plant(a)
        return near(a.G_final.param, vector{facts.den[2], facts.den[3], facts.num[#facts.num]}, {abs = 8*max(a.G_final.std)})
    end,
    hint = "Submit the model that the method returned; do not type it in." }

-- Returns the true gain and time constant at an instant.
local function at(a, instant) return vector{heater(a).gain[instant + 1], heater(a).time_constant[instant + 1]} end
local function follows_both(found, wanted)
    return all_of(near(found[1]/wanted[1], 1, {abs = 0.13, half = 0.2}), near(found[2]/wanted[2], 1, {abs = 0.4, half = 0.5}))
end
local function tracked(found, a, instant) return follows_both(found, at(a, instant)) end
local before, after = 2600, 4500
local stands_still = srivc(iddata(load("drifting_process").y, load("drifting_process").u, 1), {1, 1, 0}, {InitialState = "estimate", Offset = "none"})
local function follows(name, instant)
    return function(a)
        if #a[name] ~= 2 then return judge("The answer must have two numbers: gain and time constant.") end
        return tracked(a[name], a, instant)
    end
end
local function slips(name, instant)
    return {
        {when = function(a) return tracked(vector{a[name][2], a[name][1]}, a, instant) end, say = "The order is gain, time constant."},
        {when = function(a) return near(a[name], vector{dcgain(stands_still), 1/stands_still.den[2]}, {rel = 1e-2}) end,
         say = "This is the single model of all data, which does not track the changes."},
        {when = function(a) return tracked(vector{a[name][1], 1/a[name][2]}, a, instant) end,
         say = "The second number is the pole a; the time constant is its inverse."},
    }
end

check { id = "before_cleaning", points = 2, about = "The heater with scale, at 2600 s",
    test = follows("before_cleaning", before), mistakes = slips("before_cleaning", before),
    hint = "Use the gain b/a and the time constant 1/a of the recursion with instruments at sample 2601." }

check { id = "after_cleaning", points = 2, about = "The heater after it was descaled, at 4500 s",
    test = follows("after_cleaning", after), mistakes = slips("after_cleaning", after),
    hint = "Use the gain and the time constant at sample 4501. Choose a forgetting factor that is small enough to forget the data before the cleaning." }

check { id = "figures", points = 1, about = "Figures of the correlation and of the tracked parameters",
    test = function() return all_of(has_figure("correlation"), has_figure("tracking")) end,
    hint = "report.figure(\"correlation\", fig, \"...\") and report.figure(\"tracking\", fig, \"...\")." }

check { id = "drive_follows", points = 4, rerun = "drive", about = "Another drive: your recommended model",
    test = function(a, b)
        return all_of(differs(a.G_final.param, b.G_final.param), differs(b.G_final.param, b.G_direct.param), cured(b.G_final, truth(b).G))
    end,
    mistakes = {
        {when = function(a, b) return near(a.G_final.param, b.G_final.param, {rel = 1e-9}) end,
         say = "The model does not change with the data: estimate it; do not type it in."},
        {when = function(a, b) return near(b.G_final.param, b.G_direct.param, {rel = 1e-6}) end,
         say = "This is the direct method again."},
    },
    hint = "Estimate from the data that load(\"drive\") returns." }

check { id = "heater_follows", points = 3, rerun = "drifting_process", about = "Another heater: gain and time constant",
    test = function(a, b)
        local facts = truth(b)
        local function of(instant) return vector{facts.gain[instant + 1], facts.time_constant[instant + 1]} end
        return all_of(differs(a.before_cleaning, b.before_cleaning),
                      follows_both(b.before_cleaning, of(before)), follows_both(b.after_cleaning, of(after)))
    end,
    mistakes = {
        {when = function(a, b) return near(a.before_cleaning, b.before_cleaning, {rel = 1e-9}) end,
         say = "The results do not change with the data: compute them; do not type them in."},
    },
    hint = "Run the recursion over the data that load(\"drifting_process\") returns." }
