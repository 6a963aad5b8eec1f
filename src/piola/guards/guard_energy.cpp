// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/guards/guard.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace piola {
namespace {

/// A rise counts if it lasts for this number of steps and checks: at the onset of a load, work and energy are accounted
/// for within a step of each other, and the relative size of such an error falls with the number of steps.
constexpr double lasting_steps = 50;
constexpr double lasting_looks = 3;

/// Total energy minus external work, which nothing but an error lets rise.
class EnergyGuard : public Guard {
 public:
  EnergyGuard(GuardLimits const& limits, ParticleSet const& particles) : limits_(limits), particles_(particles) {}

  void look(GuardInput const& look) override {
    double const own = energy_without_work(look.now);
    if (!std::isfinite(own)) return;
    auto const step = static_cast<double>(look.moment.step);
    if (!(own >= m_.lowest)) {
      m_.lowest = own;
      m_.lowest_time = look.moment.time;
      m_.lowest_step = step;
    }
    double const scale = look.scale.value(), share = scale > 0 ? (own - m_.lowest) / scale : 0;
    if (share >= limits_.energy_rise_warn / 2 && before_.empty()) before_ = kinetic_per_mass(look.fields, particles_);
    if (m_.rise == 0) m_.scale = scale;
    if (m_.looks == 0) m_.window_step = step;
    m_.least = m_.looks == 0 ? share : std::min(m_.least, share);
    m_.looks += 1;
    bool const lasts = m_.looks >= lasting_looks && step - m_.window_step >= lasting_steps;
    if (!lasts && !(look.last && m_.looks >= 2)) return;
    m_.looks = 0;
    confirm(look, m_.least, scale);
  }

  std::optional<GuardNumbers> numbers() const override {
    return GuardNumbers{"energy_rise",
                        {{"share", m_.rise},
                         {"energy", m_.scale},
                         {"from_time", m_.from_time},
                         {"from_step", m_.from_step},
                         {"to_time", m_.to_time}},
                        words()};
  }

  std::string words() const override {
    if (!(m_.rise > limits_.energy_rise_warn)) return "";
    return fmt::format(
        "energy rose without a load by {:.3g} % of {} from t = {:.6g} s (step {}) to t = {:.6g} s{} - try half of "
        "run.cfl, more particles or more stabilisation; see docs/user/when-it-stops.md",
        100 * m_.rise, quantity_text(m_.scale, "J"), m_.from_time, m_.from_step, m_.to_time,
        m_.where.known() ? ", most of it near " + m_.where.text(particles_) : "");
  }

  std::optional<StopRequest> stop_request() const override {
    if (!(m_.rise > limits_.energy_rise_stop)) return std::nullopt;
    StopRequest o;
    o.failure.what = "gains most of an energy that no load brings";
    if (m_.where.known()) {
      take_particle(o.failure, m_.where, particles_);
    } else {
      o.failure.what = "energy rises without a load";
    }
    o.failure.values = {
        {"rise [%]", 100 * m_.rise}, {"of [J]", m_.scale}, {"since t [s]", m_.from_time}, {"since step", m_.from_step}};
    o.causes = fmt::format(
        "often the step is too large (try half of run.cfl), or the scheme feeds a motion that it does not resist there "
        "(a jagged or free edge, a long free flight, too little stabilisation); run.guards.energy_rise_stop is {}",
        number_text(limits_.energy_rise_stop));
    return o;
  }

  void save(StateWriter& writer) const override {
    writer.put("guard_energy", std::array{m_.lowest, m_.lowest_time, m_.lowest_step, m_.window_step, m_.looks, m_.least,
                                          m_.rise, m_.scale, m_.from_time, m_.from_step, m_.to_time, m_.where.id,
                                          m_.where.time, m_.where.x[0], m_.where.x[1], m_.where.x[2]});
    if (!before_.empty()) writer.put("guard_energy_before", before_);
  }
  void load(NamedState& reader) override {
    std::array<double, 16> v{};
    reader.get("guard_energy", v);
    m_ = {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8], v[9], v[10], {v[11], v[12], {v[13], v[14], v[15]}}};
    if (reader.has("guard_energy_before")) before_ = reader.all("guard_energy_before");
  }

 private:
  void confirm(GuardInput const& look, double share, double scale) {
    if (share <= m_.rise) return;
    m_.rise = share;
    m_.scale = scale;
    m_.from_time = m_.lowest_time;
    m_.from_step = m_.lowest_step;
    m_.to_time = look.moment.time;
    if (share > limits_.energy_rise_warn)
      m_.where = most_moved(look.fields, particles_, before_, look.moment.time).value_or(m_.where);
  }

