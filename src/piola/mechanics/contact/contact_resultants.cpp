// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/contact_resultants.hpp"
#include "piola/mechanics/contact/state_vector.hpp"
#include <algorithm>

namespace piola::contact {

ContactResultants::ContactResultants(std::size_t bodies, std::size_t rigids)
    : on_rigid_(rigids),
      ties_(rigids),
      frequencies_(rigids),
      between_(bodies, std::vector<ForceMoment>(bodies)),
      on_rigid_sums_(rigids),
      spring_sums_(rigids) {}

void ContactResultants::clear() {
  std::fill(on_rigid_.begin(), on_rigid_.end(), ForceMoment{});
  std::fill(frequencies_.begin(), frequencies_.end(), Frequencies{});
  for (auto& row : between_) std::fill(row.begin(), row.end(), ForceMoment{});
  std::fill(on_rigid_sums_.begin(), on_rigid_sums_.end(), ForceMomentSum{});
  std::fill(spring_sums_.begin(), spring_sums_.end(), exec::ReproducibleSum{});
  pair_sums_.clear();
}

void ContactResultants::add_between(std::size_t a, std::size_t b, Vec<3> const& y, Vec<3> const& force) {
  Vec<3> const moment = cross(y, force);
  if (a < b) pair_sums_[{a, b}].add(force, moment);
  if (a > b) pair_sums_[{b, a}].add(-1.0 * force, -1.0 * moment);
}

void ContactResultants::finish() {
  for (std::size_t r = 0; r < on_rigid_.size(); ++r) {
    on_rigid_[r] = on_rigid_sums_[r].value();
    frequencies_[r].of_shape = spring_sums_[r].value();
  }
  for (auto const& [pair, sum] : pair_sums_) {
    ForceMoment const on_first = sum.value();
    between_[pair.first][pair.second] = on_first;
    between_[pair.second][pair.first] = {-1.0 * on_first.force, -1.0 * on_first.moment};
  }
}

void ContactResultants::save(std::vector<double>& all) const {
  auto const put_one = [&](ForceMoment const& resultant) {
    put(all, resultant.force);
    put(all, resultant.moment);
  };
  std::for_each(on_rigid_.begin(), on_rigid_.end(), put_one);
  for (auto const& row : between_) std::for_each(row.begin(), row.end(), put_one);
}

void ContactResultants::load(StateVector& from) {
  auto const take_one = [&](ForceMoment& resultant) {
    from.take(resultant.force);
    from.take(resultant.moment);
  };
  std::for_each(on_rigid_.begin(), on_rigid_.end(), take_one);
  for (auto& row : between_) std::for_each(row.begin(), row.end(), take_one);
}

}  // namespace piola::contact
