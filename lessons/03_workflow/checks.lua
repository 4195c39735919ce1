-- The checks of lesson 3.1. `a` contains the answers, `b` the answers of a run on data of another linear system or plant.

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

-- Returns the RMS difference between the outputs of two models, relative to the standard deviation of the first output.
local function apart(reference, G, u)
    local y, other = lsim(reference, u, Ts), lsim(G, u, Ts)
    return sqrt(mean((other - y)^2))/std(y)
end
local function fit_to(data, G) return fit(data, G, {InitialState = "none", Offset = "none"}) end

check { id = "linear_orders", points = 1, about = "Simulated system: the numbers of poles and zeros",
    test = function(a) return near(a.linear_orders, true_orders(a), {abs = 0, half = 1}) end,
    mistakes = {
        {when = function(a) return a.linear_orders[1] == true_orders(a)[1] and a.linear_orders[2] == true_orders(a)[2] + 1 end,
         say = "The second number is the number of zeros, one less than the number of coefficients of B; an additional zero has no effect."},
        {when = function(a) return near(a.linear_orders, vector{true_orders(a)[2], true_orders(a)[1]}, {abs = 0}) end,
         say = "The order is poles, zeros."},
        {when = function(a) return a.linear_orders[1] < true_orders(a)[1] end,
         say = "The model has too few poles: on the second data set, a larger model is clearly better."},
        {when = function(a) return a.linear_orders[1] > true_orders(a)[1] end,
         say = "The model has too many poles: the second data set cannot distinguish it from a simpler model."},
    },
    hint = "Choose the simplest structure that the second data set cannot distinguish from larger structures." }

-- With 20 % noise and 1000 samples, estimates are within 2.3 % of the true output (25 systems); models with two poles differ
-- by 26 %.
check { id = "linear_model", points = 2, about = "Simulated system: the model",
    test = function(a)
        local G = a.G_linear
        if apart(from_second, G, linear.u) < 1e-3 then
            return judge("This model was estimated from the second data set, which is reserved for validation.")
        end
        return near(apart(from_first, G, linear.u_val), 0, {abs = 0.03, half = 0.08})
    end,
    mistakes = {
        {when = function(a) return a.G_linear.Ts > 0 end,
         say = "The model must be a continuous-time model. arx estimates a difference equation, which is biased for these data."},
        {when = function(a) return dcgain(a.G_linear) < 0 end, say = "The gain has the wrong sign."},
        {when = function(a) return near(dcgain(a.G_linear), dcgain(from_first), {rel = 0.1}).share == 1 and
                                   sum(damp(a.G_linear)) < 0.2*sum(damp(from_first)) end,
         say = "Time is counted in samples: specify the sampling time of the data."},
        {when = function(a) return #pole(a.G_linear) < 3 end,
         say = "The model has too few poles: the second data set requires three."},
    },
    hint = "Use srivc(est, {2, 3, 0}) with the first data set." }

check { id = "linear_fit", points = 2, about = "Simulated system: the fit of the model",
    test = function(a) return near(a.linear_fit, fit_to(val, a.G_linear), {abs = 0.3}) end,
    mistakes = {
        {when = function(a) return near(a.linear_fit, fit_to(est, a.G_linear), {abs = 0.1}) end,
         say = "This is the fit to the data from which the model was estimated."},
        {when = function(a) return near(a.linear_fit, arx(est, {3, 3, 1}).report.prediction_fit_percent, {abs = 0.3}) end,
         say = "This is the fit of the one-step-ahead prediction; answer with the fit of the simulated output."},
        {when = function(a) return near(a.linear_fit, fit_to(val, a.G_linear)/100, {rel = 0.02}) end,
         say = "The result must be in percent."},
        {when = function(a) return near(a.linear_fit, 100*(1 - (1 - fit_to(val, a.G_linear)/100)^2), {abs = 0.3}) end,
         say = "This is the coefficient of determination in percent; the fit is 100 (1 - |error|/|y - mean|)."},
    },
    hint = "fit(val, G) simulates the second data set with the model." }

-- The true system has the best possible fit; models with the correct structure were never 3 points below it.
check { id = "linear_follows", points = 5, rerun = "linear_system",
    about = "Another linear system: your model simulates hidden data",
    test = function(a, b)
        local unseen, best = hidden("linear_system"), truth(b).G
        local data = iddata(unseen.y_val, unseen.u_val, unseen.t[2] - unseen.t[1])
        return all_of(differs(dcgain(a.G_linear), dcgain(b.G_linear)),
                      points_between(fit_to(data, b.G_linear) - fit_to(data, best), -12, -2))
    end,
    mistakes = {
        {when = function(a, b) return near(dcgain(a.G_linear), dcgain(b.G_linear), {rel = 1e-9}) end,
         say = "The model does not change with the data: estimate it; do not type it in."},
        {when = function(_, b) return b.G_linear.Ts > 0 end,
         say = "A difference equation from arx predicts well, but simulates poorly: its noise model is wrong for these data."},
    },
    hint = "Compute everything in G_linear from the data that load(\"linear_system\") returns." }

-- The heat-transfer plant --------------------------------------------------------------------------------------------

