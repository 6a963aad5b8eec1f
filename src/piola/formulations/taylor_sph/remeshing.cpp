// SPDX-License-Identifier: Apache-2.0
// What of a body follows its motion: neighbour lists, smoothing lengths, cells; and its snapshots.
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/formulations/taylor_sph/body.hpp"
#include "piola/math/solve.hpp"
#include "piola/mechanics/rigid_rate.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace piola::taylor_sph {
namespace {

using Point = std::array<double, 3>;

/// Lists reach this much further than the kernels, so that they serve until distances have changed by half of it.
constexpr double skin = 0.2;
constexpr double largest_strain = 0.2;  ///< of squared distances: 10 % in length

/// Cells are rebuilt when the quality of one falls below this fraction of its value at construction.
constexpr double least_quality = 0.3;
constexpr long least_steps = 10;  ///< between two triangulations

struct Stopwatch {
  double& seconds;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  explicit Stopwatch(double& s) : seconds(s) {}
  Stopwatch(Stopwatch const&) = delete;
  Stopwatch& operator=(Stopwatch const&) = delete;
  ~Stopwatch() { seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }
};

double distance(Point const& a, Point const& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

/// A place with the side of a crack's face that it is on, if it is on one.
struct Place {
  Point X;
  int side;
};

/// Whether the segment from p to q passes through the crack.
bool is_blocked(Place const& p, Place const& q, Crack const& crack) {
  double const tx = crack.to[0] - crack.from[0], ty = crack.to[1] - crack.from[1], l2 = tx * tx + ty * ty;
  auto const along = [&](Point const& X) { return ((X[0] - crack.from[0]) * tx + (X[1] - crack.from[1]) * ty) / l2; };
  auto const height = [&](Place const& a) {
    double const h = (tx * (a.X[1] - crack.from[1]) - ty * (a.X[0] - crack.from[0])) / l2;
    bool const on_line = std::abs(h) < 1e-9;
    return on_line ? (a.side != 0 && along(a.X) > -1e-9 && along(a.X) < 1 + 1e-9 ? 1e-9 * a.side : 0.0) : h;
  };
  double const hp = height(p), hq = height(q);
  if (hp * hq >= 0) return false;
  double const share = hp / (hp - hq), s = along(p.X) + share * (along(q.X) - along(p.X));
  return s > (crack.tip_at_from ? 1e-9 : -1e-9) && s < 1 - (crack.tip_at_to ? 1e-9 : -1e-9);
}

/// Whether a point lies in a simplex, by barycentric coordinates.
bool is_inside(Point const& p, std::span<Index const> corners, Points const& x, int D) {
  double A[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, b[3] = {0, 0, 0};
  auto const corner = [&](std::size_t k) { return x[static_cast<std::size_t>(corners[k])]; };
  for (int i = 0; i < D; ++i) {
    auto const c = static_cast<std::size_t>(i);
    for (int k = 0; k < D; ++k) A[3 * i + k] = corner(static_cast<std::size_t>(k) + 1)[c] - corner(0)[c];
    b[i] = p[c] - corner(0)[c];
  }
  if (!(solve_in_place<3>(A, b) > 0)) return false;
  double first = 1;
  for (int k = 0; k < D; ++k) {
    if (b[k] < -1e-9) return false;
    first -= b[k];
  }
  return first > -1e-9;
}

/// The cells of `all` whose centres lie in one of `cover`, all simplices of the same points.
Cells cells_within(Cells const& all, Cells const& cover, Points const& x) {
  auto const middle = [&](Cells const& cells, Index c) {
    Point m{};
    for (Index const corner : cells.of(c))
      for (std::size_t k = 0; k < 3; ++k) m[k] += x[static_cast<std::size_t>(corner)][k] / cells.corners;
    return m;
  };
  Points centres;
  double widest = 0;
  for (Index c = 0; c < cover.count(); ++c) {
    centres.push_back(middle(cover, c));
    for (Index const corner : cover.of(c))
      widest = std::max(widest, distance(centres.back(), x[static_cast<std::size_t>(corner)]));
  }
  CellGrid const grid(centres, widest);
  Cells kept = all;
  kept.corner.clear();
  for (Index c = 0; c < all.count(); ++c) {
    Point const m = middle(all, c);
    bool inside = false;
    grid.visit(m, [&](Index other) { inside = inside || is_inside(m, cover.of(other), x, all.dimension); });
    if (inside) kept.corner.insert(kept.corner.end(), all.of(c).begin(), all.of(c).end());
  }
  return kept;
}

std::vector<double> flattened(Points const& points, int D) {
  std::vector<double> r;
  for (auto const& p : points) r.insert(r.end(), p.begin(), p.begin() + D);
  return r;
}

Points points_of(std::vector<double> const& values, int D) {
  Points r(values.size() / static_cast<std::size_t>(D));
  for (std::size_t k = 0; k < values.size(); ++k)
    r[k / static_cast<std::size_t>(D)][k % static_cast<std::size_t>(D)] = values[k];
  return r;
}

}  // namespace

Points TaylorBody::middles(Points const& x) const {
  Points r(at(cells_.count()));
  for (Index c = 0; c < cells_.count(); ++c) {
    for (Index const corner : cells_.of(c))
      for (std::size_t k = 0; k < 3; ++k) r[at(c)][k] += x[at(corner)][k];
    for (double& k : r[at(c)]) k /= cells_.corners;
  }
  return r;
}

/// Spacing that each cell stands for: its longest diagonal over that of a unit box.
std::vector<double> TaylorBody::search_radius_in_cells(Points const& x) const {
  std::vector<double> r(at(cells_.count()));
  bool const boxes = cells_.corners > D() + 1;
  double const unit = std::sqrt(D() == 1 ? 1.0 : boxes ? D() : 2.0);
  for (Index c = 0; c < cells_.count(); ++c) {
    auto const corners = cells_.of(c);
    double longest = 0;
    for (Index const a : corners)
      for (Index const b : corners) longest = std::max(longest, distance(x[at(a)], x[at(b)]));
    r[at(c)] = longest / unit;
  }
  return r;
}

std::vector<double> TaylorBody::reach_of_particles(std::vector<double> const& cells) const {
  std::vector<double> r(X_.size(), 0);
  for (Index c = 0; c < cells_.count(); ++c)
    for (Index const corner : cells_.of(c)) r[at(corner)] = std::max(r[at(corner)], cells[at(c)]);
  return r;
}

bool TaylorBody::sees(Index particle, Index cell) const {
  Point middle{};
  for (Index const corner : cells_.of(cell))
    for (std::size_t k = 0; k < 3; ++k) middle[k] += X_[at(corner)][k] / cells_.corners;
  Place const p{X_[at(particle)], crack_side_[at(particle)]};
  return std::none_of(cracks_.begin(), cracks_.end(), [&](Crack const& crack) {
    return is_blocked(p, {middle, 0}, crack);
  });
}

void TaylorBody::make_lists(Points const& x) {
  Stopwatch const watch(seconds_.lists);
  x_of_lists_ = x;
  if (options_.adjoint) return note_distances(x);
  auto cell_h = search_radius_in_cells(x), real_h = reach_of_particles(cell_h);
  for (auto* all : {&cell_h, &real_h})
    for (double& h : *all) h *= options_.smoothing_length;
  Points const middle = middles(x);
  std::vector<int> const corners(middle.size(), D() + 1);
  // On a plain side two sources (in 3D three) give the derivatives that are needed there; edges and corners need more.
  std::vector<int> least(X_.size(), D() + 1);
  for (Index i = 0; i < particles(); ++i)
    if (boundary_.sides(i) == 1) least[at(i)] = D();
  std::vector<Index> slot_of_cell(at(state_.virtual_count));
  std::iota(slot_of_cell.begin(), slot_of_cell.end(), 0);
  std::vector<Index> in_slot = slot_of_cell;
  in_slot.resize(at(state_.virtuals.last), -1);
  std::function<bool(Index, Index)> real_sees, cell_sees;
  if (!cracks_.empty()) {
    real_sees = [&](Index particle, Index cell) { return sees(particle, cell); };
    cell_sees = [&](Index cell, Index particle) { return sees(particle, cell); };
  }
  double const reach = state_.k.moving ? skin : 0;
  to_virtual_.build({middle, x, cell_h, 2, reach, corners, in_slot, slot_of_, cell_sees}, backend_->lanes,
                    state_.boundary.last);
  to_real_.build({x, middle, real_h, 2, reach, least, local_of_, slot_of_cell, real_sees}, backend_->lanes,
                 state_.virtuals.last);
  state_.to_virtual = to_virtual_.table();
  state_.to_real = to_real_.table();
  note_distances(x);
}

/// Squared distances between the corners of each cell, from which it is seen when lists have served their time.
void TaylorBody::note_distances(Points const& x) {
  int const lanes = backend_->lanes;
  Index const pairs = cells_.corners * (cells_.corners - 1) / 2;
  reference_square_.assign(at(state_.virtuals.last) * pairs, 0);
  for (Index v = 0; v < state_.virtuals.last; ++v) {
    auto const corners = cells_.of(cell_in_slot(v));
    Index pair = 0;
    for (std::size_t a = 0; a < corners.size(); ++a)
      for (std::size_t b = a + 1; b < corners.size(); ++b, ++pair) {
        double const d = distance(x[at(corners[a])], x[at(corners[b])]);
        reference_square_[(at(v / lanes) * pairs + pair) * lanes + v % lanes] = d * d;
      }
  }
  state_.cells.reference_square = reference_square_.data();
}

/// Impulse of tractions and accelerations, and its moment, with the places of half time.
void TaylorBody::add_impulses(double time, double dt, std::vector<Push> const* tractions) {
  PIOLA_EXPECTS(dt >= 0);
  std::vector<ImpulseSum> of_load(of_load_.size());
  auto const add = [&](std::size_t load, std::array<double, 3> const& x, std::array<double, 3> const& impulse) {
    of_load[load].add(x, impulse);
  };
  visit_pushes(time, dt, tractions, add);
  for (std::size_t load = 0; load < of_load.size(); ++load) {
    of_load_[load] = of_load[load].value();
    for (std::size_t c = 0; c < 3; ++c) {
      momentum_[c] += of_load_[load].linear[c];
      momentum_[3 + c] += of_load_[load].angular[c];
    }
  }
}

template <class F>
void TaylorBody::visit_pushes(double time, double dt, std::vector<Push> const* tractions, F const& add) {
  double const back = state_.k.moving ? -0.5 * dt : 0;
  boundary_.each_acceleration(time + 0.5 * dt, [&](std::size_t load, Index i, std::array<double, 3> a) {
    for (double& c : a) c *= dt * mass_[at(i)];
    add(load, place_at(i, back), a);
  });
  if (tractions != nullptr) {
    for (Push const& push : *tractions) add(push.load, place_at(push.particle, back), push.impulse);
    return;
  }
  if (!boundary_.has_tractions()) return;
  turn_boundary(back);
  for (double const t : {time, time + dt})
    boundary_.each_traction(t, [&](std::size_t load, Index i, std::array<double, 3> f) {
      for (double& c : f) c *= 0.5 * dt;
      add(load, surface_positions_[at(i)], f);
    });
  turn_boundary(0);
}

/// Normals and areas of the surface as it is when it has drifted on for a time.
void TaylorBody::turn_boundary(double ahead) {
  for (Index const i : boundary_.particles()) surface_positions_[at(i)] = place_at(i, ahead);
  boundary_.turn(surface_positions_);
}

/// Interpolation between two sets of particles does not conserve momentum. The rigid motion that restores it is found
/// as for the projections of JST-SPH: momentum and moment of momentum at the end of the step are those of the start
/// plus the impulse of the loads.
void TaylorBody::conserve_momentum() {
  double now[MotionSums::size];
  backend_->motion(state_, now);
  RateSums sums;
  sums.volume = now[MotionSums::mass];
  for (int c = 0; c < 3; ++c) {
    auto const k = static_cast<std::size_t>(c);
    sums.x[c] = now[MotionSums::x + c];
    sums.f[c] = now[MotionSums::v + c] - momentum_[k];
    sums.moment[c] = now[MotionSums::moment + c] - momentum_[3 + k];
  }
  std::copy_n(now + MotionSums::xx, 6, sums.xx);
  RigidRate const g = balancing_rate(sums, D());
  double const rate[9] = {g.spin[0], g.spin[1],   g.spin[2],   g.push[0],  g.push[1],
                          g.push[2], g.centre[0], g.centre[1], g.centre[2]};
  backend_->add_rigid(state_, rate);
}

Index TaylorBody::worst_corner() const {
  Points const x = positions();
  Index worst = 0;
  for (Index c = 1; c < cells_.count(); ++c)
    if (volume_of(cells_, c, x) < volume_of(cells_, worst, x)) worst = c;
  return cells_.of(worst).front();
}

void TaylorBody::follow_motion() {
  measures_ = backend_->place(state_);
  // A cell that doubled since its lists were made, or was crushed to a fiftieth, is as lost as one turned inside out.
  constexpr double doubled = 3, crushed = 0.02;
  bool const lost_lists = !options_.adjoint && !(measures_.strain < doubled);
  if (lost_lists || !(measures_.spacing > crushed * first_spacing_)) measures_.inverted = true;
  // Distances that change by 10 % in every step, or cells that are spoilt in no time, are no motion that steps resolve.
  constexpr long most_hasty = 25;
  if (successive_list_updates_ > most_hasty) measures_.inverted = true;
  if (measures_.inverted || failure_.index != FailureSlot::none) return;
  try {
    renew_lists();
  } catch (InputError const& error) {  // at the start this is an input error, later a body that came apart
    lost_ = {worst_corner(), fmt::format("is in a body whose cells or lists cannot be rebuilt ({})", error.what())};
  }
}

void TaylorBody::renew_lists() {
  if (measures_.quality < least_quality && steps_since_triangulation_ >= least_steps && triangulate_anew()) return;
  if (lost_) return;
  if (options_.adjoint || measures_.strain < largest_strain) {
    if (steps_since_triangulation_ > least_steps) successive_list_updates_ = 0;
    return;
  }
  make_lists(positions());
  ++list_updates_;
  ++successive_list_updates_;
  measures_ = backend_->place(state_);
}

/// Delaunay triangulation of the current positions, restricted to the cells before it, which cover the body at any
/// deformation. False if nothing would change.
bool TaylorBody::triangulate_anew() {
  constexpr long hasty = 5;  // a triangulation at the earliest possible time counts as this number of lists
  if (triangulations_ > 0 && steps_since_triangulation_ <= least_steps) successive_list_updates_ += hasty;
  steps_since_triangulation_ = 0;
  if (!cracks_.empty() || options_.lattice_cells) return false;
  Points const now = positions();
  Cells inside;
  {
    Stopwatch const watch(seconds_.triangulation);
    Cells const all = delaunay(now, D(), 2 * largest_radius_);
    inside = cells_within(all, cells_, now);
  }
  std::vector<bool> held(X_.size());
  for (Index const corner : inside.corner) held[at(corner)] = true;
  auto const lonely = std::find(held.begin(), held.end(), false);
  if (lonely != held.end()) {
    lost_ = {static_cast<Index>(lonely - held.begin()), "has no cell left around it"};
    return false;
  }
  ++triangulations_;
  Snapshot s = snapshot();
  s.x_of_lists = s.x_of_cells = s.x;
  s.corners.assign(inside.corner.begin(), inside.corner.end());
  for (auto* per_cell : {&s.cell_stress, &s.cell_across, &s.cell_hourglass}) per_cell->clear();
  s.energy_totals[4] = static_cast<double>(triangulations_);
  restore(s);
  return true;
}

Snapshot TaylorBody::snapshot() const {
  Snapshot s;
  int const n = D() * (D() + 1) / 2;
  for (Index i = 0; i < particles(); ++i) {
    double const* const own = record(i);
    s.x.insert(s.x.end(), own, own + D());
    s.volume.push_back(own[D()]);
    s.v.insert(s.v.end(), own + D() + 1, own + stress_place());
    s.stress.insert(s.stress.end(), own + stress_place(), own + stress_place() + n);
    s.across.push_back(across_.at(slot_of_[at(i)]));
    for (int c = 0; c < D(); ++c) {
      s.drift.push_back(drift_.at(slot_of_[at(i)], c));
      s.displacement.push_back(displacement_.at(slot_of_[at(i)], c));
    }
  }
  s.x_of_lists = flattened(x_of_lists_, D());
  s.x_of_cells = flattened(x_of_cells_, D());
  s.corners.assign(cells_.corner.begin(), cells_.corner.end());
  for (Index c = 0; c < cells_.count() && options_.adjoint; ++c) {
    double const* const stress = cell_stress(c);
    s.cell_stress.insert(s.cell_stress.end(), stress, stress + n);
    s.cell_across.push_back(cell_across_[at(c)]);
    auto const patterns = patterns_of(c);
    s.cell_hourglass.insert(s.cell_hourglass.end(), patterns.begin(), patterns.end());
  }
  s.energy_totals = {work_,
                     power_,
                     state_.filter_loss,
                     static_cast<double>(list_updates_),
                     static_cast<double>(triangulations_),
                     static_cast<double>(steps_since_triangulation_),
                     static_cast<double>(successive_list_updates_)};
  s.energy_totals.insert(s.energy_totals.end(), momentum_.begin(), momentum_.end());
  s.energy_totals.insert(s.energy_totals.end(), {state_.exchange_loss, last_step_, damping_loss_});
  return s;
}

/// Pointer to the stress of a cell inside its record.
double* TaylorBody::cell_stress(Index cell) const {
  return state_.virtual_ + std::ptrdiff_t{cell} * record_stride(D()) + stress_place();
}

std::span<double> TaylorBody::patterns_of(Index cell) const {
  auto const size = static_cast<std::size_t>(state_.memory.patterns * D());
  return {state_.memory.hourglass + at(cell) * size, size};
}

/// New cells take the mean stress of their corners.
void TaylorBody::restore_cells(Snapshot const& s) {
  int const n = D() * (D() + 1) / 2;
  bool const known = !s.cell_stress.empty();
  for (Index c = 0; c < cells_.count(); ++c) {
    double* const stress = cell_stress(c);
    auto const first = static_cast<std::size_t>(c) * static_cast<std::size_t>(n);
    for (int k = 0; k < n; ++k) {
      double mean = 0;
      for (Index const corner : cells_.of(c)) mean += record(corner)[stress_place() + k] / cells_.corners;
      stress[k] = known ? s.cell_stress[first + static_cast<std::size_t>(k)] : mean;
    }
    double mean = 0;
    for (Index const corner : cells_.of(c)) mean += across_.at(slot_of_[at(corner)]) / cells_.corners;
    cell_across_[at(c)] = known ? s.cell_across[at(c)] : mean;
    auto const patterns = patterns_of(c);
    if (s.cell_hourglass.empty()) continue;
    std::copy_n(s.cell_hourglass.begin() + static_cast<std::ptrdiff_t>(at(c) * patterns.size()), patterns.size(),
                patterns.begin());
  }
}

void TaylorBody::restore(Snapshot const& s) {
  cells_.corner.clear();
  for (double const corner : s.corners) cells_.corner.push_back(static_cast<Index>(corner));
  arrange(points_of(s.x_of_cells, D()));
  int const n = D() * (D() + 1) / 2;
  for (Index i = 0; i < particles(); ++i) {
    double* const own = record(i);
    auto const k = static_cast<std::ptrdiff_t>(i);
    std::copy_n(s.x.begin() + k * D(), D(), own);
    own[D()] = s.volume[at(i)];
    std::copy_n(s.v.begin() + k * D(), D(), own + D() + 1);
    std::copy_n(s.stress.begin() + k * n, n, own + stress_place());
    across_.at(slot_of_[at(i)]) = s.across[at(i)];
    for (int c = 0; c < D(); ++c) {
      auto const from = at(i) * D() + c;
      drift_.at(slot_of_[at(i)], c) = s.drift[from];
      displacement_.at(slot_of_[at(i)], c) = s.displacement[from];
    }
  }
  work_ = s.energy_totals[0];
  power_ = s.energy_totals[1];
  state_.filter_loss = s.energy_totals[2];
  list_updates_ = static_cast<long>(s.energy_totals[3]);
  triangulations_ = static_cast<long>(s.energy_totals[4]);
  steps_since_triangulation_ = static_cast<long>(s.energy_totals[5]);
  successive_list_updates_ = static_cast<long>(s.energy_totals[6]);
  std::copy_n(s.energy_totals.begin() + 7, 6, momentum_.begin());
  state_.exchange_loss = s.energy_totals[13];
  last_step_ = s.energy_totals[14];
  damping_loss_ = s.energy_totals[15];
  if (options_.adjoint) restore_cells(s);
  make_lists(points_of(s.x_of_lists, D()));
  measures_ = backend_->place(state_);
  if (!(first_spacing_ > 0)) first_spacing_ = measures_.spacing;
}

}  // namespace piola::taylor_sph
