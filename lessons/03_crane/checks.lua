-- The checks of lesson 3.2. `a` contains the answers, `b` the answers of a run on the data of another crane.

local Ts, rest = 0.02, 50
local crane = load("crane")
local resting = {InitialState = "none", Offset = "none"}

local function judge(message) return {share = 0, message = message} end
local function of(record, y) return detrend(iddata(y, record.u, Ts), "start", {samples = rest}) end
local function from_integral(record, y)
    return detrend(iddata(y, Ts*(cumsum(record.u) - record.u), Ts, {InterSample = "foh"}), "start", {samples = rest})
end
local function fit_position(record, G) return fit(of(record, record.x), G, resting) end
local function fit_angle(record, G) return fit(of(record, record.theta), G, resting) end

-- SRIVC estimate of the angle from a data set, to detect from which data a model was estimated.
local function angle_from(record) return tfsrivc(of(record, record.theta), 3, 1, {TdMax = 0, InitialState = "none", Offset = "none"}) end
local angle_of_validation, angle_of_limits = angle_from(crane.validation), angle_from(crane.limits)
-- Joint estimates of both outputs, without and with weights from the standard deviations of the errors.
local function both_from(record)
    local options = {TdMax = 0, CommonDenominator = true, InitialState = "none", Offset = "none"}
    local data = from_integral(record, matrix{record.x, record.theta})
    local first = tfsrivc(data, 3, 2, options)
    local _, tests = resid(data, first, {InitialState = "none", Offset = "none", quiet = true})
    options.OutputWeights = {1/math.sqrt(tests.outputs[1].variance), 1/math.sqrt(tests.outputs[2].variance)}
    return {first, tfsrivc(data, 3, 2, options)}
end
local joint_of_validation, joint_of_limits = both_from(crane.validation), both_from(crane.limits)

