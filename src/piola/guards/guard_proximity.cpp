// SPDX-License-Identifier: Apache-2.0
#include "piola/exec/host_loops.hpp"
#include "piola/guards/guard.hpp"
#include "piola/input/contact_capabilities.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace piola {
namespace {

using Point = std::array<double, 3>;

constexpr double boundless = std::numeric_limits<double>::infinity();
constexpr std::int64_t search_interval = 1000;  ///< steps between two searches, which cost as much as a few steps
/// In spacings of the reference configuration: nearer particles of one body are neighbours, farther ones
/// non-neighbours.
constexpr double neighbours_within = 1.8, non_neighbours_beyond = 3;

double length_between(Point const& a, Point const& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

struct Pair {
  std::size_t a = 0, b = 0;
  double distance = boundless;  ///< in spacings
};

/// Particles that were far from each other at the start (or belong to different bodies) and now are so near that one
/// must have gone through the surface of the other.
class ProximityGuard : public Guard {
 public:
  ProximityGuard(CaseSpec const& spec, ParticleSet const& particles)
      : limit_(spec.run.guards.proximity),
        merging_(spec.contact && spec.contact->law == ContactRule::Law::none),
        particles_(particles) {
    auto const D = static_cast<std::size_t>(particles.dimension);
    for (Body const& body : particles.bodies) {
      auto const [least, most] = std::minmax_element(body.spacing.begin(), body.spacing.begin() + D);
      finest_.push_back(*least);
      coarsest_.push_back(*most);
    }
    // Surface contact may press particles onto each other; their depth has a guard of its own.
    for (std::size_t a = 0; a < spec.bodies.size(); ++a) {
      surfaces_.emplace_back();
      for (std::size_t b = 0; b < spec.bodies.size(); ++b) surfaces_.back().push_back(pushed_by_surface(spec, a, b));
    }
  }

  void look(GuardInput const& look) override {
    if (finest_.empty() || !look.fields.knows("Displacement")) return;
    if (!look.last && static_cast<double>(look.moment.step) < m_.next_step) return;
    m_.next_step = static_cast<double>(look.moment.step + search_interval);
    if (look.moment.step == 0) return;
    read(look);
    if (!moved()) return;
    m_.searches += 1;
    Pair const found = search();
    if (!(found.distance < m_.nearest)) return;
    m_.nearest = found.distance;
    m_.a = suspect(look.fields, found.a, look.moment.time);
    m_.b = suspect(look.fields, found.b, look.moment.time);
  }

  std::optional<GuardNumbers> numbers() const override {
    return GuardNumbers{
        "proximity", {{"nearest", m_.nearest}, {"time", m_.a.time}, {"searches", m_.searches}}, words()};
  }
  std::string words() const override {
    if (!(m_.nearest < limit_)) return "";
    auto const body = [&](Suspect const& s) { return particles_.body[static_cast<std::size_t>(s.id)]; };
    return fmt::format(
        "{}: at t = {:.6g} s {} was {:.2g} spacings from {} (limit {}) - nothing keeps them apart there; see "
        "docs/user/when-it-stops.md",
        body(m_.a) == body(m_.b) ? "a body goes through itself" : "bodies go through each other", m_.a.time,
        m_.a.text(particles_), m_.nearest, m_.b.text(particles_), limit_);
  }
  void save(StateWriter& writer) const override {
    writer.put("guard_strangers", std::array{m_.next_step, m_.searches, m_.nearest, m_.a.id, m_.a.time, m_.a.x[0],
                                             m_.a.x[1], m_.a.x[2], m_.b.id, m_.b.x[0], m_.b.x[1], m_.b.x[2]});
  }
  void load(NamedState& reader) override {
    std::array<double, 12> v{};
    reader.get("guard_strangers", v);
    m_ = {v[0], v[1], v[2], {v[3], v[4], {v[5], v[6], v[7]}}, {v[8], v[4], {v[9], v[10], v[11]}}};
  }

 private:
  void read(GuardInput const& look) {
    auto const x = look.fields.values("Position");
    x_.resize(particles_.X.size());
    for (std::size_t i = 0; i < x_.size(); ++i) x_[i] = {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
    eulerian_.clear();
    if (look.fields.knows("KernelType")) {
      for (double const phi : look.fields.values("KernelType")) eulerian_.push_back(phi > 0 ? 1 : 0);
    }
    // Deleted particles fly on without effect.
    if (column_of(look.now, "deleted_particles").value_or(0) > 0 && look.fields.knows("Damage")) {
      auto const damage = look.fields.values("Damage");
      for (std::size_t i = 0; i < x_.size(); ++i)
        if (damage[i] >= 1) x_[i] = {boundless, boundless, boundless};
    }
  }

  /// Whether displacements differ so much that non-neighbours can be near each other.
  bool moved() const {
    auto const sums = exec_host::parallel_sums<3>(static_cast<Index>(x_.size()), [&](Index k, double* way) {
      auto const i = static_cast<std::size_t>(k);
      for (std::size_t c = 0; c < 3; ++c) way[c] = x_[i][c] - particles_.X[i][c];
    });
    auto const count = static_cast<double>(x_.size());
    Point const mean{sums.value(0) / count, sums.value(1) / count, sums.value(2) / count};
    double const finest = *std::min_element(finest_.begin(), finest_.end());
    double const least = (finest_.size() > 1 ? 0.5 : non_neighbours_beyond - 0.5) * finest / 2;
    return std::any_of(x_.begin(), x_.end(), [&](Point const& x) {
      Point const& X = particles_.X[static_cast<std::size_t>(&x - x_.data())];
      return !(std::hypot(x[0] - X[0] - mean[0], x[1] - X[1] - mean[1], x[2] - X[2] - mean[2]) < least);
    });
  }

  Pair search() const {
    CellGrid const grid(x_, *std::max_element(finest_.begin(), finest_.end()));
    Pair best;
    for (std::size_t a = 0; a < x_.size(); ++a) {
      Pair const here = nearest_stranger(grid, a);
      if (here.distance < best.distance) best = here;
    }
    return best;
  }

  /// The non-neighbour that is nearer than every neighbour: in a body that is only crushed, its neighbours lie between.
  Pair nearest_stranger(CellGrid const& grid, std::size_t a) const {
    auto const body = static_cast<std::size_t>(particles_.body[a]);
    double const finest = finest_[body], coarsest = coarsest_[body];
    double neighbour = boundless, apart = boundless;  // [m]
    Pair best{a, a, boundless};
    grid.visit(x_[a], [&](Index other) {
      auto const b = static_cast<std::size_t>(other);
      if (b == a) return;
      double const now = length_between(x_[a], x_[b]);
      if (!(now < finest) || !(now < neighbour)) return;
      auto const its = static_cast<std::size_t>(particles_.body[b]);
      double const before = length_between(particles_.X[a], particles_.X[b]);
      if (its < surfaces_.size() && body < surfaces_.size() && surfaces_[body][its]) return;
      bool const same = its == body, both_eulerian = !eulerian_.empty() && eulerian_[a] != 0 && eulerian_[b] != 0,
                 one_eulerian = !eulerian_.empty() && (eulerian_[a] != 0 || eulerian_[b] != 0);
      if (same && before < neighbours_within * coarsest) neighbour = now;
      // Eulerian particles of one body, and of bodies that may merge, are neighbours wherever they come from.
      if (same ? one_eulerian || before < non_neighbours_beyond * coarsest : merging_ && both_eulerian) return;
      double const spacing = same ? finest : (finest + finest_[its]) / 2;
      if (!same && before < spacing) return;
      if (!(now / spacing < best.distance)) return;
      best = {a, b, now / spacing};
      apart = now;
    });
    return apart < neighbour ? best : Pair{};
  }

  struct Memory {
    double next_step = 0, searches = 0, nearest = boundless;
    Suspect a = {}, b = {};
  };
  double limit_;
  bool merging_;
  ParticleSet const& particles_;
  std::vector<double> finest_, coarsest_;    ///< spacings of each body [m]
  std::vector<std::vector<bool>> surfaces_;  ///< of pairs of bodies: pushed by their surfaces
  Memory m_;
  std::vector<Point> x_;
  std::vector<char> eulerian_;
};

}  // namespace

std::unique_ptr<Guard> make_proximity_guard(CaseSpec const& spec, ParticleSet const& particles) {
  return std::make_unique<ProximityGuard>(spec, particles);
}

}  // namespace piola
