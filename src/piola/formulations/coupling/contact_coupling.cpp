// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/coupling/contact_coupling.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/formulations/coupled_particles.hpp"
#include "piola/math/array_conversion.hpp"
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

/// For a step h = 2 margin / omega: contact and ties add to the square of the frequency of the bodies.
double with_frequency(double step, double omega2) {
  return omega2 > 0 ? 1 / std::sqrt(1 / (step * step) + omega2 / (4 * margin * margin)) : step;
}

constexpr std::array<std::string_view, 4> offered_by_contact{"ContactPressure", "ContactGap", "Slip", "FrictionHeat"};

}  // namespace

void ContactCoupling::read_masses(Formulations const& formulations) {
  std::vector<double> m;
  for (GroupParticles const& share : shares_) {
    m.resize(share.local.size());
    formulations[share.part]->read_masses(share.local, m);
    for (std::size_t k = 0; k < share.at.size(); ++k) mass_[static_cast<std::size_t>(share.at[k])] = m[k];
  }
}

void ContactCoupling::read_state(Formulations const& formulations) {
  std::vector<Point> x, v;
  if (colours_.any()) read_masses(formulations);  // deleted particles have none
  for (GroupParticles const& share : shares_) {
    x.resize(share.local.size());
    v.resize(share.local.size());
    formulations[share.part]->read_motion(share.local, x, v);
    for (std::size_t k = 0; k < share.at.size(); ++k) {
      x_[static_cast<std::size_t>(share.at[k])] = vector_of(x[k]);
      v_[static_cast<std::size_t>(share.at[k])] = vector_of(v[k]);
    }
  }
  place_images();
}

/// Removes points of particles that their formulation now keeps apart from other bodies itself.
void ContactCoupling::drop_lost_surfaces(Formulations const& formulations) {
  std::vector<char> lost;
  for (GroupParticles& share : shares_) {
    CoupledParticles const& particles = *formulations[share.part];
    if (particles.surfaces_lost() == share.lost) continue;
    share.lost = particles.surfaces_lost();
    lost.resize(system_.ids().size());
    for (std::size_t k = 0; k < share.at.size(); ++k)
      if (auto const i = static_cast<std::size_t>(share.at[k]);
          i < lost.size() && particles.has_lost_surface(share.local[k]))
        lost[i] = 1;
  }
  if (!lost.empty()) system_.drop(lost);
}

void ContactCoupling::place_images() {
  for (Image const& image : images_) {
    auto const at = static_cast<std::size_t>(image.at), source = static_cast<std::size_t>(image.source);
    for (int c = 0; c < 3; ++c) {
      double const sign = image.sign[static_cast<std::size_t>(c)];
      x_[at][c] = sign * x_[source][c] + image.shift[static_cast<std::size_t>(c)];
      v_[at][c] = sign * v_[source][c];
    }
    mass_[at] = mass_[source];
  }
}

/// Adds the forces on images to their sources: the energy is a function of the particles of the run.
void ContactCoupling::fold_images() {
  if (images_.empty()) return;
  std::vector<Index> real;
  auto image = images_.begin();
  for (Index const k : loaded_indices_) {
    while (image != images_.end() && image->at < k) ++image;
    if (image == images_.end() || image->at != k) {
      real.push_back(k);
      continue;
    }
    Vec<3>&from = forces_[static_cast<std::size_t>(k)], &to = forces_[static_cast<std::size_t>(image->source)];
    for (int c = 0; c < 3; ++c) to[c] += image->sign[static_cast<std::size_t>(c)] * from[c];
    from = {};
    real.push_back(image->source);
  }
  std::sort(real.begin(), real.end());
  real.erase(std::unique(real.begin(), real.end()), real.end());
  loaded_indices_ = std::move(real);
}

void ContactCoupling::look(Formulations const& formulations) {
  PIOLA_EXPECTS(formulations.size() == shares_.size());
  read_masses(formulations);
  read_state(formulations);
  system_.set_masses({mass_.begin(), mass_.begin() + static_cast<std::ptrdiff_t>(system_.ids().size())});
  drop_lost_surfaces(formulations);
  ties_.look(system_, x_, mass_);
  if (loaded_.empty()) {
    system_.start(x_);
    motion_.start(system_);
  } else {
    system_.restore(x_, std::exchange(loaded_, {}));
  }
  colours_.evaluate(x_, mass_);
  sum_forces();
  closing_ = contact_time_step();
}

