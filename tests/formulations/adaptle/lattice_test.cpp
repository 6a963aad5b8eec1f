// SPDX-License-Identifier: Apache-2.0
// Sums over reference neighbours of a regular lattice, which come by distances in memory, against those by lists.
#include "formulations/adaptle/clouds.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using namespace testing;

struct LatticeKind {
  int dimension;
  std::string correction, form, description;
  friend std::ostream& operator<<(std::ostream& out, LatticeKind const& k) {
    return out << k.dimension << "D " << k.correction << " " << k.form << " " << k.description;
  }
  /// With gradients of material sums alone the weights of pairs are floats, which a lattice computes from its spacing
  /// and a list from positions: they may differ in their last bit.
  double tolerance() const { return correction == "material" && form == "central" ? 3e-7 : 2e-12; }
};

/// Rows of 13 or 9 particles, so that groups of lanes go on into the next row.
Assembly lattice_assembly(LatticeKind const& k, bool regular) {
  Assembly a = adaptle_assembly(unit_box(k.dimension, k.dimension == 2 ? 13 : 9, 0),
                                sample_metal("perfectly_plastic", "elastic"));
  a.particles.bodies[0].regular = regular;
  choose(a, "correction", k.correction);
  choose(a, "viscosity_form", k.form);
  choose(a, "hourglass", 0.5);
  choose(a, "description", k.description);
  choose(a, "blend", 2.0);
  if (k.description == "patch") choose_formula(a, "eulerian_where", "X + Y < 0.9");
  return a;
}

Values parallel_sums(Cloud& cloud, int dimension) {
  shake_up(cloud, dimension, 0.01);
  cloud.evaluate();
  Values r;
  for (Index i = 0; i < cloud.size(); ++i) {
    Sums const sums = cloud.sums(i);
    r.insert(r.end(), sums.force, sums.force + dimension);
  }
  return r;
}

Values value_count(Cloud const& cloud, double Sums::*member) {
  Values r;
  for (Index i = 0; i < cloud.size(); ++i) r.push_back(cloud.sums(i).*member);
  return r;
}

class AdaptleLattice : public ::testing::TestWithParam<LatticeKind> {};

TEST_P(AdaptleLattice, HasTheSumsOfItsLists) {
  LatticeKind const& k = GetParam();
  Cloud lattice(lattice_assembly(k, true)), list(lattice_assembly(k, false));
  ASSERT_NE(lattice.system().material.rows_of[0].record, nullptr);
  ASSERT_EQ(list.system().material.rows_of[0].record, nullptr);
  Values const force = parallel_sums(lattice, k.dimension), expected = parallel_sums(list, k.dimension);
  EXPECT_LT(largest_difference(force, expected), k.tolerance() * largest(expected));
  for (double Sums::*const member : {&Sums::heat, &Sums::hourglass, &Sums::compression}) {
    Values const value = value_count(lattice, member), wanted = value_count(list, member);
    EXPECT_LE(largest_difference(value, wanted), k.tolerance() * largest(wanted));
  }
  EXPECT_GT(largest(value_count(list, &Sums::heat)), 0);
  for (Index i = 0; i < list.size(); ++i) {
    Deformation const &d = lattice.deformation(i), &e = list.deformation(i);
    EXPECT_EQ(d.gap < 0, e.gap < 0);
    if (e.gap < 0) continue;
    EXPECT_NEAR(d.gap, e.gap, 1e-6);
    for (int c = 0; c < 9; ++c) {
      EXPECT_NEAR(d.F[c], e.F[c], 1e-7);
      EXPECT_NEAR(d.rate[c], e.rate[c], 1e-4);  // of some thousands
    }
  }
}

std::vector<LatticeKind> lattice_kinds() {
  std::vector<LatticeKind> r;
  for (int const dimension : {2, 3})
    for (char const* description : {"total_lagrangian", "patch"}) {
      for (char const* form : {"central", "published"})
        for (char const* correction : {"material", "none"}) r.push_back({dimension, correction, form, description});
      r.push_back({dimension, "mixed", "published", description});
    }
  return r;
}
INSTANTIATE_TEST_SUITE_P(All, AdaptleLattice, ::testing::ValuesIn(lattice_kinds()));

/// Bodies of few particles, of one row, and with a hole have groups of lanes that have little in common.
TEST(AdaptleLattices, WithLittleInCommonKeepTheirLists) {
  for (int const n : {1, 2, 3, 5}) {
    Assembly a = adaptle_assembly(unit_box(2, n, 0));
    choose(a, "description", "total_lagrangian");
    Cloud cloud(a);
    cloud.evaluate();
    EXPECT_EQ(cloud.particles->failure().index, FailureSlot::none) << n;
  }
}

}  // namespace
}  // namespace piola
