"""Looks for the best output-error models of measured records by another way than dynlab, and compares the fits.

output_error_search.py DYNLAB [RECORD ...]

DYNLAB, the program, runs ../further_orders.lua in a temporary folder: records, and its fits of many structures from
default settings. For each of these structures this program minimizes the simulation error from random starts that know
nothing of dynlab's answers: the poles (and the delay) are searched by scipy's least_squares, the numerator and a free
start follow by linear least squares in each step (variable projection, Golub and Pereyra 1973). Poles are those of
quadratics s^2 + a s + b with a, b > 0, which all stable polynomials are products of, and of one s + a where their number
is odd. Inputs are held, simulation is exact at the samples, delays may lie between these. Models that swing faster than
half the sampling frequency do not count.

Prints the structures whose fit is lower than here by more than 0.05 points, and a line for every record.
"""

import csv
import shutil
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares
from scipy.signal import lfilter

import identification as twin

STARTS, POLISHED = 20, 4
FIRST_STEPS, LAST_STEPS = 12, 300
SHORT = 0.05  # points of fit
LONGEST_DELAY = 40  # samples


def poles_of(x, n):
    """Coefficients and roots of the polynomial that n logarithms stand for."""
    A = np.ones(1)
    poles = []
    for k in range(0, n - 1, 2):
        a, b = np.exp(x[k]), np.exp(x[k + 1])
        A = np.convolve(A, (1, a, b))
        root = np.sqrt(complex(a * a / 4 - b))
        poles += [-a / 2 + root, -a / 2 - root]
    if n % 2:
        A = np.convolve(A, (1, np.exp(x[n - 1])))
        poles.append(-np.exp(x[n - 1]))
    return A, np.array(poles)


def regressors(x, u, Ts, n, m, delayed, free_start):
    """Columns whose best linear combination is the simulated output."""
    A, poles = poles_of(x, n)
    filters = twin.DerivativeFilters(A, poles, Ts)
    if delayed:
        # The states at t - delay follow from those at the sample before: x(t + g) = exp(F g) x(t) + ramp up to g.
        whole = int(np.ceil(x[n] / Ts))
        part = whole * Ts - x[n]
        states = np.array(list(filters.zoh(u, n)))
        between = np.zeros((n + 1, n + 1))
        between[0, :n] = -A[1:]
        between[np.arange(1, n), np.arange(n - 1)] = 1
        between[0, n] = 1
        sampled = twin.matrix_exponential(between * part)
        states = sampled[:n, :n] @ states + np.outer(sampled[:n, n], u)
        rows = np.zeros((m + 1, len(u)))
        rows[:, whole:] = states[n - m - 1 :, : len(u) - whole]
    else:
        rows = np.array(list(filters.zoh(u, m + 1)))
    if free_start:
        # Every solution of the homogeneous difference equation follows from n pulses.
        pulse = np.zeros(len(u))
        pulse[0] = 1
        answer = lfilter((1.0,), filters.denominator, pulse)
        rows = np.vstack([rows] + [np.concatenate((np.zeros(j), answer[: len(u) - j])) for j in range(n)])
    return rows


