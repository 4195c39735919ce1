-- Normal equations instead of solve, and IVSVF as the recommended method, with the scatter of IVSVF.
local u, Ts, sigma = prbs(4, 100), 0.01, 0.2
local Go = tf({2}, {1, 4, 3})
local x = lsim(Go, u, Ts)
local y = sigma*randn(#u) + x
local input = svf(u, 2, 3, {Ts = Ts, hold = "zoh"}):col(3)
local function lssvf_by_sums(signal)
    local S = svf(signal, 2, 3, {Ts = Ts, hold = "foh"})
    local Phi = matrix{-S:col(2), -S:col(3), input}
    return solve(Phi:t()*Phi, Phi:t()*S:col(1))
end
local data = iddata(y, u, Ts)
answer("own_without_noise", lssvf_by_sums(x))
answer("own", lssvf_by_sums(y))
answer("record", data)
answer("G_lssvf", lssvf(data, {2, 1, 0}, 3))
local iv = ivsvf(data, {2, 1, 0}, 3)
answer("G_ivsvf", iv)
answer("G_final", iv)
local a1, a2, b0 = zeros(150), zeros(150), zeros(150)
for k = 1, 150 do
    local p = ivsvf(iddata(x + sigma*randn(#u), u, Ts), {2, 1, 0}, 3).param
    a1[k], a2[k], b0[k] = p[1], p[2], p[3]
end
answer("scatter", vector{std(a1), std(a2), std(b0)})
