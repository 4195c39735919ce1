-- expects: continuous: a has the wrong sign
-- expects: discrete: a1 has the wrong sign
-- expects: noisy: the largest allowed error
-- expects: follows_samples: On a data set that you have not seen
-- The regressor is y instead of -y, so a and a1 have the opposite sign.
local games, four = load("winning_times"), load("step_response")
local last = #games.year - 1
local when, took = games.year:range(1, last), games.time:range(1, last)
local line = polyfit_report(when, took, 1)
local Phi = matrix{when - mean(when), ones(last)}
local theta = solve(Phi, took)
local e = took - Phi*theta
local there = forecast(line, 2024)
answer("line", theta)
answer("rmse", sqrt(mean(e^2)))
answer("paris", vector{there.value, there.low, there.high})
report.figure("residuals", plot(when, e), "Residuals")
report.figure("forecast", regression_plot(when, took, line), "Line")

local function step_back(y, u)
    local m = #y
    return solve(matrix{y:range(1, m - 1), u:range(1, m - 1)}, y:range(2, m))
end
local sampled = step_back(four.y, four.u)
answer("ct", solve(matrix{four.y, four.u}, four.ydot))
answer("dt", sampled)
answer("ct_noisy", solve(matrix{four.y_noisy, four.u}, four.ydot_noisy))
answer("dt_noisy", step_back(four.y_noisy, four.u))
local input = prbs(7, 4):range(1, 400)
local clean = lsim(tf({sampled[2]}, {1, -sampled[1]}, {Ts = 0.5}), input, 0.5)
local found = zeros(1000)
for k = 1, 1000 do found[k] = -step_back(clean + 0.3*randn(400), input)[1] end
answer("monte_carlo", vector{mean(found), std(found)})
report.figure("monte_carlo", histogram(found), "Study")