/// Contact and ties together.
void ContactCoupling::sum_forces() {
  for (Index const k : loaded_indices_) forces_[static_cast<std::size_t>(k)] = {};
  forces_.resize(x_.size());
  loaded_indices_.clear();
  std::set_union(system_.loaded_indices().begin(), system_.loaded_indices().end(), ties_.loaded_indices().begin(),
                 ties_.loaded_indices().end(), std::back_inserter(loaded_indices_));
  for (Index const k : system_.loaded_indices())
    forces_[static_cast<std::size_t>(k)] = system_.forces()[static_cast<std::size_t>(k)];
  ties_.add_forces(forces_);
  fold_images();
  std::vector<Index> const surfaces = std::exchange(loaded_indices_, {});
  std::set_union(surfaces.begin(), surfaces.end(), colours_.loaded_indices().begin(), colours_.loaded_indices().end(),
                 std::back_inserter(loaded_indices_));
  for (Index const k : colours_.loaded_indices()) {
    auto const i = static_cast<std::size_t>(k);
    forces_[i] = forces_[i] + colours_.forces()[i];
  }
}

/// The impulse of `half` [s] by the forces as they are. Directions that a support holds keep their velocity: the
/// support gives the impulse back and does the work that its motion takes.
void ContactCoupling::give(Formulations const& formulations, double time, double half) {
  std::vector<std::vector<std::int64_t>> ids(shares_.size());
  std::vector<std::vector<Point>> change(shares_.size());
  std::vector<ImpulseSum> kept_by(actions_.supports.size());
  exec::ReproducibleSum kept_work;
  for (std::size_t s = 0; s < shares_.size(); ++s) {
    GroupParticles const& share = shares_[s];
    auto pushed = loaded_indices_.begin();
    for (std::size_t k = 0; k < share.at.size() && pushed != loaded_indices_.end(); ++k) {
      while (pushed != loaded_indices_.end() && *pushed < share.at[k]) ++pushed;
      if (pushed == loaded_indices_.end() || *pushed != share.at[k]) continue;
      auto const i = static_cast<std::size_t>(share.at[k]);
      Vec<3> impulse = half * forces_[i];
      for (ConstrainedDirection const& held : held_[i]) {
        if (has_ended(held.until, time)) continue;
        Vec<3> const d = vector_of(held.direction);
        Vec<3> const kept = dot(impulse, d) * d;
        impulse = impulse - kept;
        if (held.support == plane) continue;
        kept_work += dot(kept, v_[i]);
        kept_by[held.support].add(array_of(x_[i]), array_of(-1.0 * kept));
      }
      ids[s].push_back(share.local[k]);
      change[s].push_back(array_of((1 / mass_[i]) * impulse));
      v_[i] = v_[i] + (1 / mass_[i]) * impulse;
    }
    formulations[share.part]->add_velocities(ids[s], change[s]);
  }
  for (std::size_t s = 0; s < kept_by.size(); ++s) actions_.supports[s].add(kept_by[s].value());
  work_ -= kept_work.value();
}

/// Applies the contact impulse of `half` [s] to the bodies (give), adds it to the energy balance
/// (add_to_energy_balance) and to the rigid shapes (kick).
void ContactCoupling::apply_impulses(Formulations const& formulations, double time, double half) {
  give(formulations, time, half);
  add_to_energy_balance(half);
  motion_.kick(system_, time, half);
}

/// Applies impulses of chatter damping, after those of contact. They temporarily replace the forces.
void ContactCoupling::damp_chatter(Formulations const& formulations, double time) {
  if (!system_.damps_chatter()) return;
  contact::ChatterDamping const& damping = system_.chatter(x_, v_);
  if (damping.damped().empty()) return;
  std::vector<Vec<3>> forces(forces_.size());
  for (Index const k : damping.damped())
    forces[static_cast<std::size_t>(k)] = damping.impulses()[static_cast<std::size_t>(k)];
  std::vector<Index> pushed = damping.damped();
  std::swap(forces, forces_);
  std::swap(pushed, loaded_indices_);
  std::vector<Vec<3>> before;
  for (Index const k : loaded_indices_) before.push_back(v_[static_cast<std::size_t>(k)]);
  give(formulations, time, 1);
  exec::ReproducibleSum loss;
  for (std::size_t n = 0; n < before.size(); ++n) {
    auto const k = static_cast<std::size_t>(loaded_indices_[n]);
    loss += -0.5 * dot(forces_[k], before[n] + v_[k]);
  }
  chatter_loss_ += loss.value();
  std::swap(forces, forces_);
  std::swap(pushed, loaded_indices_);
}

/// Records the impulses between rigid shapes and pairs of bodies in `half` [s].
void ContactCoupling::add_to_energy_balance(double half) {
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
  for (std::size_t p = 0; p < colours_.pairs().size(); ++p) {
    auto const& pair = colours_.pairs()[p];
    auto& sum = pair_impulses_[pair.a * names_.size() + pair.b];
    auto const between = colours_.resultant_on_first(p);
    sum.force = sum.force + half * between.force;
    sum.moment = sum.moment + half * between.moment;
  }
  ties_.add_to_energy_balance(half);
}

