-- How a test moves the answers of the worked solution on their way out: `move[name]` is a function of an answer, `e` the
-- sign, and `inside` whether the answer must stay within what checks.lua allows or leave it; `scaled(near, far)` and
-- `shifted(near, far)` do either by the first inside and by the second outside.
for _, name in ipairs{"line", "rmse", "ct", "dt", "ct_noisy", "dt_noisy"} do move[name] = scaled(4e-4, 1e-2) end
move.paris = shifted(0.001, 0.02)
move.monte_carlo = function(x) return x + e*x[2]*(inside and vector{0.2, 0.1} or vector{1.5, 0.6}) end
