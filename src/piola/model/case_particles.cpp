// SPDX-License-Identifier: Apache-2.0
#include "piola/model/case_particles.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/model/region_checks.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

void check_body(BodySpec const& spec, ParticleSet const& particles, Body const& body, Problems& problems) {
  if (body.first == body.last) {
    problems.add(place_of(spec.places, "shape"),
                 "body " + in_quotes(spec.name) + " has no particles - make the spacing smaller or the body larger");
    return;
  }
  FormulaCheck const check(particles, body, problems);
  auto const dimension = static_cast<std::size_t>(particles.dimension);
  for (std::size_t d = 0; d < dimension; ++d) {
    std::string const index = "[" + std::to_string(d) + "]";
    check.finite(spec.initial_velocity[d], "body.initial_velocity" + index, place_of(spec.places, "initial_velocity"));
    if (spec.initial_displacement) {
      check.finite((*spec.initial_displacement)[d], "body.initial_displacement" + index,
                   place_of(spec.places, "initial_displacement"));
    }
  }
  if (spec.initial_temperature)
    check.finite(*spec.initial_temperature, "body.initial_temperature", place_of(spec.places, "initial_temperature"),
                 0);
  check_heat(spec, problems);
  if (spec.initial_deformation_gradient) {
    check.gradient(*spec.initial_deformation_gradient, place_of(spec.places, "initial_deformation_gradient"));
  }
}

// A point of the body is at most half a cell diagonal away from a particle; jitter adds to that.
bool check_point(ProbeSpec const& probe, double jitter, ParticleSet const& particles, Body const& body,
                 Problems& problems) {
  if (body.first == body.last) return false;
  double nearest2 = std::numeric_limits<double>::infinity();
  for (std::int64_t id = body.first; id < body.last; ++id) {
    double distance2 = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      double const part = (particles.X[static_cast<std::size_t>(id)][d] - probe.at[d]) / body.spacing[d];
      distance2 += part * part;
    }
    nearest2 = std::min(nearest2, distance2);
  }
  if (std::sqrt(nearest2) <= 1.2 + jitter) return true;
  problems.add(place_of(probe.places, "at"),
               "probe.at of " + in_quotes(probe.name) + " is " + point_text(probe.at, particles.dimension) +
                   ", outside body " + in_quotes(body.name) + " (" + box_of(particles, body) + ") - move the point");
  return false;
}

void check_tip(ProbeSpec const& probe, ParticleSet const& particles, Body const& body, Problems& problems) {
  if (!particles_ahead(particles, body, probe).empty()) return;
  auto const tip = static_cast<std::size_t>(nearest_particle(particles, body, probe.at));
  problems.add(
      place_of(probe.places, "from"),
      "probe " + in_quotes(probe.name) + " finds no particle " + number_text(probe.from) + " m to " +
          number_text(probe.to) + " m ahead of the tip at " + point_text(particles.X[tip], 2) + " in the direction (" +
          number_text(probe.direction[0], 4) + ", " + number_text(probe.direction[1], 4) +
          ") (allowed: one or more, within 1e-3 of the distance from that line) - change from, to or direction");
}

void check_reference(ProbeSpec const& probe, ParticleSet const& particles, Body const& body, Problems& problems) {
  std::vector<std::int64_t> const ids = select_particles(particles, body, probe.where ? &*probe.where : nullptr);
  FormulaCheck const check(particles, body, problems);
  for (std::size_t c = 0; c < probe.reference.size(); ++c) {
    check.finite(probe.reference[c], "probe.reference[" + std::to_string(c) + "]", place_of(probe.places, "reference"),
                 ids);
  }
}

}  // namespace

ParticleSet make_particles(CaseSpec const& spec, Problems& problems) {
  ParticleSet particles;
  particles.axisymmetric = is_in_sections(spec);
  for (BodySpec const& body : spec.bodies) {
    fill(body.shape, body.name, particles);
    open_cracks(spec, particles, problems);
  }
  mark_parts(spec, particles);
  return particles;
}

ParticleSet make_particles(CaseSpec const& spec) {
  Problems problems;
  ParticleSet particles = make_particles(spec, problems);
  problems.raise_if_any();
  return particles;
}

std::int64_t nearest_particle(ParticleSet const& particles, Body const& body, std::array<double, 3> const& at) {
  PIOLA_EXPECTS(body.first < body.last);
  std::int64_t best = body.first;
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::int64_t id = body.first; id < body.last; ++id) {
    std::array<double, 3> const& X = particles.X[static_cast<std::size_t>(id)];
    double const distance = std::hypot(X[0] - at[0], X[1] - at[1], X[2] - at[2]);
    if (distance >= best_distance) continue;
    best = id;
    best_distance = distance;
  }
  return best;
}

