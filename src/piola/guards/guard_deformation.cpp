// SPDX-License-Identifier: Apache-2.0
#include "piola/guards/guard.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace piola {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Metals yield and gases of an explosive expand: any det F that their law allows is possible.
bool allows_any_jacobian(BodySpec const& body) {
  bool allows = false;
  with_solid(body.material, [&](auto const& law) { allows = law.yields || law.front_speed() > 0; });
  return allows;
}

/// det F of materials that do not yield.
class JacobianGuard : public Guard {
 public:
  JacobianGuard(CaseSpec const& spec, ParticleSet const& particles)
      : limits_(spec.run.guards.jacobian), particles_(particles) {
    for (BodySpec const& body : spec.bodies) watched_.push_back(!allows_any_jacobian(body));
  }

  void look(GuardInput const& look) override {
    Diagnostics const& d = look.now;
    m_.low = std::fmin(m_.low, d.jacobian_min);
    m_.high = std::fmax(m_.high, d.jacobian_max);
    bool const any = std::find(watched_.begin(), watched_.end(), true) != watched_.end();
    double const excess = this->excess(d.jacobian_min, d.jacobian_max);
    // A closer look costs as much as a frame: only when it became worse by a hundredth.
    if (!any || !(excess > 1) || !(excess > 1.01 * m_.looked_at)) return;
    m_.looked_at = excess;
    if (look.fields.knows("Jacobian")) find_worst(look);
  }
  std::optional<GuardNumbers> numbers() const override {
    if (!(m_.low <= m_.high)) return std::nullopt;
    GuardNumbers n{"jacobian", {{"min", m_.low}, {"max", m_.high}}, words()};
    if (m_.where.known())
      n.values.insert(n.values.end(), {{"worst", m_.worst}, {"particle", m_.where.id}, {"time", m_.where.time}});
    return n;
  }
  std::string words() const override {
    if (!m_.where.known()) return "";
    return fmt::format(
        "det F reached {:.3g} (expected of a material that does not yield: {} to {}) at t = {:.6g} s in {} - look "
        "there before you believe the rest: a load or unit that is wrong, or particles too coarse",
        m_.worst, limits_[0], limits_[1], m_.where.time, m_.where.text(particles_));
  }
  void save(StateWriter& writer) const override {
    writer.put("guard_jacobian", std::array{m_.low, m_.high, m_.looked_at, m_.worst, m_.where.id, m_.where.time,
                                            m_.where.x[0], m_.where.x[1], m_.where.x[2]});
  }
  void load(NamedState& reader) override {
    std::array<double, 9> v{};
    reader.get("guard_jacobian", v);
    m_ = {v[0], v[1], v[2], v[3], {v[4], v[5], {v[6], v[7], v[8]}}};
  }

 private:
  /// How far the range [low, high] is outside of the limits, as a factor above 1.
  double excess(double low, double high) const {
    return std::max(high / limits_[1], low > 0 ? limits_[0] / low : infinity);
  }
  void find_worst(GuardInput const& look) {
    auto const J = look.fields.values("Jacobian");
    double most = m_.where.known() ? excess(m_.worst, m_.worst) : 1;
    for (std::size_t i = 0; i < J.size(); ++i) {
      auto const body = static_cast<std::size_t>(particles_.body[i]);
      if (body < watched_.size() && !watched_[body]) continue;
      double const here = excess(J[i], J[i]);
      if (!(here > most)) continue;
      most = here;
      m_.worst = J[i];
      m_.where = suspect(look.fields, i, look.moment.time);
    }
  }

  struct Memory {
    double low = infinity, high = -infinity, looked_at = 0, worst = 1;
    Suspect where = {};
  };
  std::array<double, 2> limits_;
  ParticleSet const& particles_;
  std::vector<bool> watched_;  ///< by body
  Memory m_;
};

/// The largest value of a column since the start of the run.
class LargestGuard : public Guard {
 public:
  /// state: name in checkpoints, after "guard_".
  LargestGuard(std::string name, std::string column, std::string state)
      : name_(std::move(name)), column_(std::move(column)), state_("guard_" + std::move(state)) {}
  void look(GuardInput const& look) override {
    auto const now = column_of(look.now, column_);
    if (!now) return;
    seen_ = 1;
    if (*now > largest_ || (time_ == 0 && *now > 0)) {
      largest_ = *now;
      time_ = look.moment.time;
      grew(look);
    }
  }
  std::optional<GuardNumbers> numbers() const override {
    if (seen_ == 0) return std::nullopt;
    return GuardNumbers{name_, {{"largest", largest_}, {"time", time_}}, words()};
  }
  void save(StateWriter& writer) const override { writer.put(state_, std::array{seen_, largest_, time_}); }
  void load(NamedState& reader) override {
    std::array<double, 3> v{};
    reader.get(state_, v);
    seen_ = v[0];
    largest_ = v[1];
    time_ = v[2];
  }

 protected:
  virtual void grew(GuardInput const&) {}
  double largest() const { return largest_; }
  double time() const { return time_; }

 private:
  std::string name_, column_, state_;
  double seen_ = 0, largest_ = 0, time_ = 0;
};

