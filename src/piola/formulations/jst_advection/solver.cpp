// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_advection/solver.hpp"
#include "piola/base/errors.hpp"
#include "piola/formulations/jst_advection/options.hpp"
#include "piola/formulations/jst_advection/wave.hpp"
#include "piola/materials/laws.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <stdexcept>

namespace piola::jst_advection {
namespace {

/// Rejects features that a periodic row does not have.
void check(Assembly const& assembly) {
  Problems problems;
  ParticleSet const& set = assembly.particles;
  if (set.bodies.size() != 1) problems.add({}, "jst_advection: there are several bodies (one is allowed) - keep one");
  if (set.dimension != 1)
    problems.add({}, "jst_advection: the body is not a line (one direction is allowed) - give the box one component");
  auto const [least, most] = std::minmax_element(set.volume.begin(), set.volume.end());
  if (set.size() < 5)
    problems.add({}, "jst_advection: too few particles (5 or more are needed) - make the spacing smaller");
  else if (*most - *least > 1e-9 * *most)
    problems.add(
        {},
        "jst_advection: the particles at the ends are halves (a periodic row needs equal ones) - give the shape "
        "placement = \"cell_centred\"");
  if (!assembly.supports.empty() || !assembly.loads.empty() || !assembly.mirrors.empty())
    problems.add({}, "jst_advection: a periodic row has no boundary - remove supports, loads and mirrors");
  problems.raise_if_any();
}

/// The velocity v_x of a periodic row, carried along by (C.1).
class Solver final : public Formulation {
 public:
  explicit Solver(Assembly const& assembly)
      : options_(read_options(assembly.formulations.front(), assembly.cfl)),
        volume_(assembly.particles.volume.front()),
        h_(assembly.particles.bodies.front().spacing[0]) {
    with_law(assembly.materials.front(), [&](auto const& law) { density_ = law.rho0; });
    for (auto const& X : assembly.particles.X) x_.push_back(X[0]);
    u_.resize(x_.size());
    if (!assembly.initial_velocity.empty())
      for (std::size_t a = 0; a < u_.size(); ++a) u_[a] = assembly.initial_velocity[a][0];
    remember_start();
  }

  double stable_time_step() const override { return options_.cfl * h_ / options_.wave_speed; }
  StepEstimate step_estimate_of_run() const override {
    StepEstimate rule;
    rule.settled = rule.first = stable_time_step();
    rule.limit = fmt::format("the speed that is given: run.cfl h / c with run.cfl = {}", options_.cfl);
    return rule;
  }
  void step(double time, double dt) override {
    u_ = advance(u_, options_.wave_speed * dt / h_, options_.eps4);
    time_ = time + dt;
  }
  void damp(double factor) override {
    for (double& u : u_) u *= factor;
  }
  std::optional<Failure> failure() const override {
    for (std::size_t a = 0; a < u_.size(); ++a)
      if (!std::isfinite(u_[a]))
        return Failure{.what = "has a velocity that is not a number",
                       .particle = static_cast<std::int64_t>(a),
                       .body = {},
                       .X = {x_[a], 0, 0},
                       .x = {x_[a], 0, 0},
                       .values = {{"cfl", options_.cfl}}};
    return std::nullopt;
  }

  Diagnostics diagnose() const override;
  std::vector<FieldInfo> fields() const override { return {{"Displacement", "m", 3}, {"Velocity", "m/s", 3}}; }
  void sample(std::string_view field, std::span<double> values) const override {
    bool const moves = field == "Velocity";
    if (!moves && field != "Displacement")
      throw std::invalid_argument("no field is named '" + std::string(field) + "'");
    std::fill(values.begin(), values.end(), 0.0);
    for (std::size_t a = 0; moves && a < u_.size(); ++a) values[3 * a] = u_[a];
  }

  void save(StateWriter& writer) const override {
    writer.put("velocity", u_);
    writer.put("start",
               std::array{time_, level_, static_cast<double>(mode_), coefficient_.real(), coefficient_.imag()});
  }
  void load(StateReader& reader) override {
    reader.get("velocity", u_);
    std::array<double, 5> start{};
    reader.get("start", start);
    time_ = start[0];
    level_ = start[1];
    mode_ = static_cast<int>(start[2]);
    coefficient_ = {start[3], start[4]};
  }

  int stages_per_step() const override { return 2; }
  std::size_t memory_bytes() const override { return 5 * u_.size() * sizeof(double); }

 private:
  void remember_start() {
    level_ = level(u_);
    mode_ = dominant_mode(u_);
    coefficient_ = fourier_coefficient(u_, mode_);
  }

  Options options_;
  double volume_, h_;      ///< m (per unit section), m
  double density_ = 0;     ///< kg/m^3
  std::vector<double> x_;  ///< m
  Wave u_;                 ///< m/s
  double time_ = 0;        ///< s
  // At the start: root mean square, strongest mode and its Fourier coefficient.
  double level_ = 0;
  int mode_ = 1;
  std::complex<double> coefficient_;
};

Diagnostics Solver::diagnose() const {
  Diagnostics d;
  for (double const v : u_) {
    d.kinetic_energy += 0.5 * density_ * volume_ * v * v;
    d.linear_momentum[0] += density_ * volume_ * v;
  }
  d.jacobian_min = d.jacobian_max = 1;
  auto const n = static_cast<double>(u_.size());
  NumericalError error;
  if (std::abs(coefficient_) > 0)
    error = numerical_error(fourier_coefficient(u_, mode_) / coefficient_, 2 * std::numbers::pi * mode_ / n,
                            options_.wave_speed * time_ / h_);
  double const amplitude = level_ > 0 ? level(u_) / level_ : 0;
  d.more = {{"dispersion", error.dispersion}, {"diffusion", error.diffusion}, {"amplitude", amplitude}};
  return d;
}

}  // namespace

std::unique_ptr<Formulation> make(Assembly const& assembly) {
  check(assembly);
  return std::make_unique<Solver>(assembly);
}

}  // namespace piola::jst_advection
