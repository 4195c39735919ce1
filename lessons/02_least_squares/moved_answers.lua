-- How a test changes the answers of the reference solution before grading. `move[name]` is a function of an answer, the sign
-- `e` and `inside`, which specifies whether the answer must stay within the tolerance of checks.lua or exceed it.
-- `scaled(near, far)` and `shifted(near, far)` use the first amount inside the tolerance and the second amount outside.
for _, name in ipairs{"line", "rmse", "ct", "dt", "ct_noisy", "dt_noisy"} do move[name] = scaled(4e-4, 1e-2) end
move.paris = shifted(0.001, 0.02)
move.monte_carlo = function(x) return x + e*x[2]*(inside and vector{0.2, 0.1} or vector{1.5, 0.6}) end
