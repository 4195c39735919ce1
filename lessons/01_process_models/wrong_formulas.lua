-- expects: exchanger_reading: a third of it
-- expects: overshoot: in percent
-- expects: suspension_reading: You used D1 in percent in the formula
-- expects: figures: no figure "suspension_test"
-- The settling time is used as the time constant, the overshoot is in percent, and one comparison is missing.
local h, s = load("heat_exchanger"), load("suspension")
local heat, spring = iddata(h.y, h.u, h.t[2] - h.t[1]), iddata(s.y, s.u, s.t[2] - s.t[1])
local change = mean(h.y:range(250, #h.y)) - mean(h.y:range(1, 30))
local K = change/(h.u[#h.u] - h.u[1])
local Tr = 228
local top, instant = max(s.y)
local final = mean(s.y:range(300, #s.y))
local D1 = 100*(top/final - 1)
local z = math.sqrt(math.log(D1)^2/(math.log(D1)^2 + math.pi^2))
local z_right = math.sqrt(math.log(D1/100)^2/(math.log(D1/100)^2 + math.pi^2))
answer("settling_time", Tr)
answer("exchanger_reading", vector{K, Tr})
answer("G_exchanger", procsrivc(heat, "P1", {InitialState = "estimate", Offset = "estimate"}))
answer("overshoot", D1)
answer("suspension_reading", vector{final, z, math.pi/(s.t[instant]*math.sqrt(1 - z_right^2))})
answer("G_suspension", procsrivc(spring, "P2U"))
report.figure("exchanger_test", test_your_model(tf({K}, {Tr/3, 1}), heat), "Heat exchanger")
