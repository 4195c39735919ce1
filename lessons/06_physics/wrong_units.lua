-- expects: crane: The order is length, voltage
-- expects: crane_fit: The result must be in percent
-- expects: free_run: This is the one-step-ahead prediction error of NARX
-- expects: simulated: These are levels
-- expects: figures: The report has no figure
-- expects: crane_follows: On a data set that you have not seen
-- Two numbers are interchanged, a fit is a fraction, levels are submitted as readings, and the NARX error is one step ahead.
local R = load("crane")
local function quiet(r) return detrend(iddata(matrix{r.x, r.theta}, r.u, 0.02), "start", {samples = 50}) end
local function motion_of(t, z, u, p)
    local s, c, w = sin(z[3]), cos(z[3]), z[4]
    local pull = p.gain*u - p.viscous*z[2] - p.dry*tanh(z[2]/0.005) + p.coupling*s*w^2
    local back = -(9.81/p.length)*s - (p.pivot + p.air*abs(w))*w
    local a = (pull - p.coupling*c*back)/(1 - p.coupling*c^2/p.length)
    return {z[2], a, w, back - c*a/p.length}
end
local K = greyest(quiet(R.estimation), idgrey(motion_of, {gain = 0.25, viscous = 3, dry = {0.1, min = 0}, coupling = 0.05, length = {0.4, min = 0.1, max = 2},
                  pivot = 0.1, air = {0, min = 0}}, {states = 4, outputs = function(t, z) return {z[1], z[3]} end, x0 = {0, 0, 0, 0}}))
answer("crane", vector{K.dry/K.gain, K.length})
local fraction = select(2, fit(quiet(R.validation), K, {InitialState = "none", Offset = "none"}))/100
answer("crane_fit", fraction)
local W = load("two_tanks")
local one, two = iddata(W.y, W.u, 4), iddata(W.y_val, W.u_val, 4)
local function water(t, h, u, p)
    local over = 5*max(h[1] - 20, 0)
    local out = sqrt(max(h[1], 1e-4))
    return {p.k4*u - p.k1*out - over, p.k2*out + p.q*over - p.k3*sqrt(max(h[2], 1e-4)) - 5*max(h[2] - 20, 0)}
end
local L = greyest(one, idgrey(water, {k1 = {0.05, min = 0}, k2 = {0.05, min = 0}, k3 = {0.05, min = 0}, k4 = {0.07, min = 0}, q = {0.5, min = 0, max = 1}, base = 0},
                  {states = 2, outputs = function(t, h, u, p) return {p.base + 0.5*h[2]} end, x0 = {"estimate", "estimate"}}))
local function missed(percent, y) return (1 - percent/100)*norm(y - mean(y))/math.sqrt(#y) end
local N = narx(one, {4, 4, 1}, {degree = 2})
answer("tanks", vector{L.k1, L.k2, L.k3, L.k4, L.q, L.base})
answer("free_run", vector{missed(fit(two, srivc(one, {1, 2, 0}, {InitialState = "estimate", Offset = "estimate"})), two.y), missed(fit(two, L), two.y),
                          missed(N.report.prediction_fit_percent, one.y)})
answer("simulated", (compare(two, L).curves[2].y - L.base)/0.5)
