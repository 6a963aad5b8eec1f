// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/reproducible_sum.hpp"
#include "piola/math/tensor.hpp"

namespace piola::contact {

/// Force and moment of one object on another.
struct ForceMoment {
  Vec<3> force, moment;  ///< [N], [N m]
};

/// Reproducible sum of the forces at many points, independent of their order.
class ForceMomentSum {
 public:
  void add(Vec<3> const& force, Vec<3> const& moment) {
    double const numbers[]{force[0], force[1], force[2], moment[0], moment[1], moment[2]};
    sums_.add(numbers);
  }
  void add(Vec<3> const& moment) { add({}, moment); }
  ForceMoment value() const {
    return {{{sums_.value(0), sums_.value(1), sums_.value(2)}}, {{sums_.value(3), sums_.value(4), sums_.value(5)}}};
  }

 private:
  exec::ReproducibleSums<6> sums_;
};

}  // namespace piola::contact
