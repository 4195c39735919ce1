-- expects: two_stage: This is the direct method
-- expects: final_model: The feedback biases the direct method
-- expects: final_is_estimated: the largest allowed error
-- expects: drive_follows: This is the direct method again
-- All estimates ignore the feedback.
local r, T = load("drive").tracking, 0.01
local G = srivc(iddata(r.y, r.u, T), {1, 2, 0})
answer("G_direct", G)
local A, B, C = svf(r.y, 2, 10, {Ts = T, hold = "foh"}), svf(r.u, 2, 10, {Ts = T, hold = "zoh"}), svf(r.r, 4, 10, {Ts = T, hold = "zoh"})
local Z = matrix{C:col(3), C:col(4), C:col(5)}
answer("own_instruments", solve(Z:t()*matrix{-A:col(2), -A:col(3), B:col(3)}, Z:t()*A:col(1)))
answer("G_two_stage", G)
answer("G_final", G)
local h = load("drifting_process")
local all = iddata(h.y, h.u, 1)
for name, from in pairs{before_cleaning = 2300, after_cleaning = 4200} do
    local piece = srivc(all[{from, from + 600}], {1, 1, 0}, {InitialState = "estimate", Offset = "none"})
    answer(name, vector{dcgain(piece), 1/piece.den[2]})
end
report.figure("correlation", plot(r.t, r.y), "Speed")
report.figure("tracking", plot(h.t, h.u), "Power")
