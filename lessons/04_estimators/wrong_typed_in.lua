-- expects: own_is_lssvf: the largest allowed error
-- expects: final_is_estimated: no standard errors
-- expects: follows_data: compute it from the data
-- The true parameters are submitted as if they had been estimated.
local u = prbs(4, 100)
local y = lsim(tf({2}, {1, 4, 3}), u, 0.01) + 0.2*randn(#u)
local data = iddata(y, u, 0.01)
answer("own_without_noise", lssvf(iddata(lsim(tf({2}, {1, 4, 3}), u, 0.01), u, 0.01), {2, 1, 0}, 3).param)
answer("own", vector{4, 3, 2})
answer("record", data)
answer("G_lssvf", lssvf(data, {2, 1, 0}, 3))
answer("G_ivsvf", ivsvf(data, {2, 1, 0}, 3))
answer("G_final", tf({2}, {1, 4, 3}))
answer("scatter", vector{0.286, 0.186, 0.137})
