-- Fits of many structures to measured records from default settings, and the records themselves, for
-- peers/output_error_search.py, which looks for the optima by another way: N.csv, the columns u and y of record N, and
-- fits.csv in the folder where the program runs. Run by the peer, or: dynlab run tests/bench/further_orders.lua
local records = require("measured_records")

local columns = {record = {}, name = {}, Ts = {}, poles = {}, zeros = {}, delay = {}, start = {}, fit_percent = {}}
local function add(number, record, n, m, delay, start, ok, G)
    local row = {record = number, name = record[1], Ts = record[2].Ts, poles = n, zeros = m, delay = delay, start = start,
                 fit_percent = ok and G.report.fit_percent or -1e6}
    for column, value in pairs(row) do table.insert(columns[column], value) end
end

for number, record in ipairs(records) do
    local data = record[2]
    save_csv(number .. ".csv", {u = data.u, y = data.y}, {digits = 17})
    for _, start in ipairs{"zero", "estimate"} do
        local options = start ~= "zero" and {InitialState = start} or nil
        for n = 1, 4 do
            for m = 0, n - 1 do add(number, record, n, m, 0, start, pcall(srivc, data, {m + 1, n, 0}, options)) end
        end
    end
    for _, orders in ipairs{{1, 0}, {2, 0}, {2, 1}, {3, 0}, {3, 1}} do
        local n, m = orders[1], orders[2]
        add(number, record, n, m, 1, "zero", pcall(tfsrivc, data, n, m))
    end
end
save_csv("fits.csv", columns, {digits = 17})
