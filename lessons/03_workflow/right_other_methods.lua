-- Discrete-time output error converted to continuous time, another cutoff frequency of the high-pass filter, and an ARX
-- model of the dryer.
local L = load("linear_system")
local learn, check = iddata(L.y, L.u, 0.05), iddata(L.y_val, L.u_val, 0.05)
local G = tfcoe(learn, 3, 1, {TdMax = 0})
answer("linear_orders", vector{3, 1})
answer("G_linear", G)
answer("linear_fit", fit(check, G))
report.figure("linear_resid", resid(check, G), "Residuals")

local H = load("heat_transfer")
local function filtered(y, u) return idfilt(detrend(iddata(y, 100*(u/10)^2, 1), "start"), {0.01, math.huge}, {order = 2}) end
local plant = tfsrivc(filtered(H.y, H.u), 2, 0, {TdMax = 20})
answer("G_heat", plant)
report.figure("heat_high", compare(filtered(H.y_high, H.u_high), plant), "About 7 V")

local d = load("hairdryer")
local one, two = iddata(d.y, d.u, d.Ts):split(0.5)
one, two = one:remove_mean(), two:remove_mean()
local dryer = arx(one, {2, 2, 3})
answer("G_dryer", dryer)
answer("dryer_fit", fit(two, dryer))
report.figure("dryer_compare", compare(two, dryer), "Second half")
