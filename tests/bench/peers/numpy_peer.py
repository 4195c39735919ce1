"""Times one method in numpy: numpy_peer.py JOB DATA REPETITIONS

JOB is lsim, lssvf, lssvf_lstsq, ivsvf, srivc, monte_carlo or grey_box. DATA holds N inputs and then N outputs as 8-byte
floats, sampled every 0.01 s from a system with two poles and no zero; for monte_carlo the outputs are free of noise. For
grey_box they are the crane's estimation record, the voltage twice, then position and angle (grey_box.py). First the
estimates of a small record are compared with tests/reference/data. Prints lines of a name and its values, tabs between:
difference (largest relative one from the reference), theta, seconds (median).
"""

import csv
import statistics
import sys
import time
from pathlib import Path

import numpy as np

import grey_box
import identification as twin

SAMPLING_TIME = 0.01
POLES, ZEROS = 2, 0
CUTOFF = 3
NOISE, RUNS = 0.2, 200
ORDERS = (POLES, ZEROS, SAMPLING_TIME)
REFERENCE = Path(__file__).resolve().parents[2] / "reference" / "data"


def difference_from_reference():
    expected = {}
    with open(REFERENCE / "reference_8digits.csv", newline="") as file:
        for row in csv.DictReader(file):
            expected.setdefault((row["dataset"], row["estimator"]), []).append(float(row["python"]))
    largest = 0
    for dataset in ("sys2_noisefree", "sys2_s0.2_seed1"):
        _, u, y = np.loadtxt(REFERENCE / f"{dataset}.csv", delimiter=",", skiprows=1, unpack=True)
        estimates = {
            "lssvf_yfoh": (twin.lssvf(u, y, *ORDERS, 2), twin.lssvf_lstsq(u, y, *ORDERS, 2)),
            "ivsvf_yfoh": (twin.ivsvf(u, y, *ORDERS, 2),),
            "srivc_yfoh_ivexact": (twin.srivc(u, y, *ORDERS, 2, tolerance=1e-10)[0],),
        }
        for estimator, found in estimates.items():
            for theta in found:
                largest = max(largest, np.abs(theta / expected[dataset, estimator] - 1).max())
    system = (np.array([2.0]), np.array([1.0, 4.0, 3.0]), np.array([-1.0, -3.0]))
    _, u, y = np.loadtxt(REFERENCE / "sys2_noisefree.csv", delimiter=",", skiprows=1, unpack=True)
    return max(largest, np.abs(twin.simulate(*system, u, SAMPLING_TIME) - y).max())


def job(name, u, y):
    """What is timed; it returns the estimate, or the last output of a simulation."""
    if name == "lsim":
        system = (np.array([2.0]), np.array([1.0, 4.0, 3.0]), np.array([-1.0, -3.0]))
        return lambda: twin.simulate(*system, u, SAMPLING_TIME)[-1:]
    if name == "grey_box":
        return lambda: grey_box.fit(np.split(u, 2)[0], np.column_stack(np.split(y, 2)), 0.02)
    if name == "srivc":
        return lambda: twin.srivc(u, y, *ORDERS, CUTOFF)[0]
    if name == "monte_carlo":
        generator = np.random.Generator(np.random.SFC64(1))  # numpy's quickest source of normal numbers
        return lambda: twin.monte_carlo(u, y, NOISE, RUNS, *ORDERS, CUTOFF, generator).mean(axis=1).ravel()
    method = {"lssvf": twin.lssvf, "lssvf_lstsq": twin.lssvf_lstsq, "ivsvf": twin.ivsvf}[name]
    return lambda: method(u, y, *ORDERS, CUTOFF)


def seconds(work):
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def main(name, data, repetitions):
    difference = difference_from_reference()
    print(f"difference\t{difference:.3g}")
    if not difference < 1e-7:
        sys.exit("numpy_peer.py: the estimates are not those of the reference data, so its times would mean nothing.")
    u, y = np.fromfile(data).reshape(2, -1)
    work = job(name, u, y)
    print("theta", *(repr(float(value)) for value in work()), sep="\t")
    print(f"seconds\t{statistics.median(seconds(work) for _ in range(int(repetitions))):.9g}")


if __name__ == "__main__":
    main(*sys.argv[1:])
