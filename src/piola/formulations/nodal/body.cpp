// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/body.hpp"
#include "piola/base/errors.hpp"
#include "piola/domain/first_failure.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/nodal/field_set_up.hpp"
#include "piola/formulations/nodal/halo_fields.hpp"
#include "piola/formulations/nodal/implicit_pressure.hpp"
#include "piola/formulations/nodal/mirror_passes.hpp"
#include <algorithm>
#include <fmt/format.h>
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
/// Halvings of a step where cells may fail, at most.
constexpr int most_halvings_of_failure = 3;
/// A point of a cell that loses more than the rest of its volume in a step is crushed faster than the step can follow.
constexpr double least_share = 0.5;

/// Images of the whole body, for the set-up of cells, fits and masses. Between two planes it is endless; images beyond
/// eight spacings have no effect.
MirrorImages images_of(Assembly const& assembly, std::size_t number, Body const& body, SlotOrder const& order) {
  constexpr double far = 8;
  std::array<double, 3> reach = body.spacing;  // of directions without planes: any
  for (auto const& plane : assembly.mirrors) {
    if (plane.body != number) continue;
    if (plane.skew)
      throw InputError(
          fmt::format("body '{}': an antisymmetric mirror plane is a symmetry of small strains alone, and nodal has "
                      "one energy for all "
                      "(allowed: symmetric planes; antisymmetric ones in jst_sph) - remove antisymmetric, or the plane",
                      body.name));
    if (plane.axis >= assembly.particles.dimension) continue;  // refused below
    auto const axis = static_cast<std::size_t>(plane.axis);
    bool const endless = reach[axis] > body.spacing[axis];
    double const length = body.spacing[axis] * (body.lattice[axis] + 1);
    reach[axis] = endless ? far * body.spacing[axis] : 2 * length;
  }
  return {assembly, number, order, reach};
}

/// How images follow: records of motion have X of their own, which stays.
void attach_images(BodyState& state, MirrorImages& images) {
  state.x.copies = images.copies({MirrorImages::Kind::position});
  with_dimension(state.dimension, [&](auto dimension) {
    constexpr int D = dimension, used = Records<D>::used;
    state.stress_for_neighbours.copies = images.copies(
        D * used, [](int value, int axis) { return (value / used == axis) != turns<D>(value % used, axis); });
  });
}

}  // namespace

NodalBody::NodalBody(Assembly const& assembly, ParticleSet const& set, std::size_t body, Options const& options,
                     Backend const& backend)
    : body_(set.bodies[body]),
      options_(options),
      set_(&set),
      order_(slot_order(set, body_)),
      images_(images_of(assembly, body, body_, order_)),
      materials_(materials_of(assembly, body), set, body_, order_, options),
      state_(&fields_, set.dimension,
             {.viscosity = options.viscous,
              .solids = options.solids,
              .block_history = options.block_history,
              .failure = options.failure,
              .converts = options.converts,
              .offset = !assembly.initial_deformation_gradient.empty(),
              .implicit_pressure = options.implicit_pressure,
              .axisymmetric = set.axisymmetric,
              .conducts = options.conducts}) {
  state_.slots = even_range_of_rank(order_.slots(), comm::rank(), comm::size());
  state_.all_slots = order_.slots();
  state_.particles = order_.particles;
  materials_.attach(state_, options_);
  partial_.resize(static_cast<std::size_t>(exec::block_count(state_.slots)) + 1);
  state_.partial = partial_.data();
  failure_.id = order_.id.data();
  state_.failure = &failure_;
  make_reference(assembly, backend);
  distribute();
  allocate();
  fill(assembly, backend);
  make_boundary(assembly, body);
  if (options_.implicit_pressure) make_pressure(backend);
  backend.step(state_, 0);  // the accelerations of the start
}

NodalBody::~NodalBody() = default;

void NodalBody::make_reference(Assembly const& assembly, Backend const& backend) {
  nodal::make_reference(
      {*set_, body_, order_, assembly.loads, assembly.supports, materials_.densities(), options_.least_mass, backend,
       images_.empty() ? nullptr : &images_, comm::is_parallel() ? std::optional(state_.slots) : std::nullopt,
       assembly.coupled, options_.failure, options_.conducts},
      reference_);
  if (!images_.empty() && !reference_.held.empty())
    throw InputError(fmt::format(
        "body '{}': a support that holds the surface of a patch does not go together with mirror planes, of which the "
        "axis of axisymmetric bodies is one (allowed: hold = \"particles\") - change hold",
        body_.name));
  if (options_.converts && (!images_.empty() || set_->axisymmetric))
    throw InputError(fmt::format(
        "body '{}': conversion = \"eulerian\" knows neither mirror planes nor axisymmetric bodies yet (allowed: whole "
        "bodies in plane strain or three dimensions) - leave conversion out, or take the formulation adaptle",
        body_.name));
  images_.keep(reference_.images);
}

void NodalBody::allocate() {
  Index const n = order_.slots();
  auto& s = state_;
  bool const on_lattice = !reference_.lattice.empty();
  if (on_lattice) {
    NeighbourRecords::place_lattice(fields_, s, n, reference_.lattice.guard);
  } else {
    records_.place_records(fields_, s, n + images_.count());
    fields_[s.k].allocate_tiled(n);
  }
  fields_.each_without_memory([&](Field& f) {
    if (f.components() > 1)
      f.allocate_tiled(n);
    else
      f.allocate(n, 0);
  });
  fields_.bind();
  s.motion_for_neighbours = on_lattice ? s.x : s.X;
  s.stress_for_neighbours = on_lattice ? s.resultants : s.stress;
  if (!images_.empty()) attach_images(s, images_);
  s.list = reference_.list();
  s.lattice = reference_.lattice.table();
  if (!halo_) return;
  s.halo = &halo_->plan;
  s.ghosts = halo_->plan.received().data();
  s.ghost_count = static_cast<Index>(halo_->plan.received().size());
  with_dimension(s.dimension, [&](auto dimension) { add_halo_fields<dimension>(halo_->plan, s); });
}

