-- The checks of lesson 6. `a` contains the answers, `b` the answers of a run on the data of another crane or other tanks.

local function judge(message) return {share = 0, message = message} end
local function crane_of(facts) return vector{9.81/facts.natural_frequency^2, facts.dry_voltage} end
local function tanks_of(facts)
    return vector{facts.k1, facts.k2, facts.k3, facts.k4, facts.overflow_part, facts.sensor_offset}
end
local function rms(e) return norm(e)/math.sqrt(#e) end
local official = load("two_tanks")
local spread = std(official.y_val)

-- The length is accurate to 2 %. On other cranes, the dry friction of about 0.24 V was accurate to 0.1 V.
local function crane_found(found, facts)
    if #found ~= 2 then return judge("The answer must have two numbers: the length and the voltage.") end
    return all_of(near(found[1], facts[1], {rel = 0.02, half = 0.04}), near(found[2], facts[2], {abs = 0.15, half = 0.2}))
end

check { id = "crane", points = 2, about = "Length and dry friction of the crane",
    test = function(a) return crane_found(a.crane, crane_of(truth(a, "crane"))) end,
    mistakes = {
        {when = function(a) return near(vector{a.crane[2], a.crane[1]}, crane_of(truth(a, "crane")), {rel = 0.2}) end,
         say = "The order is length, voltage."},
        {when = function(a) return a.crane[2] <= 0 end, say = "The dry friction is zero: check that the parameter dry is not fixed."},
    },
    hint = "Submit the length of the model with all terms; dry/gain is the voltage lost to dry friction." }

check { id = "crane_fit", points = 1, about = "Fit of the simulated angle with the equations of the crane",
    -- On the official data, the equations reach 98 % and the best linear model reaches 96.4 %.
    test = function(a) return points_between(a.crane_fit, 95.5, 97) end,
    mistakes = {
        {when = function(a) return a.crane_fit <= 1 end, say = "The result must be in percent."},
        {when = function(a) return a.crane_fit > 90 end, say = "A linear model reaches this fit: check that your model does not assume small swings."},
    },
    hint = "Subtract the levels at rest, and use the second result of fit(validation, G) from rest." }

-- k1 to k4 are accurate to 10 %; only a few samples contain information about the overflow.
local function tanks_found(found, facts)
    if #found ~= 6 then return judge("The answer must have six numbers: k1, k2, k3, k4, q, y0.") end
    local rates = range(1, 1, 4)
    local wanted = tanks_of(facts)
    return all_of(near(found:range(1, 4)/wanted:range(1, 4), ones(#rates), {abs = 0.1, half = 0.2}),
                  near(found[5], wanted[5], {abs = 0.2, half = 0.3}), near(found[6], wanted[6], {abs = 0.15, half = 0.3}))
end

check { id = "tanks", points = 3, about = "The six parameters of the tanks",
    test = function(a) return tanks_found(a.tanks, truth(a, "two_tanks")) end,
    mistakes = {
        {when = function(a) return a.tanks[6] > 1 end, say = "The reading of an empty tank is a few tenths of a volt; this is too large for the offset."},
        {when = function(a) return math.abs(a.tanks[4]/truth(a, "two_tanks").k4 - 1) > 0.5 end,
         say = "The unit of the hidden level is not determined: without its rim at 20 cm, the data cannot distinguish k1, k2 and k4."},
    },
    hint = "Use greyest with both rims, and also estimate the initial levels." }

check { id = "free_run", points = 2, about = "Free-run errors of three models",
    test = function(a)
        if #a.free_run ~= 3 then return judge("The answer must have three numbers: linear, six parameters, NARX.") end
        local sensor = truth(a, "two_tanks").noise_std
        return all_of(points_between(-a.free_run[1]/spread, -0.6, -0.45), points_between(-a.free_run[2]/sensor, -3, -1.6),
                      near(a.free_run[2], rms(official.y_val - a.simulated), {abs = 0.003, half = 0.01}),
                      points_between(-a.free_run[3]/spread, -0.7, -0.45))
    end,
    mistakes = {
        {when = function(a) return a.free_run[3] < 0.06*spread end,
         say = "This is the one-step-ahead prediction error of NARX; in free run, the model uses no measured readings."},
        {when = function(a) return min(a.free_run) > 10 end, say = "These values seem to be fits in percent; submit errors in volts."},
        {when = function(a) return a.free_run[1] > spread end,
         say = "lsim starts from rest and omits the offset of the linear model; fit and compare use the initial state and the offset."},
    },
    hint = "Compute the root mean square of measured minus simulated reading on validation." }

check { id = "simulated", points = 3, about = "The validation data in free run",
    test = function(a)
        if #a.simulated ~= #official.y_val then return judge("The answer must be the simulated reading at the sampling instants of validation.") end
        local e = rms(official.y_val - a.simulated)
        if e < 0.5*truth(a, "two_tanks").noise_std then return judge("This is the measured reading; submit the simulated reading.") end
        return points_between(-e/truth(a, "two_tanks").noise_std, -6, -2)
    end,
    mistakes = {
        {when = function(a) return rms(official.y - a.simulated) < 0.2 end, say = "These are the estimation data."},
        {when = function(a) return rms(official.y_val - 0.5*a.simulated) < 1 end, say = "These are levels; submit readings in volts."},
    },
    hint = "Simulate the six-parameter model with u_val and an estimated initial state." }

check { id = "figures", points = 1, about = "Figures of the residuals and of the free run",
    test = function() return all_of(has_figure("left"), has_figure("free_run")) end,
    hint = "report.figure(\"left\", fig, \"...\") and report.figure(\"free_run\", fig, \"...\")." }

check { id = "crane_follows", points = 3, rerun = "crane", about = "Another crane: length and dry friction",
    test = function(a, b) return all_of(differs(a.crane, b.crane), crane_found(b.crane, crane_of(truth(b)))) end,
    mistakes = {
        {when = function(a, b) return near(a.crane, b.crane, {rel = 1e-9}) end,
         say = "The results do not change with the data: compute them; do not type them in."},
        {when = function(a, b)
            local own, other = crane_of(truth(a, "crane"))[1], crane_of(truth(b))[1]
            return math.abs(a.crane[1]/own - 1) < 0.02 and math.abs(b.crane[1]/other - 1) > 0.3
        end,
         say = "For the other crane, the search failed: specify bounds for every parameter, or try several initial values."},
    },
    hint = "Estimate from the data that load(\"crane\") returns, with bounds for every parameter." }

check { id = "tanks_follow", points = 5, rerun = "two_tanks", about = "Other tanks: the six parameters",
    test = function(a, b)
        return all_of(differs(a.tanks, b.tanks), differs(a.simulated, b.simulated), tanks_found(b.tanks, truth(b)))
    end,
    mistakes = {
        {when = function(a, b) return near(a.tanks, b.tanks, {rel = 1e-9}) end,
         say = "The results do not change with the data: compute them; do not type them in."},
    },
    hint = "Estimate from the data that load(\"two_tanks\") returns." }
