-- expects: direct: check that you estimated it from tracking
-- expects: own_instruments: a1 and a2 have the wrong sign
-- expects: before_cleaning: This is the single model of all data, which does not track the changes
-- expects: after_cleaning: The order is gain, time constant
-- expects: heater_follows: On a data set that you have not seen
-- expects: figures: The report has no figure
-- The model of the heater is constant, two numbers are interchanged, a sign is missing, and a wrong data set is used.
local d, S = load("drive"), 0.01
answer("G_direct", srivc(iddata(d.open_loop.y, d.open_loop.u, S), {1, 2, 0}))
local t = d.tracking
local P, Q, R = svf(t.y, 2, 10, {Ts = S, hold = "foh"}), svf(t.u, 2, 10, {Ts = S, hold = "zoh"}), svf(t.r, 4, 10, {Ts = S, hold = "zoh"})
local z = matrix{R:col(3), R:col(4), R:col(5)}:t()
answer("own_instruments", solve(z*matrix{P:col(2), P:col(3), Q:col(3)}, z*P:col(1)))
local stage = srivc(iddata(t.u, t.r, S), {4, 3, 1})
local two = srivc(iddata(t.y, lsim(stage, t.r, S), S), {1, 2, 0})
answer("G_two_stage", two)
answer("G_final", two)
local f = load("drifting_process")
local one = srivc(iddata(f.y, f.u, 1), {1, 1, 0}, {InitialState = "estimate", Offset = "none"})
answer("before_cleaning", vector{dcgain(one), 1/one.den[2]})
local late = srivc(iddata(f.y, f.u, 1)[{4200, 4800}], {1, 1, 0}, {InitialState = "estimate", Offset = "none"})
answer("after_cleaning", vector{1/late.den[2], dcgain(late)})