local heat = load("heat_transfer")
local function power(y, u) return iddata(y, u^2, 1) end  -- 100 W at 10 V: the power in W equals the squared voltage in V
local function without_drift(data) return idfilt(detrend(data, "start"), {0.015, math.huge}, {order = 2}) end
local low = power(heat.y, heat.u)
local wanted = procsrivc(without_drift(low), "P2D", {TdMax = 20, InitialState = "none", Offset = "none"})

-- Quantities that a data set determines well: gain, slow lag, and the sum of the delay and the short lags.
local function facts(G)
    local p = pole(G)
    if max(p.re) >= 0 then return nil end
    local lags = -1/p.re
    return vector{dcgain(G), max(lags), sum(lags) - max(lags) + G.IODelay}
end
-- On sixty plants, the errors of the lags were at most 5 % and of the gain at most 4 %; other cutoff frequencies double the
-- errors.
local function close(found, gain, slow, rest)
    if not found then return judge("The model is not stable.") end
    return all_of(near(found[1], gain, {rel = 0.06, half = 0.12}), near(found[2], slow, {rel = 0.08, half = 0.16}),
                  near(found[3], rest, {rel = 0.1, half = 0.2}))
end

local wrong_input = {
    {when = function(a) return a.G_heat.Ts > 0 end,
     say = "The model must be a continuous-time model, but it is a discrete-time model."},
    {when = function(a) return dcgain(a.G_heat) < 0 end, say = "The gain has the wrong sign."},
    {when = function(a) return near(dcgain(a.G_heat), 8*wanted.Kp, {rel = 0.25}) end,
     say = "The gain is in °C/V: the input is the voltage, so the gain is not valid around 7 V."},
    {when = function(a) return near(dcgain(a.G_heat), 100*wanted.Kp, {rel = 0.15}) end,
     say = "The input is the fraction of full power; divide the gain by 100 to get the gain per watt."},
    {when = function(a) return a.G_heat.IODelay == 0 end, say = "The model has no delay, but the temperature responds after some seconds."},
}

check { id = "heat_model", points = 3, about = "Heat-transfer plant: gain and lags of the final model",
    test = function(a)
        local ref = facts(wanted)
        return close(facts(a.G_heat), ref[1], ref[2], ref[3])
    end,
    mistakes = wrong_input,
    hint = "Use the power as input, remove levels and drift from both signals, and estimate two lags and a delay." }

check { id = "heat_follows", points = 5, rerun = "heat_transfer",
    about = "Another heat-transfer plant: the model from 4 V is valid around 7 V, on hidden data",
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
         say = "The model does not change with the data: estimate it; do not type it in."},
        {when = function(_, b) return dcgain(b.G_heat) > 2 end,
         say = "The gain of this model is far too large: use the power in watts as input."},
    },
    hint = "Prepare and estimate from the data that load(\"heat_transfer\") returns, and compare the model with the data around 7 V." }

-- The hair dryer -----------------------------------------------------------------------------------------------------

local dryer = load("hairdryer")
local first, second = iddata(dryer.y, dryer.u, dryer.Ts):split(0.5)
first, second = first:remove_mean(), second:remove_mean()
local from_second_half = srivc(second, {1, 2, 2}, {InitialState = "none", Offset = "none"})

check { id = "dryer_model", points = 2, about = "Hair dryer: the model on the validation half",
    -- Fits: two poles 91.8 %, one pole 84.9 %, a second-order arx model 91.3 %, without a delay 0 %.
    test = function(a)
        if near(fit(first, a.G_dryer), fit(first, from_second_half), {abs = 1e-4}).share == 1 then
            return judge("This model was estimated from the second half, which is reserved for validation.")
        end
        return points_between(fit(second, a.G_dryer), 79, 90.5)
    end,
    mistakes = {
        {when = function(a) return dcgain(a.G_dryer) < 0 end, say = "The gain has the wrong sign."},
        {when = function(a) return a.G_dryer.IODelay == 0 and a.G_dryer.Ts == 0 end,
         say = "The model has no delay, but the output responds two samples late."},
        {when = function(a) return a.G_dryer.IODelay >= 1 end,
         say = "The delay is counted in samples; use seconds."},
        {when = function(a) return #pole(a.G_dryer) == 1 end,
         say = "With one pole, the delay compensates for a missing lag; the second half of the data contradicts this model."},
    },
    hint = "Subtract both means, and use srivc(first, {1, 2, 2}): two poles and two samples of delay." }

check { id = "dryer_fit", points = 2, about = "Hair dryer: the fit of the model",
    test = function(a) return near(a.dryer_fit, fit(second, a.G_dryer), {abs = 0.3}) end,
    mistakes = {
        {when = function(a) return near(a.dryer_fit, fit(first, a.G_dryer), {abs = 0.1}) end,
         say = "This is the fit to the half from which the model was estimated."},
        {when = function(a) return a.dryer_fit > fit(second, a.G_dryer) + 1.5 end,
         say = "No linear model simulates the second half so well: this looks like the fit of the one-step-ahead prediction."},
    },
    hint = "fit(second, G) compares the simulated output with the second half." }

check { id = "figures", points = 1, about = "Figures of the residuals and the comparisons",
    test = function() return all_of(has_figure("linear_resid"), has_figure("heat_high"), has_figure("dryer_compare")) end,
    hint = "report.figure(\"linear_resid\", resid(val, G), \"...\"); name the other two figures heat_high and dryer_compare." }
