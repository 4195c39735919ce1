-- The checks of lesson 2. `a` contains the answers, `b` the answers of a run on four samples of another first-order system.
--
-- A least-squares solution is unique, so the tolerances are small; 0.1 % allows gradient descent to stop slightly early.

local games = load("winning_times")
local N = #games.year - 1
local years, times = games.year:range(1, N), games.time:range(1, N)
local center = mean(years)
local line = lsq(matrix{years - center, ones(N)}, times)
local residuals = times - matrix{years - center, ones(N)}*line.theta
local rmse = sqrt(mean(residuals^2))
local slope, middle = line.theta[1], line.theta[2]
local whole = lsq(matrix{games.year - mean(games.year), ones(N + 1)}, games.time).theta
local paris = forecast(polyfit_report(years, times, 1), 2024, 0.95)
local half_width = (paris.high - paris.low)/2

local samples = load("step_response")
local function continuous(y, ydot) return lsq(matrix{-y, samples.u}, ydot).theta end
local function discrete(y, u)
    local n = #y
    return lsq(matrix{-y:range(1, n - 1), u:range(1, n - 1)}, y:range(2, n)).theta
end
local ct, dt = continuous(samples.y, samples.ydot), discrete(samples.y, samples.u)
local ct_noisy = continuous(samples.y_noisy, samples.ydot_noisy)
local dt_noisy = discrete(samples.y_noisy, samples.u)

-- Expected least-squares estimate for 400 noisy samples of prbs(7, 4): the noise adds its energy to one diagonal element of
-- Phi'Phi.
local u_long, sigma = prbs(7, 4):range(1, 400), 0.3
local function biased(a1, b1)
    local x = lsim(tf({b1}, {1, a1}, {Ts = 1}), u_long, 1)
    local Phi = matrix{-x:range(1, 399), u_long:range(1, 399)}
    local noise = matrix{{399*sigma^2, 0}, {0, 0}}
    return solve(Phi:t()*Phi + noise, Phi:t()*x:range(2, 400))[1]
end
local scatter
do
    local x, found = lsim(tf({dt[2]}, {1, dt[1]}, {Ts = 1}), u_long, 1), zeros(200)
    for run = 1, 200 do found[run] = discrete(x + sigma*randn(400), u_long)[1] end
    scatter = std(found)
end

local function judge(message) return {share = 0, message = message} end
local function numbers(x, count, names)
    if #x ~= count then return judge(string.format("The answer must have %d numbers: %s.", count, names)) end
    return {share = 1}
