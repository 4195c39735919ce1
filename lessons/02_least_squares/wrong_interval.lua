-- expects: line: the time in the year 0
-- expects: rmse: You divided by N - 2, which estimates the noise
-- expects: paris: The interval is too narrow
-- expects: monte_carlo: The mean equals the true value
-- expects: follows_study: On a data set that you have not seen
-- The years are not centered, the interval uses the standard error of the line, and the regressors of the study contain no
-- noise.
local games, four = load("winning_times"), load("step_response")
local last = #games.year - 1
local when, took = games.year:range(1, last), games.time:range(1, last)
local raw = solve(matrix{when, ones(last)}, took)
local e = took - raw[1]*when - raw[2]
local noise = math.sqrt(sum(e^2)/(last - 2))
local x = when - mean(when)
local of_line = noise*math.sqrt(1/last + (2024 - mean(when))^2/sum(x^2))
local value = raw[1]*2024 + raw[2]
answer("line", raw)
answer("rmse", noise)
answer("paris", vector{value, value - 2*of_line, value + 2*of_line})
report.figure("residuals", plot(when, e), "Residuals")
report.figure("forecast", plot(when, took, when, took - e), "Line")

local function regression(y, past, u)
    local m = #y
    return solve(matrix{-past:range(1, m - 1), u:range(1, m - 1)}, y:range(2, m))
end
local sampled = regression(four.y, four.y, four.u)
answer("ct", solve(matrix{-four.y, four.u}, four.ydot))
answer("dt", sampled)
answer("ct_noisy", solve(matrix{-four.y_noisy, four.u}, four.ydot_noisy))
answer("dt_noisy", regression(four.y_noisy, four.y_noisy, four.u))
local input = prbs(7, 4):range(1, 400)
local clean = lsim(tf({sampled[2]}, {1, sampled[1]}, {Ts = 0.5}), input, 0.5)
local found = zeros(1000)
for k = 1, 1000 do found[k] = regression(clean + 0.12*randn(400), clean, input)[1] end
answer("monte_carlo", vector{mean(found), std(found)})
report.figure("monte_carlo", histogram(found), "Study")
