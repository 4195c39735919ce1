-- expects: line: The fit includes 2024
-- expects: rmse: the largest allowed error
-- expects: paris: This is the actual result of Paris, not the forecast of the line
-- The line is fitted to all Games, including 2024, and then used to "forecast" 2024.
local games, four = load("winning_times"), load("step_response")
local n = #games.year
local x = games.year - mean(games.year)
local line = lsq(matrix{x, ones(n)}, games.time)
local e = games.time - matrix{x, ones(n)}*line.theta
answer("line", line.theta)
answer("rmse", sqrt(mean(e^2)))
local all = polyfit_report(games.year, games.time, 1)
local seen = forecast(all, 2024)
answer("paris", vector{games.time[n], seen.low, seen.high})
report.figure("residuals", plot(games.year, e), "Residuals")
report.figure("forecast", regression_plot(games.year, games.time, all), "Line")

local function now_and_before(y, u)
    local m = #y
    return solve(matrix{-y:range(1, m - 1), u:range(1, m - 1)}, y:range(2, m))
end
local sampled = now_and_before(four.y, four.u)
answer("ct", solve(matrix{-four.y, four.u}, four.ydot))
answer("dt", sampled)
answer("ct_noisy", solve(matrix{-four.y_noisy, four.u}, four.ydot_noisy))
answer("dt_noisy", now_and_before(four.y_noisy, four.u))
local input = prbs(7, 4):range(1, 400)
local clean = lsim(tf({sampled[2]}, {1, sampled[1]}, {Ts = four.t[2] - four.t[1]}), input, four.t[2] - four.t[1])
local a1 = zeros(1000)
for k = 1, #a1 do a1[k] = now_and_before(clean + 0.3*randn(400), input)[1] end
answer("monte_carlo", vector{mean(a1), std(a1)})
report.figure("monte_carlo", histogram(a1), "Study")
