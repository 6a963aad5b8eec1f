// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/particle_data.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/adaptle/contact.hpp"
#include "piola/formulations/adaptle/records.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include "piola/math/circle.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace piola::adaptle {
namespace {

template <int D>
int spatial_stride(Settings const& s) {
  return s.corrected ? SpatialRecord<D, true>::stride(s.artificial_stress)
                     : SpatialRecord<D, false>::stride(s.artificial_stress);
}

/// Sets the constants of a body from its law. kernel_volume: of spatial sums, in volumes of a particle.
template <class Law>
void take_constants(Law const& law, BodyOptions const& o, double kernel_volume, BodyConstants& b) {
  b.releases = o.releases && !law.brittle;  // broken material still carries shear under pressure
  b.rho0 = law.rho0;
  b.least_rho = law.rho0 / kernel_volume;
  b.bulk_modulus = law.kappa;
  b.shear_modulus = law.mu;
  b.yield_stress = law.yield_stress({{}, 0, law.initial_temperature(), 0, 0}, 0);
  b.burst_pressure = law.rho0 * law.front_speed() * law.front_speed() / 4;  // Chapman-Jouguet with gamma = 3
  b.c = o.bulk_speed ? law.bulk_sound_speed() : law.p_wave_speed();
  b.shear_share = std::max(0.01, law.s_wave_speed() / law.p_wave_speed());
  b.young = 9 * law.kappa * law.mu / (3 * law.kappa + law.mu);
  b.poisson = (3 * law.kappa - 2 * law.mu) / (2 * (3 * law.kappa + law.mu));
}

ContactLaw law_of(ContactRule const& rule) {
  switch (rule.law) {
    case ContactRule::Law::kernel: return ContactLaw::kernel;
    case ContactRule::Law::linear: return ContactLaw::linear;
    case ContactRule::Law::as_published: return ContactLaw::as_published;
    default: return ContactLaw::none;
  }
}

FieldNeeds field_needs(Assembly const& assembly, Options const& options) {
  bool const lagrangian = std::any_of(options.bodies.begin(), options.bodies.end(),
                                      [](BodyOptions const& o) { return o.description != Description::eulerian; });
  return {.lagrangian = lagrangian,
          .kernel_sums = lagrangian && options.settings.equations.stores_kernel(),
          .thickness = options.settings.plane_stress || options.settings.axisymmetric,
          .axisymmetric = options.settings.axisymmetric,
          .touching = assembly.particles.bodies.size() > 1 || !assembly.rigid_shapes.empty()};
}

}  // namespace

ParticleData::ParticleData(Assembly const& assembly, Options const& options)
    : set_(assembly.particles), system_(&memory_, field_needs(assembly, options)) {
  PIOLA_EXPECTS(options.bodies.size() == set_.bodies.size());
  system_.dimension = set_.dimension;
  system_.settings = options.settings;
  system_.shared = comm::is_parallel();
  set_bodies(assembly, options);
  set_contact(assembly);
  allocate(options);
  set_descriptions(options);
}

void ParticleData::set_bodies(Assembly const& assembly, Options const& options) {
  for (std::size_t k = 0; k < set_.bodies.size(); ++k) {
    Body const& from = set_.bodies[k];
    BodyOptions const& o = options.bodies[k];
    BodyConstants b;
    b.material = assembly.materials[k];
    b.axisymmetric = options.settings.axisymmetric;
    b.first = static_cast<Index>(from.first);
    b.last = static_cast<Index>(from.last);
    for (std::size_t c = 0; c < at(set_.dimension); ++c)
      b.spacing = c == 0 ? from.spacing[c] : std::max(b.spacing, from.spacing[c]);
    b.h = o.smoothing_length * b.spacing;
    double const reach = set_.dimension == 2 ? std::numbers::pi * std::pow(2 * o.smoothing_length, 2)
                                             : 4 * std::numbers::pi / 3 * std::pow(2 * o.smoothing_length, 3);
    b.reference_h = o.material_smoothing_length * b.spacing;
    b.alpha = o.alpha;
    b.beta = o.beta;
    b.artificial_stress = o.artificial_stress;
    b.hourglass = o.hourglass;
    b.hourglass_stiffness = o.hourglass_stiffness;
    b.sheared_cfl = o.sheared_cfl;
    b.convert_strain = o.convert_strain;
    b.convert_damage = o.convert_damage;
    b.jacobian_min = o.jacobian_min;
    b.jacobian_max = o.jacobian_max;
    b.tether = o.tether;
    b.adaptive = o.description == Description::adaptive || o.description == Description::patch;
    if (o.description == Description::patch) b.tether = b.adaptive = false;
    b.lagrangian = o.description == Description::total_lagrangian;
    b.deletes = o.deletes;
    with_solid(b.material, [&](auto const& law) { take_constants(law, o, reach, b); });
    body_.push_back(b);
  }
}

