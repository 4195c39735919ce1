-- How often a richer structure fits worse than a poorer one, on measured and simulated records of the course: all
-- pairs of (n, m) and (n - 1, m), (n, m - 1), (n - 1, m - 1) up to five poles, from rest and with a free start.
-- Run it: dynlab run tests/bench/nested_structures.lua
local crane, exchanger, transfer = load("crane"), load("heat_exchanger"), load("heat_transfer")
local linear, arm, suspension, thruster = load("linear_system"), load("robot_arm"), load("suspension"), load("thruster")

local function centred(y, u, Ts) return iddata(y, u, Ts):remove_mean() end
local function of_thruster(r) return centred(r.force, r.pwm, r.t[2] - r.t[1]):resample(1, 5) end
local step = crane.estimation.t[2] - crane.estimation.t[1]
local dryer = load("hairdryer")
local records = {
    {"hairdryer", centred(dryer.y, dryer.u, dryer.Ts)},
    {"robot arm", centred(arm.y, arm.u, arm.Ts)},
    {"heat exchanger", iddata(exchanger.y, exchanger.u, exchanger.Ts)},
    {"heat transfer", centred(transfer.y, transfer.u, transfer.Ts)},
    {"heat transfer, high", centred(transfer.y_high, transfer.u_high, transfer.Ts)},
    {"linear system", iddata(linear.y, linear.u, linear.Ts)},
    {"suspension", iddata(suspension.y, suspension.u, suspension.Ts)},
    {"thruster, sine 100", of_thruster(thruster.sine_100)},
    {"thruster, sine 300", of_thruster(thruster.sine_300)},
    {"thruster, square 100", of_thruster(thruster.square_100)},
    {"thruster, square 300", of_thruster(thruster.square_300)},
}
for name, y in pairs(crane.estimation) do
    if name ~= "t" and name ~= "u" then
        records[#records + 1] = {"crane, " .. name, iddata(y, crane.estimation.u, step)}
    end
end

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
