// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/body.hpp"
#include "piola/base/errors.hpp"
#include "piola/domain/bisection.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/domain/slot_collectives.hpp"
#include "piola/domain/sum_over_slots.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/jst_sph/passes.hpp"
#include "piola/materials/laws.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <initializer_list>
#include <map>
#include <tuple>

namespace piola::jst_sph {

JstBody::JstBody(Assembly const& assembly, ParticleSet const& set, std::size_t body, Options const& options,
                 Backend const& backend)
    : body_(set.bodies[body]),
      options_(options),
      D_(set.dimension),
      order_(bisected(set, body_, pencil_order(set, body_), comm::size())),
      set_(&set),
      images_(assembly, body, order_, {reach(), reach(), reach()}),
      fields_(D_),
      boundary_(assembly, body, order_, images_.planes(), cloud(set)) {
  if (options_.filter && images_.skew())
    throw InputError(
        fmt::format("body '{}': an antisymmetric mirror plane turns strains round, which the volumetric filter does not "
                    "know of - take scheme = \"paper\" or another support",
                    body_.name));
  make_pairs(set, backend);
  take_tables();
  share(backend.lanes);
  set_constants(set, assembly.materials[body]);
  share_reference(backend.lanes);
  allocate();
  if (shared()) mark_halo();
  fill_reference(backend.lanes);
  if (options_.filter) fill_filter();
  pairs_->keep_tables();
  fill_initial(assembly, backend);
  boundary_.attach(state_);
  fill_evolved_geometry();
  backend.update_wave_speed(state_);
  if (verlet()) backend.step(state_, 0);  // the accelerations of the start
}

void JstBody::make_pairs(ParticleSet const& set, Backend const& backend) {
  double const spacing = this->spacing();
  PairOptions pair;
  pair.kernel = options_.kernel;
  pair.h_gradient = options_.gradient_support * spacing;
  pair.h_laplacian = stabilised() ? options_.laplacian_support * spacing : 0;
  pair.kernel_table = options_.filter;
  pair.lanes = backend.lanes;
  // One lane at a time gains nothing from patterns: the portable path is the plain loop over a list.
  pair.stencils = backend.lanes > 1 && images_.empty();
  pair.copies = images_.particles();
  if (!comm::is_parallel()) {
    pairs_ = std::make_unique<ReferencePairs>(set, body_, order_, pair);
    return;
  }
  pair.own = DistributedSlots{order_.slots(), order_.particles}.own();
  comm::RankError trouble;  // each rank checks its local particles
  try {
    pairs_ = std::make_unique<ReferencePairs>(set, body_, order_, pair);
  } catch (InputError const& error) {
    trouble = {2, error.what()};
  }
  trouble = comm::agree(trouble);
  if (trouble.code != 0) throw comm::CollectiveError(trouble);
}

void JstBody::take_tables() {
  state_.dimension = D_;
  state_.slots = {0, order_.slots()};
  state_.regular = pairs_->regular();
  if (state_.regular)
    state_.stencil = pairs_->stencil();
  else
    state_.list = pairs_->list();
}

void JstBody::set_constants(ParticleSet const& set, MaterialParameters const& material) {
  auto& k = state_.constants;
  state_.material = material;
  double mu = 0, kappa = 0;
  with_law(material, [&](auto const& law) {
    mu = law.mu;
    kappa = law.kappa;
    k.rho0 = law.rho0;
    k.c_p0 = law.p_wave_speed();
  });
  k.kernel_volume = set.kernel_volume[static_cast<std::size_t>(body_.first)];
  k.h_min = *std::min_element(body_.spacing.begin(), body_.spacing.begin() + D_);
  // The filtered scheme stabilises with the speed of shear-type waves.
  double const speed_ratio = verlet() ? std::min(1.0, std::sqrt((7.0 / 3.0) * mu / k.rho0) / k.c_p0) : 1.0;
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

bool JstBody::wanted(Field const& f) const {
  bool const displacement = options_.variables == Variables::displacement, verlet = this->verlet(),
             area = options_.variables == Variables::pFHJ, volume = evolves_volume(options_.variables),
             smoothed_J = options_.smoothed_volume();
  auto const among = [&](std::initializer_list<Field const*> fields) {
    return std::find(fields.begin(), fields.end(), &f) != fields.end();
  };
  if (among({&fields_.stage_position})) return displacement;
  if (among({&fields_.v_n, &fields_.F_star, &fields_.wave_speed_next})) return !verlet;
  if (among({&fields_.volume_ratio})) return verlet;
  if (among({&fields_.H, &fields_.H_star})) return area;
  if (among({&fields_.J, &fields_.J_n})) return volume;
  if (among({&fields_.J_next, &fields_.J_rate, &fields_.w_J})) return smoothed_J;
  if (among({&fields_.filtered_ratio, &fields_.filtered_pressure, &fields_.filter_scale, &fields_.filter_sum,
             &fields_.filter_source_a, &fields_.filter_source_b}))
    return options_.filter;
  return true;
}

void JstBody::allocate() {
  place_gathered();
  Index const guard = state_.regular ? SlotOrder::alignment : 0;
  fields_.each([&](Field& f) {
    bool const per_slot = &f == &fields_.filter_scale || &f == &fields_.filter_sum;
    bool const shared = state_.regular && f.role() == Role::reference && !per_slot;
    if (f.size() == 0 && wanted(f)) {  // neighbour data were placed before; the rest is streamed
      bool const source = &f == &fields_.filter_source_a || &f == &fields_.filter_source_b;
      Index const size = shared ? stored_slots_ : source ? all_slots() : order_.slots();
      if (f.components() > 1)
        f.allocate_tiled(size);
      else
        f.allocate(size, guard);
    }
    if (shared) f.share(group_.data());
  });
  auto& s = state_;
  auto const& f = fields_;
  std::tie(s.V, s.C, s.G, s.alpha, s.beta, s.diagonal) =
      std::tuple(f.V.ref(), f.C.ref(), f.G.ref(), f.alpha.ref(), f.beta.ref(), f.diagonal.ref());
  std::tie(s.x, s.v, s.F, s.wave_speed) = std::tuple(f.x.ref(), f.v.ref(), f.F.ref(), f.wave_speed.ref());
  std::tie(s.w, s.A, s.v_n, s.F_star, s.wave_speed_next, s.rate) =
      std::tuple(f.w.ref(), f.A.ref(), f.v_n.ref(), f.F_star.ref(), f.wave_speed_next.ref(), f.rate.ref());
  std::tie(s.volume_ratio, s.filtered_ratio, s.filtered_pressure, s.filter_scale, s.filter_sum) =
      std::tuple(f.volume_ratio.ref(), f.filtered_ratio.ref(), f.filtered_pressure.ref(), f.filter_scale.ref(),
                 f.filter_sum.ref());
  std::tie(s.H, s.J, s.H_star, s.J_n, s.J_next, s.J_rate) =
      std::tuple(f.H.ref(), f.J.ref(), f.H_star.ref(), f.J_n.ref(), f.J_next.ref(), f.J_rate.ref());
  s.filter_source[0] = f.filter_source_a.ref();
  s.filter_source[1] = f.filter_source_b.ref();
  s.u = options_.variables == Variables::displacement ? f.stage_position.ref() : f.v.ref();
  s.weight = s.V;
  if (!images_.empty()) mark_images();
}

template <class Visit>
void JstBody::each_seen(Visit const& f) const {
  exec_host::parallel_for(own().last - own().first, [&](Index k) { f(own().first + k); });
  if (!shared()) return;
  for (Index const i : halo_->received()) f(i);
}

/// Tells how the images' values follow, for all that sweeps read at neighbours.
void JstBody::mark_images() {
  using Kind = MirrorImages::Kind;
  auto& s = state_;
  std::vector<Kind> first{options_.variables == Variables::displacement ? Kind::position : Kind::vector};
  if (gathers_position()) first.push_back(Kind::position);
  if (options_.smoothed_volume()) first.push_back(Kind::scalar);  // J
  s.u.copies = images_.copies(first);
  std::vector<Kind> second;
  if (stabilised()) second = {Kind::vector};                       // w
  if (options_.smoothed_volume()) second.push_back(Kind::scalar);  // w_J
  if (options_.biharmonic == Biharmonic::adjoint)                  // alpha, beta
    second.insert(second.end(), {Kind::geometric_vector, Kind::scalar});
  second.push_back(Kind::tensor);  // A
  s.second.copies = images_.copies(second);
  for (FieldRef& source : s.filter_source) source.copies = images_.copies({Kind::scalar});
  weight_.allocate(order_.slots(), 0);
  for (Index i = own().first; i < own().last; ++i) weight_.at(i) = volume(i);
  s.weight = weight_.ref();
}

/// Memory of the neighbour data of a sweep: arrays for lattices; records [X, values] for lists.
JstBody::NeighbourRecords JstBody::gather(int values) const {
  NeighbourRecords g;
  auto const n = static_cast<std::ptrdiff_t>(all_slots());
  if (state_.regular) {
    // One lane of an entry has the neighbour, so the others are at most `lanes` from a slot of the body.
    g.start = SlotOrder::alignment;
    // The zeros after the last value of a component are those before the first of the next.
    g.component = 8 * (((n + 7) / 8 + g.start / 8) | 1);
    g.memory = Memory(static_cast<std::size_t>(g.component * values + 2 * g.start));
    return g;
  }
  g.component = 1;
  g.particle = (std::ptrdiff_t{D_} + values + 7) / 8 * 8;
  g.start = D_;
  g.memory = Memory(static_cast<std::size_t>(n * g.particle + 8));
  each_seen([&](Index i) {
    for (int c = 0; c < D_; ++c) g.memory.data()[i * g.particle + c] = X(i)[static_cast<std::size_t>(c)];
  });
  for (Index k = 0; k < images_.count(); ++k)
    for (int c = 0; c < D_; ++c)
      g.memory.data()[(order_.slots() + k) * g.particle + c] =
          images_.particles().X[static_cast<std::size_t>(k)][static_cast<std::size_t>(c)];
  return g;
}

void JstBody::place_gathered() {
  bool const adjoint = options_.biharmonic == Biharmonic::adjoint;
  Index const n = order_.slots();
  auto const place = [n](Field& f, NeighbourRecords& g, std::ptrdiff_t offset) {
    f.place(g.memory.data(), g.component, g.particle, g.start + offset * g.component, n, &g.version);
  };
  bool const smoothed_J = options_.smoothed_volume();
  bool const with_x = gathers_position();
  first_ = gather(with_x ? 2 * D_ : smoothed_J ? D_ + 1 : D_);
  place(options_.variables == Variables::displacement ? fields_.stage_position : fields_.v, first_, 0);
  if (with_x) place(fields_.x, first_, D_);
  if (smoothed_J) place(fields_.J, first_, D_);
  int const smoothed = stabilised() ? D_ + (smoothed_J ? 1 : 0) : 0;
  int const before_A = adjoint ? smoothed + D_ + 1 : smoothed;
  second_ = gather(before_A + D_ * D_);
  state_.second = {
      second_.memory.data() + second_.start, second_.component, second_.particle, 0, &second_.version, "second sweep"};
  if (stabilised()) place(fields_.w, second_, 0);
  if (smoothed_J) place(fields_.w_J, second_, D_);
  place(fields_.A, second_, before_A);
  if (adjoint) fill_adjoint(smoothed);
}

/// Fills the data that the adjoint of the Laplacian reads at neighbours: their alpha and beta, from component `first`
/// of `second` on.
void JstBody::fill_adjoint(int first) {
  auto const& corrections = pairs_->corrections();
  exec_host::parallel_for(own().last - own().first, [&](Index k) {
    Index const i = own().first + k;
    double* const at = state_.second.data + i * second_.particle;
    for (int c = 0; c < D_; ++c)
      at[(first + c) * second_.component] = corrections.alpha[corrections.at(i)][static_cast<std::size_t>(c)];
    at[(first + D_) * second_.component] = corrections.beta[corrections.at(i)];
  });
  if (shared()) tell_once(state_.second, first, D_ + 1);
}

/// Finds the distinct groups of lanes: the same neighbours and the same volumes give the same reference data.
void JstBody::share_reference(int lanes) {
  stored_slots_ = order_.slots();
  if (!state_.regular) return;
  std::map<std::vector<double>, std::int32_t> known;
  std::vector<double> key, last;
  group_.assign(static_cast<std::size_t>(order_.slots() / lanes), 0);
  for (Index first = state_.slots.first; first < state_.slots.last; first += lanes) {
    Index const group = first / lanes;
    std::int32_t& stored = group_[static_cast<std::size_t>(group)];
    key.assign(1, static_cast<double>(state_.stencil.pattern_of[group]));
    for (Index i = first; i < first + lanes; ++i) key.push_back(i < order_.particles ? volume(i) : 0);
    if (key == last) {  // as most groups
      stored = group_[static_cast<std::size_t>(group) - 1];
      continue;
    }
    last = key;
    auto const [at, is_new] = known.try_emplace(key, static_cast<std::int32_t>(group_first_.size()));
    if (is_new) group_first_.push_back(first);
    stored = at->second;
  }
  stored_slots_ = static_cast<Index>(group_first_.size()) * lanes;
}

template <class Visit>
void JstBody::each_stored(int lanes, Visit const& visit) const {
  Range const stored = state_.regular ? Range{0, stored_slots_} : state_.slots;
  exec_host::parallel_for(stored.last - stored.first, [&](Index k) {
    Index const to = stored.first + k;
    Index const i = state_.regular ? group_first_[static_cast<std::size_t>(to / lanes)] + to % lanes : to;
    if (i < order_.particles) visit(to, i);
  });
}

void JstBody::fill_reference(int lanes) {
  bool const stages = wanted(fields_.F_star);
  exec_host::parallel_for(state_.slots.last - state_.slots.first, [&](Index k) {
    Index const i = state_.slots.first + k;
    for (int c = 0; c < D_; ++c) {
      fields_.F.at(i, c * D_ + c) = 1;
      if (stages) fields_.F_star.at(i, c * D_ + c) = 1;
    }
  });
  auto const& corrections = pairs_->corrections();
  static constexpr int packed[3][6] = {{0}, {0, 1, 3}, {0, 1, 2, 3, 4, 5}};
  each_stored(lanes, [&](Index to, Index i) {
    auto const slot = corrections.at(i);
    fields_.V.at(to) = mirrored_volume(i);
    for (int c = 0; c < D_ * (D_ + 1) / 2; ++c)
      fields_.C.at(to, c) = corrections.C[slot][static_cast<std::size_t>(packed[D_ - 1][c])];
    for (int c = 0; c < D_; ++c) {
      fields_.G.at(to, c) = corrections.G[slot][static_cast<std::size_t>(c)];
      fields_.alpha.at(to, c) = corrections.alpha[slot][static_cast<std::size_t>(c)];
    }
    fields_.beta.at(to) = corrections.beta[slot];
    fields_.diagonal.at(to) = corrections.diagonal[slot];
  });
}

/// H and J of the start, where they are unknowns: those of F.
void JstBody::fill_evolved_geometry() {
  if (!evolves_volume(options_.variables)) return;
  bool const area = wanted(fields_.H);
  for (Index i = state_.slots.first; i < state_.slots.last; ++i) {
    Mat<3> const F = i < order_.particles ? this->F(i) : identity<3>(), H = cofactor(F);
    for (int c = 0; area && c < 9; ++c) fields_.H.at(i, c) = fields_.H_star.at(i, c) = H.c[c];
    with_law(state_.material, [&](auto const& law) { fields_.J.at(i) = volume_ratio_of(law.small_strain, F); });
  }
}

/// Sends constant data that far ghosts also need.
void JstBody::tell_once(FieldRef const& field, int first, int count) const {
  HaloPlan once = *halo_;
  FieldRef part = field;
  part.data += first * field.component_stride;
  once.add(part, 0, count, 1);
  once.exchange(part);
}

void JstBody::fill_filter() {
  std::vector<double> volumes(static_cast<std::size_t>(order_.slots()));
  for (Index i = 0; i < order_.particles; ++i) volumes[static_cast<std::size_t>(i)] = mirrored_volume(i);
  ReferencePairs::FilterShare const share{
      own(), [&](std::vector<double>& values) { tell_once({.data = values.data()}, 0, 1); }, comm::allreduce_max};
  auto const filter = pairs_->make_filter(volumes, shared() ? &share : nullptr);
  for (Index i = own().first; i < own().last; ++i) {
    fields_.filter_scale.at(i) = filter.scale[static_cast<std::size_t>(i)];
    fields_.filter_sum.at(i) = filter.sum[static_cast<std::size_t>(i)];
  }
}

void JstBody::fill_initial(Assembly const& assembly, Backend const& backend) {
  auto const& moved = assembly.initial_displacement;
  auto const& deformed = assembly.initial_deformation_gradient;
  exec_host::parallel_for(own().last - own().first, [&](Index number) {
    Index const i = own().first + number;
    auto const at = static_cast<std::size_t>(id(i));
    for (int c = 0; c < D_; ++c) {
      auto const k = static_cast<std::size_t>(c);
      fields_.x.at(i, c) = set_->X[at][k] + (moved.empty() ? 0 : moved[at][k]);
      if (!assembly.initial_velocity.empty()) fields_.v.at(i, c) = assembly.initial_velocity[at][k];
    }
  });
  bool const mixed = options_.variables != Variables::displacement;
  if (!deformed.empty() && mixed) {
    for (Index i = own().first; i < own().last; ++i)
      for (int c = 0; c < D_ * D_; ++c)
        fields_.F.at(i, c) = deformed[static_cast<std::size_t>(id(i))][std::size_t{3} * (c / D_) + c % D_];
  } else if (!moved.empty() || !mixed) {
    deform_to_positions(backend);
  }
}

void JstBody::deform_to_positions(Backend const& backend) {
  Range const mine = state_.slots;
  std::vector<double> kept(static_cast<std::size_t>(mine.last - mine.first) * static_cast<std::size_t>(D_));
  bool const mixed = options_.variables != Variables::displacement;
  auto const each = [&](auto const& f) {
    for (Index i = mine.first; i < mine.last; ++i)
      for (int c = 0; c < D_; ++c) f(i, c, kept[static_cast<std::size_t>(i - mine.first) * D_ + c]);
  };
  each([&](Index i, int c, double& value) {
    value = JstBody::value(state_.u, i, c);
    set(state_.u, i, c, JstBody::value(state_.x, i, c));
  });
  Copies const* const copies = state_.u.copies;
  state_.u.copies = images_.copies({MirrorImages::Kind::position});  // present content of `u`
  backend.update_deformation(state_);
  state_.u.copies = copies;
  if (mixed) each([&](Index i, int c, double& value) { set(state_.u, i, c, value); });
  for (Index i = own().last; i < mine.last; ++i)
    for (int c = 0; c < D_; ++c) set(state_.F, i, c * D_ + c, 1);
}

/// The point cloud for multipliers: the particles with the gradient's kernel.
std::optional<Cloud> JstBody::cloud(ParticleSet const& set) const {
  if (!options_.multipliers) return std::nullopt;
  if (!images_.empty())
    throw InputError(
        fmt::format("body '{}': supports = \"multipliers\" does not go together with mirror planes - take "
                    "direct supports or rollers in place of the mirror planes",
                    body_.name));
  Cloud r{D_, {}, {}, options_.kernel, options_.gradient_support * spacing()};
  for (Index i = 0; i < order_.particles; ++i) {
    r.X.push_back(set.X[static_cast<std::size_t>(id(i))]);
    r.volume.push_back(set.volume[static_cast<std::size_t>(id(i))]);
  }
  return r;
}

/// Mean lattice spacing [m]: unit of the support radii of the options.
double JstBody::spacing() const {
  double size = 1;
  for (int c = 0; c < D_; ++c) size *= body_.spacing[static_cast<std::size_t>(c)];
  return std::pow(size, 1.0 / D_);
}

double JstBody::reach() const {
  double const h = std::max(options_.gradient_support, options_.laplacian_support);
  return options_.kernel->support * h * spacing();
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
  for (int c = 0; c < D_ * D_; ++c) r(c / D_, c % D_) = value(state_.F, slot, c);
  return r;
}

Mat<3> JstBody::H(Index slot) const {
  if (!wanted(fields_.H)) return cofactor(F(slot));
  Mat<3> r;
  for (int c = 0; c < 9; ++c) r.c[c] = value(state_.H, slot, c);
  return r;
}

double JstBody::J(Index slot) const {
  if (wanted(fields_.J)) return value(state_.J, slot);
  double J = 1;
  with_law(state_.material, [&](auto const& law) { J = volume_ratio_of(law.small_strain, F(slot)); });
  return J;
}

std::size_t JstBody::bytes() const {
  return order_.id.size() * sizeof(order_.id[0]) + partial_.size() * sizeof(double) +
         group_.size() * sizeof(group_[0]) + pairs_->bytes() + boundary_.bytes() + first_.memory.bytes() +
         second_.memory.bytes() + weight_.bytes() + fields_.bytes();
}

}  // namespace piola::jst_sph
