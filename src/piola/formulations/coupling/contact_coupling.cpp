// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/coupling/contact_coupling.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/math/array_conversion.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace piola {
namespace {

using Point = std::array<double, 3>;

/// Fraction of the stability limit of a pair of kicks that is used. The steps of formulations already contain theirs.
constexpr double margin = 0.85;

/// For a step h = 2 margin / omega: contact and ties add to the square of the frequency of the bodies.
double with_frequency(double step, double omega2) {
  return omega2 > 0 ? 1 / std::sqrt(1 / (step * step) + omega2 / (4 * margin * margin)) : step;
}

constexpr std::array<std::string_view, 4> offered_by_contact{"ContactPressure", "ContactGap", "Slip", "FrictionHeat"};

}  // namespace

void ContactCoupling::start(Formulations const& formulations) {
  PIOLA_EXPECTS(formulations.size() == particles_.group_count());
  particles_.read_masses(formulations);
  particles_.read_motion(formulations);
  system_.set_masses(particles_.surface_masses());
  fit_areas(formulations);
  find_lost_surfaces(formulations);
  std::vector<Vec<3>> const& x = particles_.x();
  ties_.start(system_, x, particles_.masses());
  if (loaded_.surfaces.empty()) {
    system_.start(x);
    motion_.start(system_);
  } else {
    system_.late_rigids().load(loaded_.rigid_depths);
    system_.restore(x, loaded_.surfaces);
    system_.load_depths(loaded_.depths);
    colours_.load(loaded_.colours);
    loaded_ = {};
  }
  colours_.evaluate(x, particles_.masses());
  sum_forces();
  closing_ = contact_time_step();
}

/// Points on flat faces get the areas by which a uniform pressure causes uniform stress, in sum those of the faces. A
/// body in which such an area is less than a quarter of the tributary area, on irregular clouds, keeps the tributary
/// areas.
void ContactCoupling::fit_areas(Formulations const& formulations) {
  constexpr double least = 0.25;
  contact::SurfacePoints& points = system_.points();
  for (std::size_t b = 0; b < points.surfaces().size(); ++b) {
    std::vector<contact::SurfacePoint> const& of_body = points.surfaces()[b].points;
    if (!points.surfaces()[b].is_box || of_body.empty()) continue;
    Index const first = points.number_of(b, 0);
    std::vector<ContactParticles::FacePlace> places;
    for (std::size_t k = 0; k < of_body.size(); ++k)
      places.push_back({points.particle(first + static_cast<Index>(k)), array_of(of_body[k].normal), of_body[k].area});
    particles_.read_face_areas(formulations, places);
    std::map<std::array<double, 3>, std::array<double, 2>> sums;  // before, after; by normal
    bool usable = true;
    for (std::size_t k = 0; k < of_body.size(); ++k) {
      usable = usable && places[k].area > least * of_body[k].area;
      if (of_body[k].image) continue;
      sums[places[k].normal][0] += of_body[k].area;
      sums[places[k].normal][1] += places[k].area;
    }
    for (std::size_t k = 0; k < of_body.size() && usable; ++k) {
      auto const& [before, after] = sums[places[k].normal];
      points.set_area(first + static_cast<Index>(k), after > 0 ? places[k].area * before / after : of_body[k].area);
    }
  }
}

/// Particles that have lost their surface in the last step leave surface contact and enter colour contact.
void ContactCoupling::find_lost_surfaces(Formulations const& formulations) {
  std::vector<char> const lost = particles_.find_lost_surfaces(formulations);
  if (lost.empty()) return;
  system_.drop({lost.begin(), lost.begin() + static_cast<std::ptrdiff_t>(system_.ids().size())});
  lost_.count(lost, particles_.ids());
  colours_.add_targets(lost);
  system_.late_rigids().add_targets(lost);
  if ((colours_.any() || system_.late_rigids().any()) && particles_.read_late()) {
    particles_.read_masses(formulations);
    particles_.read_motion(formulations);
  }
  system_.late_rigids().set_masses(particles_.masses());
}