class Search:
    def __init__(self, u, y, Ts, n, m, delayed, free_start):
        self.u, self.y, self.Ts, self.n, self.m = u, y, Ts, n, m
        self.delayed, self.free_start = delayed, free_start

    def residual(self, x):
        rows = regressors(x, self.u, self.Ts, self.n, self.m, self.delayed, self.free_start)
        sizes = np.sqrt((rows**2).sum(axis=1))
        if not np.isfinite(sizes).all():
            return 1e3 * self.y
        rows = rows / np.where(sizes > 0, sizes, 1)[:, None]
        values, vectors = np.linalg.eigh(rows @ rows.T)
        if values[0] > 1e-9 * values[-1]:  # quick where it is accurate
            weights = vectors @ ((vectors.T @ (rows @ self.y)) / values)
        else:
            weights = np.linalg.lstsq(rows.T, self.y, rcond=None)[0]
        return self.y - weights @ rows

    def random_start(self, generator):
        """Natural frequencies from once in the record to the fastest that samples show, damping 0.02 to 3."""
        slowest, fastest = 0.5 / (self.Ts * len(self.u)), 3 / self.Ts
        x = []
        for _ in range(self.n // 2):
            w = slowest * (fastest / slowest) ** generator.random()
            x += [np.log(2 * w * 0.02 * 150 ** generator.random()), 2 * np.log(w)]
        if self.n % 2:
            x.append(np.log(slowest * (fastest / slowest) ** generator.random()))
        if self.delayed:
            x.append(generator.random() * min(LONGEST_DELAY, len(self.u) // 4) * self.Ts)
        return np.array(x)

    def refined(self, x, steps):
        low = np.log(1e-4 / (self.Ts * len(self.u)))
        high = np.log(30 / self.Ts)
        lower, upper = [], []
        for k in range(self.n):
            quadratic_end = k % 2 == 1
            lower.append(2 * low if quadratic_end else low)
            upper.append(2 * high if quadratic_end else high)
        if self.delayed:
            lower.append(0)
            upper.append(len(self.u) // 4 * self.Ts)
        x = np.clip(x, np.array(lower) + 1e-9, np.array(upper) - 1e-9)
        return least_squares(self.residual, x, bounds=(lower, upper), max_nfev=steps, x_scale="jac", xtol=1e-10, ftol=1e-10)

    def swings_beyond_samples(self, x):
        """Poles above half the sampling frequency fit by what the samples do not show."""
        return bool((np.abs(poles_of(x, self.n)[1].imag) > np.pi / self.Ts).any())

    def best_fit(self, generator):
        rough = [self.refined(self.random_start(generator), FIRST_STEPS) for _ in range(STARTS)]
        rough.sort(key=lambda found: found.cost)
        ends = [self.refined(found.x, LAST_STEPS) for found in rough[:POLISHED]]
        cost = min((end.cost for end in ends if not self.swings_beyond_samples(end.x)), default=np.inf)
        return 100 * (1 - np.sqrt(2 * cost) / np.linalg.norm(self.y - self.y.mean()))


def table(file):
    with open(file, newline="") as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def main():
    warnings.simplefilter("ignore")
    dynlab, wanted = sys.argv[1], set(sys.argv[2:])
    scripts = Path(__file__).resolve().parents[1]
    tried = short = higher = 0
    with tempfile.TemporaryDirectory() as folder:
        for script in ("further_orders.lua", "measured_records.lua"):  # it saves its files beside itself
            shutil.copy(scripts / script, folder)
        subprocess.run((dynlab, "run", f"{folder}/further_orders.lua"), check=True, stdout=subprocess.DEVNULL)
        rows = table(Path(folder) / "fits.csv")
        for number in dict.fromkeys(row["record"] for row in rows):
            cases = [row for row in rows if row["record"] == number]
            name = cases[0]["name"]
            if wanted and name not in wanted:
                continue
            record = table(Path(folder) / f"{number}.csv")
            u, y = (np.array([float(row[column]) for row in record]) for column in "uy")
            record_short = 0
            for k, case in enumerate(cases):
                n, m, delayed, free_start = int(case["poles"]), int(case["zeros"]), case["delay"] != "0", case["start"] != "zero"
                generator = np.random.default_rng((int(number), k))
                best = Search(u, y, float(case["Ts"]), n, m, delayed, free_start).best_fit(generator)
                fit = float(case["fit_percent"])
                higher += fit > best + SHORT
                if fit < best - SHORT:
                    record_short += 1
                    options = (", a delay" if delayed else "") + (", free start" if free_start else "")
                    print(f"{name}: {n} poles, {m} zeros{options}: {fit:.2f} %, here {best:.2f} %", flush=True)
            tried += len(cases)
            short += record_short
            print(f"{name}: {record_short} of {len(cases)} short", flush=True)
    print(f"{short} of {tried} structures short of the optimum found here by more than {SHORT} points; "
          f"{higher} above it by more than that")


if __name__ == "__main__":
    main()
