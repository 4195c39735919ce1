-- How often the 95 % intervals of estimates hold the true value, kind by kind: fresh noise in each of 500 records,
-- default options but for those that a kind is about. An interval is the estimate and 1.96 of its standard errors, the
-- robust ones where the noise is colored. The share of one value has a standard
-- deviation of one point.
-- Run it: dynlab run tests/bench/coverage.lua
local runs, first_seed = 500, 800000
local lowest, highest = 92, 98  -- per cent

local kinds, outside = 0, 0
print(string.format("%-58s %6s %6s %6s   %s", "", "share", "least", "most", "scatter / standard error"))

-- `trial` gives the estimates and the standard errors of one record. Without `truth` the intervals are held against the
-- means of all estimates: where these are biased, on purpose or by nature, the errors tell the scatter.
local function study(name, truth, trial)
    local estimates, errors = {}, {}
    for run = 1, runs do
        rng(first_seed + run)
        estimates[run], errors[run] = trial()
    end
    local held, least, most, smallest, largest = 0, 100, 0, math.huge, 0
    local count = #estimates[1]
    for i = 1, count do
        local mean_value, mean_error, square, within = 0, 0, 0, 0
        for run = 1, runs do
            mean_value = mean_value + estimates[run][i] / runs
            mean_error = mean_error + errors[run][i] / runs
        end
        local target = truth and truth[i] or mean_value
        for run = 1, runs do
            square = square + (estimates[run][i] - mean_value) ^ 2 / (runs - 1)
            if math.abs(estimates[run][i] - target) < 1.96 * errors[run][i] then within = within + 1 end
        end
        local share, ratio = 100 * within / runs, square ^ 0.5 / mean_error
        held = held + share / count
        least, most = math.min(least, share), math.max(most, share)
        smallest, largest = math.min(smallest, ratio), math.max(largest, ratio)
    end
    kinds = kinds + 1
    local doubt = ""
    if held < lowest or held > highest then outside, doubt = outside + 1, "  OUTSIDE" end
    print(string.format("%-58s %6.1f %6.1f %6.1f   %.2f to %.2f%s", name, held, least, most, smallest, largest, doubt))
end

local function of_errors(G) return G.param, G.std end
local function of_robust_errors(G) return G.param, G.robust_std end

-- Noise of variance one, settled: white, autoregressive, half of each, and a lightly damped swing.
local settling = 1000
local function recursion(N, a1, a2, size)
    local e, v, before, last = size * randn(N + settling), zeros(N), 0, 0
    for k = 1, N + settling do
        before, last = last, e[k] - a1 * last - a2 * before
        if k > settling then v[k - settling] = last end
    end
    return v
end
local function autoregression(pole)
    return function(N) return recursion(N, -pole, 0, (1 - pole ^ 2) ^ 0.5) end
end
local function mixed(N) return 0.5 ^ 0.5 * (autoregression(0.99)(N) + randn(N)) end
local function swing(N)
    local a1, a2 = -1.99 * math.cos(0.05), 0.995 ^ 2
    return recursion(N, a1, a2, (((1 - a2) * ((1 + a2) ^ 2 - a1 ^ 2)) / (1 + a2)) ^ 0.5)
end

local function size_of_noise(x, snr) return std(x) * 10 ^ (-snr / 20) end

