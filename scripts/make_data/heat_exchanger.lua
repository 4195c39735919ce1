-- Makes data/heat_exchanger: the step test of the simulated heat exchanger (engine/numerics/rigs/heat_exchanger.h).
local record = rig("heat_exchanger", {seed = 1})
save_csv("heat_exchanger.csv", record, {units = {t = "s", u = "%", y = "°C"}, Ts = record.t[2] - record.t[1],
         title = "Step response of a heat exchanger"})
save_mat("heat_exchanger.mat", record, {digits = 7})
