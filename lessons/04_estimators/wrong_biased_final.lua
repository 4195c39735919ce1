-- expects: final_model: biased by the noise
-- expects: scatter: the largest allowed error is 0.2
-- LSSVF has the smallest scatter, so it is recommended in spite of its bias.
local u = prbs(4, 100)
local G = tf({2}, {1, 4, 3})
local clean = lsim(G, u, 0.01)
local noisy = clean + 0.2*randn(#u)
local record = iddata(noisy, u, 0.01)
local function by_hand(y)
    local states = svf(y, 2, 3, {Ts = 0.01, hold = "foh"})
    local drive = svf(u, 2, 3, {Ts = 0.01, hold = "zoh"}):col(3)
    return solve(matrix{-states:col(2), -states:col(3), drive}, states:col(1))
end
answer("own_without_noise", by_hand(clean))
answer("own", by_hand(noisy))
answer("record", record)
local ls = lssvf(record, {2, 1, 0}, 3)
answer("G_lssvf", ls)
answer("G_ivsvf", ivsvf(record, {2, 1, 0}, 3))
answer("G_final", ls)
local study = montecarlo{system = G, input = u, Ts = 0.01, sigma = 0.2, runs = 200, estimators = {lssvf = {{2, 1, 0}, 3}}}
answer("scatter", study.lssvf.std)
