// SPDX-License-Identifier: Apache-2.0
#include "piola/verification/block_law_battery.hpp"
#include "piola/materials/block_law.hpp"
#include "piola/math/polar.hpp"
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <thread>

namespace piola {
namespace {

using Gradient = Mat<3>;

/// A material point between two steps.
struct Point {
  Gradient F = identity<3>();
  std::array<double, 9> stress{};
  double energy = 0;
  std::vector<double> history;
  bool operator==(Point const& other) const {
    return stress == other.stress && history == other.history && energy == other.energy;
  }
};

/// An array between guard values that show whether code writes outside of it.
class GuardedArray {
 public:
  explicit GuardedArray(std::size_t size) : values_(size + 2 * guard, mark) {}
  double* data() { return values_.data() + guard; }
  bool intact() const {
    auto const is_mark = [](double value) { return value == mark; };
    return std::all_of(values_.begin(), values_.begin() + guard, is_mark) &&
           std::all_of(values_.end() - guard, values_.end(), is_mark);
  }

 private:
  static constexpr std::ptrdiff_t guard = 64;
  static constexpr double mark = -6.66e66;
  std::vector<double> values_;
};

/// The arrays of a block of points.
class Block {
 public:
  Block(BlockLaw const& law, std::vector<Point> const& points, std::vector<Gradient> const& F, std::size_t stride)
      : law_(law), count_(points.size()), stride_(stride), most_history_(std::max(1, law.history_count())) {
    for (std::size_t p = 0; p < count_; ++p) {
      put(points[p], F[p], p);
    }
  }

  /// One step of the points.
  int update(std::vector<Point>& points, std::vector<Gradient> const& F, double time, double dt) {
    auto const inputs = {&F_old_, &F_new_, &U_old_, &U_new_};
    std::vector<std::vector<double>> before;
    for (GuardedArray* array : inputs) before.emplace_back(array->data(), array->data() + 9 * stride_);
    bool const turned = law_.corotated();
    piola_points block{static_cast<int>(count_),
                       static_cast<int>(stride_),
                       time,
                       dt,
                       0,
                       nullptr,
                       F_old_.data(),
                       F_new_.data(),
                       turned ? U_old_.data() : nullptr,
                       turned ? U_new_.data() : nullptr,
                       stress_.data(),
                       energy_.data(),
                       history_.data(),
                       speed_.data()};
    int const code = law_.update(block);
    std::size_t k = 0;
    for (GuardedArray* array : inputs)
      changed_ = changed_ || !std::equal(before[k].begin(), before[k].end(), array->data()), ++k;
    for (std::size_t p = 0; p < count_; ++p) take(points[p], F[p], p);
    return code;
  }
  /// Whether the law has written where it may not.
  bool harmed() const {
    auto const all = {&F_old_, &F_new_, &U_old_, &U_new_, &stress_, &energy_, &history_, &speed_};
    return changed_ || !std::all_of(all.begin(), all.end(), [](GuardedArray const* array) { return array->intact(); });
  }

 private:
  void put(Point const& point, Gradient const& F, std::size_t p) {
    auto const at = [&](int c) { return static_cast<std::size_t>(c) * stride_ + p; };
    SymMat<3> const before = stretch_of(rotation_of(point.F), point.F), after = stretch_of(rotation_of(F), F);
    for (int c = 0; c < 9; ++c) {
      F_old_.data()[at(c)] = point.F.c[c];
      F_new_.data()[at(c)] = F.c[c];
      stress_.data()[at(c)] = point.stress[static_cast<std::size_t>(c)];
    }
    for (int c = 0; c < 6; ++c) {
      U_old_.data()[at(c)] = before.c[c];
      U_new_.data()[at(c)] = after.c[c];
    }
    for (int h = 0; h < law_.history_count(); ++h) history_.data()[at(h)] = point.history[static_cast<std::size_t>(h)];
    energy_.data()[p] = point.energy;
    speed_.data()[p] = law_.p_wave_speed();
  }
  void take(Point& point, Gradient const& F, std::size_t p) {
    auto const at = [&](int c) { return static_cast<std::size_t>(c) * stride_ + p; };
    point.F = F;
    for (int c = 0; c < (law_.corotated() ? 6 : 9); ++c)
      point.stress[static_cast<std::size_t>(c)] = stress_.data()[at(c)];
    for (int h = 0; h < law_.history_count(); ++h) point.history[static_cast<std::size_t>(h)] = history_.data()[at(h)];
    if (law_.elastic()) point.energy = energy_.data()[p];
  }

