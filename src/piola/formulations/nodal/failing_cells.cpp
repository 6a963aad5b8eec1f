// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/failing_cells.hpp"
#include "piola/formulations/nodal/eulerian_cell.hpp"
#include <algorithm>
#include <cmath>

namespace piola::nodal {
namespace {

/// Volume ratio below which a point breaks an intact cell, and the mean ratio detaches a broken one.
constexpr double least_ratio = 0.1;
/// Softening from which a cell of a crack opens. Chosen by trials, see docs/decisions/29-nodal-failure.md.
constexpr double opens = 0.95;
/// The particle of a cell that has broken is detached when it is farther from where an intact cell expects it, in
/// spacings.
constexpr double tether = 1;
/// Volume ratio and norms of F and of its inverse at which an intact cell becomes Eulerian, if it may.
constexpr double least_volume = 0.3, most_volume = 3, most_norm = 4.5;
/// Least volume ratio and mean stretch of an Eulerian cell whose neighbours have parted.
constexpr double least_torn = 1.02, most_stretch = 1.4;

/// Whether an intact cell has softened so far by a crack that it opens.
bool is_opening(NodalBody const& body, Index slot) {
  return body.failure_value(slot, FailureLayout::largest_stress) > 0 &&
         body.failure_value(slot, FailureLayout::softening) >= opens;
}

/// sqrt(A:A) over the D directions that a body has.
double norm_in_space(Mat<3> const& A, int D) {
  double sum = 0;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) sum += A(i, j) * A(i, j);
  return std::sqrt(sum);
}

/// Equivalent strain sqrt(2/3 E':E') of the Green-Lagrange strain, eq. (18) of docs/theory/adaptle.md.
double equivalent_strain(Mat<3> const& F) {
  Mat<3> const E = 0.5 * (transpose(F) * F - identity<3>());
  double const mean = trace(E) / 3;
  double square = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double const deviator = E(i, j) - (i == j ? mean : 0);
      square += deviator * deviator;
    }
  return std::sqrt(2.0 / 3 * square);
}

/// Deformation gradient of a cell, mean over its points; 1 across the plane.
Mat<3> mean_gradient(NodalBody const& body, Index slot) {
  Mat<3> F = identity<3>();
  int const D = body.state().dimension;
  for (int c = 0; c < D * D; ++c) F(c / D, c % D) = body.mean_of_points(slot, HistoryLayout::F + c);
  return F;
}

/// Root mean square of the stretch between a particle and those that were within 1.5 spacings at the start.
double mean_stretch(NodalBody const& body, Index slot) {
  auto const& s = body.state();
  auto const& r = body.reference();
  double sum = 0, count = 0;
  for (auto k = r.begin[static_cast<std::size_t>(slot)]; k < r.begin[static_cast<std::size_t>(slot) + 1]; ++k) {
    Index const b = r.neighbour[static_cast<std::size_t>(k)];
    double spacings = 0, before = 0, now = 0;
    for (int c = 0; c < s.dimension; ++c) {
      double const X = value_at(s.X, b, c) - value_at(s.X, slot, c), x = value_at(s.x, b, c) - value_at(s.x, slot, c),
                   h = body.body().spacing[static_cast<std::size_t>(c)];
      spacings += X * X;
      before += X * X * h * h;
      now += x * x;
    }
    if (!(spacings > 0 && spacings < 2.25)) continue;
    sum += now / before;
    count += 1;
  }
  return count > 0 ? std::sqrt(sum / count) : 1;
}

/// Whether the gradients and the surface of a failed cell are without use, because its neighbours have parted or were
/// pressed into each other. Gradients tell it of a broken cell, the neighbours themselves of an Eulerian one.
bool is_torn(NodalBody const& body, Index slot) {
  if (body.state().has.converts)
    return body.failure_value(slot, FailureLayout::volume_factor) > least_torn &&
           mean_stretch(body, slot) > most_stretch;
  Mat<3> const F = mean_gradient(body, slot);
  int const D = body.state().dimension;
  return !(norm_in_space(F, D) < most_norm && norm_in_space(inverse(F), D) < most_norm);
}

/// Whether an intact cell becomes Eulerian by its strain, or because it is so deformed that its gradients do not serve.
bool converts(NodalBody const& body, Index slot) {
  auto const& s = body.state();
  if (!s.has.converts) return false;
  Mat<3> F = mean_gradient(body, slot);
  int const D = s.dimension;
  if (D == 2) F(2, 2) = body.mean_of_points(slot, HistoryLayout::F + 4);
  double const J = volume_ratio_at(s, slot), norm = norm_in_space(F, D), inverse_norm = norm_in_space(inverse(F), D);
  return !(J > least_volume && J < most_volume && norm < most_norm && inverse_norm < most_norm) ||
         equivalent_strain(F) >= body.options().convert_strain;
}

/// Particles of broken cells that are farther than the tether from where the gradient of an intact cell has them.
void find_detached(NodalBody const& body, Index slot, std::vector<Refits::Change>& found) {
  auto const& s = body.state();
  auto const& r = body.reference();
  int const D = s.dimension;
  double const h = *std::min_element(body.body().spacing.begin(), body.body().spacing.begin() + D);
  double F[3][3];
  for (int c = 0; c < D; ++c)
    for (int J = 0; J < D; ++J) F[c][J] = body.mean_of_points(slot, HistoryLayout::F + c * D + J);
  for (auto k = r.begin[static_cast<std::size_t>(slot)]; k < r.begin[static_cast<std::size_t>(slot) + 1]; ++k) {
    auto const at = static_cast<std::size_t>(k);
    Index const b = r.neighbour[at], owner = r.owner(b);
    if (!(r.weight[at] > 0) || r.refits->is_intact(owner)) continue;
    double square = 0;
    for (int c = 0; c < D; ++c) {
      double apart = value_at(s.x, b, c) - value_at(s.x, slot, c);
      for (int J = 0; J < D; ++J) {
        auto const axis = static_cast<std::size_t>(J);
        apart -= F[c][J] * (value_at(s.X, b, J) - value_at(s.X, slot, J)) * body.body().spacing[axis];
      }
      square += apart * apart;
    }
    if (!(square < tether * tether * h * h)) found.push_back({owner, CellCondition::detached});
  }
}

}  // namespace

std::vector<Refits::Change> find_failing(NodalBody const& body, std::vector<char> const& near_crack) {
  std::vector<Refits::Change> found;
  for (Index i = body.own().first; i < body.own().last; ++i) {
    switch (body.condition(i)) {
      case CellCondition::intact:
      case CellCondition::opening:
        if (body.failure_value(i, FailureLayout::softening) >= 1 ||
            !(value_at(body.state().change, i, 1) > least_ratio))
          found.push_back({i, CellCondition::broken});
        else if (converts(body, i))
          found.push_back({i, CellCondition::broken});
        else if (body.condition(i) == CellCondition::intact && is_opening(body, i))
          found.push_back({i, CellCondition::opening});
        else if (near_crack[static_cast<std::size_t>(i)] != 0)
          find_detached(body, i, found);
        break;
      case CellCondition::broken:
        if ((!body.state().has.converts && !(volume_ratio_at(body.state(), i) > least_ratio)) || is_torn(body, i))
          found.push_back({i, CellCondition::detached});
        break;
      case CellCondition::detached: break;
    }
  }
  return found;
}

}  // namespace piola::nodal