/// Contact and ties together.
void ContactCoupling::sum_forces() {
  auto& [forces, loaded] = forces_;
  for (Index const k : loaded) forces[static_cast<std::size_t>(k)] = {};
  forces.resize(particles_.x().size());
  loaded.clear();
  std::set_union(system_.loaded_indices().begin(), system_.loaded_indices().end(), ties_.loaded_indices().begin(),
                 ties_.loaded_indices().end(), std::back_inserter(loaded));
  for (Index const k : system_.loaded_indices())
    forces[static_cast<std::size_t>(k)] = system_.forces()[static_cast<std::size_t>(k)];
  ties_.add_forces(forces);
  particles_.fold_images(forces_);
  add_forces(colours_.forces(), colours_.loaded_indices());
  add_forces(system_.late_rigids().forces(), system_.late_rigids().loaded_indices());
}

/// Adds forces at the indices `at`.
void ContactCoupling::add_forces(std::vector<Vec<3>> const& forces, std::vector<Index> const& at) {
  std::vector<Index> const before = std::exchange(forces_.loaded, {});
  std::set_union(before.begin(), before.end(), at.begin(), at.end(), std::back_inserter(forces_.loaded));
  for (Index const k : at) {
    auto const i = static_cast<std::size_t>(k);
    forces_.values[i] = forces_.values[i] + forces[i];
  }
}

/// Applies `factor` times these vectors as impulses [N s] to the bodies, and reactions to supports.
void ContactCoupling::apply(Formulations const& formulations, SparseVectors const& impulses, double factor,
                            double time) {
  particles_.apply(formulations, impulses, factor, time, held_);
  work_ -= held_.transfer_reactions(actions_.supports);
}

/// Applies the contact impulse of `half` [s] to the bodies (apply), adds it to the energy balance
/// (add_to_energy_balance) and to the rigid shapes (kick).
void ContactCoupling::apply_impulses(Formulations const& formulations, double time, double half) {
  apply(formulations, forces_, half, time);
  add_to_energy_balance(half);
  motion_.kick(system_, time, half);
}

/// Applies impulses of chatter damping, after those of contact.
void ContactCoupling::damp_chatter(Formulations const& formulations, double time) {
  if (!system_.damps_chatter()) return;
  contact::ChatterDamping const& damping = system_.chatter(particles_.x(), particles_.v());
  if (damping.damped().empty()) return;
  std::vector<Vec<3>> before;
  for (Index const k : damping.damped()) before.push_back(particles_.v()[static_cast<std::size_t>(k)]);
  SparseVectors const impulses{damping.impulses(), damping.damped()};
  apply(formulations, impulses, 1, time);
  exec::ReproducibleSum loss;
  for (std::size_t n = 0; n < before.size(); ++n) {
    auto const k = static_cast<std::size_t>(impulses.loaded[n]);
    loss += -0.5 * dot(impulses.values[k], before[n] + particles_.v()[k]);
  }
  chatter_loss_ += loss.value();
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
    for (std::size_t b = 0; b < names_.size(); ++b) pair_impulses_.add(a, b, system_.between(a, b), half);
  for (std::size_t p = 0; p < colours_.pairs().size(); ++p)
    pair_impulses_.add(colours_.pairs()[p].a, colours_.pairs()[p].b, colours_.resultant_on_first(p), half);
  ties_.add_to_energy_balance(half);
}

double ContactCoupling::contact_time_step() const {
  return std::min({system_.contact_time_step(particles_.v()), motion_.contact_time_step(system_.rigids()),
                   colours_.contact_time_step(particles_.x(), particles_.v())});
}

void ContactCoupling::begin(Formulations const& formulations, double time, double dt) {
  PIOLA_EXPECTS(formulations.size() == particles_.group_count() && dt > 0);
  actions_.begin(dt);
  pair_impulses_.clear();
  ties_.begin();
  motion_.springs().begin();
  last_dt_ = dt;
  apply_impulses(formulations, time, 0.5 * dt);
  motion_.kick_by_dashpots(system_, 0.5 * dt, false);
  motion_.move(system_.rigids(), time, dt);
  for (std::size_t r = 0; r < shapes_.size(); ++r) actions_.rigid_about[r] = array_of(system_.rigid(r).centre);
}

