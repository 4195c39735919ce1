-- Makes data/crane: the experiments with the simulated trolley crane (engine/numerics/rigs/crane_experiments.h).
local experiments = rig("crane", {seed = 1})
local units = {t = "s", u = "V", x = "m", theta = "rad"}
local columns = {"t", "u", "x", "theta"}
for name, record in pairs(experiments) do
    save_csv("crane_" .. name .. ".csv", record, {units = units, columns = columns, Ts = record.t[2] - record.t[1],
             title = "Trolley crane, experiment " .. name})
end
save_mat("crane.mat", experiments, {digits = 7})