void ParticleData::set_contact(Assembly const& assembly) {
  std::vector<std::array<double, 3>> mean(body_.size());
  for (std::size_t b = 0; b < body_.size() && !assembly.initial_velocity.empty(); ++b)
    for (std::size_t c = 0; c < 3; ++c) {
      Index const first = body_[b].first, n = body_[b].last - first;
      auto const& velocity = assembly.initial_velocity;
      mean[b][c] = exec_host::parallel_sum(n, [&](Index k) { return velocity[at(first + k)][c]; }) / n;
    }
  contact_pairs_ = contact_pairs(system_.dimension, assembly.contact, body_, mean);
  exclude_tied_pairs(assembly.ties, body_.size(), contact_pairs_);
  mark_surface_contact(assembly, contact_pairs_);
  system_.contact.pair = contact_pairs_.data();
  system_.contact.published_stiffness = assembly.contact.stiffness;
  system_.contact.scale = assembly.contact.scale;
  system_.contact.law = law_of(assembly.contact);
}

void ParticleData::allocate(Options const& options) {
  auto const n = static_cast<std::size_t>(set_.size());
  System& s = system_;
  constexpr Index guard = 16;  // loops read whole lanes
  s.particles = static_cast<Index>(n);
  std::size_t const slots = at(s.all_slots());
  memory_.each_without_memory([&](Field& field) { field.allocate(s.all_slots(), guard); });
  memory_.bind();
  for (std::size_t b = 0; b < body_.size(); ++b)
    body_of_.insert(body_of_.end(), at(body_[b].last - body_[b].first), static_cast<int>(b));
  for (Index image = s.particles; image < s.all_slots(); ++image)
    body_of_.push_back(body_of_[at(image > s.particles ? s.source_of(image) : 0)]);
  if (options.settings.corrected) correction_ = LazyZeroArray<Correction>(n);
  position_ = LazyZeroArray<double>(3 * (slots + guard));
  eulerian_.resize(slots);
  partial_.resize(16 * (n / 64 + 2));
  s.bodies = static_cast<int>(body_.size());
  s.body = body_.data();
  s.body_of = body_of_.data();
  s.correction = correction_.data();
  s.position = position_.data();
  for (BodyConstants const& b : body_) s.smallest_radius = std::max(s.smallest_radius, 1e-3 * b.spacing);
  s.description.eulerian = eulerian_.data();
  s.partial = partial_.data();
  s.failure = &failure_;
  s.spatial.stride = s.dimension == 2 ? spatial_stride<2>(s.settings) : spatial_stride<3>(s.settings);
  for (Index i = 0; i < s.particles; ++i) fields().active.at(i) = 1;
}

void ParticleData::set_descriptions(Options const& options) {
  for (std::size_t k = 0; k < body_.size(); ++k) {
    BodyOptions const& o = options.bodies[k];
    bool const patch = o.description == Description::patch;
    std::vector<Index> outside;
    for (Index i = body_[k].first; i < body_[k].last; ++i) {
      bool const inside = patch && (*o.eulerian_where)(set_.X[at(i)]) != 0;
      fields().phi.at(i) = o.description == Description::eulerian || inside ? 1 : 0;
      if (patch && !inside) outside.push_back(i);
    }
    double const width = o.blend * body_[k].spacing;
    if (patch && width != 0 && options.settings.equations.blends()) blend_patch(body_[k], width, outside);
  }
}

