// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/guards/guard.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace piola {
namespace {

/// Particles are searched again once the step is shorter by a tenth: a search costs as much as a frame.
constexpr double worse = 0.9;

/// The largest initial speed of up to a thousand particles of a body [m/s].
double speed_at_start(BodySpec const& spec, ParticleSet const& particles, Body const& body) {
  constexpr std::int64_t most = 1000;
  double largest = 0;
  for (std::int64_t id = body.first; id < body.last; id += std::max<std::int64_t>(1, (body.last - body.first) / most)) {
    auto const& X = particles.X[static_cast<std::size_t>(id)];
    auto const& v = spec.initial_velocity;
    largest = std::max(largest, std::hypot(v[0](X), v[1](X), v[2](X)));
  }
  return largest;
}

/// cfl times spacing over the initial speed of waves and of the motion, smallest of all bodies [s]; infinity if no law
/// has a wave speed.
double step_of_waves(CaseSpec const& spec, ParticleSet const& particles) {
  constexpr double usual_cfl = 0.3;
  std::vector<double> speed;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b)
    speed.push_back(speed_at_start(spec.bodies[b], particles, particles.bodies[b]));
  return (std::isnan(spec.run.cfl) ? usual_cfl : spec.run.cfl) * crossing_time(spec, particles, speed);
}

/// The step as a fraction of the one that waves at rest allow. Impact and fracture shorten it by 100 at most; below a
/// thousandth, the default of run.guards.step_warn, the particle that limits it is no longer part of any answer. The
/// run stops at a millionth (run.min_step), or below run.guards.step_stop.
class StepGuard : public Guard {
 public:
  StepGuard(CaseSpec const& spec, ParticleSet const& particles)
      : warn_(spec.run.guards.step_warn),
        stop_(spec.run.guards.step_stop),
        waves_(step_of_waves(spec, particles)),
        particles_(particles) {}

  void look(GuardInput const& look) override {
    TimeState const& now = look.moment;
    if (now.step == 0 || now.cut_to_end || now.bounded_by_max_step || !(now.dt > 0)) return;
    reference_ = std::isfinite(waves_) ? waves_ : now.first_dt;
    if (!(now.dt < m_.least)) return;
    m_.least = now.dt;
    m_.time = now.time;
    bool const first_to_stop = fraction() < stop_ && !(m_.searched / reference_ < stop_);
    if (!(fraction() < std::max(warn_, stop_)) || !(first_to_stop || m_.least < worse * m_.searched)) return;
    m_.searched = m_.least;
    find_where(look);
  }
  std::optional<GuardNumbers> numbers() const override {
    if (!std::isfinite(m_.least)) return std::nullopt;
    return GuardNumbers{"step", {{"least", m_.least}, {"share", fraction()}, {"time", m_.time}}, words()};
  }
  std::string words() const override {
    if (!(fraction() < warn_)) return "";
    std::string const what =
        fmt::format("the step fell to {} at t = {:.6g} s, {:.2g} of the {} that waves at rest allow (limit {})",
                    quantity_text(m_.least, "s"), m_.time, fraction(), quantity_text(reference_, "s"), warn_);
    std::string const particle =
        m_.where.known() ? fmt::format("{} has det F = {:.3g}", m_.where.text(particles_), m_.jacobian) : "";
    constexpr double deformed = 0.1;  // change of volume
    if (particle.empty() || std::fabs(m_.jacobian - 1) > deformed)
      return what + (particle.empty() ? "" : "; ") + particle +
             " - the rest of the run costs more by that factor, and what is crushed or torn there is no answer any "
             "more: look at the last frame, take more particles or a law that fails, or end the run earlier";
    return what + "; no particle is crushed or torn (" + particle +
           ") - the formulation itself asks for it, as of a body that is too thin for it: take more particles across, "
           "give run.cfl, or take another formulation";
  }
  std::optional<StopRequest> stop_request() const override {
    if (!(fraction() < stop_)) return std::nullopt;
    StopRequest o;
    if (m_.where.known()) take_particle(o.failure, m_.where, particles_);
    o.failure.what = m_.where.known() ? "has changed its volume most where the time step fell" : "time step fell";
    o.failure.values = {{"step / step of waves at rest", fraction()}, {"step of waves at rest [s]", reference_}};
    if (m_.where.known()) o.failure.values.emplace_back("det F", m_.jacobian);
    o.causes = fmt::format(
        "a particle is crushed or torn, or the body is too thin for its formulation: take more particles or a law that "
        "fails, or end the run earlier; run.guards.step_stop is {}",
        stop_);
    return o;
  }
  void save(StateWriter& writer) const override {
    writer.put("guard_step", std::array{m_.least, m_.time, m_.searched, m_.jacobian, reference_, m_.where.id,
                                        m_.where.time, m_.where.x[0], m_.where.x[1], m_.where.x[2]});
  }
  void load(NamedState& reader) override {
    if (!reader.has("guard_step")) return;  // checkpoints of older versions have none
    std::array<double, 10> v{};
    reader.get("guard_step", v);
    m_ = {v[0], v[1], v[2], v[3], {v[5], v[6], {v[7], v[8], v[9]}}};
    reference_ = v[4];
  }

 private:
  double fraction() const { return std::isfinite(m_.least) && reference_ > 0 ? m_.least / reference_ : 1; }

  /// Finds the particle whose volume has changed most, which often, but not always, limits the step.
  void find_where(GuardInput const& look) {
    if (!look.fields.knows("Jacobian")) return;
    auto const J = look.fields.values("Jacobian");
    auto const change = [](double j) {
      return j > 0 ? std::fabs(std::log(j)) : std::numeric_limits<double>::infinity();
    };
    auto const most = std::max_element(J.begin(), J.end(), [&](double a, double b) { return change(a) < change(b); });
    if (most == J.end()) return;
    m_.jacobian = *most;
    m_.where = suspect(look.fields, static_cast<std::size_t>(most - J.begin()), look.moment.time);
  }

  struct Memory {
    double least = std::numeric_limits<double>::infinity(), time = 0;  ///< [s]
    double searched = std::numeric_limits<double>::infinity();         ///< step at the last search [s]
    double jacobian = 1;
    Suspect where = {};
  };
  double warn_, stop_;            ///< limits of fraction()
  double waves_, reference_ = 0;  ///< [s]
  ParticleSet const& particles_;
  Memory m_;
};

}  // namespace

std::unique_ptr<Guard> make_step_guard(CaseSpec const& spec, ParticleSet const& particles) {
  return std::make_unique<StepGuard>(spec, particles);
}

}  // namespace piola
