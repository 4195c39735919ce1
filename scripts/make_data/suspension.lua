-- Makes data/suspension: the unit step on the simulated suspension bench (engine/numerics/rigs/suspension.h).
local record = rig("suspension", {seed = 1})
save_csv("suspension.csv", record, {units = {t = "s", u = "V", y = "mm"}, Ts = record.t[2] - record.t[1],
         title = "Response of a suspension to a unit step"})
save_mat("suspension.mat", record, {digits = 7})
