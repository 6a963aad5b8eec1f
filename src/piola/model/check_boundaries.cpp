// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/mechanics/prescribed.hpp"
#include "piola/model/case_particles.hpp"
#include "piola/model/region_checks.hpp"
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace piola {
namespace {

using Vec3 = std::array<double, 3>;
using Projector = std::array<double, 9>;

/// A support or a mirror as a particle feels it: the part of its velocity along `along` is prescribed.
struct Hold {
  std::string name;  ///< e.g. "support.1", as settings write it
  Place place;
  Projector along{};
  std::optional<std::array<Expression, 3>> velocity;
  std::vector<std::int64_t> ids;
};

Projector projector_of(SupportSpec const& support, int dimension) {
  Projector P{};
  for (Direction const& d : directions_of(support, dimension))
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) P[3 * i + j] += d[i] * d[j];
  return P;
}

Projector product(Projector const& A, Projector const& B) {
  Projector C{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) C[3 * i + j] += A[3 * i + k] * B[3 * k + j];
    }
  }
  return C;
}

// The product of two projectors is symmetric exactly if what they hold is the same or at right angles, direction by
// direction; then one can be applied after the other.
bool fit_together(Projector const& PQ) {
  constexpr double rounding = 1e-9;
  return std::abs(PQ[1] - PQ[3]) < rounding && std::abs(PQ[2] - PQ[6]) < rounding && std::abs(PQ[5] - PQ[7]) < rounding;
}

Vec3 velocity_at(Hold const& hold, Vec3 const& X, double t) {
  Vec3 v{};
  for (std::size_t d = 0; hold.velocity && d < 3; ++d) v[d] = (*hold.velocity)[d](X, t);
  return v;
}

