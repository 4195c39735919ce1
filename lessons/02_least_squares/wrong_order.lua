-- expects: line: The order is slope, time at the mean year
-- expects: paris: The order is forecast, lower limit, upper limit
-- expects: continuous: The order is a, b
-- expects: discrete: The order is a1, b1
-- expects: noisy: exact samples
-- expects: follows_samples: On a data set that you have not seen
-- The columns of Phi and the three numbers of the forecast are in another order, and the exact samples are used twice.
local games, four = load("winning_times"), load("step_response")
local last = #games.year - 1
local when, took = games.year:range(1, last), games.time:range(1, last)
local Phi = matrix{ones(last), when - mean(when)}
local theta = solve(Phi, took)
local e = took - Phi*theta
local line = polyfit_report(when, took, 1)
local there = forecast(line, 2024)
answer("line", theta)
answer("rmse", sqrt(mean(e^2)))
answer("paris", vector{there.low, there.value, there.high})
report.figure("residuals", plot(when, e), "Residuals")
report.figure("forecast", regression_plot(when, took, line), "Line")

local function b1_a1(y, u)
    local m = #y
    return solve(matrix{u:range(1, m - 1), -y:range(1, m - 1)}, y:range(2, m))
end
local sampled = b1_a1(four.y, four.u)
local plant = solve(matrix{four.u, -four.y}, four.ydot)
answer("ct", plant)
answer("dt", sampled)
answer("ct_noisy", vector{plant[2], plant[1]})
answer("dt_noisy", vector{sampled[2], sampled[1]})
local input = prbs(7, 4):range(1, 400)
local clean = lsim(tf({sampled[1]}, {1, sampled[2]}, {Ts = 0.5}), input, 0.5)
local found = zeros(1000)
for k = 1, 1000 do found[k] = b1_a1(clean + 0.3*randn(400), input)[2] end
answer("monte_carlo", vector{mean(found), std(found)})
report.figure("monte_carlo", histogram(found), "Study")
