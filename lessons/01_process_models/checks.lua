-- The checks of lesson 1. `a` contains the answers, `b` the answers of a run on another exchanger or suspension.
--
-- The expected values are the output-error estimates from the official data. These estimates are far more accurate than a
-- ruler, so the tolerances allow for readings by eye. Noise of 1 % of the exchanger's step moves the time of entry into the
-- 5 % band by T/5, which is 7 % of T_r. The maximum of the overshoot is flat; one sample is 4 % of the time of the maximum.

local function record(name)
    local r = load(name)
    return r, iddata(r.y, r.u, r.t[2] - r.t[1])
end
local heat, heat_data = record("heat_exchanger")
local _, suspension_data = record("suspension")
local heat_Ts, suspension_Ts = heat_data.Ts, suspension_data.Ts

local exchanger = procsrivc(heat_data, "P1", {InitialState = "steady", Offset = "estimate"})
local K, T = exchanger.Kp, exchanger.Tp1
local suspension = procsrivc(suspension_data, "P2U")
local K2, z2, w2 = suspension.Kp, suspension.Zeta, 1/suspension.Tw
local overshoot = math.exp(-math.pi*z2/math.sqrt(1 - z2^2))

local level = heat.y[#heat.y]/heat.u[#heat.u]  -- ratio of the levels instead of the changes
local step_instant = 0
for k = 2, #heat.u do
    if heat.u[k] ~= heat.u[1] and step_instant == 0 then step_instant = heat.t[k - 1] - heat.t[1] end
end

local function judge(message) return {share = 0, message = message} end

-- Checks each number with its own relative tolerance; an error below twice the tolerance earns half the points.
local function each(x, wanted, tolerances, names)
    if #x ~= #wanted then return judge(string.format("The answer must have %d numbers: %s.", #wanted, names)) end
    local all = {}
    for i = 1, #wanted do all[i] = near(x[i], wanted[i], {rel = tolerances[i], half = 2*tolerances[i]}) end
    return all_of(table.unpack(all))
end
local function alike(x, wanted, tolerance)
    return #x == #wanted and max(abs(x/wanted - 1)) <= tolerance
end

-- Returns gain and time constant of a first-order model.
local function first_order(G)
    if #pole(G) ~= 1 then return nil end
    return vector{dcgain(G), -1/pole(G).re[1]}
end
-- Returns gain, damping ratio and natural frequency of a pair of poles.
local function second_order(G)
    if #pole(G) ~= 2 then return nil end
    local frequency, damping = damp(G)
    return vector{dcgain(G), damping[1], frequency[1]}
end

local discrete = {when = function(a) return a.Ts > 0 end,
                  say = "The model must be a continuous-time model, but it is a discrete-time model."}
local function of_model(name, mistakes)
    local list = {}
    for i, mistake in ipairs{discrete, table.unpack(mistakes)} do
        list[i] = {when = function(a) return mistake.when(a[name]) end, say = mistake.say}
    end
    return list
end

check { id = "settling_time", points = 1, about = "Heat exchanger: the 5 % settling time",
    test = function(a) return near(a.settling_time, 3*T, {rel = 0.12, half = 0.2}) end,
    mistakes = {
        {when = function(a) return near(a.settling_time, 3*T + step_instant, {rel = 0.06}) end,
         say = "This is the time from the beginning of the data; count from the opening of the valve."},
        {when = function(a) return near(a.settling_time, 3*T/heat_Ts, {rel = 0.12}) end,
         say = "This is counted in samples; use seconds."},
        {when = function(a) return near(a.settling_time, T, {rel = 0.12}) end,
         say = "This is the time constant; the settling time is three times as long."},
    },
    hint = "After what time does the response stay within 5 % of its total change around its final value?" }

check { id = "exchanger_reading", points = 2, about = "Heat exchanger: gain and time constant read off the figure",
    test = function(a) return each(a.exchanger_reading, vector{K, T}, {0.03, 0.12}, "K and T") end,
    mistakes = {
        {when = function(a) return alike(a.exchanger_reading, vector{T, K}, 0.2) end,
         say = "The order is K, T."},
        {when = function(a) return alike(a.exchanger_reading, vector{K, 3*T}, 0.2) end,
         say = "T is the settling time; the time constant is a third of it."},
        {when = function(a) return alike(a.exchanger_reading, vector{K, T/heat_Ts}, 0.15) end,
         say = "T is counted in samples; use seconds."},
        {when = function(a) return near(a.exchanger_reading[1], level, {rel = 0.02}) end,
         say = "K is the ratio of two levels; it must be the ratio of the two changes from the operating point."},
        {when = function(a) return a.exchanger_reading[1] < 0 end,
         say = "The gain has the wrong sign: the temperature rises when the valve opens."},
        {when = function(a) return near(a.exchanger_reading[1], 1/K, {rel = 0.05}) end,
         say = "K is inverted: the gain is the change of the output divided by the change of the input."},
    },
    hint = "K is the ratio of the two changes, and T is a third of the 5 % settling time." }

check { id = "exchanger_model", points = 2, about = "Heat exchanger: the estimated model",
    -- The standard errors are below 0.5 %; 2 % also allows for other ways to subtract the operating point.
    test = function(a)
        local found = first_order(a.G_exchanger)
        if not found then return judge("The response has the shape of a first-order response: the model must have exactly one pole.") end
        return each(found, vector{K, T}, {0.02, 0.03}, "K and T")
    end,
    mistakes = of_model("G_exchanger", {
        {when = function(G) return near(dcgain(G), level, {rel = 0.05}) end,
         say = "The model treats the operating point as a part of the response: subtract both levels, or estimate them."},
        {when = function(G) return dcgain(G) < 0 end, say = "The gain has the wrong sign."},
        {when = function(G) return near(dcgain(G), 1/K, {rel = 0.1}) end,
         say = "Input and output are interchanged."},
        {when = function(G) return near(first_order(G)[2], T/heat_Ts, {rel = 0.05}) end,
         say = "The time constant is counted in samples: specify the sampling time of the data."},
    }),
    hint = "procsrivc(data, \"P1\", {InitialState = \"steady\", Offset = \"estimate\"})" }

check { id = "overshoot", points = 1, about = "Suspension: the first overshoot",
    test = function(a) return near(a.overshoot, overshoot, {rel = 0.06, half = 0.12}) end,
    mistakes = {
        {when = function(a) return near(a.overshoot, 100*overshoot, {rel = 0.1}) end,
         say = "This is in percent; answer with a ratio below 1."},
        {when = function(a) return near(a.overshoot, 1 + overshoot, {rel = 0.05}) end,
         say = "This is the height of the peak above the initial level; measure the overshoot from the final value."},
        {when = function(a) return near(a.overshoot, K2*overshoot, {rel = 0.1}) end,
         say = "This is in the unit of the output; divide the overshoot by the total change of the output."},
    },
    hint = "By how much does the first peak exceed the final value, as a ratio of the total change?" }

check { id = "suspension_reading", points = 2, about = "Suspension: gain, damping and frequency read off the figure",
    test = function(a) return each(a.suspension_reading, vector{K2, z2, w2}, {0.03, 0.12, 0.06}, "K, z and omega_0") end,
    mistakes = {
        {when = function(a) return alike(a.suspension_reading, vector{K2, w2, z2}, 0.2) end,
         say = "The order is K, z, omega_0."},
        {when = function(a) return near(a.suspension_reading[3], w2/(2*math.pi), {rel = 0.05}) end,
         say = "The frequency is in Hz; use rad/s."},
        {when = function(a) return near(a.suspension_reading[3], w2*suspension_Ts, {rel = 0.06}) end,
         say = "The time of the overshoot is counted in samples; use seconds."},
        {when = function(a)
             local log = math.log(100*overshoot)
             return near(a.suspension_reading[2], log/math.sqrt(log^2 + math.pi^2), {rel = 0.05})
         end,
         say = "You used D1 in percent in the formula; it must be a ratio."},
    },
    hint = "The formulas of question 6 use D1 as a ratio and the time of the overshoot in seconds." }

check { id = "suspension_model", points = 2, about = "Suspension: the estimated model",
    test = function(a)
        local found = second_order(a.G_suspension)
        if not found then return judge("An overshoot requires two poles, and two are enough.") end
        return each(found, vector{K2, z2, w2}, {0.01, 0.04, 0.01}, "K, z and omega_0")
    end,
    mistakes = of_model("G_suspension", {
        {when = function(G) return dcgain(G) < 0 end, say = "The gain has the wrong sign."},
        {when = function(G) return near(second_order(G)[3], w2*suspension_Ts, {rel = 0.05}) end,
         say = "The time is counted in samples: specify the sampling time of the data."},
    }),
    hint = "procsrivc(data, \"P2U\"): a pair of complex conjugate poles and no zeros." }

check { id = "figures", points = 1, about = "Figures that compare both readings with the measurements",
    test = function() return all_of(has_figure("exchanger_test"), has_figure("suspension_test")) end,
    hint = "report.figure(\"exchanger_test\", test_your_model(G, data), \"...\"), and the same for the suspension." }

-- Other plant variants differ in gain and time constant by up to 25 %; on sixty variants, output error was accurate to 1.5 %.
check { id = "exchanger_follows", points = 4, rerun = "heat_exchanger", about = "Another heat exchanger: your script estimates its model",
    test = function(a, b)
        local other, fact = first_order(b.G_exchanger), truth(b)
        if not other then return judge("The model of the other exchanger does not have one pole.") end
        return all_of(differs(dcgain(a.G_exchanger), dcgain(b.G_exchanger)),
                      each(other, vector{fact.gain, fact.time_constant}, {0.03, 0.04}, "K and T"))
    end,
    mistakes = {
        {when = function(a, b) return near(dcgain(a.G_exchanger), dcgain(b.G_exchanger), {rel = 1e-9}) end,
         say = "The model does not change with the data: estimate it; do not type it in."},
    },
    hint = "Compute everything that the model needs, including the sampling time, from the data that load returns." }

check { id = "suspension_follows", points = 4, rerun = "suspension", about = "Another suspension: your script estimates its model",
    test = function(a, b)
        local other, fact = second_order(b.G_suspension), truth(b)
        if not other then return judge("The model of the other suspension does not have two poles.") end
        return all_of(differs(dcgain(a.G_suspension), dcgain(b.G_suspension)),
                      each(other, vector{fact.gain, fact.damping_ratio, fact.natural_frequency}, {0.02, 0.05, 0.02},
                           "K, z and omega_0"))
    end,
    mistakes = {
        {when = function(a, b) return near(dcgain(a.G_suspension), dcgain(b.G_suspension), {rel = 1e-9}) end,
         say = "The model does not change with the data: estimate it; do not type it in."},
    },
    hint = "Compute everything that the model needs from the data that load returns." }