-- Returns whether two denominators are equal except for rounding errors; an additional pole at the origin is ignored.
local function same_poles(G, F)
    local scaled = G.den/G.den[1]
    if #scaled < #F then return false end
    return max(abs(scaled:range(1, #F) - vector(F))/max(abs(vector(F)))) < 1e-4
end
local function same_as_any(G, joint)
    for _, estimate in ipairs(joint) do
        if same_poles(G, {1, estimate.param[1], estimate.param[2], estimate.param[3]}) then return true end
    end
    return false
end
local function estimated_on_validation(G)
    return same_as_any(G, joint_of_validation) or same_poles(G, angle_of_validation.den:table())
end
local function estimated_on_limits(G)
    return same_as_any(G, joint_of_limits) or same_poles(G, angle_of_limits.den:table())
end

-- Returns the natural frequency of the complex pair of poles.
local function swing_of(G)
    local p = pole(G)
    for k = 1, #p do
        if p.im[k] > 0.5 then return math.sqrt(p.re[k]^2 + p.im[k]^2) end
    end
    return nil
end

-- Limits of the part that no linear model can describe: the amplifier saturates, or the trolley is at a buffer.
local limits = crane.limits
local first, last, last_voltage
for k = 1, #limits.t do
    local beyond = math.abs(limits.u[k]) > 10
    if beyond then last_voltage = limits.t[k] end
    if beyond or math.abs(limits.x[k]) > 0.495 then
        first, last = first or limits.t[k], limits.t[k]
    end
end

check { id = "discarded", points = 1, about = "The part of limits that no linear model can describe",
    -- The answer must include the part. Margins of up to 2 s before (8 swings remain) and 5 s after are reasonable.
    test = function(a)
        if #a.discarded ~= 2 then return judge("The answer must have two numbers: the start and end times of the part.") end
        local from, to = a.discarded[1], a.discarded[2]
        if from > first + 0.1 then return judge("The part begins earlier: inspect voltage and position.") end
        if to < last - 0.1 then return judge("The part ends later: inspect voltage and position.") end
        if from < first - 2 or to > last + 5 then
            return {share = 0.5, message = "You discarded more than necessary: good data are lost."}
        end
        return true
    end,
    mistakes = {
        {when = function(a) return a.discarded[2] > limits.t[#limits.t] end,
         say = "The times are counted in samples; use seconds."},
        {when = function(a) return a.discarded[1] > a.discarded[2] end, say = "The order is start time, end time."},
        {when = function(a) return math.abs(a.discarded[2] - last_voltage) < 0.3 end,
         say = "After the last saturated voltage, the trolley is still at a buffer while voltage is applied."},
    },
    hint = "When does the commanded voltage exceed 10 V, and when is the trolley at ±0.5 m?" }

local zero = mean(crane.estimation.theta:range(1, rest))
check { id = "rest_angle", points = 1, about = "The reading of the potentiometer at rest",
    -- With noise of 2 mrad and a resolution of 1.5 mrad, the mean of fifty samples is accurate to 0.3 mrad.
    test = function(a) return near(a.rest_angle, zero, {abs = 1e-3, half = 2e-3}) end,
    mistakes = {
        {when = function(a) return near(a.rest_angle, zero*180/math.pi, {rel = 0.1}) end,
         say = "This is in degrees; use radians."},
        {when = function(a) return near(a.rest_angle, 1000*zero, {rel = 0.1}) end,
         say = "This is in mrad; use rad."},
        {when = function(a) return a.rest_angle == 0 end,
         say = "The potentiometer does not read zero while the load is at rest."},
    },
    hint = "Compute the mean of the first second, when nothing moves." }

local in_discrete_time = {when = function(a) return a.G_angle.Ts > 0 end,
    say = "The model must be a continuous-time model. A difference equation from arx predicts well, but simulates poorly."}

check { id = "position_model", points = 3, about = "From voltage to position",
    -- A first-order motor model reaches 97.6 %, and 99.3 % with the reaction of the load; without the integrator, the fit is useless.
    test = function(a)
        if estimated_on_validation(a.G_position) then
            return judge("This model was estimated from the validation data.")
        end
        return points_between(fit_position(crane.validation, a.G_position), 85, 97)
    end,
    mistakes = {
        {when = function(a) return a.G_position.Ts > 0 end, say = "The model must be in continuous time."},
        {when = function(a) return fit_position(crane.validation, -a.G_position) > 50 end,
         say = "The gain has the wrong sign."},
        {when = function(a)
             return fit(from_integral(crane.validation, crane.validation.x), a.G_position, resting) > 85
         end,
         say = "The integrator is missing: this model goes from the integral of the voltage to the position."},
    },
    hint = "With a constant voltage, the speed becomes constant, so there is a pole at the origin; impose this pole." }

check { id = "angle_model", points = 3, about = "From voltage to angle",
    -- Two poles reach 88.8 % and three poles 91.8 %. No linear model is better, because larger swings are slower.
    -- On 1 % of the cranes, three poles do not reach 87 %.
    test = function(a)
        if estimated_on_validation(a.G_angle) then return judge("This model was estimated from the validation data.") end
        local reached = fit_angle(crane.validation, angle_from(crane.estimation))
        return points_between(fit_angle(crane.validation, a.G_angle), 60, math.min(87, reached - 1))
    end,
    mistakes = {
        in_discrete_time,
        {when = function(a) return fit_angle(crane.validation, -a.G_angle) > 50 end,
         say = "The sign is wrong: the load lags behind when the trolley starts."},
        {when = function(a) return fit_angle(crane.validation, a.G_angle*(math.pi/180)) > 50 end,
         say = "The output of the model is in degrees; use radians."},
        {when = function(a) return estimated_on_limits(a.G_angle) end,
         say = "This model was estimated from all of limits, including the part with saturation and buffers."},
        {when = function(a) return math.abs(dcgain(a.G_angle)) > 1e-2 end,
         say = "A constant voltage does not keep the load deflected: the zero at the origin is missing."},
    },
    hint = "Use three poles, and the zero at the origin that follows from the equations of motion." }

check { id = "common_poles", points = 1, about = "Common swing poles of position and angle",
    -- Separate estimates agree to 1 %.
    test = function(a)
        local x, theta = swing_of(a.G_position), swing_of(a.G_angle)
        if not x then return judge("No pair of poles of the position oscillates: the load's reaction on the trolley is missing.") end
        if not theta then return judge("No pair of poles of the angle oscillates.") end
        return near(x, theta, {rel = 0.03, half = 0.06})
    end,
    hint = "Estimate both with CommonDenominator = true, or check whether separate estimates agree." }

check { id = "fits", points = 2, about = "Fits of the models to the validation data",
    -- A tolerance of one point allows for other ways to subtract the levels.
    test = function(a)
        if #a.fits ~= 2 then return judge("The answer must have two numbers: the fit of the position and the fit of the angle.") end
        local own = vector{fit_position(crane.validation, a.G_position), fit_angle(crane.validation, a.G_angle)}
        return near(a.fits, own, {abs = 1, half = 2})
    end,
    mistakes = {
        {when = function(a)
             local own = vector{fit_position(crane.estimation, a.G_position), fit_angle(crane.estimation, a.G_angle)}
             return near(a.fits, own, {abs = 0.3})
         end, say = "These are the fits to the data from which the models were estimated."},
        {when = function(a)
             local own = vector{fit_angle(crane.validation, a.G_angle), fit_position(crane.validation, a.G_position)}
             return near(a.fits, own, {abs = 1})
         end, say = "The order is position, angle."},
        {when = function(a) return a.fits[2] > fit_angle(crane.validation, a.G_angle) + 3 end,
         say = "No linear model simulates the angle so well: this looks like the fit of the one-step-ahead prediction."},
        {when = function(a) return max(a.fits) <= 1 end, say = "The result must be in percent."},
    },
    hint = "fit(data, G) simulates the validation data from rest, after you subtract the levels." }

local function natural(a) return truth(a, "crane").natural_frequency end
check { id = "free_swing", points = 2, about = "The swing frequency of the load while the motor is off",
    -- At 0.3 rad, the swing frequency is 0.6 % lower than at small angles.
    test = function(a) return near(a.free_swing, natural(a), {rel = 0.015, half = 0.04}) end,
    mistakes = {
        {when = function(a) return near(a.free_swing, natural(a)/(2*math.pi), {rel = 0.03}) end,
         say = "This is in Hz; use rad/s."},
        {when = function(a) return near(a.free_swing, 2*math.pi/natural(a), {rel = 0.03}) end,
         say = "This is the period; answer with the frequency in rad/s."},
        {when = function(a) return near(a.free_swing, natural(a)*180/math.pi, {rel = 0.03}) end,
         say = "This is in degrees per second; use rad/s."},
        {when = function(a) return near(a.free_swing, natural(a)*Ts, {rel = 0.03}) end,
         say = "This is in rad per sample; use rad/s."},
    },
    hint = "Count the swings of free_swing, multiply by 2 pi, and divide by their duration." }

check { id = "figures", points = 1, about = "Figures of the raw data and of the validation",
    test = function() return all_of(has_figure("raw"), has_figure("validation")) end,
    hint = "report.figure(\"raw\", fig, \"...\") and report.figure(\"validation\", fig, \"...\")." }

-- On other cranes (different cable, load, friction and motor), the recommended procedure reached at least 98.6 % and 91.5 %.
check { id = "crane_follows", points = 6, rerun = "crane", about = "Another crane: your models simulate a hidden experiment",
    test = function(a, b)
        local unseen = hidden("crane").validation
        return all_of(differs(swing_of(a.G_angle) or 0, swing_of(b.G_angle) or 0),
                      points_between(fit_position(unseen, b.G_position), 85, 97),
                      points_between(fit_angle(unseen, b.G_angle), 60, 86))
    end,
    mistakes = {
        {when = function(a, b) return near(swing_of(a.G_angle), swing_of(b.G_angle), {rel = 1e-9}) end,
         say = "The models do not change with the data: estimate them; do not type them in."},
        {when = function(_, b) return b.G_angle.Ts > 0 end,
         say = "A difference equation from arx predicts the next sample well, but simulates poorly."},
    },
    hint = "Compute everything from the data that load(\"crane\") returns; do not read numbers off a figure." }

check { id = "swing_follows", points = 2, rerun = "crane", about = "Another crane: your script estimates the swing frequency of its load",
    test = function(a, b)
        return all_of(differs(a.free_swing, b.free_swing),
                      near(b.free_swing, truth(b).natural_frequency, {rel = 0.015, half = 0.04}))
    end,
    hint = "Compute the zero crossings in your script. The sensor offset differs between cranes." }
