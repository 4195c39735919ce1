-- Makes data/linear_system: two records of the simulated linear system (engine/numerics/rigs/linear_system.h).
local record = rig("linear_system", {seed = 1})
save_csv("linear_system.csv", record, {units = {t = "s", t_val = "s"}, columns = {"t", "u", "y", "t_val", "u_val", "y_val"},
         Ts = record.t[2] - record.t[1], title = "A linear system, records for estimation and validation"})
save_mat("linear_system.mat", record, {digits = 7})
