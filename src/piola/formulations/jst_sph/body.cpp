// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/body.hpp"
#include "piola/base/errors.hpp"
#include "piola/domain/bisection.hpp"
#include "piola/domain/error_agreement.hpp"
#include "piola/domain/slot_collectives.hpp"
#include "piola/domain/sum_over_slots.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/jst_sph/field_set_up.hpp"
#include "piola/formulations/jst_sph/passes.hpp"
#include "piola/materials/laws.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace piola::jst_sph {
namespace {

/// Mean lattice spacing [m]: unit of the support radii of the options.
double mean_spacing(Body const& body, int D) {
  double size = 1;
  for (int c = 0; c < D; ++c) size *= body.spacing[static_cast<std::size_t>(c)];
  return std::pow(size, 1.0 / D);
}

/// The largest support radius, in all directions [m].
std::array<double, 3> reach_of_neighbours(Options const& options, Body const& body, int D) {
  double const h = std::max(options.gradient_support, options.laplacian_support);
  double const radius = options.kernel->support * h * mean_spacing(body, D);
  return {radius, radius, radius};
}

FieldNeeds field_needs(Options const& o, bool mirrored) {
  return {.displacement = o.variables == Variables::displacement,
          .verlet = o.integrator == Integrator::verlet,
          .area = o.variables == Variables::pFHJ,
          .volume = evolves_volume(o.variables),
          .smoothed_volume = o.smoothed_volume(),
          .filter = o.filter,
          .mirrored = mirrored};
}

}  // namespace

JstBody::JstBody(Assembly const& assembly, ParticleSet const& set, std::size_t body, Options const& options,
                 Backend const& backend)
    : body_(set.bodies[body]),
      options_(options),
      order_(bisected(set, body_, pencil_order(set, body_), comm::size())),
      set_(&set),
      images_(assembly, body, order_, reach_of_neighbours(options, body_, set.dimension)),
      state_(&fields_, set.dimension, field_needs(options, !images_.empty())),
      records_(state_, options),
      boundary_(assembly, body, order_, images_.planes(), cloud()) {
  if (options_.filter && images_.skew())
    throw InputError(fmt::format(
        "body '{}': an antisymmetric mirror plane turns strains round, which the volumetric filter does not "
        "know of - take scheme = \"paper\" or another support",
        body_.name));
  state_.slots = {0, order_.slots()};
  make_pairs(backend);
  distribute(backend.lanes);
  set_constants(assembly.materials[body]);
  if (state_.regular) group_lanes(backend.lanes);
  allocate();
  fill(assembly, backend);
  backend.update_wave_speed(state_);
  if (state_.has.verlet) backend.step(state_, 0);  // the accelerations of the start
}

void JstBody::make_pairs(Backend const& backend) {
  double const spacing = mean_spacing(body_, set_->dimension);
  PairOptions pair;
  pair.kernel = options_.kernel;
  pair.h_gradient = options_.gradient_support * spacing;
  pair.h_laplacian = options_.biharmonic != Biharmonic::none ? options_.laplacian_support * spacing : 0;
  pair.kernel_table = options_.filter;
  pair.lanes = backend.lanes;
  // One lane at a time gains nothing from patterns: the portable path is the plain loop over a list.
  pair.stencils = backend.lanes > 1 && images_.empty();
  pair.copies = images_.particles();
  if (comm::is_parallel()) pair.own = DistributedSlots{order_.slots(), order_.particles}.own();
  // Each rank checks its local particles.
  comm::agree_after([&] { pairs_ = std::make_unique<ReferencePairs>(*set_, body_, order_, pair); });
  state_.regular = pairs_->regular();
  if (state_.regular)
    state_.stencil = pairs_->stencil();
  else
    state_.list = pairs_->list();
}

/// Groups lanes with equal neighbours and equal volumes, which have equal reference data.
void JstBody::group_lanes(int lanes) {
  groups_.emplace(state_.slots, slots(), lanes, [&](Index first, std::vector<double>& key) {
    key.push_back(static_cast<double>(state_.stencil.pattern_of[first / lanes]));
    for (Index i = first; i < first + lanes; ++i) key.push_back(i < particles() ? volume(i) : 0);
  });
}