  struct Memory {
    double lowest = std::numeric_limits<double>::infinity(), lowest_time = 0, lowest_step = 0;
    double window_step = 0, looks = 0, least = 0;  ///< of the present window
    double rise = 0, scale = 0, from_time = 0, from_step = 0, to_time = 0;
    Suspect where = {};
  };
  GuardLimits limits_;
  ParticleSet const& particles_;
  Memory m_;
  std::vector<double> before_;
};

/// Energy dissipated by stabilisation, viscosity and the scheme itself.
class DissipationGuard : public Guard {
 public:
  explicit DissipationGuard(GuardLimits const& limits) : limit_(limits.dissipation) {}

  void look(GuardInput const& look) override {
    Diagnostics const& d = look.now;
    scale_ = look.scale.value();
    double const viscous = column_of(d, "viscous_loss").value_or(0);
    part_ = {d.stabilisation_loss, d.projection_loss, viscous, 0, 0};
    double const gone = look.scale.initial() + d.external_work - d.total_energy() - d.damping_loss;
    // Energy of deleted particles is no loss of the scheme, nor is intended damping of a case.
    bool const intended = column_of(d, "deleted_particles").value_or(0) > 0;
    double const rubbed = column_of(d, "friction_heat").value_or(0) + column_of(d, "chatter_damping_loss").value_or(0) +
                          column_of(d, "tie_dissipation").value_or(0) + column_of(d, "radiated_energy").value_or(0);
    if (!intended) part_[3] = gone - d.stabilisation_loss - d.projection_loss - rubbed;
    part_[4] = d.stabilisation_loss + d.projection_loss + rubbed - gone;
    for (double& p : part_) p = std::isfinite(p) ? std::max(p, 0.0) : 0.0;
    // As with a rise: the first checks under a load may miss most of it.
    looks_ = share() > limit_ ? looks_ + 1 : 0;
    last_ = look.last;
  }
  std::optional<GuardNumbers> numbers() const override {
    return GuardNumbers{"dissipation",
                        {{"share", share()},
                         {"stabilisation", of(0)},
                         {"projections", of(1)},
                         {"viscosity", of(2)},
                         {"unaccounted", of(3)},
                         {"scheme_gain", of(4)}},
                        words()};
  }
  std::string words() const override {
    if (!(share() > limit_) || (looks_ < lasting_looks && !last_)) return "";
    static constexpr std::array names{"stabilisation", "momentum projections", "viscosity and hourglass damping",
                                      "the time steps and averages of the scheme"};
    std::string parts;
    for (std::size_t k = 0; k < names.size(); ++k)
      if (of(k) > 0.001) parts += fmt::format("{}{} {:.3g} %", parts.empty() ? "" : ", ", names[k], 100 * of(k));
    if (of(4) > limit_) parts += fmt::format("), and fed {:.3g} % (out of nothing", 100 * of(4));
    return fmt::format(
        "the scheme took {:.3g} % of the energy ({}) - amplitudes and rebounds are too small by that; try more "
        "particles or less stabilisation (in a shock, viscosity is its heat)",
        100 * share(), parts);
  }
  void save(StateWriter& writer) const override {
    writer.put("guard_dissipation", std::array{scale_, part_[0], part_[1], part_[2], part_[3], part_[4], looks_});
  }
  void load(NamedState& reader) override {
    std::array<double, 7> v{};
    reader.get("guard_dissipation", v);
    scale_ = v[0];
    looks_ = v[6];
    std::copy_n(v.begin() + 1, 5, part_.begin());
  }

 private:
  double of(std::size_t part) const { return scale_ > 0 ? part_[part] / scale_ : 0; }
  double share() const { return of(0) + of(1) + of(2) + of(3); }
  double limit_;
  double scale_ = 0, looks_ = 0;  ///< looks: in a row with too large a loss
  bool last_ = false;
  std::array<double, 5> part_{};  ///< stabilisation, projections, viscosity, unaccounted for; energy supplied by the
                                  ///< scheme [J]
};

}  // namespace

std::unique_ptr<Guard> make_energy_guard(GuardLimits const& limits, ParticleSet const& particles) {
  return std::make_unique<EnergyGuard>(limits, particles);
}
std::unique_ptr<Guard> make_dissipation_guard(GuardLimits const& limits) {
  return std::make_unique<DissipationGuard>(limits);
}

}  // namespace piola
