-- Makes data/heat_transfer: three records of the simulated heat-transfer rig (engine/numerics/rigs/heat_transfer.h).
local record = rig("heat_transfer", {seed = 1})
local units, columns = {}, {}
for _, part in ipairs{"", "_val", "_high"} do
    for name, unit in pairs{t = "s", u = "V", y = "°C"} do units[name .. part] = unit end
    for _, name in ipairs{"t", "u", "y"} do columns[#columns + 1] = name .. part end
end
save_csv("heat_transfer.csv", record, {units = units, columns = columns, Ts = record.t[2] - record.t[1],
         title = "Heat-transfer rig, records for estimation, validation and another operating point"})
save_mat("heat_transfer.mat", record, {digits = 7})
