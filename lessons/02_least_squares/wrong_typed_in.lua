-- expects: follows_samples: The parameters do not change with the samples
-- expects: follows_study: The answer is the same for another data set
-- All numbers are correct, but none is computed.
local games = load("winning_times")
local picture = plot(games.year, games.time)
report.figure("residuals", picture, "Residuals")
report.figure("forecast", picture, "Forecast")
report.figure("monte_carlo", picture, "Study")
local last = #games.year - 1
local x = games.year:range(1, last) - mean(games.year:range(1, last))
local theta = solve(matrix{x, ones(last)}, games.time:range(1, last))
local e = games.time:range(1, last) - matrix{x, ones(last)}*theta
answer("line", theta)
answer("rmse", sqrt(mean(e^2)))
local in_2024 = forecast(polyfit_report(games.year:range(1, last), games.time:range(1, last), 1), 2024, 0.95)
answer("paris", vector{in_2024.value, in_2024.low, in_2024.high})
answer("ct", vector{1, 2})
answer("dt", vector{-0.6065, 0.7869})
answer("ct_noisy", vector{0.9971, 1.9942})
answer("dt_noisy", vector{-0.647, 0.7555})
answer("monte_carlo", vector{-0.5716, 0.0094})
