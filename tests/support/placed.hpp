// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "support/fake_formulation.hpp"
#include <array>
#include <utility>
#include <vector>

namespace piola::testing {

using Places3 = std::vector<std::array<double, 3>>;

/// One body "plate" of `count` particles with reference positions 0, 1, 2 ... on the x axis and unit volumes.
inline ParticleSet make_row(std::size_t count, int dimension = 2) {
  ParticleSet set;
  set.dimension = dimension;
  auto const last = static_cast<int>(count);
  set.bodies.push_back({"plate", 0, last, {1, 1, 1}, {last, 1, 1}, true});
  for (int i = 0; i < last; ++i) {
    set.X.push_back({static_cast<double>(i), 0, 0});
    set.lattice_index.push_back({i, 0, 0});
  }
  set.volume.assign(count, 1);
  set.kernel_volume.assign(count, 1);
  set.body.assign(count, 0);
  return set;
}

/// A formulation whose particles have the current positions `x` and the velocity (id, 2, -1).
class Placed : public Springs {
 public:
  Placed(ParticleSet const& set, Places3 x) : Springs(set), set_(set), x_(std::move(x)) {}
  void sample(std::string_view field, std::span<double> values) const override {
    for (std::size_t i = 0; i < x_.size(); ++i) {
      for (std::size_t c = 0; c < 3 && field == "Displacement"; ++c) values[3 * i + c] = x_[i][c] - set_.X[i][c];
      if (field != "Velocity") continue;
      values[3 * i] = static_cast<double>(i);
      values[3 * i + 1] = 2;
      values[3 * i + 2] = -1;
    }
  }

 private:
  ParticleSet set_;
  Places3 x_;
};

}  // namespace piola::testing