std::vector<std::int64_t> particles_ahead(ParticleSet const& particles, Body const& body, ProbeSpec const& probe) {
  constexpr double slack = 1e-6, aside = 1e-3;
  auto const& tip = particles.X[static_cast<std::size_t>(nearest_particle(particles, body, probe.at))];
  std::vector<std::int64_t> ids;
  for (std::int64_t id = body.first; id < body.last; ++id) {
    auto const& X = particles.X[static_cast<std::size_t>(id)];
    double const x = X[0] - tip[0], y = X[1] - tip[1], r = std::hypot(x, y);
    double const ahead = x * probe.direction[0] + y * probe.direction[1];
    double const off = x * probe.direction[1] - y * probe.direction[0];
    bool const in_range = r >= probe.from * (1 - slack) && r <= probe.to * (1 + slack);
    if (in_range && ahead > 0 && std::abs(off) <= aside * r) ids.push_back(id);
  }
  return ids;
}

std::vector<std::int64_t> select_particles(ParticleSet const& particles, Body const& body, Expression const* where) {
  PIOLA_EXPECTS(body.first >= 0 && body.last <= particles.size());
  std::vector<std::int64_t> ids;
  for (std::int64_t id = body.first; id < body.last; ++id) {
    if (where == nullptr || (*where)(particles.X[static_cast<std::size_t>(id)]) != 0) ids.push_back(id);
  }
  return ids;
}

std::vector<std::int64_t> supported_particles(ParticleSet const& particles, Body const& body,
                                              SupportSpec const& support) {
  if (!support.patch) return select_particles(particles, body, support.where ? &*support.where : nullptr);
  std::vector<std::int64_t> ids;
  for (FaceWeight const& share : supported_weights(particles, body, support)) ids.push_back(share.particle);
  return ids;
}

std::vector<FaceWeight> supported_weights(ParticleSet const& particles, Body const& body, SupportSpec const& support) {
  PIOLA_EXPECTS(support.patch.has_value());
  auto shares = face_weights(support.shape, particles, body, *support.patch);
  std::erase_if(shares, [&](FaceWeight const& share) {
    return support.where && (*support.where)(particles.X[static_cast<std::size_t>(share.particle)]) == 0;
  });
  return shares;
}

std::vector<std::int64_t> loaded_particles(ParticleSet const& particles, Body const& body, LoadSpec const& load) {
  if (!load.on_face()) return select_particles(particles, body, load.where ? &*load.where : nullptr);
  std::vector<std::int64_t> ids;
  for (FaceWeight const& share : loaded_weights(particles, body, load)) ids.push_back(share.particle);
  return ids;
}

std::vector<FaceWeight> loaded_weights(ParticleSet const& particles, Body const& body, LoadSpec const& load) {
  PIOLA_EXPECTS(load.on_face());
  auto shares = face_weights(load.shape, particles, body, load.face);
  std::erase_if(shares, [&](FaceWeight const& share) {
    return load.where && (*load.where)(particles.X[static_cast<std::size_t>(share.particle)]) == 0;
  });
  return shares;
}

void check_with_particles(CaseSpec const& spec, ParticleSet const& particles, Problems& problems) {
  PIOLA_EXPECTS(spec.bodies.size() == particles.bodies.size());
  for (std::size_t b = 0; b < spec.bodies.size(); ++b)
    check_body(spec.bodies[b], particles, particles.bodies[b], problems);
  check_parts(spec, particles, problems);
  check_boundaries(spec, particles, problems);
  check_rigid(spec, particles, problems);
  check_free_rigids(spec, particles.dimension, problems);
  check_overlap(spec, particles, problems);
  check_mirrored_contact(spec, particles, problems);
  check_ties(spec, particles, problems);
  check_abilities(spec, problems);
  check_axisymmetry(spec, particles, problems);
  for (ProbeSpec const& probe : spec.probes) {
    Body const* const body = body_named(particles, probe.body);
    if (body == nullptr) continue;
    double const jitter = spec.bodies[static_cast<std::size_t>(body - particles.bodies.data())].shape.jitter;
    bool const tip = probe.kind == ProbeSpec::Kind::stress_intensity;
    if (probe.kind == ProbeSpec::Kind::point || tip) {
      bool const inside = check_point(probe, jitter, particles, *body, problems);
      if (tip && inside) check_tip(probe, particles, *body, problems);
    }
    if (probe.anchored_where) {
      check_where(*probe.anchored_where, "probe.anchored_where", place_of(probe.places, "anchored_where"), particles,
                  *body, problems);
    }
    if (!probe.where) continue;
    check_where(*probe.where, "probe.where", place_of(probe.places, "where"), particles, *body, problems);
  }
  for (ProbeSpec const& probe : spec.probes) {
    Body const* const body = body_named(particles, probe.body);
    if (body != nullptr) check_reference(probe, particles, *body, problems);
  }
}

}  // namespace piola
