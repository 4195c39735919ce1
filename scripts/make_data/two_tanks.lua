-- Makes data/two_tanks: two records of the simulated tanks (engine/numerics/plants/two_tanks.h).
local about, record = plant().two_tanks, plant("two_tanks")
save_csv("two_tanks.csv", record, {units = about.units, columns = about.signals, Ts = about.Ts, title = about.title})
save_mat("two_tanks.mat", record, {digits = 7})