end
local function each(x, wanted, tolerance, names)
    if #x ~= #wanted then return numbers(x, #wanted, names) end
    return near(x/wanted, ones(#wanted), {rel = tolerance, half = 5*tolerance})
end
local function alike(x, wanted, tolerance)
    return #x == #wanted and max(abs(x - wanted)) <= tolerance*max(abs(wanted))
end

check { id = "line", points = 2, about = "The straight line up to 2020",
    test = function(a) return each(a.line, line.theta, 1e-3, "the slope and the time at the mean year") end,
    mistakes = {
        {when = function(a) return alike(a.line, whole, 1e-5) end,
         say = "The fit includes 2024; reserve it for the test."},
        {when = function(a) return alike(a.line, vector{middle, slope}, 1e-3) end,
         say = "The order is slope, time at the mean year."},
        {when = function(a) return alike(a.line, vector{slope, middle - slope*center}, 1e-3) end,
         say = "The second number is the time in the year 0; answer with the time at the mean year."},
        {when = function(a) return near(a.line[1], 10*slope, {rel = 1e-2}) end,
         say = "The slope is per decade; use seconds per year."},
        {when = function(a) return alike(a.line, vector{-slope, middle}, 1e-3) end,
         say = "The slope has the wrong sign: the times decrease."},
    },
    hint = "Use least squares with the Games from 1896 to 2020. Subtract the mean from the years." }

check { id = "rmse", points = 1, about = "The root mean square of the residuals",
    test = function(a) return near(a.rmse, rmse, {rel = 1e-3}) end,
    mistakes = {
        {when = function(a) return near(a.rmse, rmse*math.sqrt(N/(N - 2)), {rel = 1e-3}) end,
         say = "You divided by N - 2, which estimates the noise; the RMSE divides by N."},
        {when = function(a) return near(a.rmse, rmse^2, {rel = 1e-3}) end,
         say = "This is the mean square: the square root is missing."},
        {when = function(a) return near(a.rmse, rmse*math.sqrt(N), {rel = 1e-3}) end,
         say = "This is the norm of the residuals: divide it by the square root of N."},
        {when = function(a) return near(a.rmse, mean(abs(residuals)), {rel = 1e-3}) end,
         say = "This is the mean absolute residual, not the root mean square."},
    },
    hint = "The square root of the mean of the squared residuals of the line up to 2020." }

check { id = "paris", points = 2, about = "The forecast for 2024 and its interval",
    -- Half the points if the interval is within 10 %, for example with 1.96 instead of Student's factor.
    test = function(a)
        if #a.paris ~= 3 then return numbers(a.paris, 3, "the forecast, the lower and the upper limit") end
        return all_of(near(a.paris[1], paris.value, {abs = 0.002, half = 0.01}),
                      near(a.paris[3] - a.paris[2], 2*half_width, {rel = 0.01, half = 0.1}),
                      near((a.paris[3] + a.paris[2])/2, paris.value, {abs = 0.005, half = 0.01}))
    end,
    mistakes = {
        -- The forecast is between the limits, so it is the median of three numbers in another order.
        {when = function(a)
             local ascending = sort(a.paris)
             local others = math.abs(ascending[2] - paris.value) < 0.01 and a.paris[1] ~= ascending[2]
             return others or a.paris[2] > a.paris[3]
         end,
         say = "The order is forecast, lower limit, upper limit."},
        {when = function(a) return (a.paris[3] - a.paris[2])/2 < 0.7*half_width end,
         say = "The interval is too narrow: it must allow for one new race, not only for the uncertainty of the line."},
        {when = function(a) return near(a.paris[1], games.time[N + 1], {abs = 1e-6}) end,
         say = "This is the actual result of Paris, not the forecast of the line."},
    },
    hint = "Use forecast(line, 2024, 0.95) with the line that polyfit_report fits to the Games up to 2020." }

check { id = "continuous", points = 2, about = "The continuous-time model from the exact samples",
    test = function(a) return each(a.ct, ct, 1e-3, "a and b") end,
    mistakes = {
        {when = function(a) return alike(a.ct, vector{-ct[1], ct[2]}, 1e-3) end,
         say = "a has the wrong sign: the regressor is -y, not y."},
        {when = function(a) return alike(a.ct, vector{ct[2], ct[1]}, 1e-3) end, say = "The order is a, b."},
        {when = function(a) return alike(a.ct, ct_noisy, 1e-3) end,
         say = "These are the estimates from the noisy samples."},
        {when = function(a) return alike(a.ct, vector{1/ct[1], ct[2]/ct[1]}, 1e-3) end,
         say = "These are the time constant and the gain; answer with a and b of b/(s + a)."},
    },
    hint = "The columns of Phi are -y and u; the derivative is on the left-hand side." }

check { id = "discrete", points = 2, about = "The discrete-time model from the exact samples",
    test = function(a) return each(a.dt, dt, 1e-3, "a1 and b1") end,
    mistakes = {
        {when = function(a) return alike(a.dt, vector{-dt[1], dt[2]}, 1e-3) end,
         say = "a1 has the wrong sign: the regressor is -y, not y."},
        {when = function(a) return alike(a.dt, vector{dt[2], dt[1]}, 1e-3) end, say = "The order is a1, b1."},
        {when = function(a) return alike(a.dt, dt_noisy, 1e-3) end,
         say = "These are the estimates from the noisy samples."},
        {when = function(a) return alike(a.dt, ct, 1e-3) end,
         say = "These are the parameters of the continuous-time model."},
    },
    hint = "Regress each sample on the previous output and input. This results in three equations." }

check { id = "noisy", points = 2, about = "Both models from the noisy samples",
    test = function(a)
        return all_of(each(a.ct_noisy, ct_noisy, 1e-3, "a and b"), each(a.dt_noisy, dt_noisy, 1e-3, "a1 and b1"))
    end,
    mistakes = {
        {when = function(a) return alike(a.ct_noisy, continuous(samples.y_noisy, samples.ydot), 1e-3) end,
         say = "You used the exact derivative; the noisy output needs the noisy derivative."},
        {when = function(a) return alike(a.ct_noisy, ct, 1e-3) or alike(a.dt_noisy, dt, 1e-3) end,
         say = "These are the estimates from the exact samples."},
    },
    hint = "Repeat the regressions with y_noisy and ydot_noisy." }

-- The standard error of the mean of a thousand estimates is 3 % of their standard deviation; a tolerance of 50 % allows
-- fewer runs.
check { id = "monte_carlo", points = 2, about = "A thousand estimates: least squares is biased",
    test = function(a)
        if #a.monte_carlo ~= 2 then return numbers(a.monte_carlo, 2, "mean and standard deviation") end
        return all_of(near(a.monte_carlo[1], biased(dt[1], dt[2]), {abs = 0.5*scatter, half = scatter}),
                      near(a.monte_carlo[2], scatter, {rel = 0.25, half = 0.5}))
    end,
    mistakes = {
        {when = function(a) return near(a.monte_carlo[1], dt[1], {abs = scatter}) end,
         say = "The mean equals the true value: add noise to the output, and use the noisy output on both sides of the regression."},
        {when = function(a) return near(a.monte_carlo[2], scatter/math.sqrt(1000), {rel = 0.4}) end,
         say = "This is the standard error of the mean; answer with the standard deviation of the estimates."},
    },
    hint = "Repeat a thousand times: simulate, add noise to the output, and estimate as in question 6. Then compute mean and std." }

check { id = "figures", points = 1, about = "Figures of the residuals, the forecast and the histogram",
    test = function() return all_of(has_figure("residuals"), has_figure("forecast"), has_figure("monte_carlo")) end,
    hint = "report.figure(\"residuals\", fig, \"...\"); name the other two figures forecast and monte_carlo." }

local typed = {
    {when = function(a, b) return near(a.ct, b.ct, {rel = 1e-9}) end,
     say = "The parameters do not change with the samples: compute them; do not type them in."},
}

check { id = "follows_samples", points = 4, rerun = "step_response", about = "Another system: your script estimates both models from its samples",
    test = function(a, b)
        local fact = truth(b)
        return all_of(differs(a.ct, b.ct), differs(a.dt, b.dt), each(b.ct, vector{-fact.a, fact.b}, 1e-3, "a and b"),
                      each(b.dt, vector{-fact.f, fact.g}, 1e-3, "a1 and b1"))
    end,
    mistakes = typed,
    hint = "Compute ct and dt, including the sampling time, from the data that load(\"step_response\") returns." }

check { id = "follows_study", points = 2, rerun = "step_response", about = "Another system: the study uses the estimated model",
    test = function(a, b)
        local fact = truth(b)
        return all_of(differs(a.monte_carlo, b.monte_carlo),
                      near(b.monte_carlo[1], biased(-fact.f, fact.g), {abs = 0.5*scatter, half = scatter}))
    end,
    hint = "Simulate the data of the study with the discrete-time model that you have just estimated." }