double ContactCoupling::contact_time_step() const {
  return std::min(
      {system_.contact_time_step(v_), motion_.contact_time_step(system_.rigids()), colours_.contact_time_step(x_, v_)});
}

void ContactCoupling::begin(Formulations const& formulations, double time, double dt) {
  PIOLA_EXPECTS(formulations.size() == shares_.size() && dt > 0);
  actions_.begin(dt);
  std::fill(pair_impulses_.begin(), pair_impulses_.end(), contact::ForceMoment{});
  ties_.begin();
  last_dt_ = dt;
  apply_impulses(formulations, time, 0.5 * dt);
  motion_.move(system_.rigids(), time, dt);
  for (std::size_t r = 0; r < shapes_.size(); ++r) actions_.rigid_about[r] = array_of(system_.rigid(r).centre);
}

void ContactCoupling::finish(Formulations const& formulations, double time, double dt) {
  PIOLA_EXPECTS(formulations.size() == shares_.size() && dt > 0);
  read_state(formulations);
  drop_lost_surfaces(formulations);
  ties_.evaluate(system_, x_);
  system_.evaluate(x_, dt);
  ties_.transfer_energy(system_);
  motion_.evaluate(system_, dt);
  colours_.evaluate(x_, mass_);
  sum_forces();
  friction_work_ += system_.totals().friction_work + motion_.between_shapes().friction_work;
  apply_impulses(formulations, time, 0.5 * dt);
  damp_chatter(formulations, time);
  closing_ = contact_time_step();
}

double ContactCoupling::limit(double step) const {
  double const omega2 =
      std::max(system_.totals().frequency2, motion_.frequency2()) + ties_.frequency2() + colours_.totals().frequency2;
  return std::min(with_frequency(step, omega2), closing_);
}

double ContactCoupling::settled(double step) const { return with_frequency(step, ties_.settled_frequency2()); }

std::vector<Action> ContactCoupling::pairs() const {
  std::vector<Action> all;
  double const scale = last_dt_ > 0 ? 1 / last_dt_ : 0;
  for (std::size_t a = 0; a < names_.size(); ++a)
    for (std::size_t b = a + 1; b < names_.size(); ++b) {
      bool const coloured = std::any_of(colours_.pairs().begin(), colours_.pairs().end(),
                                        [&](auto const& pair) { return pair.a == a && pair.b == b; });
      if (!system_.is_active(a, b) && !coloured) continue;
      auto const& sum = pair_impulses_[a * names_.size() + b];
      all.push_back({names_[a] + "-" + names_[b], array_of(scale * sum.force), array_of(scale * sum.moment)});
    }
  ties_.add_actions(scale, all);
  return all;
}

void ContactCoupling::report(Diagnostics& sum) const {
  contact::Totals now = system_.totals();
  contact::RigidPairs::Totals const& between = motion_.between_shapes();
  now.energy += between.energy + colours_.totals().energy;
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
  overlap = std::max({overlap, now.deepest, between.deepest, colours_.totals().deepest});
  column("friction_heat") = friction_work_ - now.spring_energy;
  column("chatter_damping_loss") = chatter_loss_;
  column("contact_points") = static_cast<double>(now.touched) + between.touched + colours_.totals().touched;
  ties_.report(sum);
  auto const named = [&](std::size_t k) {
    return k < names_.size() ? "body " + in_quotes(names_[k])
                             : "the rigid shape " + in_quotes(shapes_[k - names_.size()].name);
  };
  for (contact::Passed const& p : system_.passed()) sum.passages.push_back({named(p.of), named(p.through), p.points});
}

std::vector<FieldInfo> ContactCoupling::fields() { return field_infos(offered_by_contact); }

bool ContactCoupling::sample(std::string_view field, std::span<double> values) const {
  if (std::find(offered_by_contact.begin(), offered_by_contact.end(), field) == offered_by_contact.end()) return false;
  if (values.empty()) return true;  // all ranks have the values, only rank 0 needs them
  OutputField const& observed = find_output_field(field, offered_by_contact);
  for (auto const& at : system_.at_particles()) {
    auto const place = std::lower_bound(system_.ids().begin(), system_.ids().end(), at.id) - system_.ids().begin();
    auto const id = run_ids_[static_cast<std::size_t>(place)];
    if (id < 0) continue;
    ParticleOutput p;
    p.id = static_cast<double>(id);
    p.contact_pressure = at.pressure;
    p.contact_gap = at.gap;
    p.slip = at.slid;
    p.friction_heat = at.heat;
    put(observed, p, values);
  }
  return true;
}

std::optional<Failure> ContactCoupling::failure() const {
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
