// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/fields.hpp"

namespace piola::nodal {

/// Memory of what sweeps read of neighbours: X, x, mu and the stress. For lists a record per particle and sweep; for
/// lattices component after component, with zeros around.
class Gathered {
 public:
  Gathered() = default;
  Gathered(Gathered const&) = delete;
  Gathered& operator=(Gathered const&) = delete;

  /// Of records complete_record() is due for all that are read.
  void place_records(Fields& fields, int D, Index slots);
  void complete_record(int D, Index slot);
  /// guard: slots that loops over a lattice may read beside the first and the last one.
  static void place_lattice(Fields& fields, Index slots, Index guard);
  std::size_t bytes() const { return first_.bytes() + second_.bytes(); }

 private:
  Memory first_, second_;
  FieldVersion first_version_, second_version_;
};

}  // namespace piola::nodal
