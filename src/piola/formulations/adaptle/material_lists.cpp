// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/material_lists.hpp"
#include "piola/formulations/adaptle/records.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <cmath>

namespace piola::adaptle {
namespace {

constexpr FoldedCorrection plain{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {}};

/// The inverse of the first moments, or nothing where it is singular.
template <int D>
bool invert_moments(double const* A, double* K) {
  Mat<D> m;
  for (int p = 0; p < D; ++p)
    for (int q = 0; q < D; ++q) m(p, q) = A[3 * p + q];
  Mat<D> const r = inverse(m);
  double size = 0;
  for (double const k : r.c) size += k * k;
  if (!(size < 1e8)) return false;
  for (int p = 0; p < D; ++p)
    for (int q = 0; q < D; ++q) K[3 * p + q] = r(p, q);
  return true;
}

}  // namespace

void MaterialLists::build(ParticleSet const& set, ParticleOrder const& order, std::vector<BodyConstants> const& bodies,
                          std::vector<Reference> const& reference, Settings const& settings, int lanes) {
  particles_ = static_cast<Index>(set.size());
  published_ = settings.published;
  rounded_ = !published_ && settings.corrected_material;
  begin_.assign(1, 0);
  begin_.reserve(at(particles_) + 1);
  filled_.reserve(at(particles_));
  for (std::size_t b = 0; b < bodies.size(); ++b) list(set, order, set.bodies[b], bodies[b], reference, lanes);
  if (published_) {
    correction_.assign(at(particles_), plain);
    moments_.resize(at(particles_));
    if (settings.corrected_material) correct(reference, bodies, set.dimension);
    sum_gradients([](Index) { return true; }, reference);
  } else {
    invert(reference, set.dimension, settings.corrected_material);
  }
  int const components =
      set.dimension == 2 ? MaterialRecord<2>::values(published_) : MaterialRecord<3>::values(published_);
  for (std::size_t b = 0; b < bodies.size(); ++b)
    rows_.emplace_back(set, order, set.bodies[b], bodies[b].material_h, begin_, neighbour_, lanes, rounded_,
                       components);
  for (LatticeRows& rows : rows_) row_views_.push_back(rows.view());
}

void MaterialLists::list(ParticleSet const& set, ParticleOrder const& order, Body const& geometry,
                         BodyConstants const& body, std::vector<Reference> const& reference, int lanes) {
  double const reach = 2 * body.material_h * (1 - 1e-9);
  bool const lattice = geometry.regular && !geometry.scattered;
  auto const& place = set.lattice_index.seen();
  std::vector<std::array<double, 3>> points;
  for (Index i = body.first; i < body.last; ++i) points.push_back(set.X[order.id(i)]);
  CellGrid const grid(points, reach);
  std::vector<Index> near;
  for (Index i = body.first; i < body.last; ++i) {
    auto const& x = set.X[order.id(i)];
    near.clear();
    grid.visit(x, [&](Index local) {
      Index const j = body.first + local;
      auto const& y = set.X[order.id(j)];
      double const dx = x[0] - y[0], dy = x[1] - y[1], dz = x[2] - y[2];
      if (j != i && dx * dx + dy * dy + dz * dz < reach * reach) near.push_back(j);
    });
    std::sort(near.begin(), near.end(), [&](Index a, Index b) { return order.id(a) < order.id(b); });
    for (Index const j : near) {
      double square = 0;
      for (int c = 0; c < 3; ++c) {
        double const d = reference[at(j)].X[c] - reference[at(i)].X[c];
        square += d * d;
      }
      // Of a lattice: the same number wherever the pair is, as patterns have it.
      if (lattice) square = lattice_square(geometry, place[order.id(i)], place[order.id(j)]);
      add_pair(set.dimension, body.material_h, j, square);
    }
    std::size_t const found = neighbour_.size();
    while (neighbour_.size() % static_cast<std::size_t>(lanes) != 0)
      add_pair(set.dimension, body.material_h, particles_, 1e300);
    filled_.push_back(static_cast<std::uint8_t>(neighbour_.size() - found));
    begin_.push_back(static_cast<Offset>(neighbour_.size()));
  }
}

void MaterialLists::add_pair(int dimension, double h, Index j, double square) {
  double s = 0, W = 0;
  if (j < particles_) kernel_of(dimension, h, square, s, W);
  neighbour_.push_back(j);
  if (rounded_) gradient_.push_back(static_cast<float>(s));
  if (!rounded_) s_.push_back(s);
  if (published_) W_.push_back(W);
}

/// K from the same rounded s as the sums, so that gradients of linear fields stay exact to double precision; the
/// identity where there is no correction.
void MaterialLists::invert(std::vector<Reference> const& reference, int dimension, bool corrected) {
  moments_.resize(at(particles_));
  for (Index i = 0; i < particles_; ++i) {
    double A[9]{}, K[9]{1, 0, 0, 0, 1, 0, 0, 0, 1};
    MaterialCorrection& m = moments_[at(i)];
    m = {};
    for (Offset k = begin_[at(i)]; k < begin_[at(i) + 1]; ++k) {
      Index const j = neighbour_[at(k)];
      if (j >= particles_) continue;
      double const Vs = reference[at(j)].volume * gradient(k);
      double r[3];
      for (int c = 0; c < 3; ++c) r[c] = reference[at(j)].X[c] - reference[at(i)].X[c];
      for (int p = 0; p < 3; ++p) {
        m.G[p] += Vs * r[p];
        for (int q = 0; q < 3; ++q) A[3 * p + q] += Vs * r[p] * r[q];
      }
    }
    if (corrected && dimension == 2) invert_moments<2>(A, K);
    if (corrected && dimension == 3) invert_moments<3>(A, K);
    for (int p = 0; p < dimension; ++p)
      for (int q = p; q < dimension; ++q)
        m.K[dimension == 2 ? SymMat<2>::at(p, q) : SymMat<3>::at(p, q)] = K[3 * p + q];
  }
}

/// The sums of V0 s r and V0 W anew, without deleted neighbours.
template <class F>
void MaterialLists::sum_gradients(F const& alive, std::vector<Reference> const& reference) {
  for (Index i = 0; i < particles_; ++i) {
    MaterialCorrection& m = moments_[at(i)];
    for (int c = 0; c < 3; ++c) m.G[c] = 0;
    m.W = 0;
    for (Offset k = begin_[at(i)]; k < begin_[at(i) + 1]; ++k) {
      Index const j = neighbour_[at(k)];
      if (j >= particles_ || !alive(j)) continue;
      double const Vs = reference[at(j)].volume * gradient(k);
      for (int c = 0; c < 3; ++c) m.G[c] += Vs * (reference[at(j)].X[c] - reference[at(i)].X[c]);
      if (published_) m.W += reference[at(j)].volume * W_[at(k)];
    }
  }
}

void MaterialLists::correct(std::vector<Reference> const& reference, std::vector<BodyConstants> const& bodies,
                            int dimension) {
  for (BodyConstants const& body : bodies)
    for (Index i = body.first; i < body.last; ++i) {
      double none = 0, W0 = 0, G[3]{}, xW[3]{}, moments[9]{};
      kernel_of(dimension, body.material_h, 0, none, W0);
      double S = reference[at(i)].volume * W0;
      for (Offset k = begin_[at(i)]; k < begin_[at(i) + 1]; ++k) {
        Index const j = neighbour_[at(k)];
        if (j >= particles_) continue;
        double const V = reference[at(j)].volume;
        double r[3];
        for (int c = 0; c < 3; ++c) r[c] = reference[at(j)].X[c] - reference[at(i)].X[c];
        S += V * W_[at(k)];
        for (int p = 0; p < 3; ++p) {
          G[p] += V * s_[at(k)] * r[p];
          xW[p] += V * W_[at(k)] * r[p];
          for (int q = 0; q < 3; ++q) moments[3 * p + q] += V * s_[at(k)] * r[p] * r[q];
        }
      }
      double A[9];
      for (int p = 0; p < 3; ++p)
        for (int q = 0; q < 3; ++q) A[3 * p + q] = (S * moments[3 * p + q] - G[p] * xW[q]) / (S * S);
      FoldedCorrection k = plain;
      bool const regular = dimension == 2 ? invert_moments<2>(A, k.N) : invert_moments<3>(A, k.N);
      if (!regular) continue;
      for (double& N : k.N) N /= S;
      for (int c = 0; c < 3; ++c) k.G[c] = G[c] / S;
      correction_[at(i)] = k;
    }
}

void MaterialLists::choose(std::span<Range const> own_slots, std::vector<State> const& state,
                           std::vector<Reference> const& reference, bool printed,
                           std::vector<Deformation>& deformation) {
  bool const deleted = std::any_of(state.begin(), state.end(), [](State const& s) { return !(s.alive > 0); });
  if (deleted || deleted_) sum_gradients([&](Index j) { return state[at(j)].alive > 0; }, reference);
  deleted_ = deleted;
  using Part = MaterialPart;
  part_.assign(at(particles_) + 16, 0);
  auto const lagrangian = [&](Index i) { return state[at(i)].phi < 1; };
  for (Index i = 0; i < particles_; ++i) {
    bool const own = lagrangian(i), other = state[at(i)].phi > 0;
    bool beside = false;
    for (Offset k = begin_[at(i)]; k < begin_[at(i) + 1] && other; ++k) {
      Index const j = neighbour_[at(k)];
      if (j >= particles_) continue;
      part_[at(j)] |= Part::mixed;
      beside = beside || lagrangian(j);
    }
    bool const kinematic = own || (printed && beside);
    if (kinematic) part_[at(i)] |= Part::kinematic;
    if (own || (beside && !printed)) part_[at(i)] |= Part::target;
    deformation[at(i)].gap = kinematic ? std::max(deformation[at(i)].gap, 0.0) : -1;
  }
  kinematic_.clear();
  target_.clear();
  for (std::size_t b = 0; b < rows_.size(); ++b) {
    if (rows_[b].has_rows()) continue;
    for (Index i = own_slots[b].first; i < own_slots[b].last; ++i) {
      if ((part_[at(i)] & Part::kinematic) != 0) kinematic_.push_back(i);
      if ((part_[at(i)] & Part::target) != 0) target_.push_back(i);
    }
  }
}

void MaterialLists::put_into(MaterialTable& table) const {
  table.begin = begin_.data();
  table.neighbour = neighbour_.data();
  table.gradient = gradient_.data();
  table.moments = moments_.data();
  table.s = s_.data();
  table.W = W_.data();
  table.correction = correction_.data();
  table.kinematic = kinematic_.data();
  table.kinematics = static_cast<Index>(kinematic_.size());
  table.target = target_.data();
  table.part = part_.data();
  table.rows_of = row_views_.data();
  table.targets = static_cast<Index>(target_.size());
}

std::size_t MaterialLists::bytes() const {
  std::size_t rows = 0;
  for (LatticeRows const& of_body : rows_) rows += of_body.bytes();
  return rows + part_.size() + sizeof(Offset) * begin_.size() +
         sizeof(Index) * (neighbour_.size() + kinematic_.size() + target_.size()) + sizeof(float) * gradient_.size() +
         sizeof(double) * (s_.size() + W_.size()) + filled_.size() + sizeof(FoldedCorrection) * correction_.size() +
         sizeof(MaterialCorrection) * moments_.size();
}

}  // namespace piola::adaptle