  BlockLaw const& law_;
  std::size_t count_, stride_;
  int most_history_;
  GuardedArray F_old_{9 * stride_}, F_new_{9 * stride_}, U_old_{9 * stride_}, U_new_{9 * stride_}, stress_{9 * stride_},
      energy_{stride_}, history_{static_cast<std::size_t>(most_history_) * stride_}, speed_{stride_};
  bool changed_ = false;
};

Gradient first_piola(BlockLaw const& law, Point const& point) {
  Gradient P;
  if (!law.corotated()) {
    std::copy(point.stress.begin(), point.stress.end(), P.c);
    return P;
  }
  SymMat<3> turned;
  std::copy_n(point.stress.begin(), 6, turned.c);
  Gradient const R = rotation_of(point.F);
  return (R * turned) * transpose(R) * cofactor(point.F);
}

double norm(Gradient const& A) { return std::sqrt(contract(A, A)); }

/// Rotation about (1, 2, 3).
Gradient rotation(double angle) {
  double const s = std::sin(angle) / std::sqrt(14.0), c = std::cos(angle), t = (1 - c) / 14;
  double const n[3]{1, 2, 3};
  Gradient Q;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) Q(i, j) = t * n[i] * n[j] + (i == j ? c : 0);
  Q(0, 1) -= 3 * s;
  Q(0, 2) += 2 * s;
  Q(1, 0) += 3 * s;
  Q(1, 2) -= s;
  Q(2, 0) -= 2 * s;
  Q(2, 1) += s;
  return Q;
}

/// Gradients of the battery at the end of their paths: stretch, compression, shear, all with turns.
std::vector<Gradient> gradients() {
  std::vector<Gradient> all;
  constexpr double size = 0.08;
  for (int k = 0; k < 27; ++k) {
    Gradient F = identity<3>();
    for (int c = 0; c < 9; ++c) F.c[c] += size * std::sin(1.0 + 2.3 * k + 1.7 * c);
    all.push_back(rotation(0.3 * k) * F);
  }
  return all;
}

class Battery {
 public:
  explicit Battery(MaterialParameters const& material)
      : law_(material), stiffness_(law_.rho0 * law_.p_wave_speed() * law_.p_wave_speed()), ends_(gradients()) {
    rest_.history.resize(static_cast<std::size_t>(law_.history_count()));
    law_.start(rest_.history.data());
  }

  std::vector<LawCheck> run() {
    std::vector<Point> const reference = at_ends(steps_);
    add("writes within its arrays, and not into its input", harmed_ ? 1 : 0, 0);
    add("returns 0 for stretches of 0.85 to 1.15", failed_ ? 1 : 0, 0);
    add("gives numbers", worst([&](std::size_t p) { return finite(reference[p]) ? 0.0 : 1.0; }), 0);
    add("is free of stress at rest, relative to the modulus", at_rest(), 1e-9);
    add("gives equal bits twice", differing(reference, at_ends(steps_)), 0);
    add("gives equal bits in several threads", in_threads(reference), 0);
    add("gives the same in a block and alone, relative to the largest stress", apart(reference, alone()), 1e-11);
    add("is objective: a turn of the body turns the stress alone", objective(reference), 1e-9);
    add("has a symmetric Cauchy stress", worst([&](std::size_t p) { return asymmetry(reference[p]); }), 1e-9);
    add("changes by less than this with a quarter of the step", apart(reference, at_ends(4 * steps_)), 0.02);
    if (law_.elastic())
      add("has a stress that is the derivative of its energy", derivative(), 1e-6);
    else
      add("dissipates: energy that a cycle of strain gains, relative to that of its way out", gained(), 1e-6);
    return checks_;
  }

