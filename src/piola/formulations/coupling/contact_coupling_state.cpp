// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/coupling/contact_coupling.hpp"
#include "piola/mechanics/contact/state_vector.hpp"

namespace piola {

void ContactCoupling::save(StateWriter& writer) const {
  writer.put_sized("contact_count", "contact_state", system_.state());
  if (!lost_.pairs().empty()) writer.put_sized("contact_colour_count", "contact_colours", colours_.state());
  if (lost_.any()) {
    writer.put_sized("contact_depth_count", "contact_depths", system_.depths());
    writer.put_sized("rigid_depth_count", "rigid_depths", system_.late_rigids().state());
  }
  std::vector<double> rigid{work_, last_dt_, friction_work_, chatter_loss_};
  for (std::size_t r = 0; r < shapes_.size(); ++r)
    for (Vec<3> const& a : {system_.rigid(r).centre, system_.rigid(r).velocity}) contact::put(rigid, a);
  for (auto const& pair : pair_impulses_.all())
    for (Vec<3> const& a : {pair.force, pair.moment}) contact::put(rigid, a);
  writer.put("contact", rigid);
  writer.put("contact_actions", actions_.state());
  ties_.save(writer);
  if (motion_.any()) writer.put_sized("rigid_count", "rigid_state", motion_.state());
}

void ContactCoupling::load(StateReader& reader) {
  std::vector<double> rigid(4 + 6 * (shapes_.size() + pair_impulses_.all().size()));
  reader.get("contact", rigid);
  contact::StateVector from(rigid);
  for (double* number : {&work_, &last_dt_, &friction_work_, &chatter_loss_}) *number = from.next();
  for (std::size_t r = 0; r < shapes_.size(); ++r) {
    from.take(system_.rigid(r).centre);
    from.take(system_.rigid(r).velocity);
  }
  for (auto& pair : pair_impulses_.all()) {
    from.take(pair.force);
    from.take(pair.moment);
  }
  loaded_.surfaces = reader.get_sized("contact_count", "contact_state");
  if (!lost_.pairs().empty()) loaded_.colours = reader.get_sized("contact_colour_count", "contact_colours");
  if (lost_.any()) {
    loaded_.depths = reader.get_sized("contact_depth_count", "contact_depths");
    loaded_.rigid_depths = reader.get_sized("rigid_depth_count", "rigid_depths");
  }
  std::vector<double> actions = actions_.state();
  reader.get("contact_actions", actions);
  actions_.restore(actions);
  ties_.load(reader);
  if (motion_.any()) motion_.restore(system_.rigids(), reader.get_sized("rigid_count", "rigid_state"));
}

}  // namespace piola
