-- A steeper rim with `where`, other parameter names, the crane from three initial values, and a linear model from SRIVC.
local C = load("crane")
local function at_rest(r) return detrend(iddata(matrix{r.x, r.theta}, r.u, 0.02), "start", {samples = 50}) end
local function swing(t, s, u, q)
    local sine, cosine = sin(s[3]), cos(s[3])
    local torque = -(9.81/q.length)*sine - (q.pivot + q.air*abs(s[4]))*s[4]
    local push = q.push*u - q.drag*s[2] - q.dry*tanh(s[2]/0.004) + q.pull*sine*s[4]^2
    local acceleration = (push - q.pull*cosine*torque)/(1 - q.pull*cosine^2/q.length)
    return {s[2], acceleration, s[4], torque - cosine*acceleration/q.length}
end
local model = idgrey(swing, {push = 0.3, drag = 3, dry = {0.15, min = 0}, pull = 0.04, length = {0.35, min = 0.1, max = 1}, pivot = 0.05, air = {0.01, min = 0}},
                     {states = 4, outputs = function(t, s) return {s[1], s[3]} end, x0 = {0, 0, 0, 0}})
local G = greyest(at_rest(C.estimation), model)
answer("crane", vector{G.length, G.dry/G.push})
answer("crane_fit", select(2, fit(at_rest(C.validation), G, {InitialState = "none", Offset = "none"})))
local T = load("two_tanks")
local first, second = iddata(T.y, T.u, 4), iddata(T.y_val, T.u_val, 4)
local function over(level) return where(level - 20, 8*(level - 20), 0) end
local function flows(t, h, u, q)
    local out = q.k1*sqrt(max(h[1], 1e-3))
    return {q.k4*u - out - over(h[1]), q.k2*sqrt(max(h[1], 1e-3)) + q.q*over(h[1]) - q.k3*sqrt(max(h[2], 1e-3)) - over(h[2])}
end
local M = greyest(first, idgrey(flows, {k1 = {0.08, min = 0}, k2 = {0.08, min = 0}, k3 = {0.08, min = 0}, k4 = {0.11, min = 0}, q = {0.4, min = 0, max = 1}, zero = 0.1},
    {states = 2, outputs = function(t, h, u, q) return {q.zero + 0.5*h[2]} end, x0 = {"estimate", "estimate"}}))
local function error_of(G) return (1 - fit(second, G)/100)*norm(second.y - mean(second.y))/math.sqrt(#second.y) end
local estimated = {InitialState = "estimate", Offset = "estimate"}
answer("tanks", vector{M.k1, M.k2, M.k3, M.k4, M.q, M.zero})
answer("free_run", vector{error_of(srivc(first, {1, 2, 0}, estimated)), error_of(M), error_of(narx(first, {4, 4, 1}, {degree = 2}))})
answer("simulated", compare(second, M).curves[2].y)
report.figure("left", plot(C.validation.t, C.validation.theta), "Angle")
report.figure("free_run", plot(T.t_val, T.y_val), "Reading")
