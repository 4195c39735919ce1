-- Makes data/drifting_process: the record of the simulated heater (engine/numerics/plants/drifting_process.h).
local about, record = plant().drifting_process, plant("drifting_process")
save_csv("drifting_process.csv", record, {units = about.units, columns = about.signals, Ts = about.Ts, title = about.title})
save_mat("drifting_process.mat", record, {digits = 7})
