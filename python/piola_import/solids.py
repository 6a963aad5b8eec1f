# SPDX-License-Identifier: Apache-2.0
"""Geometry of elements: volumes, centroids, faces, and the surface around a set of elements.

Every solid is a hexahedron of eight corners in the order of LS-DYNA and Abaqus; wedges, pyramids and tetrahedra repeat
corners. Its map from the unit cube is trilinear, and two Gauss points per direction integrate volume and first moment
exactly. Plane elements are quadrilaterals likewise.
"""
import numpy as np

# Corners of a face, in the order of the faces S1 to S6 of a hexahedron; normals point outwards.
HEXAHEDRON_FACES = np.array([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
# Positions of the corners of other solids among the eight.
TETRAHEDRON = [0, 1, 2, 2, 3, 3, 3, 3]
WEDGE = [0, 1, 2, 2, 3, 4, 5, 5]
PYRAMID = [0, 1, 2, 3, 4, 4, 4, 4]
# Edges of a tetrahedron with a node in their middle, in the order of the nodes 5 to 10 (Abaqus, LS-DYNA, VTK).
TETRAHEDRON_EDGES = np.array([[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]])
GAUSS = np.array([-1, 1]) / np.sqrt(3)


def _shape(signs, place):
    """Multilinear shape functions and their derivatives at a place of the unit cube."""
    factors = 1 + signs * place
    count = signs.shape[1]
    values = factors.prod(axis=1) / 2**count
    slopes = np.stack([signs[:, k] * np.delete(factors, k, axis=1).prod(axis=1) for k in range(count)]) / 2**count
    return values, slopes


def volumes_and_centroids(corners):
    """Exact volumes (n,) and centroids (n, d) of elements with corners (n, 2^d, d); areas in the plane, d = 2.

    A volume is negative if the corners run the wrong way.
    """
    dimension = corners.shape[2]
    signs = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], dtype=float)
    if dimension == 3:
        signs = np.vstack([np.column_stack([signs, np.full(4, z)]) for z in (-1.0, 1.0)])
    origin = corners.mean(axis=1)
    local = corners - origin[:, None]
    volume, moment = np.zeros(len(corners)), np.zeros((len(corners), dimension))
    for place in np.stack(np.meshgrid(*[GAUSS] * dimension), axis=-1).reshape(-1, dimension):
        values, slopes = _shape(signs, place)
        weight = np.linalg.det(np.einsum("kc,ncd->nkd", slopes, local))
        volume += weight
        moment += weight[:, None] * np.einsum("c,ncd->nd", values, local)
    safe = np.where(volume == 0, 1, volume)
    return volume, origin + moment / safe[:, None]


def curved_tetrahedra(nodes):
    """Exact volumes and centroids of tetrahedra of ten nodes (n, 10, 3); their edges are parabolas.

    The determinant is a cubic and the first moment a quintic: a product rule of 4 x 4 x 4 points over the collapsed
    cube is exact for both.
    """
    points, weights = np.polynomial.legendre.leggauss(4)
    points, weights = (points + 1) / 2, weights / 2
    volume, moment = np.zeros(len(nodes)), np.zeros((len(nodes), 3))
    for a, wa in zip(points, weights):
        for b, wb in zip(points, weights):
            for c, wc in zip(points, weights):
                place = np.array([a, b * (1 - a), c * (1 - a) * (1 - b)])
                values, slopes = _quadratic_shape(place)
                weight = np.linalg.det(np.einsum("kc,ncd->nkd", slopes, nodes))
                weight = weight * wa * wb * wc * (1 - a)**2 * (1 - b)
                volume += weight
                moment += weight[:, None] * np.einsum("c,ncd->nd", values, nodes)
    return volume, moment / np.where(volume == 0, 1, volume)[:, None]


def _quadratic_shape(place):
    """The ten shape functions of a tetrahedron, and their derivatives by the three coordinates."""
    corner = np.array([1 - place.sum(), *place])
    slope = np.vstack([-np.ones(3), np.eye(3)])
    values = np.concatenate([corner * (2 * corner - 1), [4 * corner[a] * corner[b] for a, b in TETRAHEDRON_EDGES]])
    slopes = [(4 * corner[a] - 1) * slope[a] for a in range(4)]
    slopes += [4 * (corner[a] * slope[b] + corner[b] * slope[a]) for a, b in TETRAHEDRON_EDGES]
    return values, np.array(slopes).T


