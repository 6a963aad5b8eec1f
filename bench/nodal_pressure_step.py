#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sub-steps or an implicit rule for the pressure alone, near Poisson's ratio 0.5, in the scheme of nodal.

    bench/nodal_pressure_step.py frequencies [--across 4]         # largest frequencies of both parts of the force
    bench/nodal_pressure_step.py substeps                         # stability of linear steps
    bench/nodal_pressure_step.py bend [--across 4] [--end 0.5]    # cases/nodal/bending_column at nu = 0.499

Needs numpy; some minutes with OpenBLAS. Gradients, cells, masses and energy are those of docs/theory/nodal.md
for a box on a lattice: facet fluxes, four points per cell, neo-Hookean. Matrices are dense, so that seconds of this
script say nothing. It counts steps and iterations.

The force has a slow part, isochoric and logarithm, and a fast part, from kappa/2 (J - 1)^2 with the mean volume ratio
J of a cell. A step is half a kick by the slow force, motion by the fast force alone, and half a kick.
substeps: a column of 6 spacings at rest. Steps are reversible and symplectic, so that (l + 1/l)/2 of the eigenvalues l
are those of the block of positions: stable if real and within [-1, 1]. "averaged" takes the slow energy at positions
averaged over dt of fast motion to both sides (mollified impulse, Garcia-Archilla, Sanz-Serna and Skeel 1999).
bend: the fast motion follows the midpoint rule (theta = 1/2) or backward Euler (1). Pressures times volumes y obey
    (1/(kappa V) + (theta dt)^2 D M^-1 D^T) y = J - 1 + D (x + theta dt v - x^),   D = dJ/dx,
