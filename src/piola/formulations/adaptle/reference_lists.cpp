// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/reference_lists.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/formulations/adaptle/records.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <array>

namespace piola::adaptle {
namespace {

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

void ReferenceLists::build(ParticleSet const& set, std::vector<BodyConstants> const& bodies,
                           std::vector<Range> const& own, Fields& fields, Settings const& settings, int lanes) {
  PIOLA_EXPECTS(bodies.size() == own.size() && lanes >= 1);
  *this = {};
  particles_ = static_cast<Index>(set.size());
  own_ = own;
  equations_ = settings.equations;
  kernel_ = kernel_function(*settings.kernel, set.dimension);
  begin_ = LazyZeroArray<Offset>(at(particles_) + 1);
  filled_ = LazyZeroArray<std::uint8_t>(at(particles_));
  part_ = LazyZeroArray<std::uint8_t>(at(particles_) + 16);
  for (std::size_t b = 0; b < bodies.size(); ++b) list(set, {set.bodies[b], bodies[b], own[b]}, lanes);
  find_edge();
  find_images();
  for (Index const i : edge_)
    each_neighbour_of({i, i + 1}, [&](Index j) {
      for (int c = 0; c < 3; ++c) fields.X.at(j, c) = set.X[at(j)][at(c)];
      fields.volume.at(j) = set.volume[at(j)];
    });
  if (equations_.stores_kernel()) {
    for_each_local([&](Index i) {
      for (int c = 0; c < 9; ++c) fields.N.at(i, c) = c % 4 == 0 ? 1 : 0;
      for (int c = 0; c < 3; ++c) fields.gradient_mean.at(i, c) = 0;
    });
    if (equations_.has_correction()) correct(fields, bodies, set.dimension);
    sum_gradients([](Index) { return true; }, fields);
  } else {
    invert(fields, set.dimension);
  }
  if (!image_.empty()) correct_axis(bodies, fields);
  int const components =
      set.dimension == 2 ? MaterialRecord<2>::values(equations_) : MaterialRecord<3>::values(equations_);
  for (std::size_t b = 0; b < bodies.size(); ++b)
    rows_.emplace_back(set, LatticeStencils::BodyInput{set.bodies[b], own[b], bodies[b].reference_h, kernel_}, begin_,
                       neighbour_, lanes, equations_.rounds_gradients(), components);
  for (LatticeStencils& rows : rows_) row_views_.push_back(rows.view());
  if (std::all_of(rows_.begin(), rows_.end(), [](LatticeStencils const& rows) { return rows.is_lattice(); })) return;
  set.dimension == 2 ? allocate_records<2>() : allocate_records<3>();
}

/// With a filler after the last, whose viscosity is not negative.
template <int D>
void ReferenceLists::allocate_records() {
  using R = MaterialRecord<D>;
  int const stride = R::stride(equations_);
  records_ = Memory(((image_.empty() ? 1 : 2) * at(particles_) + 1) * at(stride));
  double* const filler = records_.data() + std::ptrdiff_t{particles_} * stride;
  filler[R::viscosity] = 1;
  if (equations_.records_deformation()) filler[R::inverse_J] = 1;
}

void ReferenceLists::find_images() {
  for (Index const j : neighbour_)
    if (j > particles_) image_.push_back(source_of(j, particles_));
  std::sort(image_.begin(), image_.end());
  image_.erase(std::unique(image_.begin(), image_.end()), image_.end());
}

void ReferenceLists::find_edge() {
  if (!comm::is_parallel()) return;
  for (Range const& own : own_)
    for (Index i = own.first; i < own.last; ++i) {
      bool inside = true;
      each_neighbour_of({i, i + 1}, [&](Index j) { inside = inside && has(j, own); });
      if (!inside) edge_.push_back(i);
    }
}

/// Calls f(slot) for the particles of a body within the search distance of a particle of `own`.
template <class F>
void each_around(ParticleSet const& set, Range body, Range own, double reach, F const& f) {
  std::array<double, 3> low{}, high{};
  for (Index i = own.first; i < own.last; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      double const x = set.X[at(i)][c];
      low[c] = i == own.first ? x : std::min(low[c], x);
      high[c] = i == own.first ? x : std::max(high[c], x);
    }
  for (Index i = body.first; i < body.last; ++i) {
    auto const& x = set.X[at(i)];
    bool near = true;
    for (std::size_t c = 0; c < 3; ++c) near = near && x[c] >= low[c] - reach && x[c] <= high[c] + reach;
    if (near) f(i);
  }
}

/// Calls f(point, squared distance) for the points whose images behind the axis are within the search distance of x.
template <class F>
void each_image_around(CellGrid const& grid, std::vector<std::array<double, 3>> const& points,
                       std::array<double, 3> const& x, double reach, F const& f) {
  std::array const image{-x[0], x[1], x[2]};
  grid.visit(image, [&](Index local) {
    auto const& y = points[at(local)];
    double const dx = y[0] - image[0], dy = y[1] - image[1], square = dx * dx + dy * dy;
    if (square < reach * reach) f(local, square);
  });
}

void ReferenceLists::list(ParticleSet const& set, BodyInput const& body, int lanes) {
  auto const& [geometry, constants, own] = body;
  begin_[at(own.first)] = static_cast<Offset>(neighbour_.size());
  if (own.first == own.last) return;
  double const reach = 2 * constants.reference_h * (1 - 1e-9);
  bool const lattice = geometry.regular && !geometry.off_lattice;
  auto const& place = set.lattice_index.seen();
  std::vector<std::array<double, 3>> points;
  std::vector<Index> slots;
  each_around(set, {constants.first, constants.last}, own, reach, [&](Index i) {
    points.push_back(set.X[at(i)]);
    slots.push_back(i);
  });
  CellGrid const grid(points, reach);
  std::vector<Index> near;
  for (Index i = own.first; i < own.last; ++i) {
    auto const& x = set.X[at(i)];
    near.clear();
    grid.visit(x, [&](Index local) {
      Index const j = slots[at(local)];
      auto const& y = set.X[at(j)];
      double const dx = x[0] - y[0], dy = x[1] - y[1], dz = x[2] - y[2];
      if (j != i && dx * dx + dy * dy + dz * dz < reach * reach) near.push_back(j);
    });
    std::sort(near.begin(), near.end());
    for (Index const j : near) {
      auto const& y = set.X[at(j)];
      double square = 0;
      for (std::size_t c = 0; c < 3; ++c) square += (y[c] - x[c]) * (y[c] - x[c]);
      // On a lattice: bit-identical for all pairs of one offset, like the patterns.
      if (lattice) square = lattice_square(geometry, place[at(i)], place[at(j)]);
      add_pair(constants.reference_h, j, square);
    }
    if (set.axisymmetric)
      each_image_around(grid, points, x, reach, [&](Index local, double square) {
        add_pair(constants.reference_h, particles_ + 1 + slots[at(local)], square);
      });
    end_list(i, lanes);
  }
}

/// Fills the list of a particle up to whole lanes.
void ReferenceLists::end_list(Index i, int lanes) {
  std::size_t const found = neighbour_.size();
  while (neighbour_.size() % static_cast<std::size_t>(lanes) != 0) add_pair(1, particles_, 1e300);
  filled_[at(i)] = static_cast<std::uint8_t>(neighbour_.size() - found);
  begin_[at(i) + 1] = static_cast<Offset>(neighbour_.size());
}

void ReferenceLists::add_pair(double h, Index j, double square) {
  double s = 0, W = 0;
  if (j != particles_) kernel_(h, square, s, W);
  neighbour_.push_back(j);
  if (equations_.rounds_gradients())
    gradient_.push_back(static_cast<float>(s));
  else
    s_.push_back(s);
  if (equations_.stores_kernel()) W_.push_back(W);
}

/// K from the same rounded s as the sums, so that gradients of linear fields stay exact to double precision; the
/// identity where there is no correction.
void ReferenceLists::invert(Fields& fields, int dimension) {
  bool const corrected = equations_.has_correction();
  for_each_local([&](Index i) {
    double G[3]{}, A[9]{}, K[9]{1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (Offset k = begin_[at(i)]; k < begin_[at(i) + 1]; ++k) {
      Index const j = neighbour_[at(k)];
      if (j == particles_) continue;
      double const Vs = fields.weight().at(j) * gradient(k);
      double r[3];
      for (int c = 0; c < 3; ++c) r[c] = fields.X.at(j, c) - fields.X.at(i, c);
      for (int p = 0; p < 3; ++p) {
        G[p] += Vs * r[p];
        for (int q = 0; q < 3; ++q) A[3 * p + q] += Vs * r[p] * r[q];
      }
    }
    for (int p = 0; p < 3; ++p) fields.gradient_sum.at(i, p) = G[p];
    if (corrected && dimension == 2) invert_moments<2>(A, K);
    if (corrected && dimension == 3) invert_moments<3>(A, K);
    for (int p = 0; p < dimension; ++p)
      for (int q = p; q < dimension; ++q)
        fields.K.at(i, dimension == 2 ? SymMat<2>::at(p, q) : SymMat<3>::at(p, q)) = K[3 * p + q];
  });
}

/// Recomputes the sums of V0 s r and V0 W, without deleted neighbours.
template <class F>
void ReferenceLists::sum_gradients(F const& active, Fields& fields) {
  for_each_local([&](Index i) {
    double G[3]{}, W = 0;
    for (Offset k = begin_[at(i)]; k < begin_[at(i) + 1]; ++k) {
      Index const j = neighbour_[at(k)];
      if (j == particles_ || !active(source_of(j, particles_))) continue;
      double const Vs = fields.weight().at(j) * gradient(k);
      for (int c = 0; c < 3; ++c) G[c] += Vs * (fields.X.at(j, c) - fields.X.at(i, c));
      if (equations_.stores_kernel()) W += fields.weight().at(j) * W_[at(k)];
    }
    for (int c = 0; c < 3; ++c) fields.gradient_sum.at(i, c) = G[c];
    if (equations_.stores_kernel()) fields.kernel_sum.at(i) = W;
  });
}

void ReferenceLists::correct(Fields& fields, std::vector<BodyConstants> const& bodies, int dimension) {
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (Index i = own_[b].first; i < own_[b].last; ++i) {
      double none = 0, W0 = 0, G[3]{}, xW[3]{}, moments[9]{};
      kernel_(bodies[b].reference_h, 0, none, W0);
      double S = fields.weight().at(i) * W0;
      for (Offset k = begin_[at(i)]; k < begin_[at(i) + 1]; ++k) {
        Index const j = neighbour_[at(k)];
        if (j == particles_) continue;
        double const V = fields.weight().at(j);
        double r[3];
        for (int c = 0; c < 3; ++c) r[c] = fields.X.at(j, c) - fields.X.at(i, c);
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
      double N[9]{1, 0, 0, 0, 1, 0, 0, 0, 1};
      bool const regular = dimension == 2 ? invert_moments<2>(A, N) : invert_moments<3>(A, N);
      if (!regular) continue;
      for (int c = 0; c < 9; ++c) fields.N.at(i, c) = N[c] / S;
      for (int c = 0; c < 3; ++c) fields.gradient_mean.at(i, c) = G[c] / S;
    }
}

void ReferenceLists::correct_axis(std::vector<BodyConstants> const& bodies, Fields const& fields) {
  std::vector<double> s(neighbour_.size(), 0), radial(neighbour_.size(), 0), axial(neighbour_.size(), 0);
  for_each_local([&](Index i) {
    for (Offset k = begin_[at(i)]; k < begin_[at(i) + 1]; ++k) {
      if (neighbour_[at(k)] == particles_) continue;
      s[at(k)] = gradient(k);
      radial[at(k)] = gradient_along(0, i, k, fields);
      axial[at(k)] = gradient_along(1, i, k, fields);
    }
  });
  std::vector<AxisCorrection::Body> of;
  for (BodyConstants const& b : bodies) {
    double own = 0, none = 0;
    kernel_(b.reference_h, 0.36 * b.reference_h * b.reference_h, own, none);
    of.push_back({{b.first, b.last}, b.spacing, own});
  }
  axis_ = AxisCorrection({particles_, {begin_.begin(), begin_.end()}, neighbour_, s, radial, axial, fields}, of);
}

/// A0_b G_ab along the radius, 0, or the axis, 1.
double ReferenceLists::gradient_along(int axis, Index i, Offset k, Fields const& fields) const {
  Index const j = neighbour_[at(k)];
  double sum = 0;
  for (int c = 0; c < 2; ++c) {
    double const r = fields.X.at(j, c) - fields.X.at(i, c);
    if (!equations_.stores_kernel())
      sum += fields.K.at(i, SymMat<2>::at(axis, c)) * gradient(k) * r;
    else
      sum += fields.N.at(i, 3 * axis + c) * (gradient(k) * r - W_[at(k)] * fields.gradient_mean.at(i, c));
  }
  return fields.weight().at(j) * sum;
}

void ReferenceLists::choose(Fields& fields) {
  bool deleted = false;
  for (Index i = 0; i < particles_; ++i) deleted = deleted || !(fields.active.at(i) > 0);
  if (deleted || deleted_) sum_gradients([&](Index j) { return fields.active.at(j) > 0; }, fields);
  deleted_ = deleted;
  using Part = ReferenceRole;
  auto const lagrangian = [&](Index i) { return fields.phi.at(i) < 1; };
  for_each_local([&](Index i) { part_[at(i)] = 0; });
  mark_mixed(fields);
  for_each_local([&](Index i) {
    bool const own = lagrangian(i), other = fields.phi.at(i) > 0;
    bool beside = false;
    for (Offset k = begin_[at(i)]; k < begin_[at(i) + 1] && other && !beside; ++k)
      if (Index const j = neighbour_[at(k)]; j != particles_) beside = lagrangian(source_of(j, particles_));
    bool const kinematic = own || (beside && equations_.deforms_eulerian());
    if (kinematic) part_[at(i)] |= Part::kinematic;
    if (own || (beside && equations_.has_reactions())) part_[at(i)] |= Part::target;
    fields.gap.at(i) = kinematic ? std::max(fields.gap.at(i), 0.0) : -1;
  });
}

/// Marks particles with a reference neighbour that is not purely total-Lagrangian. The loop runs over the (few)
/// converted particles and marks their neighbours; particles with ghost neighbours (`edge_`) are checked separately.
void ReferenceLists::mark_mixed(Fields const& fields) {
  auto const other = [&](Index i) { return fields.phi.at(i) > 0; };
  for (Range const& own : own_)
    for (Index i = own.first; i < own.last; ++i) {
      if (!other(i)) continue;
      each_neighbour_of({i, i + 1}, [&](Index j) {
        if (has(j, own)) part_[at(j)] |= ReferenceRole::mixed;
      });
    }
  for (Index const i : edge_)
    each_neighbour_of({i, i + 1}, [&](Index j) {
      if (other(j)) part_[at(i)] |= ReferenceRole::mixed;
    });
}

void ReferenceLists::put_into(MaterialTable& table) {
  table.begin = begin_.data();
  table.neighbour = neighbour_.data();
  table.gradient = gradient_.data();
  table.s = s_.data();
  table.W = W_.data();
  table.part = part_.data();
  table.record = records_.data();
  table.images = static_cast<Index>(image_.size());
  table.image = image_.data();
  table.axis = axis_.view();
  table.rows_of = row_views_.data();
}

std::size_t ReferenceLists::bytes() const {
  std::size_t rows = 0;
  for (LatticeStencils const& of_body : rows_) rows += of_body.bytes();
  return rows + axis_.bytes() + records_.bytes() + part_.size() + sizeof(Offset) * begin_.size() +
         sizeof(Index) * neighbour_.size() + sizeof(float) * gradient_.size() +
         sizeof(double) * (s_.size() + W_.size()) + filled_.size();
}

}  // namespace piola::adaptle
