"""Direct continuous-time identification in numpy, as fast as numpy and scipy honestly go.

The twins of dynlab's lsim, lssvf, ivsvf and srivc with the conventions of tests/reference/data: exact discretization,
inputs held (zoh), outputs on straight lines between the samples (foh), zero filter states at the first sample, the
highest derivative by the identity p^n/E y = y - sum e_i p^(n-i)/E y, normal equations. Every filtered signal is one
compiled recursion (scipy.signal.lfilter); the rest are a few array operations.

Model: y = B/A u + e, A = s^n + a_1 s^(n-1) + ... + a_n, B = b_0 s^m + ... + b_m, theta = [a_1..a_n b_0..b_m].
"""

import math

import numpy as np
from scipy.signal import lfilter


def matrix_exponential(M):
    """By scaling, Taylor's series and squaring; for matrices this small several times quicker than scipy's."""
    size = float(np.abs(M).sum(axis=1).max())
    squarings = max(0, math.ceil(math.log2(size / 0.5)))
    M = M / 2.0**squarings
    size /= 2.0**squarings
    term, result = M, np.eye(len(M)) + M
    k, bound = 1, size
    while bound > 1e-17:
        k += 1
        bound *= size / k
        term = term @ M / k
        result = result + term
    for _ in range(squarings):
        result = result @ result
    return result


class DerivativeFilters:
    """The filters p^i/A, i < n, and p^i B/A^2 for a polynomial A with the given poles, sampled exactly."""

    def __init__(self, A, poles, Ts, B=None):
        n = len(A) - 1
        states = n if B is None else 2 * n
        M = np.zeros((states + 2, states + 2))
        for first in range(0, states, n):  # controllable companion form: the states are p^(n-1) x/A .. x/A
            M[first, first : first + n] = -A[1:]
            for k in range(1, n):
                M[first + k, first + k - 1] = 1
        if B is not None:
            M[n, n - len(B) : n] = B  # B/A x drives the second stage
        M[0, states] = M[states, states + 1] = 1
        sampled = matrix_exponential(M * Ts)
        self.n = n
        self.F = sampled[:states, :states]
        self.held = sampled[:states, states]
        self.ramp = sampled[:states, states + 1] / Ts
        self.denominator = np.poly(np.exp(poles * Ts)).real

    def numerators(self, start, first, order, denominator):
        """Of the filters that start -> F start -> ... is the impulse response of, for n states from the first on."""
        columns = [start[: first + self.n]]
        F = self.F[: first + self.n, : first + self.n]
        for _ in range(order - 1):
            columns.append(F @ columns[-1])
        toeplitz = np.zeros((order, order))
        for k in range(order):
            toeplitz[k, k:] = denominator[: order - k]
        return np.array(columns)[:, first:].T @ toeplitz

    def zoh(self, x, count):
        """p^(count-1) x/A .. x/A for an x held between its samples."""
        b = self.numerators(self.held, 0, self.n, self.denominator)
        for row in b[self.n - count :]:
            yield lfilter(np.concatenate(((0.0,), row)), self.denominator, x)

    def foh(self, x):
        """p^(n-1) x/A .. x/A for an x on straight lines between its samples (along the last axis)."""
        n = self.n
        ramp = self.ramp[:n]
        driven = self.F[:n, :n] @ ramp + self.held[:n] - ramp
        b = np.outer(ramp, self.denominator)
        b[:, 1:] += self.numerators(driven, 0, n, self.denominator)
        # Without a start value the recursion would see a ramp from zero before the first sample.
        start = -self.numerators(ramp, 0, n, self.denominator)
        for row, first in zip(b, start):
            yield lfilter(row, self.denominator, x, zi=first * x[..., :1])[0]

    def cascade(self, x):
        """p^(n-1) B/A^2 x .. B/A^2 x for an x held between its samples."""
        denominator = np.convolve(self.denominator, self.denominator)
        for row in self.numerators(self.held, self.n, 2 * self.n, denominator):
            yield lfilter(np.concatenate(((0.0,), row)), denominator, x)


def reflected(a):
    """Polynomial s^n + a_1 s^(n-1) + ... and its zeros, the unstable ones mirrored at the imaginary axis."""
    A = np.concatenate(((1.0,), a))
    poles = np.roots(A)
    if (poles.real > 0).any():
        poles = np.where(poles.real > 0, -poles.conj(), poles)
        A = np.poly(poles).real
    return A, poles


