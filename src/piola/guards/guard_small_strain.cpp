// SPDX-License-Identifier: Apache-2.0
#include "piola/guards/guard.hpp"
#include "piola/math/symmetric_eigen.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola {
namespace {

/// Angle of the rotation of a deformation gradient of small strain, with a relative error of the size of the strain.
/// F: row by row.
double rotation_of(double const* F) {
  double const x = F[7] - F[5], y = F[2] - F[6], z = F[3] - F[1];
  return std::atan2(0.5 * std::sqrt(x * x + y * y + z * z), 0.5 * (F[0] + F[4] + F[8] - 1));
}

/// The largest magnitude of a principal Green strain, at least `known`.
double strain_of(double const* F, double known) {
  SymMat<3> E;
  double square = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      double sum = i == j ? -1 : 0;
      for (int k = 0; k < 3; ++k) sum += F[3 * k + i] * F[3 * k + j];
      E(i, j) = 0.5 * sum;
      square += (i == j ? 1 : 2) * E(i, j) * E(i, j);
    }
  if (!(square > known * known)) return known;  // the norm is no less than any principal value
  double largest = known;
  for (double const value : symmetric_eigen(E).value) largest = std::max(largest, std::fabs(value));
  return largest;
}

/// Strain and rotation of bodies whose law is for small ones. P = C : (sym F - 1) has errors of first order. Cauchy's
/// stress P F^T / J differs from P, and from a symmetric tensor, by a relative (strain + rotation); a rotation by r
/// alone appears as a strain of r^2/2. At the default limits these are 2 % by strain, and 5 % and a strain of 0.00125
/// by rotation.
class SmallStrainGuard : public Guard {
 public:
  SmallStrainGuard(CaseSpec const& spec, ParticleSet const& particles)
      : limits_(spec.run.guards), particles_(particles) {
    for (BodySpec const& body : spec.bodies) {
      bool const with_gradient = body.formulation.name != "taylor_sph";
      watched_.push_back(body.law == "linear_elastic" && with_gradient);
    }
    any_ = std::find(watched_.begin(), watched_.end(), true) != watched_.end();
  }

  void look(GuardInput const& look) override {
    if (!any_ || !look.fields.knows("DeformationGradient")) return;
    auto const F = look.fields.values("DeformationGradient");
    for (std::size_t i = 0; i < F.size() / 9; ++i) {
      auto const body = static_cast<std::size_t>(particles_.body[i]);
      if (body >= watched_.size() || !watched_[body]) continue;
      observe(m_.strain, strain_of(&F[9 * i], m_.strain.value), i, look);
      observe(m_.rotation, rotation_of(&F[9 * i]), i, look);
    }
  }
  std::optional<GuardNumbers> numbers() const override {
    if (!any_) return std::nullopt;
    return GuardNumbers{"small_strain", {{"strain", m_.strain.value}, {"rotation", m_.rotation.value}}, words()};
  }
  std::string words() const override {
    std::string text;
    auto const add = [&](char const* what, Largest const& most, double limit, char const* unit) {
      if (!(most.value > limit)) return;
      text += fmt::format("{}the {} reached {:.3g}{} (limit {}) at t = {:.6g} s in {}", text.empty() ? "" : "; ", what,
                          most.value, unit, limit, most.where.time, most.where.text(particles_));
    };
    add("strain", m_.strain, limits_.small_strain_warn, "");
    add("rotation", m_.rotation, limits_.small_rotation_warn, " rad");
    if (text.empty()) return text;
    double const rotation = m_.rotation.value;
    return fmt::format(
        "linear_elastic is for small strain and rotation, but {} - there the stress is wrong by about {:.2g} % and not "
        "symmetric, and the rotation counts as a strain of {:.2g}; take saint_venant_kirchhoff (large rotation) or "
        "neo_hookean (large strain, too)",
        text, 100 * std::max(m_.strain.value, rotation), 1 - std::cos(rotation));
  }
  std::optional<StopRequest> stop_request() const override {
    bool const strained = m_.strain.value > limits_.small_strain_stop;
    if (!strained && !(m_.rotation.value > limits_.small_rotation_stop)) return std::nullopt;
    StopRequest o;
    take_particle(o.failure, strained ? m_.strain.where : m_.rotation.where, particles_);
    o.failure.what =
        strained ? "has a strain that linear_elastic is not for" : "has a rotation that linear_elastic is not for";
    o.failure.values = {{"largest strain", m_.strain.value}, {"largest rotation [rad]", m_.rotation.value}};
    o.causes = fmt::format(
        "linear_elastic is for small strain and rotation: take saint_venant_kirchhoff (large rotation) or neo_hookean "
        "(large strain, too); run.guards.{} is {}",
        strained ? "small_strain_stop" : "small_rotation_stop",
        strained ? limits_.small_strain_stop : limits_.small_rotation_stop);
    return o;
  }
  void save(StateWriter& writer) const override {
    writer.put(
        "guard_small_strain",
        std::array{m_.strain.value, m_.strain.where.id, m_.strain.where.time, m_.strain.where.x[0],
                   m_.strain.where.x[1], m_.strain.where.x[2], m_.rotation.value, m_.rotation.where.id,
                   m_.rotation.where.time, m_.rotation.where.x[0], m_.rotation.where.x[1], m_.rotation.where.x[2]});
  }
  void load(NamedState& reader) override {
    if (!reader.has("guard_small_strain")) return;  // checkpoints of older versions have none
    std::array<double, 12> v{};
    reader.get("guard_small_strain", v);
    m_.strain = {v[0], {v[1], v[2], {v[3], v[4], v[5]}}};
    m_.rotation = {v[6], {v[7], v[8], {v[9], v[10], v[11]}}};
  }

 private:
  struct Largest {
    double value = 0;
    Suspect where = {};
  };
  struct Memory {
    Largest strain, rotation;
  };
  static void observe(Largest& most, double value, std::size_t particle, GuardInput const& look) {
    if (!(value > most.value)) return;
    most = {value, suspect(look.fields, particle, look.moment.time)};
  }

  GuardLimits limits_;
  ParticleSet const& particles_;
  std::vector<bool> watched_;  ///< by body
  bool any_ = false;
  Memory m_;
};

}  // namespace

std::unique_ptr<Guard> make_small_strain_guard(CaseSpec const& spec, ParticleSet const& particles) {
  return std::make_unique<SmallStrainGuard>(spec, particles);
}

}  // namespace piola