/// Blends the kernel types over a width [m] at the border of a patch.
void ParticleData::blend_patch(BodyConstants const& body, double width, std::vector<Index> const& outside) {
  for (Index i = body.first; i < body.last; ++i) {
    if (fields().phi.at(i) == 0) continue;
    double nearest = width;
    for (Index const j : outside) {
      auto const &p = set_.X[at(i)], &q = set_.X[at(j)];
      nearest = std::min(nearest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
    }
    double const z = nearest / width;
    fields().phi.at(i) = z * z * (3 - 2 * z);
  }
}

void ParticleData::set_reference() {
  auto const set_point = [&](Index slot) {
    std::size_t const i = at(slot);
    for (int c = 0; c < 3; ++c) fields().X.at(slot, c) = set_.X[i][at(c)];
    fields().volume.at(slot) = set_.volume[i];
    if (!Fields::holds(fields().area)) return;
    Index const image = system_.image_of(slot);
    for (int c = 0; c < 3; ++c) fields().X.at(image, c) = c == 0 ? -set_.X[i][0] : set_.X[i][at(c)];
    fields().area.at(slot) = fields().area.at(image) =
        set_.volume[i] / circle(ring_radius(set_.X[i][0], body_of(slot).spacing));
  };
  for (std::size_t b = 0; b < body_.size(); ++b)
    for (Index i = system_.part[b].first; i < system_.part[b].last; ++i) {
      set_point(i);
      fields().mass.at(i) = body_[b].rho0 * set_.volume[at(i)];
      bool const deforms = Fields::holds(fields().F) && fields().active.at(i) > 0;  // deleted particles keep theirs
      for (int c = 0; c < 9 && deforms; ++c) fields().F.at(i, c) = c % 4 == 0 ? 1 : 0;
    }
  set_point(0);                                         // where cells of space begin
  if (system_.contact.law == ContactLaw::as_published)  // its potential needs data of both sides
    for (Index i = 0; i < system_.particles; ++i) set_point(i);
}

void ParticleData::set_initial_state(Assembly const& assembly) {
  for (std::size_t k = 0; k < body_.size(); ++k)
    with_solid(body_[k].material, [&](auto const& law) {
      for (Index slot = system_.part[k].first; slot < system_.part[k].last; ++slot) {
        std::size_t const i = at(slot);
        for (int c = 0; c < 3; ++c) {
          double const moved = assembly.initial_displacement.empty() ? 0 : assembly.initial_displacement[i][at(c)];
          fields().x.at(slot, c) = position_[3 * at(slot) + at(c)] = set_.X[i][at(c)] + moved;
          fields().v.at(slot, c) = assembly.initial_velocity.empty() ? 0 : assembly.initial_velocity[i][at(c)];
        }
        fields().rho.at(slot) = body_[k].rho0;
        fields().viscosity.at(slot) = 1;
        if (Fields::holds(fields().thickness)) fields().thickness.at(slot) = initial_thickness(slot);
        fields().temperature.at(slot) = law.initial_temperature();
        fields().energy.at(slot) = fields().mass.at(slot) * law.initial_energy();
      }
    });
}

/// See Fields::thickness. Also puts the image of the particle.
double ParticleData::initial_thickness(Index slot) {
  if (!system_.settings.axisymmetric) return 1;
  double const radius = fields().x.at(slot);
  Index const image = system_.image_of(slot);
  for (int c = 0; c < 3; ++c) position_[3 * at(image) + at(c)] = c == 0 ? -radius : fields().x.at(slot, c);
  return circle(radius);
}

void ParticleData::update_kernel_types() {
  Index const n = system_.particles;
  for (Index i = 0; i < n; ++i) eulerian_[at(i)] = fields().phi.at(i) > 0 ? 1 : 0;
  system_.description.eulerians =
      static_cast<Index>(std::count(eulerian_.begin(), eulerian_.begin() + n, std::uint8_t{1}));
  if (system_.settings.axisymmetric)
    for (Index i = 0; i < n; ++i) eulerian_[at(system_.image_of(i))] = eulerian_[at(i)];
}

bool ParticleData::has_surface_contact() const {
  return std::any_of(contact_pairs_.begin(), contact_pairs_.end(), [](auto const& pair) { return pair.surfaces; });
}

bool ParticleData::has_lagrangian() const {
  for (Index i = 0; i < system_.particles; ++i)
    if (fields().phi.at(i) < 1) return true;
  return false;
}

bool ParticleData::has_deleted() const {
  for (Index i = 0; i < system_.particles; ++i)
    if (!(fields().active.at(i) > 0)) return true;
  return false;
}

double ParticleData::contact_mass(std::int64_t id) const {
  auto const slot = static_cast<Index>(id);
  return fields().active.at(slot) > 0 ? body_of(slot).rho0 * set_.volume[at(id)] : 0;
}

std::size_t ParticleData::bytes() const {
  return memory_.bytes() + sizeof(int) * body_of_.size() + sizeof(double) * position_.size() +
         correction_.size() * sizeof(Correction);
}

}  // namespace piola::adaptle
