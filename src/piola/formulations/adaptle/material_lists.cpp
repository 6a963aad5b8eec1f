// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/material_lists.hpp"
#include "piola/formulations/adaptle/records.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <cmath>

namespace piola::adaptle {
namespace {

constexpr Correction plain{1, {}, {1, 0, 0, 0, 1, 0, 0, 0, 1}};

template <int D>
void kernel_of(double h, double square, double& s, double& W) {
  Kernel<D>(h).evaluate(square, s, W);
}

void kernel_of(int dimension, double h, double square, double& s, double& W) {
  if (dimension == 2) return kernel_of<2>(h, square, s, W);
  kernel_of<3>(h, square, s, W);
}

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

void MaterialLists::build(ParticleSet const& set, std::vector<BodyConstants> const& bodies,
                          std::vector<Reference> const& reference, bool corrected, int lanes) {
  particles_ = static_cast<Index>(set.size());
  begin_.assign(1, 0);
  count_.assign(at(particles_), 0);
  std::vector<int> body(at(particles_));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    BodyConstants const& constants = bodies[b];
    double const reach = 2 * constants.h * (1 - 1e-9);
    std::vector<std::array<double, 3>> const points(set.X.begin() + constants.first, set.X.begin() + constants.last);
    CellGrid const grid(points, reach);
    std::vector<Index> near;
    for (Index i = constants.first; i < constants.last; ++i) {
      body[at(i)] = static_cast<int>(b);
      auto const& x = set.X[at(i)];
      near.clear();
      grid.visit(x, [&](Index local) {
        Index const j = constants.first + local;
        auto const& y = set.X[at(j)];
        double const dx = x[0] - y[0], dy = x[1] - y[1], dz = x[2] - y[2];
        if (j != i && dx * dx + dy * dy + dz * dz < reach * reach) near.push_back(j);
      });
      std::sort(near.begin(), near.end());
      count_[at(i)] = static_cast<int>(near.size());
      for (Index const j : near) {
        double square = 0, s = 0, W = 0;
        for (int c = 0; c < 3; ++c) {
          double const d = reference[at(j)].X[c] - reference[at(i)].X[c];
          square += d * d;
        }
        kernel_of(set.dimension, constants.h, square, s, W);
        neighbour_.push_back(j);
        s_.push_back(s);
        W_.push_back(W);
      }
      while (neighbour_.size() % static_cast<std::size_t>(lanes) != 0) {
        neighbour_.push_back(particles_);
        s_.push_back(0);
        W_.push_back(0);
      }
      begin_.push_back(static_cast<Index>(neighbour_.size()));
    }
  }
  correction_.assign(at(particles_), plain);
  if (corrected) correct(reference, bodies, body, set.dimension);
}

void MaterialLists::correct(std::vector<Reference> const& reference, std::vector<BodyConstants> const& bodies,
                            std::vector<int> const& body, int dimension) {
  for (Index i = 0; i < particles_; ++i) {
    double none = 0, W0 = 0, G[3]{}, xW[3]{}, moments[9]{};
    kernel_of(dimension, bodies[static_cast<std::size_t>(body[at(i)])].h, 0, none, W0);
    double S = reference[at(i)].volume * W0;
    for (Index k = begin_[at(i)]; k < begin_[at(i) + 1]; ++k) {
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
    Correction k = plain;
    bool const regular = dimension == 2 ? invert_moments<2>(A, k.K) : invert_moments<3>(A, k.K);
    if (!regular) continue;
    k.S = S;
    std::copy_n(G, 3, k.G);
    correction_[at(i)] = k;
  }
}

void MaterialLists::choose(std::vector<State> const& state, bool printed, std::vector<Deformation>& deformation) {
  kinematic_.clear();
  target_.clear();
  auto const lagrangian = [&](Index i) { return state[at(i)].phi < 1; };
  for (Index i = 0; i < particles_; ++i) {
    bool const own = lagrangian(i);
    bool beside = false;
    for (Index k = begin_[at(i)]; k < begin_[at(i) + 1] && !own && !beside; ++k)
      beside = neighbour_[at(k)] < particles_ && lagrangian(neighbour_[at(k)]);
    bool const kinematic = own || (printed && beside);
    if (kinematic) kinematic_.push_back(i);
    if (own || (beside && !printed)) target_.push_back(i);
    deformation[at(i)].gap = kinematic ? std::max(deformation[at(i)].gap, 0.0) : -1;
  }
}

void MaterialLists::put_into(MaterialTable& table) const {
  table.begin = begin_.data();
  table.neighbour = neighbour_.data();
  table.s = s_.data();
  table.W = W_.data();
  table.correction = correction_.data();
  table.kinematic = kinematic_.data();
  table.kinematics = static_cast<Index>(kinematic_.size());
  table.target = target_.data();
  table.targets = static_cast<Index>(target_.size());
}

std::size_t MaterialLists::bytes() const {
  return sizeof(Index) * (begin_.size() + neighbour_.size() + kinematic_.size() + target_.size()) +
         sizeof(double) * (s_.size() + W_.size()) + sizeof(Correction) * correction_.size();
}

}  // namespace piola::adaptle
