-- Makes data/heat_transfer: three records of the simulated heat-transfer rig (engine/numerics/plants/heat_transfer.h).
local about, record = plant().heat_transfer, plant("heat_transfer")
save_csv("heat_transfer.csv", record, {units = about.units, columns = about.signals, Ts = about.Ts, title = about.title})
save_mat("heat_transfer.mat", record, {digits = 7})
