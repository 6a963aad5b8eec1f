// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/meeting.hpp"
#include "piola/math/places.hpp"
#include "piola/mechanics/prescribed.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace piola {
namespace {

using Point = std::array<double, 3>;

/// Share of the stability limit of a pair of kicks that is used; the steps of formulations have theirs in them.
constexpr double margin = 0.85;

/// Of a step h = 2 margin / omega: contact and ties add to the square of the frequency of the bodies.
double with_frequency(double step, double omega2) {
  return omega2 > 0 ? 1 / std::sqrt(1 / (step * step) + omega2 / (4 * margin * margin)) : step;
}

constexpr std::array<std::string_view, 4> offered_by_contact{"ContactPressure", "ContactGap", "Slip", "FrictionHeat"};

std::vector<contact::RigidSurface> rigid_surfaces(Assembly const& whole) {
  std::vector<contact::RigidSurface> all;
  for (RigidShape const& shape : whole.rigid_shapes)
    all.push_back(contact::surface_of(shape, whole.particles.dimension));
  return all;
}

/// Who meets whom: bodies with a surface, except two of a formulation that has a contact of its own and are not tied,
/// and such a body and a rigid shape that does not turn; what is said of a pair goes before what is said of all.
contact::System::Setting touches_of(Assembly const& whole) {
  auto const own = [&](std::size_t b) {
    auto const info = find_formulation(whole.formulations[b].name);
    return info && info->contact && whole.contact.law != ContactRule::Law::surface;
  };
  auto const& bodies = whole.particles.bodies;
  std::size_t const n = bodies.size(), all = n + whole.rigid_shapes.size();
  contact::System::Setting touches(n, std::vector<contact::System::Touch>(all));
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < all; ++b) {
      bool const rigid = b >= n;
      std::string const& name = rigid ? whole.rigid_shapes[b - n].name : bodies[b].name;
      ContactPair const* const pair = find_pair(whole.contact_pairs, bodies[a].name, name);
      bool const surfaces = !whole.surfaces[a].points.empty() && (rigid || !whole.surfaces[b].points.empty());
      // By the contact of their own formulation.
      bool const apart =
          own(a) && (rigid ? !whole.rigid_shapes[b - n].turns() : own(b) && !contact::is_tied(whole.ties, a, b));
      bool const others = a == b ? pair != nullptr || whole.contact.self : !apart;
      bool const off = whole.contact.law == ContactRule::Law::none || (pair != nullptr && pair->off);
      touches[a][b] = {surfaces && others && !off, 0.5 * (pair != nullptr ? pair->scale : whole.contact.scale),
                       pair != nullptr ? pair->friction : whole.contact.friction};
    }
  return touches;
}

contact::System system_of(Assembly const& whole) {
  return {whole.particles, whole.surfaces, rigid_surfaces(whole), touches_of(whole)};
}

/// The layer between rigid shapes is that of the stiffest body that has a surface.
contact::RigidMotion motion_of(Assembly const& whole) {
  contact::RigidPairs::Setting between{0, 0, whole.contact.friction};
  for (contact::Surface const& surface : whole.surfaces) {
    if (surface.points.empty()) continue;
    double const k = contact::layer_stiffness(1, 0.5 * whole.contact.scale, surface.modulus, surface.spacing);
    if (k > between.stiffness) between = {k, surface.spacing, whole.contact.friction};
  }
  return {whole.rigid_shapes, whole.particles.dimension, between};
}

}  // namespace

Meeting::Meeting(Assembly const& whole, std::vector<EnsemblePart> const& parts)
    : dimension_(whole.particles.dimension),
      shapes_(whole.rigid_shapes),
      supports_(whole.supports),
      system_(system_of(whole)),
      motion_(motion_of(whole)),
      held_(system_.ids().size()),
      actions_(whole.supports, whole.loads, whole.rigid_shapes),
      ties_(whole, system_) {
  for (Body const& body : whole.particles.bodies) names_.push_back(body.name);
  motion_.place(system_.rigids());
  auto const& ids = system_.ids();
  for (std::size_t p = 0; p < parts.size(); ++p) {
    Share share{.part = p, .at = {}, .local = {}};
    for (std::size_t k = 0; k < ids.size(); ++k)
      if (auto const local = parts[p].id_in_part(ids[k])) {
        share.at.push_back(static_cast<Index>(k));
        share.local.push_back(*local);
      }
    shares_.push_back(std::move(share));
  }
  find_held();
  mass_.resize(ids.size());
  x_.resize(ids.size());
  v_.resize(ids.size());
  std::size_t const n = names_.size();
  pair_impulses_.resize(n * n);
}