def faces_of(solids):
    """All faces of solids (n, 8) as corners (f, 4), without those that repeated corners make vanish.

    A triangle has its last corner twice.
    """
    faces = solids[:, HEXAHEDRON_FACES].reshape(-1, 4)
    return without_repeats(faces)


def without_repeats(faces):
    """Faces (f, 4) with at least three different corners; a corner that is there twice moves to the end."""
    same = faces == np.roll(faces, -1, axis=1)  # corner k is the next one, too
    count = same.sum(axis=1)
    faces, same, count = faces[count < 2], same[count < 2], count[count < 2]
    turn = np.where(count == 1, (same.argmax(axis=1) + 2) % 4, 0)
    faces = faces[np.arange(len(faces))[:, None], (np.arange(4) + turn[:, None]) % 4]
    folded = (faces[:, 0] == faces[:, 2]) | (faces[:, 1] == faces[:, 3])
    return faces[~folded]


def keys_of(faces):
    """One value for each face or edge: the same for the same corners in any order."""
    ordered = np.ascontiguousarray(np.sort(faces, axis=1))
    if ordered.shape[1] == 4:  # a triangle: whichever corner is there twice, it counts once
        double = ordered[:, 1:] == ordered[:, :-1]
        at = np.where(double.any(axis=1), double.argmax(axis=1), 3)
        ordered[np.arange(len(ordered)), at] = np.where(double.any(axis=1), -1, ordered[np.arange(len(ordered)), at])
        ordered = np.ascontiguousarray(np.sort(ordered, axis=1))
    return ordered.view([("", ordered.dtype)] * ordered.shape[1]).ravel()


def hull(faces):
    """The faces (or edges) that only one element has: the surface around them."""
    _, index, count = np.unique(keys_of(faces), return_index=True, return_counts=True)
    return faces[np.sort(index[count == 1])]


def edges_of(quads):
    """The edges (e, 2) of plane elements (n, 4), counterclockwise around each."""
    edges = np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2)
    return edges[edges[:, 0] != edges[:, 1]]


def triangles_of(faces, X, middles=None):
    """Triangles of faces (f, 4), the face of each, and the corners X with those that had to be added.

    Plane faces are cut along a diagonal. A warped face gets a corner in its middle, which keeps the volume of the
    bilinear surface exactly. `middles`: nodes in the middle of edges, by (smaller, larger) corner; a triangle with
    three of them becomes four.
    """
    corners = X[faces]
    across = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    size = np.abs(corners - corners[:, :1]).max(axis=(1, 2))
    off = np.abs(np.einsum("nd,nd->n", across, corners[:, 1] - corners[:, 0]))
    is_triangle = faces[:, 2] == faces[:, 3]
    warped = ~is_triangle & (off > 1e-9 * size**3)
    triangles, owner = [], []
    added = len(X) + np.cumsum(warped) - 1
    for k, face in enumerate(faces.tolist()):
        a, b, c, d = face
        if is_triangle[k]:
            new = _split(a, b, c, middles)
        elif warped[k]:
            m = int(added[k])
            new = [(a, b, m), (b, c, m), (c, d, m), (d, a, m)]
        else:
            new = [(a, b, c), (a, c, d)]
        triangles += new
        owner += [k] * len(new)
    all_corners = np.vstack([X, corners[warped].mean(axis=1)])
    return np.array(triangles, dtype=np.int64).reshape(-1, 3), np.array(owner, dtype=np.int64), all_corners


def _split(a, b, c, middles):
    """A triangle, or the four that the nodes in the middle of its edges make of it."""
    if middles:
        ab, bc, ca = (middles.get((min(p, q), max(p, q))) for p, q in ((a, b), (b, c), (c, a)))
        if ab is not None and bc is not None and ca is not None:
            return [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return [(a, b, c)]


def enclosed_volume(triangles, X):
    """Volume inside a closed surface."""
    a, b, c = (X[triangles[:, k]] - X[0] for k in range(3))
    return float(np.einsum("nd,nd->n", a, np.cross(b, c)).sum() / 6)


def loops_of(edges):
    """Closed loops of corners along edges (e, 2), each in order. Raises ValueError if an edge has no successor."""
    after = {}
    for a, b in edges.tolist():
        if a in after:
            raise ValueError("outlines touch in one node")
        after[a] = b
    loops = []
    while after:
        first = next(iter(after))
        loop, node = [], first
        while node in after:
            loop.append(node)
            node = after.pop(node)
        if node != first:
            raise ValueError("an outline is not closed")
        loops.append(loop)
    return loops