 private:
  static constexpr int steps_ = 64;
  static constexpr double duration = 1e-3;  // s

  void add(char const* what, double value, double bound) { checks_.push_back({what, value, bound}); }
  template <class F>
  double worst(F const& of) const {
    double most = 0;
    for (std::size_t p = 0; p < ends_.size(); ++p) {
      double const value = of(p);
      most = value > most || value != value ? value : most;
    }
    return most;
  }
  static bool finite(Point const& point) {
    auto const is = [](double value) { return std::isfinite(value); };
    return std::all_of(point.stress.begin(), point.stress.end(), is) && std::isfinite(point.energy) &&
           std::all_of(point.history.begin(), point.history.end(), is);
  }

  void advance(std::vector<Point>& points, std::vector<Gradient> const& F, double time, double dt) {
    Block block(law_, points, F, points.size() + 3);
    failed_ = block.update(points, F, time, dt) != 0 || failed_;
    harmed_ = harmed_ || block.harmed();
  }
  /// From rest along straight lines of stretch, then turned; `turn`: of the whole path.
  std::vector<Gradient> on_the_way(double share, Gradient const& turn) const {
    std::vector<Gradient> F;
    for (Gradient const& end : ends_) F.push_back(turn * (identity<3>() + share * (end_shape(end) - identity<3>())));
    return F;
  }
  /// The end's stretch, as a path of rotations would pass through singular gradients.
  static Gradient end_shape(Gradient const& end) {
    SymMat<3> const U = stretch_of(rotation_of(end), end);
    Gradient shape;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) shape(i, j) = U(i, j);
    shape(0, 1) += 0.05;  // not symmetric: the material turns
    return shape;
  }
  std::vector<Point> at_ends(int steps, Gradient const& turn = identity<3>()) {
    std::vector<Point> points(ends_.size(), rest_);
    for (Point& point : points) point.F = turn;
    for (int k = 1; k <= steps; ++k)
      advance(points, on_the_way(static_cast<double>(k) / steps, turn), k * duration / steps, duration / steps);
    return points;
  }
  std::vector<Point> alone() {
    std::vector<Point> points(ends_.size(), rest_);
    for (int k = 1; k <= steps_; ++k) {
      auto const F = on_the_way(static_cast<double>(k) / steps_, identity<3>());
      for (std::size_t p = 0; p < points.size(); ++p) {
        std::vector<Point> one{points[p]};
        advance(one, {F[p]}, k * duration / steps_, duration / steps_);
        points[p] = one[0];
      }
    }
    return points;
  }
  double in_threads(std::vector<Point> const& reference) const {
    std::vector<double> apart(4);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < apart.size(); ++t)
      threads.emplace_back([&, t] {
        Battery mine(*this);
        apart[t] = mine.differing(reference, mine.at_ends(steps_));
      });
    for (std::thread& thread : threads) thread.join();
    return *std::max_element(apart.begin(), apart.end());
  }

  double at_rest() {
    std::vector<Point> one{rest_};
    advance(one, {identity<3>()}, 0, 0);
    return norm(first_piola(law_, one[0])) / stiffness_;
  }
  double differing(std::vector<Point> const& a, std::vector<Point> const& b) const {
    return worst([&](std::size_t p) { return a[p] == b[p] ? 0.0 : 1.0; });
  }
  double largest(std::vector<Point> const& points) const {
    return std::max(worst([&](std::size_t p) { return norm(first_piola(law_, points[p])); }), 1e-12 * stiffness_);
  }
  double apart(std::vector<Point> const& a, std::vector<Point> const& b) const {
    return worst([&](std::size_t p) { return norm(first_piola(law_, a[p]) - first_piola(law_, b[p])); }) / largest(a);
  }
  double objective(std::vector<Point> const& reference) {
    Gradient const Q = rotation(1.1);
    auto const turned = at_ends(steps_, Q);
    return worst([&](std::size_t p) {
             return norm(first_piola(law_, turned[p]) - Q * first_piola(law_, reference[p]));
           }) /
           largest(reference);
  }
  double asymmetry(Point const& point) const {
    Gradient const tau = first_piola(law_, point) * transpose(point.F);
    return norm(tau - transpose(tau)) / std::max(norm(tau), 1e-12 * stiffness_);
  }

  /// Energy along a straight line in the gradients, against the work of the stress by Simpson's rule.
  double derivative() {
    double most = 0;
    for (Gradient const& end : ends_) {
      Gradient const shape = end_shape(end), change = shape - identity<3>();
      constexpr double h = 1e-3;
      auto const at = [&](double share) {
        std::vector<Point> one{rest_};
        advance(one, {identity<3>() + share * change}, 0, 0);
        return one[0];
      };
      Point const before = at(1 - h), middle = at(1), after = at(1 + h);
      double const work =
          (2 * h / 6) * (contract(first_piola(law_, before), change) + 4 * contract(first_piola(law_, middle), change) +
                         contract(first_piola(law_, after), change));
      most = std::max(most, std::abs(after.energy - before.energy - work) /
                                (2 * h * std::max(norm(first_piola(law_, middle)), 1e-12 * stiffness_) * norm(change)));
    }
    return most;
  }

  /// Out and back; what the material gives more than it got.
  double gained() {
    std::vector<Point> points(ends_.size(), rest_);
    std::vector<double> work(ends_.size()), out(ends_.size());
    constexpr int steps = 8 * steps_;
    for (int k = 1; k <= 2 * steps; ++k) {
      auto const before = points;
      double const share = k <= steps ? static_cast<double>(k) / steps : 2 - static_cast<double>(k) / steps;
      advance(points, on_the_way(share, identity<3>()), k * duration / steps, duration / steps);
      for (std::size_t p = 0; p < points.size(); ++p) {
        work[p] +=
            0.5 * contract(first_piola(law_, before[p]) + first_piola(law_, points[p]), points[p].F - before[p].F);
        points[p].energy = work[p];
        out[p] = std::max(out[p], std::abs(work[p]));
      }
    }
    constexpr double truncation = 1e-3;  // of the trapezoidal rule on this path
    return worst([&](std::size_t p) { return std::max(0.0, -work[p] / std::max(out[p], 1e-300) - truncation); });
  }

  BlockLaw law_;
  double stiffness_;
  std::vector<Gradient> ends_;
  Point rest_;
  std::vector<LawCheck> checks_;
  bool failed_ = false, harmed_ = false;
};

}  // namespace

std::vector<LawCheck> check_block_law(MaterialParameters const& material) { return Battery(material).run(); }

double seconds_per_point(MaterialParameters const& material) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t number = 4096;
  BlockLaw const law(material);
  Point rest;
  rest.history.resize(static_cast<std::size_t>(law.history_count()));
  law.start(rest.history.data());
  std::vector<Point> points(number, rest);
  auto const some = gradients();
  std::vector<Gradient> F;
  for (std::size_t p = 0; p < number; ++p) F.push_back(some[p % some.size()]);
  Block block(law, points, F, number);
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 5; ++k) {
    auto const start = Clock::now();
    block.update(points, F, 1e-6, 1e-6);
    best = std::min(best, std::chrono::duration<double>(Clock::now() - start).count() / number);
  }
  return best;
}

}  // namespace piola