/// The directions that supports hold of particles on surfaces. Those that hold the surface itself are the formulation's
/// business, which gives back what moves it.
void Meeting::find_held() {
  auto const& ids = system_.ids();
  for (std::size_t s = 0; s < supports_.size(); ++s) {
    if (supports_[s].on_surface()) continue;
    for (auto const id : supports_[s].particles) {
      auto const found = std::lower_bound(ids.begin(), ids.end(), id);
      if (found == ids.end() || *found != id) continue;
      auto& here = held_[static_cast<std::size_t>(found - ids.begin())];
      std::vector<Direction> known;
      for (Held const& held : here) known.push_back(held.direction);
      for (Direction d : directions_of(supports_[s], dimension_)) {
        if (!make_orthogonal(d, known)) continue;
        known.push_back(d);
        here.push_back({s, d, supports_[s].until});
      }
    }
  }
}

void Meeting::read_state(Formulations const& formulations) {
  std::vector<Point> x, v;
  for (Share const& share : shares_) {
    x.resize(share.local.size());
    v.resize(share.local.size());
    formulations[share.part]->read_motion(share.local, x, v);
    for (std::size_t k = 0; k < share.at.size(); ++k) {
      x_[static_cast<std::size_t>(share.at[k])] = vector_of(x[k]);
      v_[static_cast<std::size_t>(share.at[k])] = vector_of(v[k]);
    }
  }
}

void Meeting::look(Formulations const& formulations) {
  std::vector<double> m;
  for (Share const& share : shares_) {
    m.resize(share.local.size());
    formulations[share.part]->read_masses(share.local, m);
    for (std::size_t k = 0; k < share.at.size(); ++k) mass_[static_cast<std::size_t>(share.at[k])] = m[k];
  }
  system_.set_masses(mass_);
  read_state(formulations);
  ties_.look(system_, x_, mass_);
  if (loaded_.empty()) {
    system_.start(x_);
    motion_.start(system_);
  } else {
    system_.restore(x_, std::exchange(loaded_, {}));
  }
  sum_forces();
  closing_ = closing_step();
}

/// Contact and ties together.
void Meeting::sum_forces() {
  for (Index const k : pushed_) forces_[static_cast<std::size_t>(k)] = {};
  forces_.resize(x_.size());
  pushed_.clear();
  std::set_union(system_.pushed().begin(), system_.pushed().end(), ties_.pushed().begin(), ties_.pushed().end(),
                 std::back_inserter(pushed_));
  for (Index const k : system_.pushed())
    forces_[static_cast<std::size_t>(k)] = system_.forces()[static_cast<std::size_t>(k)];
  ties_.add_forces(forces_);
}

/// The impulse of `half` [s] by the forces as they are. Directions that a support holds keep their velocity: the
/// support gives the impulse back and does the work that its motion takes.
void Meeting::push(Formulations const& formulations, double time, double half) {
  std::vector<std::vector<std::int64_t>> ids(shares_.size());
  std::vector<std::vector<Point>> change(shares_.size());
  std::vector<ImpulseSum> kept_by(actions_.supports.size());
  exec::ExactSum kept_work;
  for (std::size_t s = 0; s < shares_.size(); ++s) {
    Share const& share = shares_[s];
    auto pushed = pushed_.begin();
    for (std::size_t k = 0; k < share.at.size() && pushed != pushed_.end(); ++k) {
      while (pushed != pushed_.end() && *pushed < share.at[k]) ++pushed;
      if (pushed == pushed_.end() || *pushed != share.at[k]) continue;
      auto const i = static_cast<std::size_t>(share.at[k]);
      Vec<3> impulse = half * forces_[i];
      for (Held const& held : held_[i]) {
        if (has_ended(held.until, time)) continue;
        Vec<3> const d = vector_of(held.direction);
        Vec<3> const kept = dot(impulse, d) * d;
        impulse = impulse - kept;
        kept_work += dot(kept, v_[i]);
        kept_by[held.support].add(array_of(x_[i]), array_of(-1.0 * kept));
      }
      ids[s].push_back(share.local[k]);
      change[s].push_back(array_of((1 / mass_[i]) * impulse));
      v_[i] = v_[i] + (1 / mass_[i]) * impulse;
    }
    formulations[share.part]->push(ids[s], change[s]);
  }
  for (std::size_t s = 0; s < kept_by.size(); ++s) actions_.supports[s].add(kept_by[s].value());
  work_ -= kept_work.value();
  book(half);
  motion_.kick(system_, time, half);
}

/// What rigid shapes and pairs of bodies did to each other in `half` [s].
void Meeting::book(double half) {
  for (std::size_t r = 0; r < shapes_.size(); ++r) {
    auto const on = motion_.on(system_, r);
    Point const about = actions_.rigid_about[r];
    contact::RigidSurface const& rigid = system_.rigid(r);
    if (!shapes_[r].free) work_ -= half * (dot(on.force, rigid.velocity) + dot(on.moment, rigid.angular_velocity));
    Impulse by;
    by.linear = array_of(-half * on.force);
    by.angular = array_of(-half * (on.moment + cross(vector_of(about), on.force)));
    actions_.rigids[r].add(by);
  }
  for (std::size_t a = 0; a < names_.size(); ++a)
    for (std::size_t b = 0; b < names_.size(); ++b) {
      auto const& between = system_.between(a, b);
      auto& sum = pair_impulses_[a * names_.size() + b];
      sum.force = sum.force + half * between.force;
      sum.moment = sum.moment + half * between.moment;
    }
  ties_.book(half);
}

