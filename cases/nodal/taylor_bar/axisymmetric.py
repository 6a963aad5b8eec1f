#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Taylor bars by finite elements, for the references in checks.toml of all cases with a Taylor bar.

    python3 cases/nodal/taylor_bar/axisymmetric.py [--bar linear|ofhc|armco] [--across 8] [x,y,z ...]

Bars: `linear`, copper with linear hardening (227 m/s); `ofhc`, annealed copper by Johnson and Cook with the pressure of
Mie and Grueneisen (190 m/s); `armco`, Armco iron by the same laws (221 m/s). Axisymmetric quadrilaterals with 2 x 2 points and one pressure each (mean dilatation),
deviator by its Jaumann rate and radial return in the geometry of half time, lumped masses, central differences. The
wall holds the lowest nodes. Prints the radius of the foot where material was that came from each radius [mm], the
length [mm] and the largest plastic strain at the end; for each particle given by its coordinates at the start [mm],
z above the wall, where it is then: its x doubled is the width of a foot whose outermost particle it is. numpy alone;
20 s for 8 elements across the radius.
"""
import argparse
import numpy as np

CORNERS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])


class Linear:
    """Copper with linear hardening, elastic in volume."""
    radius, length, speed, end = 3.2e-3, 32.4e-3, 227.0, 80e-6
    rho, E, nu, start, hardening = 8930.0, 117e9, 0.35, 400e6, 100e6
    mu, kappa = E / (2 * (1 + nu)), E / (3 * (1 - 2 * nu))

    def plastic(self, mises, strain, heat, dt):
        """Increment of the plastic strain from the von Mises stress of the trial, strain so far, heat [J/m3], time."""
        return np.maximum(mises - self.start - self.hardening * strain, 0) / (3 * self.mu + self.hardening)

    def pressure(self, ratio, energy):
        """Pressure by volume over that at the start, and internal energy [J/m3 of the start]."""
        return self.kappa * (1 - ratio) / ratio


class JohnsonCook(Linear):
    """Annealed oxygen-free copper: Johnson and Cook, Mie and Grueneisen."""
    radius, length, speed, end = 3.8e-3, 25.4e-3, 190.0, 90e-6
    rho, E, nu, A, B, n, C, m = 8960.0, 115e9, 0.31, 65e6, 356e6, 0.37, 0.013, 1.09
    heat_capacity, room, melting = 383.0, 293.0, 1356.0
    c0, s1, gamma, slope = 3940.0, 1.489, 2.02, 0.47
    mu, kappa = E / (2 * (1 + nu)), rho * c0**2

    def plastic(self, mises, strain, heat, dt):
        part = np.clip(heat / (self.rho * self.heat_capacity) / (self.melting - self.room), 0, 1)
        low, high = np.zeros_like(mises), mises / (3 * self.mu)
        for _ in range(40):  # halving: the flow stress grows with the increment
            x = 0.5 * (low + high)
            rate = 1 + self.C * np.log(np.maximum(x / dt, 1.0))
            above = mises - 3 * self.mu * x > (self.A + self.B * (strain + x)**self.n) * rate * (1 - part**self.m)
            low, high = np.where(above, x, low), np.where(above, high, x)
        return np.where(low > 0, 0.5 * (low + high), 0)

    def pressure(self, ratio, energy):
        m = 1 / ratio - 1
        cold = np.where(m > 0, self.kappa * m * (1 + (1 - self.gamma / 2) * m - self.slope / 2 * m * m) /
                        (1 - (self.s1 - 1) * m)**2, self.kappa * m)
        return cold + (self.gamma + self.slope * m) * energy


class ArmcoIron(JohnsonCook):
    """Armco iron: `iron_armco` of the library."""
    speed = 221.0
    rho, E, nu, A, B, n, C, m = 7890.0, 207e9, 0.29, 175e6, 380e6, 0.32, 0.06, 0.55
    heat_capacity, melting = 452.0, 1811.0
    c0, s1, gamma, slope = 4578.0, 1.33, 1.67, 0.43
    mu, kappa = E / (2 * (1 + nu)), rho * c0**2


def mesh(bar, across):
    """Nodes (r, z) and elements of across x along squares."""
    along = round(bar.length / bar.radius * across)
    z, r = np.meshgrid(np.linspace(0, bar.length, along + 1), np.linspace(0, bar.radius, across + 1), indexing="ij")
    i, j = np.meshgrid(np.arange(across), np.arange(along))
    first = (j * (across + 1) + i).ravel()
    return np.stack([r.ravel(), z.ravel()], 1), first[:, None] + np.array([0, 1, across + 2, across + 1])


def points(x, elements):
    """Of each element and point: shape functions, their derivatives by r and z, radius, volume of the ring."""
    xe = x[elements]
    for g in CORNERS / np.sqrt(3):
        shape = 0.25 * np.prod(1 + g * CORNERS, 1)
        local = 0.25 * CORNERS * (1 + g * CORNERS)[:, ::-1]
        jacobian = np.einsum("ka,ekb->eab", local, xe)
        by_rz = np.einsum("eba,ka->ekb", np.linalg.inv(jacobian), local)
        radius = xe[:, :, 0] @ shape
        yield shape, by_rz, radius, 2 * np.pi * radius * np.linalg.det(jacobian)


def flow(bar, S, state, ve, shape, by_rz, radius, dt):
    """Deviator (rr, zz, tt, rz) and (plastic strain, heat) after dt."""
    L = np.einsum("eka,ekb->eab", ve, by_rz)  # dv_a / dx_b
    hoop = ve[:, :, 0] @ shape / radius
    mean, spin = (L[:, 0, 0] + L[:, 1, 1] + hoop) / 3, 0.5 * (L[:, 0, 1] - L[:, 1, 0])
    S = S + dt * np.stack([2 * bar.mu * (L[:, 0, 0] - mean) + 2 * spin * S[:, 3],
                           2 * bar.mu * (L[:, 1, 1] - mean) - 2 * spin * S[:, 3], 2 * bar.mu * (hoop - mean),
                           bar.mu * (L[:, 0, 1] + L[:, 1, 0]) + spin * (S[:, 1] - S[:, 0])], 1)
    mises = np.sqrt(1.5 * (np.sum(S[:, :3]**2, 1) + 2 * S[:, 3]**2))
    strain, heat = state
    more = bar.plastic(mises, strain, heat, dt)
    left = mises - 3 * bar.mu * more
    return S * (left / np.maximum(mises, 1e-300))[:, None], (strain + more, heat + left * more)


def step_length(bar, x, elements):
    """A third of what a wave takes across the thinnest element."""
    wave = np.sqrt((bar.kappa + 4 * bar.mu / 3) / bar.rho)
    d = x[elements]
    a, b = d[:, 2] - d[:, 0], d[:, 3] - d[:, 1]
    area = 0.5 * np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    return 0.35 / wave * np.min(area / np.maximum(np.hypot(*a.T), np.hypot(*b.T))) * 1.3


def run(bar, across):
    """Nodes and the largest plastic strain at the end."""
    x, elements = mesh(bar, across)
    v = np.tile([0.0, -bar.speed], (len(x), 1))
    foot, axis = x[:, 1] == 0, x[:, 0] == 0
    v[foot, 1] = 0
    mass, start = np.zeros(len(x)), np.zeros(len(elements))
    for shape, _, _, volume in points(x, elements):
        np.add.at(mass, elements, bar.rho * volume[:, None] * shape)
        start += volume
    none, energy = np.zeros(len(elements)), np.zeros(len(elements))
    S, state = [np.zeros((len(elements), 4))] * 4, [(none, none)] * 4
    time, dt = 0.0, step_length(bar, x, elements)
    while time < bar.end:
        half, x = x + 0.5 * dt * v, x + dt * v
        force, opening, volume = np.zeros_like(x[elements]), np.zeros_like(x[elements]), 0
        for q, (middle, now) in enumerate(zip(points(half, elements), points(x, elements))):
            S[q], state[q] = flow(bar, S[q], state[q], v[elements], *middle[:3], dt)
            shape, by_rz, radius, of_point = now
            rr, zz, tt, rz = S[q].T[:, :, None]
            ring = shape / radius[:, None]
            w = of_point[:, None]
            force[:, :, 0] -= w * (rr * by_rz[:, :, 0] + rz * by_rz[:, :, 1] + tt * ring)
            force[:, :, 1] -= w * (rz * by_rz[:, :, 0] + zz * by_rz[:, :, 1])
            opening += w[:, :, None] * (by_rz + np.stack([ring, 0 * ring], 2))
            volume = volume + of_point
        force += bar.pressure(volume / start, energy / start)[:, None, None] * opening
        energy -= dt * np.einsum("eka,eka->e", force, v[elements])
        total = np.zeros_like(x)
        np.add.at(total, elements, force)
        following = min(1.02 * dt, step_length(bar, x, elements))
        v = v + 0.5 * (dt + following) * total / mass[:, None]
        v[foot, 1] = 0
        v[axis, 0] = 0
        time, dt = time + dt, following
    return x, np.max([strain for strain, _ in state])


def carried(bar, x, across, particle):
    """(x, z) of a particle that stood at (x, y, z) [m]: between the nodes of its element as at the start."""
    r, along = np.hypot(particle[0], particle[1]), len(x) // (across + 1) - 1
    size = np.array([bar.radius / across, bar.length / along])
    place = np.array([r, particle[2]]) / size
    i, j = np.minimum(place.astype(int), [across - 1, along - 1])
    s, t = place - [i, j]
    corners = x.reshape(-1, across + 1, 2)[j:j + 2, i:i + 2]
    now = np.einsum("j,i,jia->a", [1 - t, t], [1 - s, s], corners)
    return now[0] * particle[0] / r, now[1]


def main():
    bars = {"linear": Linear(), "ofhc": JohnsonCook(), "armco": ArmcoIron()}
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bar", choices=bars, default="linear")
    parser.add_argument("--across", type=int, default=8, help="elements across the radius")
    parser.add_argument("particles", nargs="*", help="x,y,z at the start [mm]")
    asked = parser.parse_args()
    bar, across = bars[asked.bar], asked.across
    x, strain = run(bar, across)
    for k in range(across + 1):
        print(f"material radius {1e3 * bar.radius * k / across:.3f}  foot radius {1e3 * x[k, 0]:.4f}")
    print(f"length {1e3 * np.max(x[-across - 1:, 1]):.4f}  largest plastic strain {strain:.4f}")
    for text in asked.particles:
        now = carried(bar, x, across, 1e-3 * np.array([float(a) for a in text.split(",")]))
        print(f"particle {text}  twice its x {2e3 * now[0]:.4f}  z {1e3 * now[1]:.4f}")


if __name__ == "__main__":
    main()
