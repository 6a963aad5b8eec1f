// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/body_boundary_conditions.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include <span>

namespace piola {

BodyBoundary::BodyBoundary(int dimension, std::vector<Support> const& supports, std::vector<Load> const& loads,
                           bool multiplied)
    : supports_(dimension, supports, multiplied), loads_(dimension, loads) {}

void BodyBoundary::keep(Range own) {
  PIOLA_EXPECTS(own.first <= own.last);
  PIOLA_EXPECTS(released_ < 0);
  share(own);
  first_kept_ = own.first;
  if (supports_.multiplied()) return;
  supports_.keep(own);
  loads_.keep(own);
}

void BodyBoundary::start(FieldRef const& v) const {
  PIOLA_EXPECTS(released_ >= 0);
  supports_.start(v);
}

bool BodyBoundary::begin_step(FieldRef const& x, double time, double dt) {
  int const released = supports_.ended(time) + loads_.ended(time);
  bool const changed = released != released_, continues = !changed && time == ended_;
  released_ = released;
  ended_ = time + dt;
  supports_.begin_step(x, time, ended_, changed, continues);
  loads_.begin_step(x, time, ended_, changed, continues);
  return changed;
}

void BodyBoundary::end_step(FieldRef const& x, DeferredGlobalSum& work) {
  exec::ReproducibleSum of_step;
  for (auto const& h : supports_.held())
    if (is_local(own_, h.slot)) of_step += h.work;
  for (auto const& p : loads_.loaded())
    if (is_local(own_, p.slot)) of_step += p.work;
  if (own_)
    work.add_part(of_step);
  else
    work.add(of_step.value());
  supports_.end_step(x, own_);
  loads_.end_step(x, own_);
}

void BodyBoundary::add_resultants_to(Resultants& actions) const {
  std::size_t const supports = supports_.impulses().size(), loads = loads_.impulses().size();
  PIOLA_EXPECTS(actions.supports.size() <= supports);
  PIOLA_EXPECTS(actions.loads.size() >= loads);
  std::vector<ImpulseSum> all(supports_.impulses());
  all.insert(all.end(), loads_.impulses().begin(), loads_.impulses().end());
  if (own_) comm::allreduce_sum(std::span(all));
  for (std::size_t k = 0; k < actions.supports.size(); ++k) actions.supports[k].add(all[k].value());
  for (std::size_t k = 0; k < loads; ++k) actions.loads[k].add(all[supports + k].value());
}

void BodyBoundary::reset_impulses() {
  for (std::vector<ImpulseSum>* const sums : {&supports_.impulses(), &loads_.impulses()})
    sums->assign(sums->size(), {});
}

}  // namespace piola
