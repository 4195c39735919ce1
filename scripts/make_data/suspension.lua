-- Makes data/suspension: the unit step on the simulated suspension bench (engine/numerics/plants/suspension.h).
local about, record = plant().suspension, plant("suspension")
save_csv("suspension.csv", record, {units = about.units, columns = about.signals, Ts = about.Ts, title = about.title})
save_mat("suspension.mat", record, {digits = 7})
