-- expects: own_without_noise: Your filter uses a zero-order hold for the output
-- expects: own_is_lssvf: the largest allowed error
-- expects: lssvf: The model was estimated with a lambda other than 3
-- expects: ivsvf: the largest allowed error
-- expects: follows_data: the largest allowed error
-- The filter uses a zero-order hold for the measured output, and the library function another cutoff frequency.
local u, Ts = prbs(4, 100), 0.01
local Go = tf({2}, {1, 4, 3})
local x = lsim(Go, u, Ts)
local y = x + 0.2*randn(#u)
local function estimate(signal)
    local out, inp = svf(signal, 2, 3, {Ts = Ts, hold = "zoh"}), svf(u, 2, 3, {Ts = Ts, hold = "zoh"})
    return solve(matrix{-out:col(2), -out:col(3), inp:col(3)}, out:col(1))
end
local data = iddata(y, u, Ts)
answer("own_without_noise", estimate(x))
answer("own", estimate(y))
answer("record", data)
answer("G_lssvf", lssvf(data, {2, 1, 0}, 30))
answer("G_ivsvf", ivsvf(data, {2, 1, 0}, 30))
answer("G_final", srivc(data, {1, 2, 0}))
local many = montecarlo{system = Go, input = u, Ts = Ts, sigma = 0.2, runs = 200, estimators = {srivc = {{1, 2, 0}}}}
answer("scatter", many.srivc.std)