-- Continuous time, white noise.
local s = tf("s")
local Ts, snr = 0.05, 10
local u = prbs(8, 6):range(1, 1500)
do
    local G0 = tf({-1.5, 4}, {1, 1.2, 4}, {IODelay = 0.37})
    local x, w = lsim(G0, u, Ts), vector{0.3, 1, 1.8, 3, 6}
    local size, G = size_of_noise(x, snr)
    local function again() G = tfsrivc(iddata(x + size * randn(#x), u, Ts), 2, 1) end
    study("tfsrivc, zero in the right half plane, free delay", {1.2, 4, -1.5, 4, 0.37}, function()
        again()
        return of_errors(G)
    end)
    study("the same: its magnitude", bode_values(G0, w), function()
        again()
        local magnitude, _, _, error_of_magnitude = bode_values(G, w)
        return magnitude, error_of_magnitude
    end)
end
local G0, truth = tf({4}, {1, 1.2, 4}), {1.2, 4, 4}
local x = lsim(G0, u, Ts)
local size = size_of_noise(x, snr)
local function record(noise) return iddata(x + size * (noise or randn)(#x), u, Ts) end
do
    local running = iddata(x, u, Ts):range(201, 1500)
    study("srivc, start and offset estimated", truth, function()
        local data = iddata(running.y + 5 + size * randn(running.N), running.u, Ts)
        return of_errors(srivc(data, {1, 2, 0}, {InitialState = "estimate", Offset = "estimate"}))
    end)
    local steps = cumsum(Ts * (0.4 + 1.2 * rand(1000)))
    local held = u:range(1, 1000)
    local uneven = lsim(G0, held, steps)
    study("srivc, irregular sampling", truth, function()
        local y = uneven + size_of_noise(uneven, snr) * randn(#uneven)
        return of_errors(srivc(iddata(y, held, nil, {SamplingInstants = steps}), {1, 2, 0}))
    end)
    study("srivc, two outputs with one denominator", {1.2, 4, 4, 1, 2}, function()
        local other = lsim(tf({1, 2}, {1, 1.2, 4}), u, Ts)
        local y = matrix{(x + size * randn(#x)):table(), (other + size_of_noise(other, snr) * randn(#x)):table()}:t()
        return of_errors(srivc(iddata(y, u, Ts), {{1, 2}, {2, 2}, {0, 0}}, {CommonDenominator = true}))
    end)
end
do
    local P = idproc("P2DU", {Kp = 2, Tw = 0.5, Zeta = 0.3, Td = 0.33})
    local y = lsim(P, u, Ts)
    local names = {"Kp", "Tw", "Zeta", "Td"}
    study("procsrivc, P2DU on an offset", {2, 0.5, 0.3, 0.33}, function()
        local G = procsrivc(iddata(y + 3 + size_of_noise(y, snr) * randn(#y), u, Ts), "P2DU")
        local estimates, errors = {}, {}
        for k, name in ipairs(names) do
            estimates[k] = G[name]
            for i = 1, #G.names do
                if G.names[i] == name then errors[k] = G.std[i] end
            end
        end
        return estimates, errors
    end)
end
-- Cut from a running experiment: inputs from before the record still arrive in it.
do
    local G = tf({4}, {1, 1.2, 4}, {IODelay = 0.63})
    local cut = iddata(lsim(G, u, Ts), u, Ts):range(301, 1500)
    local level = size_of_noise(cut.y, snr)
    study("tfsrivc, cut from a running experiment, a delay", {1.2, 4, 4, 0.63}, function()
        local data = iddata(cut.y + level * randn(cut.N), cut.u, Ts)
        return of_errors(tfsrivc(data, 2, 0, {InitialState = "estimate"}))
    end)
    study("procsrivc, cut from a running experiment, a delay", {1, 0.5, 0.3, 0.63}, function()
        local M = procsrivc(iddata(cut.y + level * randn(cut.N), cut.u, Ts), "P2DU", {InitialState = "estimate"})
        return {M.Kp, M.Tw, M.Zeta, M.Td}, M.std
    end)
end
-- Discrete time.
do
    local N = 1000
    local pulse = prbs(10, 1):range(1, N)
    local function difference(e, C, whole)
        local y, past = zeros(N), zeros(N)
        for k = 1, N do
            local y1, y2 = k > 1 and y[k - 1] or 0, k > 2 and y[k - 2] or 0
            local u1, u2 = k > 1 and pulse[k - 1] or 0, k > 2 and pulse[k - 2] or 0
            local noise = e[k] + C * (k > 1 and e[k - 1] or 0)
            y[k] = 1.5 * y1 - 0.7 * y2 + u1 + 0.5 * u2 + (whole and noise or 0)
        end
        return whole and y or y + e
    end
    local theta = {-1.5, 0.7, 1, 0.5}
    study("oe", theta, function()
        local G = oe(iddata(difference(randn(N), 0, false), pulse, 1), {2, 2, 1})
        return {G.F[2], G.F[3], G.B[2], G.B[3]}, G.std
    end)
    study("armax", {-1.5, 0.7, 1, 0.5, 0.6}, function()
        return of_errors(armax(iddata(difference(randn(N), 0.6, true), pulse, 1), {2, 2, 1, 1}))
    end)
    study("iv4", theta, function()
        return of_errors(iv4(iddata(difference(randn(N), 0, true), pulse, 1), {2, 2, 1}))
    end)
    study("iv4, equation error a moving average", theta, function()
        return of_errors(iv4(iddata(difference(randn(N), 0.6, true), pulse, 1), {2, 2, 1}))
    end)
end
-- A characteristic with a dead band.
do
    rng(first_seed)
    local levels = 2 * rand(200) - 1
    local v, f = zeros(1200), zeros(1200)
    for k = 1, 1200 do
        v[k] = levels[1 + (k - 1) // 6]
        f[k] = v[k] > 0.2 and v[k] - 0.2 or v[k] < -0.2 and v[k] + 0.2 or 0
    end
    local y = lsim(tf({9}, {1, 2, 9}), f, Ts)
    study("hammerstein, its levels", {-0.8, 0, 0, 0.8}, function()
        local data = iddata(y + size_of_noise(y, snr) * randn(#y), v, Ts)
        local H = hammerstein(data, 2, 0, {Breakpoints = {-1, -0.2, 0.2, 1}, IODelay = 0, InitialState = "zero"})
        return H.report.levels, H.report.levels_std
    end)
end
-- Colored noise.
study("srivc, white noise: robust", truth, function() return of_robust_errors(srivc(record(), {1, 2, 0})) end)
local colored = {
    {"noise AR(1) 0.9", autoregression(0.9)},
    {"noise AR(1) 0.99", autoregression(0.99)},
    {"noise white + AR(1) 0.99", mixed},
    {"noise a slow swing", swing},
}
for _, kind in ipairs(colored) do
    study("srivc, " .. kind[1] .. ": robust", truth, function()
        return of_robust_errors(srivc(record(kind[2]), {1, 2, 0}))
    end)
end
study("rivc, noise AR(1) 0.9", truth, function()
    return of_errors(rivc(record(autoregression(0.9)), {1, 0, 1, 2, 0}))
end)
study("procsrivc, noise AR(1) 0.9: robust", {1, 0.5, 0.3}, function()
    local G = procsrivc(record(autoregression(0.9)), "P2U")
    return {G.Kp, G.Tw, G.Zeta}, G.robust_std
end)
-- Without iterations.
for _, kind in ipairs{{"white noise"}, table.unpack(colored)} do
    study("ivsvf, " .. kind[1], truth, function() return of_errors(ivsvf(record(kind[2]), {2, 1, 0}, 3)) end)
end
study("lssvf, white noise, about the means", nil, function() return of_errors(lssvf(record(), {2, 1, 0}, 3)) end)
-- Two inputs, whose delays take the longest to find.
do
    local u1, u2 = prbs(9, 6):range(1, 1270), prbs(7, 10)
    local inputs = matrix{u1:table(), u2:table()}:t()
    local G1, G2 = tf({4}, {1, 2, 4}, {IODelay = 0.03}), tf({1}, {1, 1, 1}, {IODelay = 0.05})
    local x = lsim(G1, u1, 0.01) + lsim(G2, u2, 0.01)
    local size = size_of_noise(x, snr)
    study("tfsrivc, two inputs, two delays", {2, 4, 4, 0.03, 1, 1, 1, 0.05}, function()
        return of_errors(tfsrivc(iddata(x + size * randn(#x), inputs, 0.01), {2, 2}, {0, 0}, {TdMax = 0.2}))
    end)
end

print(string.format("%d of %d kinds outside %d to %d %%", outside, kinds, lowest, highest))
