-- Makes data/thruster: chirps on the simulated thruster (engine/numerics/plants/thruster.h).
local thruster, records = plant().thruster, plant("thruster")
for name, record in pairs(records) do
    save_csv("thruster_" .. name .. ".csv", record, {units = thruster.units, columns = thruster.signals, Ts = thruster.Ts,
             title = thruster.title .. ", record " .. name})
end
save_mat("thruster.mat", records, {digits = 7})
