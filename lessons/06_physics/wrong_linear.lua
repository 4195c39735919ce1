-- expects: crane: The dry friction is zero
-- expects: crane_fit: A linear model reaches this fit
-- expects: tanks: without its rim at 20 cm
-- expects: free_run: lsim starts from rest
-- expects: simulated: The score is
-- expects: crane_follows: On a data set that you have not seen
-- expects: tanks_follow: On a data set that you have not seen
-- The model assumes small swings and no dry friction, the tanks have no rims, and the linear model has no offset.
local record = load("crane")
local function settled(r) return detrend(iddata(matrix{r.x, r.theta}, r.u, 0.02), "start", {samples = 50}) end
local function small(t, x, u, p)
    local torque = -(9.81/p.length)*x[3] - p.pivot*x[4]
    local a = (p.gain*u - p.viscous*x[2] - p.coupling*torque)/(1 - p.coupling/p.length)
    return {x[2], a, x[4], torque - a/p.length}
end
local L = greyest(settled(record.estimation), idgrey(small, {gain = 0.25, viscous = 3, coupling = 0.05, length = {0.4, min = 0.1, max = 2}, pivot = 0.1},
                  {states = 4, outputs = function(t, x) return {x[1], x[3]} end, x0 = {0, 0, 0, 0}}))
answer("crane", vector{L.length, 0})
answer("crane_fit", select(2, fit(settled(record.validation), L, {InitialState = "none", Offset = "none"})))
local w = load("two_tanks")
local d, v = iddata(w.y, w.u, 4), iddata(w.y_val, w.u_val, 4)
local function pour(t, h, u, p)
    local a, b = sqrt(max(h[1], 1e-4)), sqrt(max(h[2], 1e-4))
    return {0.3*u - p.k1*a, p.k2*a - p.k3*b}
end
local P = greyest(d, idgrey(pour, {k1 = {0.2, min = 0}, k2 = {0.1, min = 0}, k3 = {0.1, min = 0}, base = 0},
                  {states = 2, outputs = function(t, h, u, p) return {p.base + 0.5*h[2]} end, x0 = {"estimate", "estimate"}}))
local function off(G) return (1 - fit(v, G)/100)*norm(v.y - mean(v.y))/math.sqrt(#v.y) end
local begin = {InitialState = "estimate", Offset = "estimate"}
answer("tanks", vector{P.k1, P.k2, P.k3, 0.3, 0, P.base})
local bare = v.y - lsim(srivc(d, {1, 2, 0}, begin), v.u, 4)
answer("free_run", vector{norm(bare)/math.sqrt(#bare), off(P), off(narx(d, {4, 4, 1}, {degree = 2}))})
answer("simulated", compare(v, P).curves[2].y)
report.figure("left", plot(record.validation.t, record.validation.theta), "Angle")
report.figure("free_run", plot(w.t_val, w.y_val), "Reading")
