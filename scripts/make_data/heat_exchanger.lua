-- Makes data/heat_exchanger: the step test of the simulated heat exchanger (engine/numerics/plants/heat_exchanger.h).
local about, record = plant().heat_exchanger, plant("heat_exchanger")
save_csv("heat_exchanger.csv", record, {units = about.units, columns = about.signals, Ts = about.Ts, title = about.title})
save_mat("heat_exchanger.mat", record, {digits = 7})
