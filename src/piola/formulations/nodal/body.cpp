// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/body.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/domain/first_failure.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/nodal/mirror_passes.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include "piola/materials/laws.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <tuple>
#include <utility>

namespace piola::nodal {
namespace {

/// Reduction payload of a step.
struct StepReduction {
  FirstFailure first;
  double change;
  void add(StepReduction const& other) {
    first.add(other.first);
    comm::max_or_nan(other.change, change);
  }
};

/// A step is taken in at most two to this power parts.
constexpr int most_halvings = 8;
/// A point of a cell that loses more than the rest of its volume in a step is crushed faster than the step can follow.
constexpr double least_share = 0.5;

}  // namespace

NodalBody::NodalBody(Assembly const& assembly, ParticleSet const& set, std::size_t body, Options const& options,
                     Backend const& backend)
    : body_(set.bodies[body]),
      options_(options),
      D_(set.dimension),
      order_(slot_order(set, body_)),
      images_(make_images(assembly, body)),
      set_(&set),
      fields_(D_, options.fluctuation_viscosity > 0 || options.shock_viscosity > 0, options.solids,
              !assembly.initial_deformation_gradient.empty()) {
  set_materials(materials_of(assembly, body));
  set_up(assembly, backend);
  if (!images_.empty() && !reference_.held.empty())
    throw InputError(fmt::format(
        "body '{}': a support that holds the surface of a patch does not go together with mirror planes (allowed: "
        "hold = \"particles\") - change hold",
        body_.name));
  images_.keep(reference_.images);
  share();
  allocate();
  if (shared()) mark_halo();
  fill_reference();
  if (!images_.empty()) keep_own_side();
  fill_initial(assembly);
  fill_histories();
  if (fields_.with_offset) fill_offset(assembly, backend);
  make_boundary(assembly, body);
  backend.step(state_, 0);  // the accelerations of the start
}

void NodalBody::set_up(Assembly const& assembly, Backend const& backend) {
  reference_ = make_reference({*set_, body_, order_, assembly.loads, assembly.supports, densities(),
                               options_.least_mass, backend, images_.empty() ? nullptr : &images_,
                               comm::is_parallel() ? std::optional(state_.slots) : std::nullopt});
}

/// Images of the whole body, for the set-up of cells, fits and masses. Between two planes it is endless; images beyond
/// eight spacings have no effect.
MirrorImages NodalBody::make_images(Assembly const& assembly, std::size_t body) const {
  constexpr double far = 8;
  std::array<double, 3> reach = body_.spacing;  // of directions without planes: any
  for (auto const& plane : assembly.mirrors) {
    if (plane.body != body) continue;
    if (plane.skew)
      throw InputError(
          fmt::format("body '{}': an antisymmetric mirror plane is a symmetry of small strains alone, and nodal has "
                      "one energy for all "
                      "(allowed: symmetric planes; antisymmetric ones in jst_sph) - remove antisymmetric, or the plane",
                      body_.name));
    if (plane.axis >= D_) continue;  // refused below
    auto const axis = static_cast<std::size_t>(plane.axis);
    bool const endless = reach[axis] > body_.spacing[axis];
    double const length = body_.spacing[axis] * (body_.lattice[axis] + 1);
    reach[axis] = endless ? far * body_.spacing[axis] : 2 * length;
  }
  return {assembly, body, order_, reach};
}

/// How images follow: records of motion have X and mu of their own, which stay.
void NodalBody::attach_images() {
  state_.x.copies = images_.copies({MirrorImages::Kind::position});
  with_dimension(D_, [&](auto dimension) {
    constexpr int D = dimension, width = Records<D>::width;
    state_.second.copies = images_.copies(D * width, [](int value, int axis) {
      int const m = value % width;
      return (value / width == axis) != (m < Records<D>::used && turns<D>(m, axis));
    });
  });
}

/// Treats particles on a plane: half of their volume belongs to the body, and they stay in the plane.
void NodalBody::keep_own_side() {
  for (Index i = own().first; i < own().last; ++i) {
    int axes = 0;
    for (int axis = 0; axis < D_; ++axis)
      if (images_.on_plane(i, static_cast<std::size_t>(axis))) axes |= 1 << axis;
    if (axes != 0) mirrored_.push_back({i, axes});
  }
  state_.mirrored = mirrored_.data();
  state_.mirrored_count = static_cast<Index>(mirrored_.size());
  for (Index i = own().first; i < own().last; ++i) {
    auto const slot = static_cast<std::size_t>(i);
    reference_.mass[slot] *= share(i);
    for (auto& part : reference_.parts)
      if (!part.empty()) part[slot].area *= share(i);
  }
}

void NodalBody::set_materials(std::vector<MaterialParameters> const& materials) {
  state_.dimension = D_;
  state_.slots = even_range_of_rank(order_.slots(), comm::rank(), comm::size());
  state_.all_slots = order_.slots();
  state_.particles = order_.particles;
  double const spacing = *std::min_element(body_.spacing.begin(), body_.spacing.begin() + D_);
  Index first = 0;
  for (std::size_t k = 0; k < materials.size(); ++k) {
    Index last = first;
    while (last < order_.particles && part_of(*set_, static_cast<std::size_t>(id(last))) == k) ++last;
    with_any_law(materials[k], [&](auto const& law) {
      Constants const constants{
          law.rho0, law.kappa, law.mu, std::min(law.kappa, law.mu), spacing / law.p_wave_speed(), options_.stress_free,
          0};
      materials_.push_back({materials[k], constants, first, last});
    });
    first = last;
  }
  PIOLA_ENSURES(first == order_.particles);
  state_.materials = materials_.data();
  state_.material_count = static_cast<Index>(materials_.size());
  state_.constants = materials_.front().constants;
  for (MaterialRange const& range : materials_)
    state_.constants.unit_step = std::min(state_.constants.unit_step, range.constants.unit_step);
  set_viscosity(materials.front());
  partial_.resize(static_cast<std::size_t>(exec::block_count(state_.slots)) + 1);
  state_.partial = partial_.data();
  failure_.id = order_.id.data();
  state_.failure = &failure_;
}

void NodalBody::set_viscosity(MaterialParameters const& material) {
  if (fields_.with_viscosity && materials_.size() > 1)
    throw InputError(fmt::format(
        "body '{}': fluctuation_viscosity and shock_viscosity are those of one material (allowed: 0 for a body with "
        "parts) - leave them out, or make the parts bodies and tie them",
        body_.name));
  with_any_law(material, [&](auto const& law) {
    double h = 1;
    for (std::size_t c = 0; c < static_cast<std::size_t>(D_); ++c) h *= std::pow(body_.spacing[c], 1.0 / D_);
    double const speed = std::sqrt((state_.constants.kappa_local + 4 * law.mu / 3) / law.rho0);
    state_.viscosity = {options_.fluctuation_viscosity * law.rho0 * h * speed,
                        options_.shock_viscosity * 0.06 * law.rho0 * h * law.p_wave_speed(),
                        options_.shock_viscosity * 1.2 * law.rho0 * h * h};
  });
}

std::vector<double> NodalBody::densities() const {
  std::vector<double> densities;
  for (MaterialRange const& range : materials_) densities.push_back(range.constants.rho0);
  return densities;
}

MaterialRange const& NodalBody::material(Index slot) const {
  return *std::find_if(materials_.begin(), materials_.end(), [&](MaterialRange const& r) { return slot < r.last; });
}

void NodalBody::allocate() {
  Index const n = order_.slots();
  if (reference_.lattice)
    NeighbourRecords::place_lattice(fields_, n, reference_.lattice->guard());
  else
    gathered_.place_records(fields_, D_, n + images_.count());
  if (auto const& group = reference_.group_of_k; !group.empty()) {
    fields_.k.allocate_tiled(static_cast<Index>(reference_.k.size()) / fields_.k.components());
    fields_.k.share(group.data());
  }
  fields_.each([&](Field& f) {
    if (f.size() > 0 || &f == (reference_.lattice ? &fields_.X : &fields_.products)) return;
    if (!fields_.with_offset && &f == &fields_.offset) return;
    if (!fields_.with_viscosity && (&f == &fields_.viscous || &f == &fields_.viscous_kept)) return;
    if (!fields_.with_solids && (&f == &fields_.history || &f == &fields_.history_kept)) return;
    if (f.components() > 1)
      f.allocate_tiled(n);
    else
      f.allocate(n, 0);
  });
  auto& s = state_;
  auto const& f = fields_;
  std::tie(s.V, s.mass, s.L, s.g, s.k, s.own) =
      std::tuple(f.V.ref(), f.mass.ref(), f.L.ref(), f.g.ref(), f.k.ref(), f.own.ref());
  std::tie(s.x, s.v, s.a, s.first, s.second) =
      std::tuple(f.x.ref(), f.v.ref(), f.a.ref(), reference_.lattice ? f.products.ref() : f.X.ref(), f.stress.ref());
  s.mu = f.mu.ref();
  s.offset = f.offset.ref();
  std::tie(s.F, s.P, s.cell, s.C_measured, s.change, s.kept) =
      std::tuple(f.F.ref(), f.P.ref(), f.cell.ref(), f.C_measured.ref(), f.change.ref(), f.kept.ref());
  s.viscous = f.viscous.ref();
  s.viscous_kept = f.viscous_kept.ref();
  s.history = f.history.ref();
  s.history_kept = f.history_kept.ref();
  if (!images_.empty()) attach_images();
  s.list = reference_.list();
  if (reference_.lattice) s.lattice = reference_.lattice->table();
}

template <class Visit>
void NodalBody::each_seen(Visit const& f) const {
  exec_host::parallel_for(state_.slots.last - state_.slots.first, [&](Index k) { f(state_.slots.first + k); });
  for (Index k = 0; k < images_.count(); ++k) f(order_.slots() + k);
  if (!shared()) return;
  for (Index const i : halo_->received()) f(i);
}

void NodalBody::fill_reference() {
  auto const copy_at = [](LazyZeroArray<double> const& from, Field& to, Index i) {
    auto const size = static_cast<std::size_t>(to.components());
    for (std::size_t c = 0; c < size; ++c) to.at(i, static_cast<int>(c)) = from[static_cast<std::size_t>(i) * size + c];
  };
  auto& r = reference_;
  auto& f = fields_;
  exec_host::parallel_for(state_.slots.last - state_.slots.first, [&](Index k) {
    Index const i = state_.slots.first + k;
    copy_at(r.V, f.V, i);
    copy_at(r.mass, f.mass, i);
    copy_at(r.L, f.L, i);
    copy_at(r.g, f.g, i);
    copy_at(r.own, f.own, i);
    if (r.group_of_k.empty()) copy_at(r.k, f.k, i);
    // Slots without a particle hold nothing that counts.
    for (int c = 0; c < D_ && i < order_.particles; ++c) f.C_measured.at(i, c) = 1;
  });
  for (Index i = 0; i < f.k.size() && !r.group_of_k.empty(); ++i) copy_at(r.k, f.k, i);
  each_seen([&](Index i) {
    copy_at(r.mu, f.mu, i);
    if (r.lattice) return;
    copy_at(r.X, f.X, i);
    gathered_.complete_record(D_, i);
  });
  // The fields have them now.
  for (auto* array : {&r.L, &r.g, &r.k, &r.own, &r.mu}) LazyZeroArray<double>().swap(*array);
}

void NodalBody::fill_initial(Assembly const& assembly) {
  auto const& moved = assembly.initial_displacement;
  exec_host::parallel_for(own().last - own().first, [&](Index k) {
    Index const i = own().first + k;
    auto const at = static_cast<std::size_t>(id(i));
    for (int c = 0; c < D_; ++c) {
      auto const d = static_cast<std::size_t>(c);
      fields_.x.at(i, c) = set_->X[at][d] + (moved.empty() ? 0 : moved[at][d]);
      if (!assembly.initial_velocity.empty()) fields_.v.at(i, c) = assembly.initial_velocity[at][d];
    }
  });
  for (MirroredParticle const& p : mirrored_)
    for (int c = 0; c < D_; ++c) {
      if ((p.axes >> c & 1) == 0) continue;
      fields_.x.at(p.slot, c) = set_->X[static_cast<std::size_t>(id(p.slot))][static_cast<std::size_t>(c)];
      fields_.v.at(p.slot, c) = 0;
    }
}

/// F = offset + GRAD x with an offset that stays: F starts from the given values, which count at the particles.
void NodalBody::fill_offset(Assembly const& assembly, Backend const& backend) {
  Field centroid("CellCentroid", "m", D_, Role::reference);
  centroid.allocate_tiled(order_.slots());
  exec_host::parallel_for(own().last - own().first, [&](Index k) {
    Index const i = own().first + k;
    auto const& F = assembly.initial_deformation_gradient[static_cast<std::size_t>(id(i))];
    for (int c = 0; c < D_; ++c) {
      centroid.at(i, c) = reference_.centroid[static_cast<std::size_t>(i * D_ + c)];
      for (int J = 0; J < D_; ++J) fields_.offset.at(i, c * D_ + J) = F[std::size_t{3} * c + J];
    }
  });
  backend.subtract_gradients(state_, centroid.ref());
  for (MirroredParticle const& p : mirrored_)  // what is odd across a plane vanishes there
    for (int c = 0; c < D_; ++c)
      for (int J = 0; J < D_; ++J)
        if (((p.axes >> c ^ p.axes >> J) & 1) != 0) fields_.offset.at(p.slot, c * D_ + J) = 0;
}

void NodalBody::make_boundary(Assembly const& assembly, std::size_t body) {
  auto& r = reference_;
  // Masses of all particles on all ranks for contact, or if every rank solves for held surface places.
  if (shared() && (assembly.coupled || !r.held.empty())) DistributedSlots{slots(), particles()}.complete(r.mass, 1);
  std::optional<Range> own;
  if (shared()) own = state_.slots;
  boundary_.emplace(assembly, body, Boundary::BodyInput{order_, r.mass, r.parts, r.centroid, r.held, own});
  boundary_->attach(state_);
  if (!assembly.coupled) LazyZeroArray<double>().swap(r.mass);
  LazyZeroArray<double>().swap(r.centroid);
  r.parts.clear();
}

/// Solids in rate form start free of stress where they are not deformed.
void NodalBody::fill_histories() {
  for (MaterialRange const& range : materials_)
    with_solid(range.material, [&](auto const& law) {
      for (Index i = std::max(range.first, own().first); i < std::min(range.last, own().last); ++i) {
        for (int q = 0; q < Fields::points(D_); ++q) {
          int const at = HistoryLayout::point(q, D_);
          fields_.history.at(i, at + HistoryLayout::temperature) = law.initial_temperature();
          for (int c = 0; c < D_; ++c) fields_.history.at(i, at + HistoryLayout::F + c * (D_ + 1)) = 1;
        }
      }
    });
}

int NodalBody::step(Backend const& backend, double time, double dt) { return step(backend, time, dt, 0); }

int NodalBody::step(Backend const& backend, double time, double dt, int halvings) {
  backend.keep(state_);
  boundary_->begin_step(state_, time, dt);
  state_.constants.least_share = halvings < most_halvings ? least_share : 0;
  backend.step(state_, dt);
  agree_on_step(backend.largest_change(state_));
  if (!failed() || halvings == most_halvings) {
    boundary_->end_step(state_);
    return 0;
  }
  backend.restore(state_);
  failure_.clear();
  int const first = step(backend, time, 0.5 * dt, halvings + 1);
  return 1 + first + (failed() ? 0 : step(backend, time + 0.5 * dt, 0.5 * dt, halvings + 1));
}

/// All ranks have the first failure and the largest change of a strain.
void NodalBody::agree_on_step(double change) {
  largest_change_ = change;
  if (!shared()) return;
  StepReduction said{FirstFailure(failure_), change};
  comm::allreduce_sum(said);
  said.first.put(failure_);
  largest_change_ = said.change;
}

void NodalBody::damp(double factor) {
  double const before = kinetic_energy();
  boundary_->damp(state_, factor);
  damping_loss_ += before - kinetic_energy();
}

std::size_t NodalBody::bytes() const {
  auto const& r = reference_;
  std::size_t total = gathered_.bytes() + order_.id.size() * 8 + r.begin.size() * 8 + r.neighbour.size() * 4 +
                      r.weight.size() * 8 + r.group_of_k.size() * 4 +
                      (r.V.size() + r.mass.size() + r.X.size() + partial_.size()) * 8;
  total += r.neighbour.size() * 8 + r.V.size() * 8;  // the smoothing of observers
  return total + fields_.bytes() + boundary_->bytes();
}

}  // namespace piola::nodal
