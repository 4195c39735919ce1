-- Makes data/linear_system: two records of the simulated linear system (engine/numerics/plants/linear_system.h).
local about, record = plant().linear_system, plant("linear_system")
save_csv("linear_system.csv", record, {units = about.units, columns = about.signals, Ts = about.Ts, title = about.title})
save_mat("linear_system.mat", record, {digits = 7})
