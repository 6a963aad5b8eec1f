#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Volumes, centroids and surfaces of elements against closed forms.

Environment: PYTHONPATH finds piola_import.
"""
import unittest

import numpy as np
from piola_import.solids import (PYRAMID, TETRAHEDRON, TETRAHEDRON_EDGES, WEDGE, curved_tetrahedra, enclosed_volume,
                                 faces_of, hull, triangles_of, volumes_and_centroids)

from decks import CORNERS, block

ROUND_OFF = 1e-13
UNIT = np.array(CORNERS, dtype=float)


def measure(nodes, places=range(8)):
    volume, centroid = volumes_and_centroids(np.asarray(nodes, dtype=float)[list(places)][None])
    return volume[0], centroid[0]


class Elements(unittest.TestCase):
    def test_sheared_hexahedron_has_the_volume_of_its_parallelepiped(self):
        F = np.array([[2, 0.7, -0.3], [0.1, 1.5, 0.4], [0.2, -0.6, 3]])
        volume, centroid = measure(UNIT @ F.T + [5, -7, 11])
        self.assertAlmostEqual(volume, np.linalg.det(F), delta=10 * ROUND_OFF)
        np.testing.assert_allclose(centroid, F @ np.full(3, 0.5) + [5, -7, 11], rtol=1e-12)

    def test_frustum_has_the_volume_and_centroid_of_a_cut_pyramid(self):
        # Squares of side 3 and 1, a height of 2 apart.
        nodes = [(3 * (x - 0.5), 3 * (y - 0.5), 0) if z == 0 else (x - 0.5, y - 0.5, 2) for x, y, z in CORNERS]
        volume, centroid = measure(nodes)
        self.assertAlmostEqual(volume, 2 / 3 * (9 + 1 + 3), places=12)
        self.assertAlmostEqual(centroid[2], 2 / 4 * (9 + 2 * 3 + 3 * 1) / (9 + 3 + 1), places=12)

    def test_wedge_pyramid_and_tetrahedron(self):
        triangle = [(0, 0, 0), (2, 0, 0), (0, 3, 0)]
        volume, centroid = measure([*triangle, *[(x, y, 5) for x, y, _ in triangle]], WEDGE)
        self.assertAlmostEqual(volume, 15, places=12)
        np.testing.assert_allclose(centroid, [2 / 3, 1, 2.5], rtol=1e-12)
        volume, centroid = measure([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (1, 1, 3)], PYRAMID)
        self.assertAlmostEqual(volume, 4, places=12)
        np.testing.assert_allclose(centroid, [1, 1, 0.75], rtol=1e-12)
        volume, centroid = measure([*triangle, (0, 0, 4)], TETRAHEDRON)
        self.assertAlmostEqual(volume, 4, places=12)
        np.testing.assert_allclose(centroid, [0.5, 0.75, 1], rtol=1e-12)

    def test_turned_element_has_a_negative_volume(self):
        self.assertAlmostEqual(measure(UNIT[[3, 2, 1, 0, 7, 6, 5, 4]])[0], -1, places=12)

    def test_curved_tetrahedron_integrates_its_parabolas(self):
        # x = r + e r^2 is a map that ten nodes hold exactly: V = 1/6 + 2 e / 24, the moment of x by hand.
        e = 0.3
        corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
        nodes = np.vstack([corners, corners[TETRAHEDRON_EDGES].mean(axis=1)])
        nodes[:, 0] += e * nodes[:, 0]**2
        volume, centroid = curved_tetrahedra(nodes[None])
        self.assertAlmostEqual(volume[0], 1 / 6 + 2 * e / 24, places=14)
        moment = 1 / 24 + 3 * e * 2 / 120 + 2 * e * e * 6 / 720
        self.assertAlmostEqual(centroid[0, 0], moment / volume[0], places=14)

    def test_plane_elements(self):
        plane = [[[0, 0], [4, 0], [2, 2], [0, 2]], [[0, 0], [3, 0], [0, 3], [0, 3]]]
        area, centroid = volumes_and_centroids(np.array(plane, dtype=float))
        np.testing.assert_allclose(area, [6, 4.5], rtol=1e-14)
        np.testing.assert_allclose(centroid, [[14 / 9, 8 / 9], [1, 1]], rtol=1e-12)


class Surfaces(unittest.TestCase):
    def test_surface_of_warped_elements_encloses_exactly_their_volume(self):
        X, solids, _ = block((4, 3, 3), (4, 3, 3))
        X = X + np.random.default_rng(1).uniform(-0.2, 0.2, X.shape)
        triangles, _, corners = triangles_of(hull(faces_of(solids)), X)
        volume = volumes_and_centroids(X[solids])[0].sum()
        self.assertAlmostEqual(enclosed_volume(triangles, corners), volume, delta=1e-12 * volume)

    def test_tetrahedra_of_a_ball_approach_its_volume_with_second_order(self):
        errors = []
        for count in (4, 8):
            X, solids, _ = block((count,) * 3, (2, 2, 2))
            X = X - 1
            longest = np.abs(X).max(axis=1, keepdims=True)
            X = X * longest / np.maximum(np.linalg.norm(X, axis=1, keepdims=True), 1e-300)
            six = [[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]]
            tetrahedra = np.vstack([solids[:, corners] for corners in six])[:, TETRAHEDRON]
            volume = volumes_and_centroids(X[tetrahedra])[0]
            self.assertGreater(volume.min(), 0)
            triangles, _, corners = triangles_of(hull(faces_of(tetrahedra)), X)
            self.assertAlmostEqual(enclosed_volume(triangles, corners), volume.sum(), places=12)
            errors.append(1 - volume.sum() / (4 / 3 * np.pi))
        self.assertLess(errors[1], 0.05)
        self.assertGreater(errors[0] / errors[1], 3.4)
        self.assertLess(errors[0] / errors[1], 4.6)


if __name__ == "__main__":
    unittest.main()
