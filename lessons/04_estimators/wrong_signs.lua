-- expects: own_without_noise: a1 and a2 have the wrong sign
-- expects: own_is_lssvf: the largest allowed error
-- expects: ivsvf: the instruments are missing
-- expects: final_model: The gain has the wrong sign
-- expects: final_is_estimated: no standard errors
-- expects: follows_data: the largest allowed error
-- The regressors of the output have the wrong sign, there are no instruments, and the sign of the final gain is changed by
-- hand.
local input, T = prbs(4, 100), 0.01
local plant = tf({2}, {1, 4, 3})
local x = lsim(plant, input, T)
local y = x + 0.2*randn(#x)
local function fitted(signal)
    local S, U = svf(signal, 2, 3, {Ts = T, hold = "foh"}), svf(input, 2, 3, {Ts = T, hold = "zoh"})
    return solve(matrix{S:col(2), S:col(3), U:col(3)}, S:col(1))
end
local d = iddata(y, input, T)
answer("own_without_noise", fitted(x))
answer("own", fitted(y))
answer("record", d)
answer("G_lssvf", lssvf(d, {2, 1, 0}, 3))
answer("G_ivsvf", lssvf(d, {2, 1, 0}, 3))
local best = tfsrivc(d, 2, 0, {TdMax = 0})
answer("G_final", tf({-best.param[3]}, {1, best.param[1], best.param[2]}))
local repeated = montecarlo{system = plant, input = input, Ts = T, sigma = 0.2, runs = 200, estimators = {tfsrivc = {2, 0, {TdMax = 0}}}}
answer("scatter", repeated.tfsrivc.std)
