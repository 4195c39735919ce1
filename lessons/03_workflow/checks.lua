-- The checks of lesson 3.1. `a` holds the answers, `b` those of a run on records of another linear system or another rig.

local function judge(message) return {share = 0, message = message} end

-- The simulated system -----------------------------------------------------------------------------------------------

local linear = load("linear_system")
local Ts = linear.t[2] - linear.t[1]
local est, val = iddata(linear.y, linear.u, Ts), iddata(linear.y_val, linear.u_val, Ts)
local function true_orders(a)
    local G = truth(a, "linear_system").G
    return vector{#pole(G), #zero(G)}
end
local from_first, from_second = srivc(est, {2, 3, 0}), srivc(val, {2, 3, 0})

-- How far two models are apart on an input: the size of the difference of their outputs, in parts of the swing of the first.
local function apart(reference, G, u)
    local y, other = lsim(reference, u, Ts), lsim(G, u, Ts)
    return sqrt(mean((other - y)^2))/std(y)
end
local function fit_to(data, G) return fit(data, G, {InitialState = "zero", Offset = "none"}) end

check { id = "linear_orders", points = 1, about = "Simulated system: how many poles and zeros",
    test = function(a) return near(a.linear_orders, true_orders(a), {abs = 0, half = 1}) end,
    mistakes = {
        {when = function(a) return a.linear_orders[1] == true_orders(a)[1] and a.linear_orders[2] == true_orders(a)[2] + 1 end,
         say = "The second number is that of the zeros, one less than the coefficients of B; a further zero finds nothing to do."},
        {when = function(a) return near(a.linear_orders, vector{true_orders(a)[2], true_orders(a)[1]}, {abs = 0}) end,
         say = "The order is poles, zeros."},
        {when = function(a) return a.linear_orders[1] < true_orders(a)[1] end,
         say = "Too simple: on the second record a larger model is clearly ahead."},
        {when = function(a) return a.linear_orders[1] > true_orders(a)[1] end,
         say = "Too many: the second record cannot tell this model from a simpler one."},
    },
    hint = "The simplest structure that the second record cannot tell from larger ones." }

-- With noise of a fifth of the swing and 1000 samples, estimates stay within 2.3 % of the true output (25 systems); two poles miss it by 26 %.
check { id = "linear_model", points = 2, about = "Simulated system: the model",
    test = function(a)
        local G = a.G_linear
        if apart(from_second, G, linear.u) < 1e-3 then
            return judge("This model was estimated on the second record, which was put away for validation.")
        end
        return near(apart(from_first, G, linear.u_val), 0, {abs = 0.03, half = 0.08})
    end,
    mistakes = {
        {when = function(a) return a.G_linear.Ts > 0 end,
         say = "A continuous-time model is wanted; arx gives a difference equation, and a biased one here."},
        {when = function(a) return dcgain(a.G_linear) < 0 end, say = "The gain has the wrong sign."},
        {when = function(a) return near(dcgain(a.G_linear), dcgain(from_first), {rel = 0.1}).share == 1 and
                                   sum(damp(a.G_linear)) < 0.2*sum(damp(from_first)) end,
         say = "Time is counted in samples: give the data their sampling time."},
        {when = function(a) return #pole(a.G_linear) < 3 end,
         say = "The model has too few poles: the second record asks for three."},
    },
    hint = "srivc(est, {2, 3, 0}) on the first record." }

check { id = "linear_fit", points = 2, about = "Simulated system: what the model is worth",
    test = function(a) return near(a.linear_fit, fit_to(val, a.G_linear), {abs = 0.3}) end,
    mistakes = {
        {when = function(a) return near(a.linear_fit, fit_to(est, a.G_linear), {abs = 0.1}) end,
         say = "This is the fit to the record that the model was estimated on."},
        {when = function(a) return near(a.linear_fit, arx(est, {3, 3, 1}).report.prediction_fit_percent, {abs = 0.3}) end,
         say = "This is how well the next sample is predicted; the fit of the simulated output is wanted."},
        {when = function(a) return near(a.linear_fit, fit_to(val, a.G_linear)/100, {rel = 0.02}) end,
         say = "Percent are wanted."},
        {when = function(a) return near(a.linear_fit, 100*(1 - (1 - fit_to(val, a.G_linear)/100)^2), {abs = 0.3}) end,
         say = "This is the coefficient of determination in percent; the fit is 100 (1 - |error|/|y - mean|)."},
    },
    hint = "fit(val, G) simulates the second record with the model." }

-- The true system itself loses only the noise; 3 points below it a model of the right structure has never been.
check { id = "linear_follows", points = 5, rerun = "linear_system",
    about = "Another linear system: your model simulates a record that it has not seen",
    test = function(a, b)
        local unseen, best = hidden("linear_system"), truth(b).G
        local data = iddata(unseen.y_val, unseen.u_val, unseen.t[2] - unseen.t[1])
        return all_of(differs(dcgain(a.G_linear), dcgain(b.G_linear)),
                      points_between(fit_to(data, b.G_linear) - fit_to(data, best), -12, -2))
    end,
    mistakes = {
        {when = function(a, b) return near(dcgain(a.G_linear), dcgain(b.G_linear), {rel = 1e-9}) end,
         say = "The model does not change with the record: it must be estimated, not typed in."},
        {when = function(_, b) return b.G_linear.Ts > 0 end,
         say = "A difference equation from arx predicts well and simulates badly: its noise model is wrong here."},
    },
    hint = "Everything in G_linear must come from what load(\"linear_system\") gives." }

-- The rig ------------------------------------------------------------------------------------------------------------

local heat = load("heat_transfer")
local function power(y, u) return iddata(y, u^2, 1) end  -- 100 W at 10 V: as many watts as volts squared
local function without_drift(data) return idfilt(detrend(data, "start"), {0.015, math.huge}, {order = 2}) end
local low = power(heat.y, heat.u)
local wanted = procsrivc(without_drift(low), "P2D", {TdMax = 20, InitialState = "zero", Offset = "none"})

-- What a record says well of the rig: gain, slow lag, and the sum of the delay and the short lags.
local function facts(G)
    local p = pole(G)
    if max(p.re) >= 0 then return nil end
    local lags = -1/p.re
    return vector{dcgain(G), max(lags), sum(lags) - max(lags) + G.IODelay}
end
-- The lags estimated on sixty rigs were wrong by at most 5 %, the gain by at most 4 %; other edges of the filter cost as much again.
local function close(found, gain, slow, rest)
    if not found then return judge("The model is not stable.") end
    return all_of(near(found[1], gain, {rel = 0.06, half = 0.12}), near(found[2], slow, {rel = 0.08, half = 0.16}),
                  near(found[3], rest, {rel = 0.1, half = 0.2}))
end

local wrong_input = {
    {when = function(a) return a.G_heat.Ts > 0 end,
     say = "A continuous-time model is wanted, but this one is in discrete time."},
    {when = function(a) return dcgain(a.G_heat) < 0 end, say = "The gain has the wrong sign."},
    {when = function(a) return near(dcgain(a.G_heat), 8*wanted.Kp, {rel = 0.25}) end,
     say = "The gain is in degrees per volt: the input is the voltage, and no gain of that kind holds about 7 V."},
    {when = function(a) return near(dcgain(a.G_heat), 100*wanted.Kp, {rel = 0.15}) end,
     say = "The input is the part of full power; the gain per watt is a hundredth of this."},
    {when = function(a) return a.G_heat.IODelay == 0 end, say = "The model has no delay; the temperature answers some seconds late."},
}

check { id = "heat_model", points = 3, about = "Rig: gain and lags of the final model",
    test = function(a)
        local ref = facts(wanted)
        return close(facts(a.G_heat), ref[1], ref[2], ref[3])
    end,
    mistakes = wrong_input,
    hint = "Power for the input, levels and drift off both signals, two lags and a delay." }

check { id = "heat_follows", points = 5, rerun = "heat_transfer",
    about = "Another rig: the model from 4 V holds about 7 V, on a record that it has not seen",
    test = function(a, b)
        local fact, unseen = truth(b), hidden("heat_transfer")
        local at_seven = without_drift(power(unseen.y_high, unseen.u_high))
        return all_of(differs(dcgain(a.G_heat), dcgain(b.G_heat)),
                      close(facts(b.G_heat), fact.low.gain/(2*fact.low.voltage), fact.low.slow,
                            fact.dead_time + fact.sensor_time + fact.low.fast),
                      points_between(fit_to(at_seven, b.G_heat), 60, 85))
    end,
    mistakes = {
        {when = function(a, b) return near(dcgain(a.G_heat), dcgain(b.G_heat), {rel = 1e-9}) end,
         say = "The model does not change with the record: it must be estimated, not typed in."},
        {when = function(_, b) return dcgain(b.G_heat) > 2 end,
         say = "The gain of this model is far too large: is its input the power in watts?"},
    },
    hint = "Prepare and estimate from what load(\"heat_transfer\") gives, and hold the model against the record about 7 V." }

-- The hair dryer -----------------------------------------------------------------------------------------------------

local dryer = load("hairdryer")
local first, second = iddata(dryer.y, dryer.u, dryer.Ts):split(0.5)
first, second = first:remove_mean(), second:remove_mean()
local from_second_half = srivc(second, {1, 2, 2}, {InitialState = "none", Offset = "none"})

check { id = "dryer_model", points = 2, about = "Hair dryer: the model on the half that it has not seen",
    -- Two poles reach 91.8 %, one pole 84.9 %, an arx model of second order 91.3 %; 0 without a delay.
    test = function(a)
        if near(fit(first, a.G_dryer), fit(first, from_second_half), {abs = 1e-4}).share == 1 then
            return judge("This model was estimated on the second half, which is for validation.")
        end
        return points_between(fit(second, a.G_dryer), 79, 90.5)
    end,
    mistakes = {
        {when = function(a) return dcgain(a.G_dryer) < 0 end, say = "The gain has the wrong sign."},
        {when = function(a) return a.G_dryer.IODelay == 0 and a.G_dryer.Ts == 0 end,
         say = "The model has no delay; the output answers two samples late."},
        {when = function(a) return a.G_dryer.IODelay >= 1 end,
         say = "The delay is counted in samples; seconds are wanted."},
        {when = function(a) return #pole(a.G_dryer) == 1 end,
         say = "With one pole the delay has to stand in for a missing lag; the second half tells against it."},
    },
    hint = "srivc(first, {1, 2, 2}): two poles and two samples of delay, both means taken off." }

check { id = "dryer_fit", points = 2, about = "Hair dryer: what the model is worth",
    test = function(a) return near(a.dryer_fit, fit(second, a.G_dryer), {abs = 0.3}) end,
    mistakes = {
        {when = function(a) return near(a.dryer_fit, fit(first, a.G_dryer), {abs = 0.1}) end,
         say = "This is the fit to the half that the model was estimated on."},
        {when = function(a) return a.dryer_fit > fit(second, a.G_dryer) + 1.5 end,
         say = "No model simulates the second half as well as this: it looks like the fit of predicting one step."},
    },
    hint = "fit(second, G): the simulated output on the second half." }

check { id = "figures", points = 1, about = "Residuals and comparisons are drawn",
    test = function() return all_of(has_figure("linear_resid"), has_figure("heat_high"), has_figure("dryer_compare")) end,
    hint = "report.figure(\"linear_resid\", resid(val, G), \"...\") and the others by their names." }
