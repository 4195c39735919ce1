"""The crane's physics fitted with scipy as one would write it: solve_ivp between changes of the input, least_squares with
its own differences. The model is crane_model() of tests/support/grey_cases.h."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import least_squares

START = np.array([1, 15, 0.3, 0.05, 0.4, 0.01, 0.0])
LOWER = np.array([0, 0, 0, 0, 0.1, -np.inf, -np.inf])
WEIGHTS = np.array([1 / 0.005, 1 / 0.01])  # of position and angle


def rates(_, state, u, p):
    a, b, d, mu, length, c, _ = p
    _, v, phi, w = state
    co, si = np.cos(phi), np.sin(phi)
    r1 = a * u - b * v - d * np.tanh(200 * v) + mu * si * w * w
    r2 = -9.81 * si - c * w
    det = length - mu * co * co
    return [v, (length * r1 - mu * co * r2) / det, w, (r2 - co * r1) / det]


def simulated(p, u, t):
    """Position and angle at the samples t, the input u held between them."""
    changes = np.flatnonzero(np.diff(u)) + 1
    edges = np.concatenate(([0], changes, [len(u) - 1]))
    states = np.zeros((len(u), 4))
    for first, last in zip(edges[:-1], edges[1:]):
        if last == first:
            continue
        run = solve_ivp(rates, (t[first], t[last]), states[first], t_eval=t[first:last + 1], args=(u[first], p),
                        rtol=1e-7, atol=1e-9)
        states[first:last + 1] = run.y.T
    return np.column_stack((states[:, 0], states[:, 2] + p[6]))


def fit(u, y, Ts):
    """y: N x 2."""
    t = Ts * np.arange(len(u))
    residuals = lambda p: ((simulated(p, u, t) - y) * WEIGHTS).ravel()
    return least_squares(residuals, START, bounds=(LOWER, np.inf), x_scale="jac").x
