// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/formulations/setting_warnings.hpp"
#include "piola/guards/guard.hpp"
#include "piola/model/body_properties.hpp"
#include "piola/model/case_particles.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola {
namespace {

/// Kinetic energy counts as growing if its maximum at least doubles in this number of consecutive windows, each as long
/// as damping needs to reduce a velocity to 1 / e. One mode of vibration grows for a quarter of its period, at most 1.6
/// windows, because slower modes are overdamped.
constexpr double growing_windows = 3;
constexpr double least_growth = 2;
/// Fraction of the energy of the run below which changes are rounding.
constexpr double least_share = 1e-9;
constexpr double same = 1e-9;  ///< relative change of a steady load

/// Whether a pressure follows its face and varies along it: such a load is not conservative.
bool feeds_motion(LoadSpec const& load, ParticleSet const& particles, double time) {
  if (!load.follower || load.kind != LoadSpec::Kind::pressure) return false;
  auto const ids = loaded_particles(particles, *body_named(particles, load.body), load);
  return varies_between(ids, load.value[0], particles, time);
}

/// Whether the values of a load may be evaluated at any time.
bool holds_anywhere(LoadSpec const& load) {
  return std::all_of(load.value.begin(), load.value.end(), [](Expression const& e) { return e.holds_anywhere(); });
}

/// Watches for kinetic energy that grows although damping takes energy and every load is steady. A pressure that
/// follows its face and varies along the face feeds such motion (docs/theory/nodal.md, section 6). The guard judges
/// runs with `run.damping` only, because a vibration need not decay without damping, and loads that hold anywhere.
class FollowingLoadGuard : public Guard {
 public:
  FollowingLoadGuard(CaseSpec const& spec, ParticleSet const& particles) : spec_(spec), particles_(particles) {
    bool const follows =
        std::any_of(spec.loads.begin(), spec.loads.end(), [](LoadSpec const& load) { return load.follower; });
    bool const known = std::all_of(spec.loads.begin(), spec.loads.end(), holds_anywhere);
    judges_ = spec.run.damping > 0 && follows && known && !has_driven_support(spec);
  }

  void look(GuardInput const& look) override {
    if (!judges_) return;
    double const time = look.moment.time, kinetic = look.now.kinetic_energy;
    if (!steady(time)) {
      m_ = {.begun = time, .reported = m_.reported, .times = m_.times, .since = m_.since, .work = m_.work};
      return;
    }
    if (!(kinetic <= m_.most)) m_.most = kinetic;
    if (!(time - m_.begun >= 1 / spec_.run.damping)) return;
    bool const grows = m_.before > least_share * look.scale.value() && m_.most > least_growth * m_.before;
    if (!grows) {
      m_.rises = 0;
      m_.first = m_.most;
      m_.first_time = time;
      m_.first_work = look.now.external_work;
    } else {
      m_.rises += 1;
    }
    double const work = look.now.external_work - m_.first_work;
    if (m_.rises >= growing_windows && work > 0) {
      m_.reported = time;
      m_.times = m_.most / m_.first;
      m_.since = m_.first_time;
      m_.work = work;
    }
    m_.begun = time;
    m_.before = m_.most;
    m_.most = 0;
  }

  std::optional<GuardNumbers> numbers() const override {
    if (!judges_) return std::nullopt;
    return GuardNumbers{"following_load",
                        {{"growth", m_.times}, {"work", m_.work}, {"from_time", m_.since}, {"to_time", m_.reported}},
                        words()};
  }

  std::string words() const override {
    if (!(m_.times > 0)) return "";
    return fmt::format(
        "kinetic energy grew {:.2g} times from t = {:.6g} s to t = {:.6g} s while every load was steady, and the loads "
        "did work of {}: {} follows the face and varies along it, which is not conservative and feeds short waves - "
        "give the body fluctuation_viscosity = 0.05, or load it otherwise",
        m_.times, m_.since, m_.reported, quantity_text(m_.work, "J"), names(m_.reported));
  }

  void save(StateWriter& writer) const override {
    if (judges_)
      writer.put("guard_following_load", std::array{m_.begun, m_.most, m_.before, m_.rises, m_.first, m_.first_time,
                                                    m_.first_work, m_.reported, m_.times, m_.since, m_.work});
  }
  void load(NamedState& reader) override {
    if (!judges_ || !reader.has("guard_following_load")) return;
    std::array<double, 11> v{};
    reader.get("guard_following_load", v);
    m_ = {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8], v[9], v[10]};
  }

 private:
  /// Whether every load has the values of the begin of the window at the first, middle and last particle of its body.
  bool steady(double time) const {
    for (LoadSpec const& load : spec_.loads) {
      if ((m_.begun <= load.until) != (time <= load.until)) return false;
      Body const& body = *body_named(particles_, load.body);
      for (std::int64_t const id : {body.first, (body.first + body.last) / 2, body.last - 1})
        for (Expression const& value : load.value) {
          auto const& X = particles_.X[static_cast<std::size_t>(id)];
          double const before = value(X, m_.begun), now = value(X, time);
          if (std::fabs(now - before) > same * std::max(std::fabs(now), std::fabs(before))) return false;
        }
    }
    return true;
  }

  /// The loads that feed motion: "load 'moment'".
  std::string names(double time) const {
    std::string text;
    for (LoadSpec const& load : spec_.loads)
      if (feeds_motion(load, particles_, time))
        text += (text.empty() ? "" : " and ") +
                (load.name.empty() ? "the load of body " + in_quotes(load.body) : "load " + in_quotes(load.name));
    return text.empty() ? "a pressure" : text;
  }

  /// Energies and work [J], times [s].
  struct Memory {
    double begun = 0, most = 0;                           ///< present window: begin, maximum of kinetic energy so far
    double before = 0;                                    ///< maximum of the previous window
    double rises = 0;                                     ///< number of consecutive windows with growth
    double first = 0, first_time = 0, first_work = 0;     ///< maximum, end and work of the last window without growth
    double reported = 0, times = 0, since = 0, work = 0;  ///< end, growth, begin, work of the message; times 0: none
  };
  CaseSpec const& spec_;
  ParticleSet const& particles_;
  bool judges_ = false;
  Memory m_;
};

}  // namespace

std::unique_ptr<Guard> make_following_load_guard(CaseSpec const& spec, ParticleSet const& particles) {
  return std::make_unique<FollowingLoadGuard>(spec, particles);
}

}  // namespace piola