void ContactCoupling::finish(Formulations const& formulations, double time, double dt) {
  PIOLA_EXPECTS(formulations.size() == particles_.group_count() && dt > 0);
  if (colours_.any()) particles_.read_masses(formulations);  // deleted particles have none
  particles_.read_motion(formulations);
  find_lost_surfaces(formulations);
  ties_.evaluate(system_, particles_.x());
  system_.evaluate(particles_.x(), dt);
  ties_.transfer_energy(system_);
  motion_.evaluate(system_, dt);
  colours_.evaluate(particles_.x(), particles_.masses());
  sum_forces();
  friction_work_ += system_.totals().friction_work + motion_.between_shapes().friction_work;
  motion_.kick_by_dashpots(system_, 0.5 * dt, true);
  apply_impulses(formulations, time, 0.5 * dt);
  damp_chatter(formulations, time);
  closing_ = contact_time_step();
}

double ContactCoupling::limit(double step) const {
  double const omega2 =
      std::max(system_.totals().frequency2, motion_.frequency2()) + ties_.frequency2() + colours_.totals().frequency2;
  return std::min(with_frequency(step, omega2), closing_);
}

StepBound ContactCoupling::bound(StepBound of_bodies) const {
  double const step = limit(of_bodies.step), alone = limit(std::numeric_limits<double>::infinity());
  if (!(step < of_bodies.step)) return of_bodies;
  if (step == closing_)
    return {.step = step,
            .text = motion_.springs().any() ? "the approach of surfaces, or the springs of rigid shapes"
                                            : "the approach of surfaces"};
  if (alone < of_bodies.step) return {.step = step, .text = "the stiffness of contact and ties"};
  of_bodies.step = step;
  of_bodies.text += ", and the stiffness of contact and ties";
  return of_bodies;
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
      contact::ForceMoment const& sum = pair_impulses_(a, b);
      all.push_back({names_[a] + "-" + names_[b], array_of(scale * sum.force), array_of(scale * sum.moment)});
    }
  ties_.add_actions(scale, all);
  contact::RigidSprings const& springs = motion_.springs();
  for (std::size_t s = 0; s < springs.springs().size(); ++s) {
    contact::ForceMoment const& sum = springs.impulses()[s];
    all.push_back({springs.springs()[s].name, array_of(scale * sum.force), array_of(scale * sum.moment)});
  }
  return all;
}

void ContactCoupling::report(Diagnostics& sum) const {
  contact::Totals now = system_.totals();
  contact::RigidPairs::Totals const& between = motion_.between_shapes();
  now.energy += between.energy + colours_.totals().energy;
  now.spring_energy += between.spring_energy;
  contact::RigidSprings const& springs = motion_.springs();
  double const stored = now.energy + now.spring_energy + ties_.energy() + springs.energy(),
               moving = motion_.kinetic_energy();
  sum.strain_energy += stored;
  sum.kinetic_energy += moving;
  for (auto& [name, value] : sum.more)
    if (name == "centred_energy") value += stored + moving;  // the sum that does not rise
  sum.external_work += work_ + motion_.work();
  sum.damping_loss += motion_.damping_loss() + springs.dashpot_loss();
  for (std::size_t c = 0; c < 3; ++c) {
    sum.linear_momentum[c] += motion_.linear_momentum().c[c];
    sum.angular_momentum[c] += motion_.angular_momentum().c[c];
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
  if (springs.any())
    sum.more.insert(sum.more.end(), {{"spring_energy", springs.energy()}, {"dashpot_loss", springs.dashpot_loss()}});
  auto const named = [&](std::size_t k) {
    return k < names_.size() ? "body " + in_quotes(names_[k])
                             : "the rigid shape " + in_quotes(shapes_[k - names_.size()].name);
  };
  for (contact::Passed const& p : system_.passed()) sum.passages.push_back({named(p.of), named(p.through), p.points});
  lost_.report(sum);
}

std::vector<FieldInfo> contact_fields() { return field_infos(offered_by_contact); }

bool ContactCoupling::sample(std::string_view field, std::span<double> values) const {
  if (std::find(offered_by_contact.begin(), offered_by_contact.end(), field) == offered_by_contact.end()) return false;
  if (values.empty()) return true;  // replicated, needed on root only
  OutputField const& observed = find_output_field(field, offered_by_contact);
  for (auto const& at : system_.at_particles()) {
    auto const place = std::lower_bound(system_.ids().begin(), system_.ids().end(), at.id) - system_.ids().begin();
    auto const id = particles_.ids()[static_cast<std::size_t>(place)];
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
