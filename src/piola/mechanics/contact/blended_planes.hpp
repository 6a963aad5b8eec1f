// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include <cmath>

/// The gap between a surface point and the surface of another body, by blended planes, and the energy of contact.
/// Points of a body's surface have a position y and an outward unit normal n; each defines a plane. Theory:
/// docs/theory/contact.md.
namespace piola::contact {

/// A surface point in the current configuration.
struct Plane {
  Vec<3> y, n;  ///< position [m], outward unit normal
};

/// Contact law of a pair of surfaces.
struct PairRule {
  double reach = 0;                   ///< R: planes beyond this distance have no weight [m]
  double stiffness = 0;               ///< k: pressure by depth [Pa/m]
  double length = 0;                  ///< l: depth at which the pressure of a linear layer is doubled [m]
  double fade_from = 0, fade_to = 0;  ///< distances beyond the rim of a face over which its planes fade out [m]
};

/// q: 1/2 for pairs of surfaces, which are both tested; 1 for a rigid shape. P-wave moduli M [Pa], spacings [m],
/// factor: C_s.
inline double penalty_stiffness(double q, double factor, double modulus, double spacing) {
  return q * factor * modulus / spacing;
}

inline PairRule pair_rule(double factor, double modulus_a, double spacing_a, double modulus_b, double spacing_b) {
  double const mean = 2 * modulus_a * modulus_b / (modulus_a + modulus_b), dp = 0.5 * (spacing_a + spacing_b);
  double const larger = spacing_a > spacing_b ? spacing_a : spacing_b;
  return {2 * larger, penalty_stiffness(0.5, factor, mean, dp), 0.5 * dp, 0.45 * larger, 0.75 * larger};
}

/// The weight of a plane: (1 - r^2/R^2)^3 c^2 for opposing normals, c = n_a . n_b < 0.
inline double plane_weight(double square_over_reach, double c) {
  double const rest = 1 - square_over_reach;
  return rest > 0 && c < 0 ? rest * rest * rest * c * c : 0;
}

/// Energy per area psi(g) of the layer and its slope, g < 0 inside [m]; zero outside.
struct Layer {
  double energy = 0, slope = 0;  ///< [J/m2], [Pa]
};
inline Layer layer(double gap, double stiffness, double length) {
  if (!(gap < 0)) return {};
  double const square = gap * gap, over = square / (length * length);
  return {stiffness * square * (0.5 + 0.25 * over), stiffness * gap * (1 + over)};
}

/// Inverse of layer().energy: the gap [m].
inline double gap_of_layer(double energy, double stiffness, double length) {
  double const square = length * length;
  return -std::sqrt(square * (std::sqrt(1 + 4 * energy / (stiffness * square)) - 1));
}

/// theta: 1 if the planes are opposite, 0 beyond the rim of a face. tau2: squared distance of their centroid along the
/// face [m2]; slope by tau2 [1/m2].
struct Fade {
  double value = 1, slope = 0;
};
inline Fade fade(double tau2, double from, double to) {
  double const a = from * from, b = to * to;
  if (!(tau2 > a)) return {};
  if (!(tau2 < b)) return {0, 0};
  double const s = (b - tau2) / (b - a);
  return {s * s * (3 - 2 * s), -6 * s * (1 - s) / (b - a)};
}

/// p: fraction of a face in front of a point: 0 if the weights Sw of all its planes are negligible, 1 for a full face.
/// Continuous as a plane appears or rotates. Slope by Sw.
inline Fade coverage(double weight) {
  constexpr double none = 0.02,
                   whole = 0.3;  // Sw of a flat face is pi R^2 / (4 dp^2) = 3.1 in 3D; at its corner a quarter of it
  if (!(weight > none)) return {0, 0};
  if (!(weight < whole)) return {1, 0};
  double const s = (weight - none) / (whole - none);
  return {s * s * (3 - 2 * s), 6 * s * (1 - s) / (whole - none)};
}

/// The blended gap of a point from the planes near it.
struct Gap {
  double weight = 0;  ///< Sw
  double gap = 0;     ///< g [m]
  Vec<3> centroid;    ///< weighted mean of y_a - y_b [m]
  bool seen() const { return weight > 0; }
  double tau2() const { return dot(centroid, centroid) - gap * gap; }
};

/// sources(k) is the plane k = 0 ... count - 1; weights[k] becomes its weight.
template <class Sources>
Gap blended_gap(Plane const& a, Index count, Sources const& sources, double reach, double* weights) {
  Gap g;
  for (Index k = 0; k < count; ++k) {
    Plane const& b = sources(k);
    Vec<3> const r = a.y - b.y;
    double const w = plane_weight(dot(r, r) / (reach * reach), dot(a.n, b.n));
    weights[k] = w;
    if (!(w > 0)) continue;
    g.weight += w;
    g.gap += w * dot(b.n, r);
    g.centroid = g.centroid + w * r;
  }
  if (!g.seen()) return g;
  g.gap /= g.weight;
  g.centroid = (1 / g.weight) * g.centroid;
  return g;
}

/// Force on a point, the derivative of the energy by its normal, and additional action on F.
struct PointLoad {
  Vec<3> force, by_normal;  ///< [N], [J]
  Mat<3> on_gradient = {};  ///< of friction: minus the force on F [N m]
};

/// Contribution of one target with area A [m2]: the full derivative of E = A psi(g) theta p(Sw). Calls on_source(k,
/// load) with the load of source k; returns the load of the target.
template <class Sources, class OnSource>
PointLoad contact_loads(Plane const& a, double area, Gap const& g, Layer const& psi, Fade const& theta, Index count,
                        Sources const& sources, double reach, OnSource const& on_source) {
  Fade const p = coverage(g.weight);
  double const alpha = p.value * area * (psi.slope * theta.value - 2 * g.gap * psi.energy * theta.slope);
  Vec<3> const gamma = (2 * p.value * area * psi.energy * theta.slope) * g.centroid;
  double const by_presence = area * psi.energy * theta.value * p.slope;
  PointLoad target;
  for (Index k = 0; k < count; ++k) {
    Plane const& b = sources(k);
    Vec<3> const r = a.y - b.y;
    double const c = dot(a.n, b.n), rest = 1 - dot(r, r) / (reach * reach), w = plane_weight(1 - rest, c);
    if (!(w > 0)) continue;
    double const share = w / g.weight, distance = dot(b.n, r);
    double const by_weight = (alpha * (distance - g.gap) + dot(gamma, r - g.centroid)) / g.weight + by_presence;
    double const w0 = rest * rest * rest, w1 = -6 * rest * rest / (reach * reach);
    Vec<3> const h = share * (alpha * b.n + gamma) + (by_weight * c * c * w1) * r;
    target.force = target.force - h;
    target.by_normal = target.by_normal + (2 * by_weight * w0 * c) * b.n;
    on_source(k, PointLoad{h, (share * alpha) * r + (2 * by_weight * w0 * c) * a.n, {}});
  }
  return target;
}

/// The normal of a point attached to a particle with F: F^-T N / |F^-T N|.
inline Vec<3> push_forward_normal(Mat<3> const& F, Vec<3> const& N) {
  Vec<3> const m = transpose(inverse(F)) * N;
  return (1 / std::sqrt(dot(m, m))) * m;
}

/// dE/dF of the host particle of a point: y = x + F S, n = F^-T N / |F^-T N|. f, q: the point's load.
inline Mat<3> couple(Vec<3> const& S, Vec<3> const& N, Mat<3> const& F, PointLoad const& load) {
  Mat<3> const inverse_F = inverse(F);
  Vec<3> const m = transpose(inverse_F) * N;
  double const length = std::sqrt(dot(m, m));
  Vec<3> const n = (1 / length) * m;
  Vec<3> const r = (1 / length) * (load.by_normal - dot(n, load.by_normal) * n);
  return load.on_gradient - outer(load.force, S) - outer(m, inverse_F * r);
}

/// Square of the largest frequency that a contact adds [1/s2]: 2.5 C_s M/dp A (1 + 3 g^2/l^2) (1/m_a + 1/m_b).
inline double frequency2(double layer_modulus, double area, double gap, double length, double inverse_masses) {
  return 2.5 * layer_modulus * area * (1 + 3 * gap * gap / (length * length)) * inverse_masses;
}

}  // namespace piola::contact
