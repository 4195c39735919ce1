-- Makes data/crane: the experiments with the simulated trolley crane (engine/numerics/plants/crane_experiments.h).
local crane, experiments = plant().crane, plant("crane")
for name, record in pairs(experiments) do
    save_csv("crane_" .. name .. ".csv", record, {units = crane.units, columns = crane.signals, Ts = crane.Ts,
             title = crane.title .. ", experiment " .. name})
end
save_mat("crane.mat", experiments, {digits = 7})