linearised at x^. Conjugate gradients start from extrapolated y. The tolerance is a fraction of the right side.
"""
import argparse

import numpy as np

from nodal_step_bound import REACH, VOIGT
from nodal_step_bound import T as CORNERS

EXPONENTS = np.array(
    [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (2, 0, 0), (0, 2, 0), (0, 0, 2), (0, 1, 1), (1, 0, 1), (1, 1, 0)])
FACTORS = np.where((EXPONENTS == 2).any(1), 0.5, 1.0)


def monomials(r):
    return FACTORS * np.prod(r[:, None, :] ** EXPONENTS, axis=2)


def fit(p, weights):
    """Coefficients of the weighted least-squares fit with the monomials p, by the values."""
    return np.linalg.solve((p * weights[:, None]).T @ p, (p * weights[:, None]).T)


def face_integrals(low, high, axis, place):
    """Integrals of the monomials over the face of a block at `place` along `axis`."""
    powers = np.arange(3)
    line = [(high[i] ** (powers + 1) - low[i] ** (powers + 1)) / (powers + 1) for i in range(3)]
    line[axis] = place**powers
    return FACTORS * np.prod([line[i][EXPONENTS[:, i]] for i in range(3)], axis=0)


def line_masses(count):
    m = np.ones(count)
    for k, change in enumerate((-5 / 8, 1 / 6, -1 / 24)):
        m[k] += change
        m[-1 - k] += change
    return m


class Column:
    """A box on a lattice, held at Y = 0, with spacing, density and shear modulus one."""

    def __init__(self, across, spacings, nu):
        counts = (across, spacings + 1, across)
        self.place = np.array(list(np.ndindex(counts)))
        self.X = self.place.astype(float)
        self.low = np.maximum(self.X - 0.5, 0)
        self.high = np.minimum(self.X + 0.5, np.array(counts) - 1.0)
        self.V = np.prod(self.high - self.low, axis=1)
        self.mass = np.prod([line_masses(c)[self.place[:, i]] for i, c in enumerate(counts)], axis=0)
        self.free = self.place[:, 1] > 0
        self.nu, self.mu, self.kappa = nu, 1.0, 2 * (1 + nu) / (3 * (1 - 2 * nu))
        self.local = min(self.mu, self.kappa)
        self.B = self.gradients()  # [9, cell, particle]: the mean gradient, then second derivatives
        self.by_cell = np.ascontiguousarray(self.B.transpose(1, 2, 0))
        # F_q = g T_q for the nine sums g of a cell.
        z = CORNERS[:, None] * (self.high - self.low) / np.sqrt(12) * np.where(self.place.sum(1) % 2, -1, 1)[:, None]
        self.T = np.zeros((4, len(self.X), 9, 3))
        self.T[:, :, :3] = np.eye(3)
        for k, (i, j) in enumerate(VOIGT):
            self.T[:, :, 3 + k, i] = z[:, :, j]
            self.T[:, :, 3 + k, j] = z[:, :, i]

    def gradients(self):
        X, low, high, n = self.X, self.low, self.high, len(self.X)
        index = {tuple(p): a for a, p in enumerate(self.place)}
        apart = np.sqrt(((X[:, None] - X) ** 2).sum(2))
        sees = apart < REACH - 1e-9
        inside = 1 - (apart / REACH) ** 2
        B = np.zeros((9, n, n))
        for a in range(n):
            near = np.nonzero(sees[a] & (apart[a] > 0))[0]
            e = fit(monomials(X[near] - X[a])[:, 1:], inside[a, near] ** 2 / apart[a, near] ** 3)
            B[3:, a, near], B[3:, a, a] = e[3:], -e[3:].sum(1)
            for axis, side in [(axis, side) for axis in range(3) for side in (-1, 1)]:
                b = index.get(tuple(self.place[a] + side * np.eye(3, dtype=int)[axis]))
                if b is None:
                    edge = (high if side > 0 else low)[a, axis] - X[a, axis]
                    of_face = side * face_integrals(low[a] - X[a], high[a] - X[a], axis, edge)
                    B[axis, a, near] += of_face[1:] @ e
                    B[axis, a, a] += of_face[0] - (of_face[1:] @ e).sum()
                elif side > 0:
                    common, middle = np.nonzero(sees[a] & sees[b])[0], (X[a] + X[b]) / 2
                    r = X[common] - middle
                    weights = inside[a, common] * inside[b, common] / ((r**2).sum(1) + 0.05)
                    flux = face_integrals(low[a] - middle, high[a] - middle, axis, 0.0) @ fit(monomials(r), weights)
                    B[axis, a, common] += flux
                    B[axis, b, common] -= flux
        B[:3] /= self.V[None, :, None]
        return B

    def points(self, x):
        """F, its cofactor and determinant at the four points of the cells."""
        sums = (self.B.reshape(-1, len(x)) @ x).reshape(9, len(x), 3).transpose(1, 2, 0)
        F = sums @ self.T
        cof = np.stack([np.cross(F[..., (J + 1) % 3], F[..., (J + 2) % 3]) for J in range(3)], axis=-1)
        return F, cof, (F[..., 0] * cof[..., 0]).sum(-1)

    def force(self, P):
        R = (self.V[None, :, None, None] / 4 * P @ self.T.transpose(0, 1, 3, 2)).sum(0)
        return -(self.B.reshape(-1, len(R)).T @ R.transpose(2, 0, 1).reshape(-1, 3)) * self.free[:, None]

    def evaluate(self, x, fast):
        """Force, with the fast part or without, energy, J, and the cofactors."""
        F, cof, J = self.points(x)
        mean, square, scale = J.mean(0), (F * F).sum((2, 3)), self.mu * J ** (-2 / 3)
        of_cof = -scale * square / (3 * J) + self.local * (1 / mean - 1 / J) + fast * self.kappa * (mean - 1)
        energy = ((scale * square - 3 * self.mu) / 2 + self.local * np.log(mean / J)).mean(0)
        energy = (self.V * (energy + self.kappa / 2 * (mean - 1) ** 2)).sum()
        return self.force(scale[..., None, None] * F + of_cof[..., None, None] * cof), energy, mean, cof

    def derivative(self, cof):
        """dJ/dx by the free positions."""
        by_sums = (cof @ self.T.transpose(0, 1, 3, 2)).mean(0)
        return ((self.by_cell @ by_sums.transpose(0, 2, 1)) * self.free[None, :, None]).reshape(len(cof[0]), -1)

    def stiffness(self):
        """Slow and fast part at rest, over the masses, for free directions."""
        n = len(self.X)
        slow = np.zeros((n, 3, n, 3))
        grad = np.einsum("qakJ,kab->qabJ", self.T, self.B)
        mean = grad.mean(0)
        for g in grad:
            for i, j in np.ndindex(3, 3):
                slow[:, i, :, j] += self.mu / 4 * (self.V * g[..., j].T) @ g[..., i]
                slow[:, i, :, j] -= self.mu / 6 * (self.V * g[..., i].T) @ g[..., j]
                slow[:, i, :, i] += self.mu / 4 * (self.V * g[..., j].T) @ g[..., j]
            apart = (g - mean).reshape(n, -1)
            slow += (self.local / 4 * (self.V * apart.T) @ apart).reshape(slow.shape)
        mean = mean.reshape(n, -1)
        keep = np.repeat(self.free, 3)
        root = np.sqrt(np.repeat(self.mass, 3)[keep])
        parts = slow.reshape(3 * n, -1), self.kappa * (self.V * mean.T) @ mean
        return [K[np.ix_(keep, keep)] / root[:, None] / root for K in parts]


def largest(K):
    return np.sqrt(np.linalg.eigvalsh(K)[-1])


def frequencies(across):
    for nu in (0.45, 0.49, 0.499, 0.4999):
        slow, fast = Column(across, 6 * (across - 1), nu).stiffness()
        both, s, f = largest(slow + fast), largest(slow), largest(fast)
        print(f"nu {nu}: largest omega h / c_s {both:.2f}, of the fast part {f:.2f}, of the slow part {s:.2f}, ratio "
              f"{both / s:.1f}", flush=True)


def growth(dt, w, slow, scheme):
    """Largest |eigenvalue| of a step; scheme: a number of Verlet sub-steps, exact, averaged or implicit."""
    c, s, mean = np.cos(w * dt), dt * np.sinc(w * dt / np.pi), 1
    if scheme == "implicit":
        c, s = (1 - (w * dt / 2) ** 2) / (1 + (w * dt / 2) ** 2), dt / (1 + (w * dt / 2) ** 2)
    elif scheme == "averaged":
        mean = np.sinc(w * dt / np.pi)
    elif scheme != "exact":
        h = dt / scheme
        angle = np.arccos(1 - (h * w) ** 2 / 2)
        c, s = np.cos(scheme * angle), np.where(w > 1e-6, np.sin(scheme * angle) * h / np.sin(angle + 1e-99), dt)
    half = np.linalg.eigvals(np.diag(c) - (s * mean)[:, None] * dt / 2 * slow * mean).astype(complex)
    root = np.sqrt(half**2 - 1)
    return max(abs(half + root).max(), abs(half - root).max())


def substeps():
    slow, fast = Column(4, 6, 0.499).stiffness()
    limit, ratio = 2 / largest(slow + fast), largest(slow + fast) / largest(slow)
    w2, modes = np.linalg.eigh(fast)
    w, slow = np.sqrt(np.maximum(w2, 0)), modes.T @ slow @ modes
    steps = np.concatenate([np.arange(1, 4, 0.02), np.arange(4, ratio - 0.2, 0.25)])
    print(f"steps over the limit of one step for both parts, 2/omega; the slow part alone allows {ratio:.1f}")
    for scheme in (2, 4, 8, 16, "exact", "averaged", "implicit"):
        at = steps if isinstance(scheme, str) else steps[steps < 0.999 * scheme]  # where sub-steps are stable
        g = np.array([growth(step * limit, w, slow, scheme) for step in at])
        bad = g > 1 + 1e-4
        first = f"{at[bad][0]:.2f}" if bad.any() else "none"
        print(f"{scheme}: first unstable step {first}, unstable {bad.mean():.0%} of {len(at)}, growth per step "
              f"to 4: {g[at <= 4].max():.4f}, to {at[-1]:.1f}: {g.max():.4f}", flush=True)


def conjugate_gradients(apply, precondition, b, y, tolerance):
    r = b - apply(y)
    z = precondition(r)
    p, rz, count = z, r @ z, 0
    aim = tolerance**2 * (b @ precondition(b))
    while rz > aim and count < 500:
        q = apply(p)
        step = rz / (p @ q)
        y, r, count = y + step * p, r - step * q, count + 1
        z = precondition(r)
        p, rz = z + (r @ z) / rz * p, r @ z
    return y, count


def implicit_motion(column, x, v, dt, start, history, settings):
    """Motion by the fast force, linearised at a predicted place `passes` times, or at the start. frozen: the
    preconditioner is the inverse of the matrix at rest, not of its diagonal."""
    passes, theta = settings.get("passes", 1), settings.get("theta", 0.5)
    tau, free, of_mass = (theta * dt) ** 2, x + theta * dt * v, 1 / np.repeat(column.mass, 3)
    flexibility = 1 / (column.kappa * column.V)
    y, at, (J, cof) = 2 * history["y"] - history["before"], x, start
    for _ in range(max(passes, 1)):
        if passes:
            at = free + tau * history["acceleration"](y, history["D"])
            _, cof, J = column.points(at)
            J = J.mean(0)
        D = column.derivative(cof)
        if settings.get("frozen"):
            if "inverse" not in history:
                history["inverse"] = np.linalg.inv(np.diag(flexibility) + tau * D @ (of_mass[:, None] * D.T))
            precondition = history["inverse"].__matmul__
        else:
            precondition = (1 / (flexibility + tau * (D * D) @ of_mass)).__mul__
        y, count = conjugate_gradients(
            lambda u: flexibility * u + tau * (D @ (of_mass * (D.T @ u))), precondition,
            J - 1 + D @ (free - at).ravel(), y, settings.get("tolerance", 1e-4))
        history["iterations"] += count
        history["D"] = D
    history["before"], history["y"] = history["y"], y
    a = history["acceleration"](y, D)
    return x + dt * v + theta * dt * dt * a, v + dt * a


def bend(column, dt, end, settings):
    """Runs to `end`; returns counts, the first peak of the tip and the error of the energy."""
    explicit, x, v, mass = settings.get("explicit", False), column.X, np.zeros_like(column.X), column.mass[:, None]
    length = x[:, 1].max()
    v[:, 0] = 10 / np.sqrt(17e6 / (2 * (1 + column.nu) * 1100)) * x[:, 1] / length  # 10 m/s at the tip
    force, energy, J, cof = column.evaluate(x, explicit)
    first, curve, errors = energy + (mass * v * v).sum() / 2, [(0, 0)], []
    history = {"y": np.zeros(len(x)), "before": np.zeros(len(x)), "D": column.derivative(cof), "iterations": 0,
               "acceleration": lambda y, D: -(D.T @ y).reshape(x.shape) / mass}
    while curve[-1][0] < end:
        v = v + dt / 2 * force / mass
        x, v = (x + dt * v, v) if explicit else implicit_motion(column, x, v, dt, (J, cof), history, settings)
        force, energy, J, cof = column.evaluate(x, explicit)
        v = v + dt / 2 * force / mass
        errors.append((energy + (mass * v * v).sum() / 2) / first - 1)
        curve.append((curve[-1][0] + dt, (x - column.X)[column.X[:, 1] == length, 0].mean() / length * 6))
        if not abs(errors[-1]) < 0.5:
            return f"unstable after {len(errors)} steps"
    value = np.array(curve)[:, 1]
    k = int(value.argmax())
    peak = value[k] + (value[k + 1] - value[k - 1]) ** 2 / (8 * (2 * value[k] - value[k + 1] - value[k - 1]))
    return (f"{len(errors)} steps, peak {peak:.4f} m, energy error {max(map(abs, errors)):.1e}, at the end "
            f"{errors[-1]:.1e}, iterations per step {history['iterations'] / len(errors):.1f}")


def bends(across, end):
    column = Column(across, 6 * (across - 1), 0.499)
    slow, fast = column.stiffness()
    limit, slow_limit = 0.85 * 2 / largest(slow + fast), 0.85 * 2 / largest(slow)
    end *= np.sqrt(17e6 / (2 * (1 + column.nu) * 1100)) * (across - 1)
    print(f"{len(column.X)} particles; steps in parts of 0.85 of the limit of the slow part", flush=True)
    for part, settings in (
            (1, {}), (1, {"tolerance": 1e-6}), (1, {"tolerance": 1e-3}), (1, {"tolerance": 1e-2}), (1, {"passes": 0}),
            (1, {"passes": 2}), (1, {"frozen": True}), (1, {"theta": 1}), (0.5, {}), (0.25, {}),
            (limit / slow_limit, {"explicit": True})):
        print(f"{part:.3f} {settings}: {bend(column, part * slow_limit, end, settings)}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=("frequencies", "substeps", "bend"))
    parser.add_argument("--across", type=int, default=4, help="particles across, four or more")
    parser.add_argument("--end", type=float, default=0.5, help="end of the bend [s]; the first peak is at 0.46")
    args = parser.parse_args()
    {"frequencies": lambda: frequencies(args.across), "substeps": substeps,
     "bend": lambda: bends(args.across, args.end)}[args.what]()


if __name__ == "__main__":
    main()
