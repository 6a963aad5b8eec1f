#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How far bounds of the largest frequency that go cell by cell lie above it, for the forces of nodal.

    bench/nodal_step_bound.py [--side 6]     # half a minute; needs numpy

Isotropic elasticity at rest, the energy of docs/theory/nodal.md, section 2, with the gradients of the fits of section
3.2 in place of facet fluxes.
Clouds: a lattice and jittered ones in a box whose opposite sides are one (period), and a free block, whose masses are
those of its cells. The bound: with a share theta_ab of the mass of b for every cell a that sees it, sum_a theta_ab = 1,
    omega^2 <= max_a (largest eigenvalue of the cell's own stiffness over its shares of mass)
(Irons and Treharne 1971), here with theta_ab in proportion to a power of what the cell adds to the diagonal at b.
"moduli apart": the largest eigenvalue of |grad u|^2 at the points times the largest modulus there, and that of the
square of the mean divergence times the bulk modulus: what could be made once and multiplied by the moduli of the moment.
"rows": Gershgorin's bound by the rows of the assembled matrix.
"""
import argparse
import itertools

import numpy as np

REACH = 2.4
T = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], float)
VOIGT = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]


def monomials(r):
    x, y, z = r.T
    return np.stack([x, y, z, x * x / 2, y * y / 2, z * z / 2, y * z, x * z, x * y], axis=1)


def nearest_image(r, side, periodic):
    return r - side * np.round(r / side) if periodic else r


def cells(X, side, periodic, fine=6):
    """Volumes, centroids and central second moments, from samples a sixth of a spacing apart."""
    low, high = (0, side) if periodic else (0, side - 1)
    count = int(round((high - low) * fine))
    line = low + (np.arange(count) + 0.5) / fine
    V, first, second = np.zeros(len(X)), np.zeros((len(X), 3)), np.zeros((len(X), 3, 3))
    v = fine**-3.0
    for x in line:
        points = np.array([(x, y, z) for y in line for z in line])
        r = nearest_image(points[:, None, :] - X[None, :, :], side, periodic)
        owner = np.argmin((r**2).sum(2), axis=1)
        r = r[np.arange(len(points)), owner]
        np.add.at(V, owner, v)
        np.add.at(first, owner, v * r)
        np.add.at(second, owner, v * r[:, :, None] * r[:, None, :])
    c = first / V[:, None]
    M = second / V[:, None, None] - c[:, :, None] * c[:, None, :] + np.eye(3) * fine**-2.0 / 12
    return V, c, M


def gradients(X, c, M, a, side, periodic):
    """Particles near a, and the gradient at the four points of its cell by their values: [point, particle, 3]."""
    r = nearest_image(X - X[a], side, periodic)
    d = np.sqrt((r**2).sum(1))
    near = np.nonzero((d > 0) & (d < REACH * (1 - 1e-9)))[0]
    s = (1 - (d[near] / REACH) ** 2) ** 2 / d[near] ** 3
    p = monomials(r[near])
    e = np.linalg.solve((p * s[:, None]).T @ p, (p * s[:, None]).T)
    second = np.zeros((3, 3, len(near)))
    for n, (i, j) in enumerate(VOIGT):
        second[i, j] = second[j, i] = e[3 + n]
    z = c[a] + T @ np.linalg.cholesky(M[a]).T
    at = e[None, :3] + np.einsum("JKb,qK->qJb", second, z)
    G = np.zeros((4, len(near) + 1, 3))
    G[:, :-1] = at.transpose(0, 2, 1)
    G[:, -1] = -G[:, :-1].sum(1)
    return np.append(near, a), G


def strains(G, kappa, mu):
    """Rows whose squares add up to twice the energy of the cell per volume, by the displacements of its particles."""
    points, particles, _ = G.shape
    grad = np.zeros((points, 3, 3, particles, 3))
    for i in range(3):
        grad[:, i, :, :, i] = G.transpose(0, 2, 1)
    grad = grad.reshape(points, 3, 3, -1)
    e = 0.5 * (grad + grad.transpose(0, 2, 1, 3))
    tr = np.einsum("qiim->qm", e)
    dev = e - np.eye(3)[None, :, :, None] * tr[:, None, None, :] / 3
    mean = tr.mean(0)
    local = min(kappa, mu)
    return np.concatenate(
        [
            np.sqrt(2 * mu / points) * dev.reshape(points * 9, -1),
            np.sqrt(local / points) * (tr - mean),
            np.sqrt(kappa) * mean[None],
        ]
    )


def largest(B):
    """Eigenvalue of B B^T."""
    return np.linalg.eigvalsh(B @ B.T)[-1]


def factors(G):
    """The same for |grad u|^2 at the points and for the square of the mean divergence, without moduli."""
    points, particles, _ = G.shape
    grad = np.zeros((points, 3, 3, particles, 3))
    for i in range(3):
        grad[:, i, :, :, i] = G.transpose(0, 2, 1)
    grad = grad.reshape(points, 3, 3, -1)
    return grad.reshape(points * 9, -1) / np.sqrt(points), np.einsum("qiim->qm", grad).mean(0)[None]


def measure(X, side, periodic, nu):
    mu, kappa = 1 / (2 * (1 + nu)), 1 / (3 * (1 - 2 * nu))
    V, c, M = cells(X, side, periodic)
    mass = V
    K = np.zeros((3 * len(X), 3 * len(X)))
    of_cell = []
    for a in range(len(X)):
        near, G = gradients(X, c, M, a, side, periodic)
        B = np.sqrt(V[a]) * strains(G, kappa, mu)
        dofs = (3 * near[:, None] + np.arange(3)).ravel()
        K[np.ix_(dofs, dofs)] += B.T @ B
        own = (B**2).sum(0).reshape(-1, 3).sum(1)
        of_cell.append((near, B, own, [np.sqrt(V[a]) * f for f in factors(G)]))
    root = np.sqrt(np.repeat(mass, 3))
    scaled = K / root[:, None] / root[None, :]
    true = np.linalg.eigvalsh(scaled)[-1]
    bounds = {"rows": np.abs(K).sum(1) / np.repeat(mass, 3)}
    for power in (0.5, 1.0):
        total = np.zeros(len(X))
        for near, _, own, _ in of_cell:
            total[near] += own**power
        worst, apart = [], []
        for near, B, own, (grad, mean) in of_cell:
            root_of_share = np.sqrt(np.repeat(mass[near] * own**power / total[near], 3))
            worst.append(largest(B / root_of_share))
            at_points = max(2 * mu, 3 * min(kappa, mu)) * largest(grad / root_of_share)
            apart.append(at_points + kappa * largest(mean / root_of_share))
        bounds[f"cells, power {power}"] = np.array(worst)
        bounds[f"moduli apart, power {power}"] = np.array(apart)
    speed = np.sqrt(kappa + 4 * mu / 3)
    return np.sqrt(true) / speed, {k: np.sqrt(v.max() / true) for k, v in bounds.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--side", type=int, default=6)
    side = parser.parse_args().side
    lattice = np.array(list(itertools.product(range(side), repeat=3)), float)
    random = np.random.default_rng(1)
    clouds = (("lattice", 0, True), ("jitter 0.2", 0.2, True), ("jitter 0.4", 0.4, True), ("free block", 0, False))
    for name, jitter, periodic in clouds:
        X = lattice + 0.5 * periodic + jitter * random.uniform(-1, 1, lattice.shape) / 2
        for nu in (0.3, 0.45, 0.499):
            omega, ratio = measure(X, side, periodic, nu)
            bounds = ", ".join(f"{k} {v:.2f}" for k, v in ratio.items())
            print(f"{name:12} nu {nu:5}  omega h / c_p {omega:.2f}  bound / omega: {bounds}", flush=True)


if __name__ == "__main__":
    main()
