"""Writes learning_record.csv and learning_twins.csv: a record, and what numpy makes of it by the definitions.

narx: forward selection on the stored matrix of all candidates, by modified Gram and Schmidt; dmdc: the singular value
decompositions of the stored snapshots.
"""
import itertools
import sys

import numpy as np

N = 400
rng = np.random.RandomState(1)


def record():
    u = np.repeat(rng.uniform(-1, 1, N // 4), 4)
    e = 0.05 * rng.normal(size=(N, 2))
    y = np.zeros((N, 2))
    for k in range(2, N):
        y[k, 0] = (0.6 * y[k - 1, 0] - 0.2 * y[k - 2, 0] + 0.5 * u[k - 1] + 0.3 * y[k - 1, 0] * u[k - 1]
                   - 0.2 * u[k - 2] ** 2 + e[k, 0])
        y[k, 1] = 0.8 * y[k - 1, 1] + 0.1 * y[k - 1, 0] + 0.2 * u[k - 1] + e[k, 1]
    return u, y


def monomials(names, degree):
    """Lists of the variables of each product, by degree."""
    return [c for d in range(degree + 1) for c in itertools.combinations_with_replacement(range(len(names)), d)]


def narx(u, y, na, nb, nk, degree, terms):
    first = max(na, nk + nb - 1)
    past = np.array([[y[k - i] for i in range(1, na + 1)] + [u[k - nk - i] for i in range(nb)]
                     for k in range(first, len(y))])
    products = monomials(range(na + nb), degree)
    P = np.array([[np.prod(row[list(c)]) if c else 1.0 for c in products] for row in past])
    target = y[first:]
    W, rest, chosen, reduction, bic = P.copy(), target.copy(), [], [], []
    rows = len(target)
    for _ in range(terms if terms else len(products)):
        gains = np.full(len(products), -1.0)
        for j in range(len(products)):
            own = W[:, j] @ W[:, j]
            if j not in chosen and own > 1e-12 * (P[:, j] @ P[:, j]):
                gains[j] = (W[:, j] @ rest) ** 2 / own
        best = int(np.argmax(gains))
        if gains[best] <= 0:
            break
        q = W[:, best] / np.linalg.norm(W[:, best])
        for j in range(len(products)):
            if j != best:
                W[:, j] -= q * (q @ W[:, j])
        rest = rest - q * (q @ rest)
        chosen.append(best)
        reduction.append(gains[best] / (target @ target))
        bic.append(np.log(rest @ rest / rows) + len(chosen) * np.log(rows) / rows)
    if not terms:
        chosen = chosen[:int(np.argmin(bic)) + 1]
    theta = np.linalg.lstsq(P[:, chosen], target, rcond=None)[0]
    errors = target - P[:, chosen] @ theta
    covariance = errors @ errors / (rows - len(chosen)) * np.linalg.inv(P[:, chosen].T @ P[:, chosen])
    free = y.copy()
    for k in range(first, len(y)):
        z = np.array([free[k - i] for i in range(1, na + 1)] + [u[k - nk - i] for i in range(nb)])
        free[k] = sum(t * np.prod(z[list(products[c])]) for t, c in zip(theta, chosen))
    return chosen, theta, np.sqrt(np.diag(covariance)), reduction, free


def dmdc(u, y, rank, delays):
    sy, su = np.sqrt(np.mean(y ** 2, axis=0)), np.sqrt(np.mean(u ** 2))
    y, u = y / sy, u / su
    z = np.array([np.concatenate([y[k - i] for i in range(delays)] + [[u[k - i]] for i in range(1, delays)])
                  for k in range(delays - 1, len(y))]).T
    now, nxt = z[:, :-1], z[:, 1:]
    omega = np.vstack([now, u[delays - 1:-1][None, :]])
    U, s, Vt = np.linalg.svd(omega, full_matrices=False)
    p = rank + 1
    U2 = np.linalg.svd(nxt, full_matrices=False)[0][:, :rank]
    G = U2.T @ nxt @ Vt[:p].T @ np.diag(1 / s[:p]) @ U[:, :p].T
    A, B, C = G[:, :-1] @ U2, G[:, -1:] / su, np.diag(sy) @ U2[:y.shape[1]]
    markov, x = [], B
    for _ in range(10):
        markov += list((C @ x).ravel())
        x = A @ x
    return np.sort_complex(np.linalg.eigvals(A)), markov


def main(folder):
    u, y = record()
    with open(folder + "/learning_record.csv", "w") as out:
        out.write("u,y1,y2\n")
        out.writelines("%.17g,%.17g,%.17g\n" % (a, b, c) for a, (b, c) in zip(u, y))
    values = []
    for label, terms in (("narx6", 6), ("narxbic", 0)):
        chosen, theta, std, reduction, free = narx(u, y[:, 0], 2, 2, 1, 2, terms)
        for name, column in (("term", chosen), ("theta", theta), ("std", std), ("reduction", reduction[:len(chosen)]),
                             ("free", free[-20:])):
            values += [(label + "_" + name, x) for x in column]
    for label, rank, delays in (("dmdc1", 2, 1), ("dmdc3", 4, 3)):
        eigenvalues, markov = dmdc(u, y, rank, delays)
        values += [(label + "_real", x.real) for x in eigenvalues] + [(label + "_imag", x.imag) for x in eigenvalues]
        values += [(label + "_markov", x) for x in markov]
    with open(folder + "/learning_twins.csv", "w") as out:
        out.write("name,value\n")
        out.writelines("%s,%.17g\n" % pair for pair in values)


main(sys.argv[1] if len(sys.argv) > 1 else ".")