double Meeting::closing_step() const {
  return std::min(system_.closing_step(v_), motion_.closing_step(system_.rigids()));
}

void Meeting::begin(Formulations const& formulations, double time, double dt) {
  actions_.begin(dt);
  std::fill(pair_impulses_.begin(), pair_impulses_.end(), contact::System::Between{});
  ties_.begin();
  last_dt_ = dt;
  push(formulations, time, 0.5 * dt);
  motion_.move(system_.rigids(), time, dt);
  for (std::size_t r = 0; r < shapes_.size(); ++r) actions_.rigid_about[r] = array_of(system_.rigid(r).centre);
}

void Meeting::finish(Formulations const& formulations, double time, double dt) {
  read_state(formulations);
  ties_.evaluate(system_, x_);
  system_.evaluate(x_, dt);
  ties_.hand_over(system_);
  motion_.evaluate(system_, dt);
  sum_forces();
  friction_work_ += system_.totals().friction_work + motion_.between_shapes().friction_work;
  push(formulations, time, 0.5 * dt);
  closing_ = closing_step();
}

double Meeting::limit(double step) const {
  double const omega2 = std::max(system_.totals().frequency2, motion_.frequency2()) + ties_.frequency2();
  return std::min(with_frequency(step, omega2), closing_);
}

double Meeting::settled(double step) const { return with_frequency(step, ties_.frequency2()); }

std::vector<Action> Meeting::pairs() const {
  std::vector<Action> all;
  double const scale = last_dt_ > 0 ? 1 / last_dt_ : 0;
  for (std::size_t a = 0; a < names_.size(); ++a)
    for (std::size_t b = a + 1; b < names_.size(); ++b) {
      if (!system_.meets(a, b)) continue;
      auto const& sum = pair_impulses_[a * names_.size() + b];
      all.push_back({names_[a] + "-" + names_[b], array_of(scale * sum.force), array_of(scale * sum.moment)});
    }
  ties_.add_actions(scale, all);
  return all;
}

void Meeting::report(Diagnostics& sum) const {
  contact::Totals now = system_.totals();
  contact::RigidPairs::Totals const& between = motion_.between_shapes();
  now.energy += between.energy;
  now.spring_energy += between.spring_energy;
  double const stored = now.energy + now.spring_energy + ties_.energy(), moving = motion_.kinetic_energy();
  sum.strain_energy += stored;
  sum.kinetic_energy += moving;
  for (auto& [name, value] : sum.more)
    if (name == "centred_energy") value += stored + moving;  // the sum that does not rise
  sum.external_work += work_ + motion_.work();
  sum.damping_loss += motion_.damping_loss();
  for (int c = 0; c < 3; ++c) {
    sum.linear_momentum[static_cast<std::size_t>(c)] += motion_.linear_momentum()[c];
    sum.angular_momentum[static_cast<std::size_t>(c)] += motion_.angular_momentum()[c];
  }
  sum.rigids = rigids();
  auto const column = [&](char const* name) -> double& {
    for (auto& [known, value] : sum.more)
      if (known == name) return value;
    return sum.more.emplace_back(name, 0.0).second;
  };
  column("contact_energy") += now.energy;
  double& overlap = column("contact_overlap");
  overlap = std::max({overlap, now.deepest, between.deepest});
  column("friction_heat") = friction_work_ - now.spring_energy;
  column("contact_points") = static_cast<double>(now.touched) + between.touched;
  ties_.report(sum);
}

std::vector<FieldInfo> Meeting::fields() { return field_infos(offered_by_contact); }

bool Meeting::sample(std::string_view field, std::span<double> values) const {
  if (std::find(offered_by_contact.begin(), offered_by_contact.end(), field) == offered_by_contact.end()) return false;
  ObservedField const& observed = find_observed(field, offered_by_contact);
  for (auto const& at : system_.at_particles()) {
    ObservedParticle p;
    p.id = static_cast<double>(at.id);
    p.contact_pressure = at.pressure;
    p.contact_gap = at.gap;
    p.slip = at.slid;
    p.friction_heat = at.heat;
    put(observed, p, values);
  }
  return true;
}

std::optional<Failure> Meeting::failure() const {
  for (RigidState const& rigid : rigids()) {
    double const sum = rigid.kinetic_energy + rigid.centre[0] + rigid.centre[1] + rigid.centre[2];
    if (std::isfinite(sum)) continue;
    Failure failure;
    failure.what = "free rigid shape '" + rigid.name + "' moves with what is not a number";
    failure.values = {{"kinetic energy [J]", rigid.kinetic_energy}, {"x [m]", rigid.centre[0]}};
    return failure;
  }
  return std::nullopt;
}

}  // namespace piola
