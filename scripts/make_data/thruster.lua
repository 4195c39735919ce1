-- Makes data/thruster: chirps on the simulated thruster (engine/numerics/rigs/thruster.h).
local records = rig("thruster", {seed = 1})
local units, columns = {t = "s", pwm = "µs", force = "N"}, {"t", "pwm", "force"}
for name, record in pairs(records) do
    save_csv("thruster_" .. name .. ".csv", record, {units = units, columns = columns, Ts = record.t[2] - record.t[1],
             title = "Thruster, record " .. name})
end
save_mat("thruster.mat", records, {digits = 7})
