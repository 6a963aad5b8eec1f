// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/coupling/contact_coupling.hpp"
#include "piola/mechanics/contact/state_vector.hpp"
#include <array>

namespace piola {

void ContactCoupling::save(StateWriter& writer) const {
  std::vector<double> const system = system_.state();
  writer.put("contact_count", std::array{static_cast<double>(system.size())});
  writer.put("contact_state", system);
  if (!lost_.pairs().empty()) {
    std::vector<double> const depths = colours_.state();
    writer.put("contact_colour_count", std::array{static_cast<double>(depths.size())});
    writer.put("contact_colours", depths);
  }
  std::vector<double> rigid{work_, last_dt_, friction_work_, chatter_loss_};
  for (std::size_t r = 0; r < shapes_.size(); ++r)
    for (Vec<3> const& a : {system_.rigid(r).centre, system_.rigid(r).velocity}) contact::put(rigid, a);
  for (auto const& pair : pair_impulses_.all())
    for (Vec<3> const& a : {pair.force, pair.moment}) contact::put(rigid, a);
  writer.put("contact", rigid);
  writer.put("contact_actions", actions_.state());
  ties_.save(writer);
  if (!motion_.any()) return;
  std::vector<double> const motion = motion_.state();
  writer.put("rigid_count", std::array{static_cast<double>(motion.size())});
  writer.put("rigid_state", motion);
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
  std::array<double, 1> count{};
  reader.get("contact_count", count);
  loaded_.surfaces.resize(static_cast<std::size_t>(count[0]));
  reader.get("contact_state", loaded_.surfaces);
  if (!lost_.pairs().empty()) {
    reader.get("contact_colour_count", count);
    loaded_.colours.resize(static_cast<std::size_t>(count[0]));
    reader.get("contact_colours", loaded_.colours);
  }
  std::vector<double> actions = actions_.state();
  reader.get("contact_actions", actions);
  actions_.restore(actions);
  ties_.load(reader);
  if (!motion_.any()) return;
  reader.get("rigid_count", count);
  std::vector<double> motion(static_cast<std::size_t>(count[0]));
  reader.get("rigid_state", motion);
  motion_.restore(system_.rigids(), motion);
}

}  // namespace piola
