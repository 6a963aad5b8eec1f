#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Cook's membrane at large strain by finite elements, for the references in checks.toml.

    python3 cases/nodal/cooks_membrane/plane_strain.py [--elements 8 16 32 64] [--nu 0.4999]

Nine-node quadrilaterals with 3 x 3 points in plane strain and a volume ratio that is linear within each element (Q2P1, Simo,
Taylor and Pister, Comput. Meth. Appl. Mech. Eng. 51, 1985):
    W = mu/2 (J^(-2/3) (F:F + 1) - 3) + kappa/2 (theta - 1)^2, theta = J projected on 1, xi, eta over the element
Newton's method in ten steps of the load. Prints the vertical displacement of the loaded edge, mean and at the upper corner
[mm]. numpy alone.
"""
import argparse
import numpy as np

CORNERS = np.array([[0, 0], [48, 44], [48, 60], [0, 44]], float)  # mm
YOUNG, FORCE = 240.565, 100.0  # N/mm2; N per mm of thickness
GAUSS, WEIGHT = np.array([-np.sqrt(0.6), 0, np.sqrt(0.6)]), np.array([5, 8, 5]) / 9
MINOR = np.array([[0, 0, 0, 1], [0, 0, -1, 0], [0, -1, 0, 0], [1, 0, 0, 0]], float)  # second derivative of det F


def line(t):
    """Quadratic functions of the nodes -1, 0, 1 and their derivatives."""
    return np.array([t * (t - 1) / 2, 1 - t * t, t * (t + 1) / 2]), np.array([t - 0.5, -2 * t, t + 0.5])


def points():
    """(xi, eta), weight, the nine functions and their local derivatives at each point; node 3 i + j stands at (xi_i, eta_j)."""
    for a, wa in zip(GAUSS, WEIGHT):
        for b, wb in zip(GAUSS, WEIGHT):
            (f, df), (g, dg) = line(a), line(b)
            yield (a, b), wa * wb, np.outer(f, g).ravel(), np.stack([np.outer(df, g).ravel(), np.outer(f, dg).ravel()])


def grid(corners, across, along):
    """Nodes, column by column along the first side, and the nine nodes of each element."""
    s, t = np.meshgrid(np.linspace(0, 1, 2 * along + 1), np.linspace(0, 1, 2 * across + 1), indexing="ij")
    a, b, c, d = corners
    x = ((1 - s) * (1 - t))[..., None] * a + (s * (1 - t))[..., None] * b + (s * t)[..., None] * c + ((1 - s) * t)[..., None] * d
    rows = 2 * across + 1
    first = 2 * rows * np.arange(along)[:, None] + 2 * np.arange(across)
    node = (rows * np.arange(3)[:, None] + np.arange(3)).ravel()
    return x.reshape(-1, 2), first.reshape(-1, 1) + node


def solve(matrices, elements, right, free, across, along):
    """Solves K u = right for the free unknowns, K the sum of element matrices: elimination over columns of elements."""
    rows, dofs = 2 * across + 1, right.shape[0]
    block = 4 * rows
    count = -(-dofs // block)
    diagonal, upper = np.zeros((count, block, block)), np.zeros((count, block, block))
    unknown = (2 * elements[:, :, None] + np.arange(2)).reshape(len(elements), -1)
    hold = free[unknown]
    matrices = matrices * hold[:, :, None] * hold[:, None, :]
    home, place = unknown // block, unknown % block
    e, i, j = np.nonzero(np.ones(matrices.shape, bool))
    same, next_ = home[e, i] == home[e, j], home[e, i] + 1 == home[e, j]
    values = matrices[e, i, j]
    np.add.at(diagonal, (home[e, i][same], place[e, i][same], place[e, j][same]), values[same])
    np.add.at(upper, (home[e, i][next_], place[e, i][next_], place[e, j][next_]), values[next_])
    b = np.zeros(count * block)
    b[:dofs] = np.where(free, right, 0)
    b = b.reshape(count, block)
    held = np.ones(count * block, bool)
    held[:dofs] = ~free
    for k, mask in enumerate(held.reshape(count, block)):
        diagonal[k][mask, mask] = 1
    for k in range(1, count):
        factor = np.linalg.solve(diagonal[k - 1], np.column_stack([upper[k - 1], b[k - 1]]))
        diagonal[k] -= upper[k - 1].T @ factor[:, :-1]
        b[k] -= upper[k - 1].T @ factor[:, -1]
    for k in reversed(range(count)):
        b[k] = np.linalg.solve(diagonal[k], b[k] - (upper[k] @ b[k + 1] if k + 1 < count else 0))
    return b.ravel()[:dofs]


class Membrane:
    def __init__(self, n, nu):
        self.n = n
        self.mu, self.kappa = YOUNG / (2 * (1 + nu)), YOUNG / (3 * (1 - 2 * nu))
        self.x, self.elements = grid(CORNERS, n, n)
        self.at = []
        for place, weight, _, local in points():
            jacobian = np.einsum("ck,ekd->ecd", local, self.x[self.elements])
            self.at.append((np.array([1, *place]), weight * np.linalg.det(jacobian),
                            np.einsum("edc,ck->ekd", np.linalg.inv(jacobian), local)))
        self.mass = sum(w[:, None, None] * np.outer(p, p) for p, w, _ in self.at)

    def forces(self, u):
        """Internal forces of each element [node, direction] and their derivative."""
        m, ue = len(self.elements), u[self.elements]
        fields = []
        for p, w, by in self.at:
            F = np.eye(2) + np.einsum("eki,ekj->eij", ue, by)
            J = F[:, 0, 0] * F[:, 1, 1] - F[:, 0, 1] * F[:, 1, 0]
            H = (F.reshape(m, 4) @ MINOR).reshape(m, 2, 2)
            fields.append((F.reshape(m, 4), J, H.reshape(m, 4)))
        lack = sum(np.outer(w * (J - 1), p) for (p, w, _), (_, J, _) in zip(self.at, fields))
        pressure = self.kappa * np.linalg.solve(self.mass, lack[..., None])[..., 0]
        force, tangent, opening = np.zeros((m, 18)), np.zeros((m, 18, 18)), np.zeros((m, 3, 18))
        for (p, w, by), (F, J, H) in zip(self.at, fields):
            root, I1 = J ** (-2 / 3), np.einsum("ea,ea->e", F, F) + 1
            B = np.einsum("ekj,il->eijkl", by, np.eye(2)).reshape(m, 4, 18)  # dF = B du
            P = self.mu * root[:, None] * (F - (I1 / (3 * J))[:, None] * H) + (pressure @ p)[:, None] * H
            FH = np.einsum("ea,eb->eab", F, H)
            D = self.mu * root[:, None, None] * (
                np.eye(4) - 2 / (3 * J)[:, None, None] * (FH + FH.transpose(0, 2, 1))
                + (5 * I1 / (9 * J * J))[:, None, None] * np.einsum("ea,eb->eab", H, H)
                - (I1 / (3 * J))[:, None, None] * MINOR) + (pressure @ p)[:, None, None] * MINOR
            force += w[:, None] * np.einsum("ea,ead->ed", P, B)
            tangent += w[:, None, None] * np.einsum("eac,eab,ebd->ecd", B, D, B, optimize=True)
            opening += w[:, None, None] * np.einsum("s,ed->esd", p, np.einsum("ea,ead->ed", H, B))
        tangent += self.kappa * np.einsum("esc,esd->ecd", opening, np.linalg.solve(self.mass, opening), optimize=True)
        return force, tangent

    def deflection(self, steps=10):
        n = self.n
        rows = 2 * n + 1
        u, load = np.zeros_like(self.x), np.zeros_like(self.x)
        edge = load[-rows:, 1]
        for k in range(n):
            edge[2 * k:2 * k + 3] += FORCE / n * np.array([1, 4, 1]) / 6
        free = np.repeat(np.arange(len(self.x)) >= rows, 2)
        for step in range(1, steps + 1):
            for _ in range(30):
                force, tangent = self.forces(u)
                right = step / steps * load
                np.subtract.at(right, self.elements, force.reshape(len(force), 9, 2))
                residual = np.where(free, right.ravel(), 0)
                if np.linalg.norm(residual) < 1e-9 * FORCE:
                    break
                u += solve(tangent, self.elements, residual, free, n, n).reshape(-1, 2)
        return np.sum(load * u) / FORCE, u[-1, 1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--elements", type=int, nargs="+", default=[8, 16, 32], help="elements along each side")
    parser.add_argument("--nu", type=float, default=0.4999, help="Poisson's ratio")
    chosen = parser.parse_args()
    for n in chosen.elements:
        mean, corner = Membrane(n, chosen.nu).deflection()
        print(f"{n:3} x {n:<3} mean of the edge {mean:.5f} mm, upper corner {corner:.5f} mm", flush=True)


if __name__ == "__main__":
    main()