void JstBody::set_constants(MaterialParameters const& material) {
  auto& k = state_.constants;
  state_.material = material;
  double mu = 0, kappa = 0;
  with_law(material, [&](auto const& law) {
    mu = law.mu;
    kappa = law.kappa;
    k.rho0 = law.rho0;
    k.c_p0 = law.p_wave_speed();
  });
  k.kernel_volume = set_->kernel_volume[static_cast<std::size_t>(body_.first)];
  k.h_min = *std::min_element(body_.spacing.begin(), body_.spacing.begin() + state_.dimension);
  // The filtered scheme stabilises with the speed of shear-type waves.
  double const speed_ratio = state_.has.verlet ? std::min(1.0, std::sqrt((7.0 / 3.0) * mu / k.rho0) / k.c_p0) : 1.0;
  k.eps2 = options_.eps2 * speed_ratio;
  k.eps4 = options_.eps4 * speed_ratio;
  k.kappa_local = options_.filter ? std::min(kappa, mu) : kappa;
  k.kappa_filtered = kappa - k.kappa_local;
  k.eps2_J = options_.eps2_J;
  k.eps4_J = options_.eps4_J;
  k.exact_speed = options_.exact_speed;
  k.integrator = options_.integrator;
  k.variables = options_.variables;
  k.biharmonic = options_.biharmonic;
  k.mirrored = !images_.empty();
  k.project = options_.project && !k.mirrored;
  auto const moments = sums_over_slots<4>(shared(), own(), [&](Index i, double* sum) {
    auto const X = this->X(i);
    sum[3] = volume(i);
    for (std::size_t c = 0; c < 3; ++c) sum[c] = volume(i) * X[c];
  });
  k.total_volume = moments.value(3);
  for (int c = 0; c < 3; ++c) k.centre[c] = moments.value(c) / k.total_volume;
  constexpr Index widest = ForceTotals<3>::size;
  partial_.resize(static_cast<std::size_t>(exec::leaf_count(state_.slots)) * widest);
  state_.partial = partial_.data();
  failure_.id = order_.id.data();
  state_.failure = &failure_;
  state_.external_work = &external_work_;
}

void JstBody::allocate() {
  Index const guard = state_.regular ? SlotOrder::alignment : 0, n = order_.slots();
  auto const allocate = [&](Field& f, Index size) {
    if (f.components() > 1)
      f.allocate_tiled(size);
    else
      f.allocate(size, guard);
  };
  records_.place(fields_, n, images_.count());
  if (options_.filter) {  // its reference data are those of slots, and it reads its sources at neighbours
    for (FieldRef const* f : {&state_.filter_scale, &state_.filter_sum}) allocate(fields_[*f], n);
    for (FieldRef const& f : state_.filter_source) allocate(fields_[f], n + images_.count());
  }
  fields_.each_without_memory([&](Field& f) {
    bool const grouped = groups_ && f.role() == Role::reference;
    allocate(f, grouped ? groups_->stored_slots() : n);
    if (grouped) f.share(groups_->stored.data());
  });
  fields_.bind();
  if (!state_.has.mirrored) state_.weight = state_.V;
  records_.bind(images_);
  if (halo_) records_.add_to(halo_->plan);
}

void JstBody::fill(Assembly const& assembly, Backend const& backend) {
  FieldSetUp set_up(*this, backend);
  set_up.fill_records(records_, *pairs_);
  set_up.fill_reference(groups_ ? &*groups_ : nullptr, *pairs_);
  if (options_.filter) set_up.fill_filter(*pairs_);
  pairs_->keep_tables();
  set_up.fill_initial(assembly);
  boundary_.attach(state_);
  set_up.fill_evolved_geometry();
}

/// The point cloud for multipliers: the particles with the gradient's kernel.
std::optional<Cloud> JstBody::cloud() const {
  if (!options_.multipliers) return std::nullopt;
  if (!images_.empty())
    throw InputError(
        fmt::format("body '{}': supports = \"multipliers\" does not go together with mirror planes - take "
                    "direct supports or rollers in place of the mirror planes",
                    body_.name));
  int const D = set_->dimension;
  Cloud r{D, {}, {}, options_.kernel, options_.gradient_support * mean_spacing(body_, D)};
  for (Index i = 0; i < order_.particles; ++i) {
    r.X.push_back(X(i));
    r.volume.push_back(volume(i));
  }
  return r;
}

void JstBody::step(Backend const& backend, double time, double dt) {
  boundary_.begin_step(state_, time, dt);
  backend.step(state_, dt);
  boundary_.end_step(state_);
}

void JstBody::damp(double factor) {
  double const before = kinetic_energy();
  boundary_.damp(state_, factor);
  state_.totals.damping_loss += before - kinetic_energy();
}

double JstBody::kinetic_energy() const {
  return 0.5 * state_.constants.rho0 * sum_over_slots(shared(), own(), [&](Index i) {
           auto const v = this->v(i);
           return volume(i) * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
         });
}

Mat<3> JstBody::F(Index slot) const {
  Mat<3> r = identity<3>();
  int const D = state_.dimension;
  for (int c = 0; c < D * D; ++c) r(c / D, c % D) = value(state_.F, slot, c);
  return r;
}

Mat<3> JstBody::H(Index slot) const {
  if (!state_.has.area) return cofactor(F(slot));
  Mat<3> r;
  for (int c = 0; c < 9; ++c) r.c[c] = value(state_.H, slot, c);
  return r;
}

double JstBody::J(Index slot) const {
  if (state_.has.volume) return value(state_.J, slot);
  double J = 1;
  with_law(state_.material, [&](auto const& law) { J = volume_ratio_of(law.small_strain, F(slot)); });
  return J;
}

std::size_t JstBody::bytes() const {
  return order_.id.size() * sizeof(order_.id[0]) + partial_.size() * sizeof(double) +
         (groups_ ? groups_->stored.size() * sizeof(std::int32_t) : 0) + pairs_->bytes() + boundary_.bytes() +
         records_.bytes() + fields_.bytes();
}

}  // namespace piola::jst_sph