/// Depth of contacts, and points that have gone through a surface.
class OverlapGuard : public LargestGuard {
 public:
  explicit OverlapGuard(GuardLimits const& limits)
      : LargestGuard("overlap", "contact_overlap", "overlap"), limit_(limits.overlap) {}
  void look(GuardInput const& look) override {
    LargestGuard::look(look);
    passages_ = look.now.passages;
    uncovered_ = look.now.uncovered;
    looked_at_ = look.moment.time;
  }
  std::string words() const override {
    std::string all;
    for (std::string const& words : {words_of_passages(), words_of_uncovered(), words_of_depth()})
      if (!words.empty()) all += (all.empty() ? "" : "; ") + words;
    return all;
  }
  std::optional<GuardNumbers> numbers() const override {
    std::optional<GuardNumbers> n = LargestGuard::numbers();
    double points = 0;
    for (Passage const& p : passages_) points += static_cast<double>(p.points);
    if (n && points > 0) n->values.emplace_back("points_through", points);
    return n;
  }

 private:
  std::string words_of_depth() const {
    if (!(largest() > limit_)) return "";
    return fmt::format(
        "contact overlap reached {:.3g} spacings (limit {}) at t = {:.6g} s: a particle is behind the face of a body "
        "or a rigid shape - try a stiffer contact (scale, closing_speed) or a smaller run.cfl",
        largest(), limit_, time());
  }
  std::string words_of_passages() const {
    if (!std::isfinite(limit_)) return "";
    std::string all;
    for (Passage const& p : passages_)
      all += fmt::format("{}{} surface point{} of {} went through the surface of {}", all.empty() ? "" : ", ", p.points,
                         p.points == 1 ? "" : "s", p.of, p.through);
    if (all.empty()) return "";
    return fmt::format(
        "{} by t = {:.6g} s (allowed: none): what follows is no answer - take particles as fine as the sharper of the "
        "two, a stiffer contact (scale) or less speed",
        all, looked_at_);
  }
  std::string words_of_uncovered() const {
    if (!std::isfinite(limit_)) return "";
    std::string all;
    for (UncoveredParticles const& p : uncovered_)
      all += fmt::format("{}{} particle{} of {} beside failed material: nothing keeps {} apart from {}",
                         all.empty() ? "" : ", ", p.particles, p.particles == 1 ? "" : "s", p.of,
                         p.particles == 1 ? "it" : "them", p.from);
    if (all.empty()) return "";
    return fmt::format(
        "{} at t = {:.6g} s (allowed: none) - take the formulation adaptle if what has failed meets something", all,
        looked_at_);
  }

  double limit_, looked_at_ = 0;
  std::vector<Passage> passages_;
  std::vector<UncoveredParticles> uncovered_;
};

/// Strain drift: strain of the cells between particles that their stress does not have (Taylor-SPH).
class StrainDriftGuard : public LargestGuard {
 public:
  StrainDriftGuard(GuardLimits const& limits, ParticleSet const& particles)
      : LargestGuard("strain_drift", "strain_drift", "parting"), limits_(limits), particles_(particles) {}
  std::string words() const override {
    if (!(largest() > limits_.strain_drift_warn)) return "";
    return fmt::format(
        "the strain of cells differs from that of their stress by {:.3g} (limit {}) at t = {:.6g} s{} - particles "
        "creep away without resistance; end the run earlier, or take more particles or configuration = \"fixed\"",
        largest(), limits_.strain_drift_warn, time(), where_.known() ? " near " + where_.text(particles_) : "");
  }
  std::optional<StopRequest> stop_request() const override {
    if (!(largest() > limits_.strain_drift_stop)) return std::nullopt;
    StopRequest o;
    o.failure.what = "has a cell whose strain is inconsistent with its stress";
    if (where_.known()) {
      auto const id = static_cast<std::size_t>(where_.id);
      o.failure.particle = static_cast<std::int64_t>(id);
      o.failure.body = particles_.bodies[static_cast<std::size_t>(particles_.body[id])].name;
      o.failure.X = particles_.X[id];
      o.failure.x = where_.x;
    } else {
      o.failure.what = "strain of cells is inconsistent with their stress";
    }
    o.failure.values = {{"strain without stress", largest()}};
    o.causes = fmt::format(
        "often jagged edges of a body that turns freely for many turns: particles there creep away without resistance; "
        "end the run earlier, take more particles or configuration = \"fixed\"; run.guards.strain_drift_stop is {}",
        limits_.strain_drift_stop);
    return o;
  }
  void save(StateWriter& writer) const override {
    LargestGuard::save(writer);
    writer.put("guard_parting_where", std::array{where_.id, where_.time, where_.x[0], where_.x[1], where_.x[2]});
  }
  void load(NamedState& reader) override {
    LargestGuard::load(reader);
    std::array<double, 5> v{};
    reader.get("guard_parting_where", v);
    where_ = {v[0], v[1], {v[2], v[3], v[4]}};
  }

 private:
  void grew(GuardInput const& look) override {
    if (!(largest() > limits_.strain_drift_warn) || !look.fields.knows("StrainDrift")) return;
    auto const all = look.fields.values("StrainDrift");
    auto const worst = std::max_element(all.begin(), all.end());
    if (worst != all.end())
      where_ = suspect(look.fields, static_cast<std::size_t>(worst - all.begin()), look.moment.time);
  }
  GuardLimits limits_;
  ParticleSet const& particles_;
  Suspect where_;
};

}  // namespace

std::unique_ptr<Guard> make_jacobian_guard(CaseSpec const& spec, ParticleSet const& particles) {
  return std::make_unique<JacobianGuard>(spec, particles);
}
std::unique_ptr<Guard> make_overlap_guard(GuardLimits const& limits) { return std::make_unique<OverlapGuard>(limits); }
std::unique_ptr<Guard> make_strain_drift_guard(GuardLimits const& limits, ParticleSet const& particles) {
  return std::make_unique<StrainDriftGuard>(limits, particles);
}

}  // namespace piola