void NodalBody::fill(Assembly const& assembly, Backend const& backend) {
  FieldSetUp set_up(*this, reference_, assembly);
  set_up.fill_reference();
  if (!images_.empty()) {
    mirrored_ = set_up.keep_own_side();
    state_.boundary.mirrored = mirrored_.data();
    state_.boundary.mirrored_count = static_cast<Index>(mirrored_.size());
  }
  set_up.fill_initial();
  set_up.fill_histories();
  if (state_.has.offset) set_up.fill_offset(backend);
}

void NodalBody::make_boundary(Assembly const& assembly, std::size_t body) {
  auto& r = reference_;
  // Masses of all particles on all ranks for contact, also of pieces, or if every rank solves for held surface places.
  bool const in_contact = assembly.coupled || options_.failure;
  if (shared() && (in_contact || !r.held.empty() || !r.absorbing.empty()))
    DistributedSlots{slots(), particles()}.complete(r.mass, 1);
  if (shared())
    for (LazyZeroArray<double>& areas : r.face_areas) DistributedSlots{slots(), particles()}.complete(areas, 1);
  std::optional<Range> own;
  if (shared()) own = state_.slots;
  set_drags(r.absorbing, assembly.loads, state_.dimension,
            [&](Index slot) -> Constants const& { return materials_.of(slot).constants; });
  boundary_.emplace(assembly, body, Boundary::BodyInput{order_, r.mass, r.parts, r.centroid, r.held, r.absorbing, own});
  boundary_->attach(state_);
  if (!in_contact) LazyZeroArray<double>().swap(r.mass);
  LazyZeroArray<double>().swap(r.centroid);
  r.parts.clear();
  r.absorbing.clear();
}

void NodalBody::make_pressure(Backend const& backend) {
  implicit_pressure_ = std::make_unique<ImplicitPressure>(*this, backend);
  state_.implicit_pressure = implicit_pressure_.get();
  state_.move_by_pressure = [](ImplicitPressure& pressure, double dt) { pressure.move(dt); };
}

int NodalBody::step(Backend const& backend, double time, double dt, int halvings) {
  backend.keep(state_);
  boundary_->begin_step(state_, time, dt);
  int const most = on_crushed_ ? most_halvings_of_failure : most_halvings;
  state_.constants.least_share = halvings < most ? least_share : 0;
  state_.time = time + dt;
  backend.step(state_, dt);
  if (state_.has.axisymmetric) record_behind_axis();
  agree_on_step(backend.largest_change(state_));
  std::vector<Index> inverted;
  bool const crushes = failed() && halvings == most && on_crushed_ && find_crushed(inverted);
  if (!failed() || (halvings == most && !crushes)) {
    boundary_->end_step(state_);
    return 0;
  }
  backend.restore(state_);
  failure_.clear();
  if (crushes) {
    on_crushed_(inverted);
    return step(backend, time, dt, halvings);
  }
  int const first = step(backend, time, 0.5 * dt, halvings + 1);
  return 1 + first + (failed() ? 0 : step(backend, time + 0.5 * dt, 0.5 * dt, halvings + 1));
}

/// Finds the local cells with an inverted point, and broken ones behind the axis. Returns whether there is one on any
/// rank.
bool NodalBody::find_crushed(std::vector<Index>& slots) const {
  for (Index i = own().first; i < std::min(own().last, order_.particles); ++i)
    if (!(value(state_.change, i, 1) > 0) || (is_behind_axis(i) && is_broken(i))) slots.push_back(i);
  double any = slots.empty() ? 0 : 1;
  if (shared()) comm::allreduce_max(any);
  return any > 0;
}

bool NodalBody::is_behind_axis(Index slot) const {
  constexpr double rounding = 1e-6;  // spacings
  return state_.has.axisymmetric && value(state_.x, slot) < -rounding * body_.spacing[0];
}

/// A hole of the body has closed, or the step was too large. Detached particles cross the axis: the ring that has
/// closed opens again.
void NodalBody::record_behind_axis() {
  for (Index i = own().first; i < own().last; ++i) {
    if (!is_behind_axis(i)) continue;
    if (condition(i) != CellCondition::detached) {
      exec::record(&failure_, i, behind_axis);
      continue;
    }
    for (auto const& field : {state_.x, state_.v}) value_at(field, i, 0) *= -1;
  }
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
  std::size_t total = records_.bytes() + order_.id.size() * 8 + r.begin.size() * 8 + r.neighbour.size() * 4 +
                      (r.weight.size() + r.gradient.size() + r.reaction.size()) * 8 + r.lattice.bytes() +
                      (r.V.size() + r.mass.size() + r.X.size() + partial_.size()) * 8;
  total += r.neighbour.size() * 8 + r.V.size() * 8;  // the smoothing of observers
  if (implicit_pressure_) total += implicit_pressure_->bytes();
  return total + fields_.bytes() + boundary_->bytes();
}

}  // namespace piola::nodal