/// Whether both prescribe the same along what both hold. Formulas are compared at a few times.
bool agree(Hold const& a, Hold const& b, Projector const& both, Vec3 const& X, double end) {
  if (!a.velocity && !b.velocity) return true;
  for (double const part : {0.0, 0.1234, 0.5, 1.0}) {
    Vec3 const va = velocity_at(a, X, part * end), vb = velocity_at(b, X, part * end);
    double const size = std::hypot(va[0], va[1], va[2]) + std::hypot(vb[0], vb[1], vb[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      double difference = 0;
      for (std::size_t j = 0; j < 3; ++j) difference += both[3 * i + j] * (va[j] - vb[j]);
      if (std::abs(difference) > 1e-9 * size) return false;
    }
  }
  return true;
}

/// Looks for particles that two holds treat differently; each pair complains once.
class HoldCheck {
 public:
  HoldCheck(std::vector<Hold> const& holds, ParticleSet const& particles, double end, Problems& problems)
      : holds_(holds), particles_(particles), end_(end), problems_(problems) {}

  void run() {
    std::vector<std::vector<std::size_t>> on_particle(particles_.X.size());
    for (std::size_t h = 0; h < holds_.size(); ++h) {
      for (std::int64_t const id : holds_[h].ids) {
        auto& others = on_particle[static_cast<std::size_t>(id)];
        for (std::size_t const other : others) compare(other, h, id);
        others.push_back(h);
      }
    }
  }

 private:
  void compare(std::size_t first, std::size_t second, std::int64_t id) {
    if (reported_.contains({first, second})) return;
    Hold const &a = holds_[first], &b = holds_[second];
    Vec3 const& X = particles_.X[static_cast<std::size_t>(id)];
    Projector const both = product(a.along, b.along);
    bool const fit = fit_together(both);
    if (fit && agree(a, b, both, X, end_)) return;
    reported_.insert({first, second});
    std::string const body =
        particles_.bodies[static_cast<std::size_t>(particles_.body[static_cast<std::size_t>(id)])].name;
    problems_.add(b.place, b.name + " and " + a.name + place_text(a.place) + " both hold the particle at X = " +
                               point_text(X, particles_.dimension) + " of body " + in_quotes(body) +
                               (fit ? ", with different velocities (allowed: the same velocity)"
                                    : ", in directions that are askew (allowed: the same or at right angles)") +
                               " - let \"where\" leave it out of one of them");
  }

  static std::string place_text(Place const& place) {
    return place.line > 0 ? " (line " + std::to_string(place.line) + ")" : "";
  }

  std::vector<Hold> const& holds_;
  ParticleSet const& particles_;
  double end_;
  Problems& problems_;
  std::set<std::pair<std::size_t, std::size_t>> reported_;
};

Hold hold_of(SupportSpec const& support, std::size_t number, ParticleSet const& particles, Body const& body) {
  return {.name = "support." + std::to_string(number),
          .place = place_of(support.places, ""),
          .along = projector_of(support, particles.dimension),
          .velocity = support.velocity,
          .ids = supported_particles(particles, body, support)};
}

/// The particles of a face that lie in it: none of those that are half a spacing inside of it.
std::vector<std::int64_t> particles_on(Face const& face, ParticleSet const& particles, Body const& body) {
  auto ids = face_particles(particles, body, face);
  auto const axis = static_cast<std::size_t>(face.axis);
  double const at = face.upper ? body.outline.max[axis] : body.outline.min[axis];
  std::erase_if(ids, [&](std::int64_t id) {
    return std::abs(particles.X[static_cast<std::size_t>(id)][axis] - at) > 1e-6 * body.spacing[axis];
  });
  return ids;
}

// By symmetry the particles on a mirror never leave it, those on an antisymmetric one never move along it.
Hold hold_of(MirrorSpec const& mirror, std::size_t number, ParticleSet const& particles, Body const& body) {
  Hold hold{.name = "mirror." + std::to_string(number),
            .place = place_of(mirror.places, ""),
            .along = {},
            .velocity = {},
            .ids = particles_on(mirror.face, particles, body)};
  for (std::size_t i = 0; i < static_cast<std::size_t>(particles.dimension); ++i)
    hold.along[4 * i] = (static_cast<int>(i) == mirror.face.axis) != mirror.antisymmetric ? 1 : 0;
  return hold;
}

/// Whether condition and velocity are valid, so that the support can be compared with other supports.
bool check_support(SupportSpec const& support, ParticleSet const& particles, Body const& body, Problems& problems) {
  if (support.where &&
      !check_where(*support.where, "support.where", place_of(support.places, "where"), particles, body, problems))
    return false;
  std::vector<std::int64_t> const ids = supported_particles(particles, body, support);
  if (support.patch && ids.empty()) {
    problems.add(place_of(support.places, "patch"), "support.where selects no particle of the patch " +
                                                        in_quotes(face_text(support.shape, *support.patch)) +
                                                        " of body " + in_quotes(body.name) + " (" +
                                                        box_of(particles, body) + ") - change the condition");
    return false;
  }
  if (!support.velocity) return true;
  FormulaCheck const check(particles, body, problems);
  bool sound = true;
  for (std::size_t d = 0; d < static_cast<std::size_t>(particles.dimension); ++d) {
    if (support.frame == Support::Frame::axes && !support.fix[d]) continue;
    sound = check.finite((*support.velocity)[d], "support.velocity[" + std::to_string(d) + "]",
                         place_of(support.places, "velocity"), ids) &&
            sound;
  }
  return sound;
}

void check_load(LoadSpec const& load, ParticleSet const& particles, Body const& body, Problems& problems) {
  Place const place = place_of(load.places, "where");
  if (load.where && !check_where(*load.where, "load.where", place, particles, body, problems)) return;
  std::vector<std::int64_t> const ids = loaded_particles(particles, body, load);
  if (ids.empty() && body.first < body.last) {
    std::string const what =
        load.where ? "load.where, formula " + in_quotes(load.where->text()) + " selects no particle of the face "
                   : "no particle is at the face ";
    problems.add(place, what + in_quotes(face_text(load.shape, load.face)) + " of body " + in_quotes(body.name) + " (" +
                            box_of(particles, body) + ") - " +
                            (load.where ? "change the condition" : "load another face"));
  }
  std::string const key = load.value_key();
  FormulaCheck const check(particles, body, problems);
  if (load.kind == LoadSpec::Kind::pressure) {
    check.finite(load.value[0], "load.pressure", place_of(load.places, key), ids);
    return;
  }
  for (std::size_t d = 0; d < static_cast<std::size_t>(particles.dimension); ++d) {
    check.finite(load.value[d], "load." + key + "[" + std::to_string(d) + "]", place_of(load.places, key), ids);
  }
}

/// A support that holds all particles of a non-reflecting patch in all directions leaves it nothing to do.
void check_absorbing(CaseSpec const& spec, LoadSpec const& load, ParticleSet const& particles, Body const& body,
                     Problems& problems) {
  if (load.kind != LoadSpec::Kind::non_reflecting) return;
  for (SupportSpec const& support : spec.supports) {
    auto const directions = std::count(support.fix.begin(), support.fix.end(), true);
    if (support.body != load.body || directions < particles.dimension) continue;
    std::set<std::int64_t> held;
    for (auto const id : supported_particles(particles, body, support)) held.insert(id);
    auto const ids = loaded_particles(particles, body, load);
    if (!std::all_of(ids.begin(), ids.end(), [&](auto id) { return held.contains(id); })) continue;
    problems.add(place_of(load.places, "face"),
                 "a support holds all particles of the non-reflecting face " +
                     in_quotes(face_text(load.shape, load.face)) + " of body " + in_quotes(body.name) +
                     " (allowed: one of the two; static support by a traction or pressure) - remove one");
  }
}

bool check_mirror(CaseSpec const& spec, std::size_t number, Body const& body, Problems& problems) {
  MirrorSpec const& mirror = spec.mirrors[number];
  Place const place = place_of(mirror.places, "face");
  std::string const face = "the face " + in_quotes(face_text({}, mirror.face)) + " of body " + in_quotes(body.name);
  auto const axis = static_cast<std::size_t>(mirror.face.axis);
  if (body.lattice[axis] < 2) {
    problems.add(place, face + " cannot be a mirror, because the body has a single particle in " + "xyz"[axis] +
                            ", in its middle (allowed: 2 or more) - change body.shape.particles");
    return false;
  }
  for (std::size_t other = 0; other < number; ++other) {
    if (spec.mirrors[other].body != mirror.body || !(spec.mirrors[other].face == mirror.face)) continue;
    problems.add(place, face + " is a mirror already (allowed: one mirror per face) - remove one");
    return false;
  }
  for (LoadSpec const& load : spec.loads) {
    if (!load.on_face() || load.body != mirror.body || !(load.face == mirror.face)) continue;
    problems.add(
        place_of(load.places, "face"),
        face +
            " is a mirror, inside the whole body (allowed: tractions and pressures on other faces) - remove the load "
            "or the mirror");
  }
  return true;
}

}  // namespace

void check_boundaries(CaseSpec const& spec, ParticleSet const& particles, Problems& problems) {
  PIOLA_EXPECTS(spec.bodies.size() == particles.bodies.size());
  std::vector<Hold> holds;
  for (std::size_t s = 0; s < spec.supports.size(); ++s) {
    Body const* const body = body_named(particles, spec.supports[s].body);
    if (body != nullptr && check_support(spec.supports[s], particles, *body, problems))
      holds.push_back(hold_of(spec.supports[s], s, particles, *body));
  }
  for (LoadSpec const& load : spec.loads) {
    if (Body const* const body = body_named(particles, load.body)) {
      check_load(load, particles, *body, problems);
      check_absorbing(spec, load, particles, *body, problems);
    }
  }
  for (std::size_t m = 0; m < spec.mirrors.size(); ++m) {
    Body const* const body = body_named(particles, spec.mirrors[m].body);
    if (body != nullptr && check_mirror(spec, m, *body, problems))
      holds.push_back(hold_of(spec.mirrors[m], m, particles, *body));
  }
  HoldCheck(holds, particles, spec.run.end, problems).run();
}

}  // namespace piola
