-- Makes data/drive: experiments with the simulated drive (engine/numerics/plants/drive.h).
local drive, records = plant().drive, plant("drive")
for name, record in pairs(records) do
    save_csv("drive_" .. name .. ".csv", record, {units = drive.units, columns = drive.signals, Ts = drive.Ts,
             title = drive.title .. ", record " .. name})
end
save_mat("drive.mat", records, {digits = 7})
