-- How often a richer structure fits worse than a poorer one, on measured and simulated records of the course: all
-- pairs of (n, m) and (n - 1, m), (n, m - 1), (n - 1, m - 1) up to five poles, from rest and with a free start.
-- Run it: dynlab run tests/bench/nested_structures.lua
local records = require("measured_records")

local pairs_tried, worse, worst = 0, 0, 0
for _, record in ipairs(records) do
    local name, data = record[1], record[2]
    for _, state in ipairs{"zero", "estimate"} do
        local fits = {}
        for n = 1, 5 do
            for m = 0, n - 1 do
                local ok, G = pcall(srivc, data, {m + 1, n, 0}, {InitialState = state})
                local fit = ok and G.report.fit_percent or nil
                fits[10 * n + m] = fit
                for _, before in ipairs{10 * (n - 1) + m, 10 * n + m - 1, 10 * (n - 1) + m - 1} do
                    if fits[before] and (before % 10) < 9 then
                        pairs_tried = pairs_tried + 1
                        local lost = fits[before] - (fit or -100)
                        worst = math.max(worst, lost)
                        if lost > 0.05 then
                            worse = worse + 1
                            print(string.format("%s, %s: {%d, %d} %.2f %% after {%d, %d} %.2f %%", name, state, n, m,
                                                fit or 0/0, before // 10, before % 10, fits[before]))
                        end
                    end
                end
            end
        end
    end
end
print(string.format("%d of %d pairs fit worse by more than 0.05 points; the worst by %.2f", worse, pairs_tried, worst))
