-- Measured and simulated records of the course, as the studies of searches take them: {name, data}, signals counted from
-- their means where they swing about an operating point.
local crane, exchanger, transfer = load("crane"), load("heat_exchanger"), load("heat_transfer")
local linear, arm, suspension, thruster = load("linear_system"), load("robot_arm"), load("suspension"), load("thruster")
local dryer = load("hairdryer")

local function centered(y, u, Ts) return iddata(y, u, Ts):remove_mean() end
local function of_thruster(r) return centered(r.force, r.pwm, r.t[2] - r.t[1]):resample(1, 5) end

local records = {
    {"hairdryer", centered(dryer.y, dryer.u, dryer.Ts)},
    {"robot arm", centered(arm.y, arm.u, arm.Ts)},
    {"heat exchanger", iddata(exchanger.y, exchanger.u, exchanger.Ts)},
    {"heat transfer", centered(transfer.y, transfer.u, transfer.Ts)},
    {"heat transfer, high", centered(transfer.y_high, transfer.u_high, transfer.Ts)},
    {"linear system", iddata(linear.y, linear.u, linear.Ts)},
    {"suspension", iddata(suspension.y, suspension.u, suspension.Ts)},
    {"thruster, sine 100", of_thruster(thruster.sine_100)},
    {"thruster, sine 300", of_thruster(thruster.sine_300)},
    {"thruster, square 100", of_thruster(thruster.square_100)},
    {"thruster, square 300", of_thruster(thruster.square_300)},
}
local step = crane.estimation.t[2] - crane.estimation.t[1]
local names = {}
for name in pairs(crane.estimation) do
    if name ~= "t" and name ~= "u" then names[#names + 1] = name end
end
table.sort(names)
for _, name in ipairs(names) do
    records[#records + 1] = {"crane, " .. name, iddata(crane.estimation[name], crane.estimation.u, step)}
end
return records
