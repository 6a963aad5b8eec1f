// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/ties.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>

namespace piola::contact {
namespace {

std::size_t place_of(Index k) { return static_cast<std::size_t>(k); }

Vec<3> place_on(RigidSurface const& shape, Vec<3> const& arm) { return shape.centre + shape.turn * arm; }

}  // namespace

/// Whether the tied point belongs to the object that the tie names first.
bool Ties::is_of_first(Row const& row) const {
  TieRule const& rule = rules_[row.tie];
  return row.hold.body == rule.bodies[0] && !rule.rigid_first;
}

/// Computes jump and traction of a row; writes only data of the row.
void Ties::stretch(std::size_t r, HostParticles const& hosts, std::vector<Vec<3>> const& x,
                   std::vector<RigidSurface> const& rigids) {
  Row const& row = rows_[r];
  if (has_failed(r)) {
    pulls_[r] = {};
    return;
  }
  Vec<3> const& self = x[place_of(terms_[row.first].at)];
  Vec<3> own, other;
  for (std::size_t k = row.first + 1; k < row.other; ++k) own = own + terms_[k].c * (x[place_of(terms_[k].at)] - self);
  for (std::size_t k = row.other; k < row.last; ++k) other = other + terms_[k].c * (x[place_of(terms_[k].at)] - self);
  TieForce pull{own + other, self + own, {}, {}};
  if (row.rigid != no_shape) pull.jump = pull.y - place_on(rigids[row.rigid], row.arm);
  Bond bond;
  if (rules_[row.tie].fails()) {
    Vec<3> const n = push_forward_normal(hosts.F(row.host, x), row.N);
    double const opening = effective_opening(row.law, separation(pull.jump, n));
    if (opening > opened_[r]) opened_[r] = opening;
    bond = cohesive_bond(row.law, pull.jump, n, opened_[r]);
    lost_[r] = row.area * lost_energy(row.law, opened_[r]);
    if (has_failed(r)) {  // energy stored at failure under pressure is lost with it
      lost_[r] += row.area * bond.energy;
      bond = {};
    }
  } else {
    bond = elastic_bond(row.law.stiffness, pull.jump);
  }
  pull.energy = row.area * bond.energy;
  pull.by_jump = row.area * bond.by_jump;
  pull.by_normal = row.area * bond.by_normal;
  pulls_[r] = pull;
}

void Ties::evaluate(HostParticles const& hosts, std::vector<Vec<3>> const& x, std::vector<RigidSurface> const& rigids) {
  PIOLA_EXPECTS(rows_.empty() || x.size() >= forces_.size());
  released_.clear();
  for (std::size_t r = 0; r < rows_.size(); ++r)
    if (!has_failed(r)) released_.push_back(r);
  exec_host::parallel_for(static_cast<Index>(rows_.size()), [&](Index r) { stretch(place_of(r), hosts, x, rigids); });
  std::erase_if(released_, [&](std::size_t r) { return !has_failed(r); });
  exec_host::parallel_for(static_cast<Index>(touched_.size()), [&](Index k) {
    Vec<3> sum;
    for (std::size_t j = begin_[place_of(k)]; j < begin_[place_of(k) + 1]; ++j)
      sum = sum - by_particle_[j].c * pulls_[place_of(by_particle_[j].at)].by_jump;
    forces_[place_of(touched_[place_of(k)])] = sum;
  });
  std::vector<ForceMomentSum> resultant_on_first(rules_.size());
  add_up(resultant_on_first, rigids);
  for (std::size_t r = 0; r < rows_.size(); ++r)
    if (dot(pulls_[r].by_normal, pulls_[r].by_normal) > 0)
      resultant_on_first[rows_[r].tie].add(turn(rows_[r], pulls_[r].by_normal, hosts, x));
  for (std::size_t tie = 0; tie < rules_.size(); ++tie) on_first_[tie] = resultant_on_first[tie].value();
}

void Ties::add_up(std::vector<ForceMomentSum>& resultant_on_first, std::vector<RigidSurface> const& rigids) {
  std::vector<ForceMomentSum> resultant_on_rigid(on_rigid_.size());
  exec::ReproducibleSum energy, heat, can_fail, failed;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    Row const& row = rows_[r];
    TieForce const& pull = pulls_[r];
    energy += pull.energy;
    heat += lost_[r];
    if (rules_[row.tie].fails()) can_fail += row.area;
    if (has_failed(r)) failed += row.area;
    bool const first = is_of_first(row);
    Vec<3> const f = (first ? -1.0 : 1.0) * pull.by_jump, y = first ? pull.y : pull.y - pull.jump;
    resultant_on_first[row.tie].add(f, cross(y, f));
    if (row.rigid != no_shape)
      resultant_on_rigid[row.rigid].add(pull.by_jump, cross(rigids[row.rigid].turn * row.arm, pull.by_jump));
  }
  for (std::size_t k = 0; k < resultant_on_rigid.size(); ++k) on_rigid_[k] = resultant_on_rigid[k].value();
  totals_ = {energy.value(), heat.value(), can_fail.value() > 0 ? failed.value() / can_fail.value() : 0};
}

/// Forces of a load on the normal of the held point, by way of F of its particle.
Vec<3> Ties::turn(Row const& row, Vec<3> const& by_normal, HostParticles const& hosts, std::vector<Vec<3>> const& x) {
  Mat<3> const T = couple({}, row.N, hosts.F(row.host, x), {{}, by_normal, {}});
  std::size_t const self = place_of(hosts.self(row.host));
  Vec<3> moment;
  for (std::size_t j = hosts.first(row.host); j < hosts.last(row.host); ++j) {
    HostParticles::Neighbour const& b = hosts.neighbour(j);
    Vec<3> const f = T * b.g;
    forces_[place_of(b.at)] = forces_[place_of(b.at)] - f;
    forces_[self] = forces_[self] + f;
    moment = moment - cross(x[place_of(b.at)] - x[self], f);
  }
  return is_of_first(row) ? moment : Vec<3>{};
}

double Ties::springs_of_shape(std::size_t shape, std::vector<RigidSurface> const& rigids) const {
  PIOLA_EXPECTS(shape < rigids.size());
  exec::ReproducibleSum sum;
  for (Row const& row : rows_)
    if (row.rigid == shape)
      sum += row.area * row.law.stiffness * std::max(1.0, row.law.shear2) *
             rigids[shape].mobility(place_on(rigids[shape], row.arm));
  return sum.value();
}

std::vector<double> Ties::state() const {
  std::vector<double> all = opened_;
  all.insert(all.end(), lost_.begin(), lost_.end());
  return all;
}

void Ties::restore(std::vector<double> const& state) {
  PIOLA_EXPECTS(state.size() == 2 * rows_.size());
  auto const half = state.begin() + static_cast<std::ptrdiff_t>(rows_.size());
  opened_.assign(state.begin(), half);
  lost_.assign(half, state.end());
}

std::size_t Ties::bytes() const {
  return rows_.size() * (sizeof(Row) + sizeof(TieForce) + 2 * sizeof(double)) +
         (terms_.size() + by_particle_.size()) * sizeof(Term) + forces_.size() * sizeof(Vec<3>) +
         touched_.size() * (sizeof(Index) + sizeof(std::size_t));
}

}  // namespace piola::contact