def simulate(B, A, poles, u, Ts):
    """Response of B/A to the held input u: one recursion."""
    n = len(A) - 1
    filters = DerivativeFilters(A, poles, Ts)
    b = B @ filters.numerators(filters.held, 0, n, filters.denominator)[n - len(B) :]
    return lfilter(np.concatenate(((0.0,), b)), filters.denominator, u)


def svf(n, cutoff):
    """Polynomial and zeros of the state-variable filter (s + cutoff)^n."""
    poles = np.full(n, -float(cutoff))
    return np.poly(poles), poles


def regression(E, filters, u, y, m):
    """Rows [-p^(n-1) y_f .. -y_f, p^m u_f .. u_f, p^n y_f] with x_f = x/E."""
    n = filters.n
    rows = np.empty((n + m + 2, len(u)))
    rows[-1] = y
    for k, filtered in enumerate(filters.foh(y)):
        np.negative(filtered, out=rows[k])
        filtered *= E[k + 1]
        rows[-1] -= filtered
    for k, filtered in enumerate(filters.zoh(u, m + 1)):
        rows[n + k] = filtered
    return rows


def least_squares(rows):
    """The last row as a linear combination of the others."""
    products = rows[:-1] @ rows.T
    return np.linalg.solve(products[:, :-1], products[:, -1])


def instrumental_variables(rows, outputs):
    """The same with instruments: the given rows for the filtered outputs, the filtered inputs for themselves."""
    n = len(outputs)
    products = np.concatenate((-(outputs @ rows.T), rows[n:-1] @ rows.T))
    return np.linalg.solve(products[:, :-1], products[:, -1])


def stacked(signals, count, samples):
    """The signals, made one after the other, as rows."""
    rows = np.empty((count, samples))
    for k, signal in enumerate(signals):
        rows[k] = signal
    return rows


def lssvf(u, y, n, m, Ts, cutoff):
    """Least squares on signals filtered by 1/(s + cutoff)^n, by normal equations."""
    E, poles = svf(n, cutoff)
    return least_squares(regression(E, DerivativeFilters(E, poles, Ts), u, y, m))


def lssvf_lstsq(u, y, n, m, Ts, cutoff):
    """The same by numpy's general solver, as most would write it; normal equations are quicker and accurate enough."""
    E, poles = svf(n, cutoff)
    rows = regression(E, DerivativeFilters(E, poles, Ts), u, y, m)
    return np.linalg.lstsq(rows[:-1].T, rows[-1], rcond=None)[0]


def ivsvf(u, y, n, m, Ts, cutoff):
    """Instrumental variables: the instruments come from the output simulated by the LSSVF model."""
    E, poles = svf(n, cutoff)
    filters = DerivativeFilters(E, poles, Ts)
    rows = regression(E, filters, u, y, m)
    start = least_squares(rows)
    x = simulate(start[n:], *reflected(start[:n]), u, Ts)
    return instrumental_variables(rows, stacked(filters.foh(x), n, len(u)))


def srivc(u, y, n, m, Ts, cutoff, tolerance=1e-6, most=50):
    """Refined instrumental variables for output-error models from an LSSVF start: theta and the iterations made.

    Instruments p^i B/A^2 u by one exact filter of order 2n."""
    theta = lssvf(u, y, n, m, Ts, cutoff)
    for iteration in range(1, most + 1):
        A, poles = reflected(theta[:n])
        filters = DerivativeFilters(A, poles, Ts, theta[n:])
        rows = regression(A, filters, u, y, m)
        last, theta = theta, instrumental_variables(rows, stacked(filters.cascade(u), n, len(u)))
        if np.abs((theta - last) / theta).max() < tolerance:
            break
    return theta, iteration


def monte_carlo(u, x, sigma, runs, n, m, Ts, cutoff, generator):
    """Estimates of three methods, each from the data alone, for outputs x + sigma e with fresh white e: 3 x runs x d."""
    estimates = np.empty((3, runs, n + m + 1))
    for run in range(runs):
        y = x + sigma * generator.standard_normal(len(x))
        estimates[0, run] = lssvf(u, y, n, m, Ts, cutoff)
        estimates[1, run] = ivsvf(u, y, n, m, Ts, cutoff)
        estimates[2, run] = srivc(u, y, n, m, Ts, cutoff)[0]
    return estimates
