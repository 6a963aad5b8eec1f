// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/setup/contact_surface.hpp"
#include "formulations/small_bodies.hpp"
#include "materials/solid_samples.hpp"

/// Blocks with contact surfaces, of any formulation, for tests of interactions between bodies.
namespace piola::testing {

/// Adds a square or cube with n particles per side. Material: rubber, or an elastic metal under adaptle. `formulation`
/// "adaptle" is total Lagrangian with a surface; "eulerian" is adaptle with Eulerian particles and no surface.
inline void add_block(Assembly& a, int dimension, std::string const& formulation, std::array<double, 3> const& min,
                      int n, double spacing) {
  ShapeSpec shape;
  shape.dimension = dimension;
  shape.placement = ShapeSpec::Placement::cell_centred;
  for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) {
    shape.min[c] = min[c];
    shape.max[c] = min[c] + n * spacing;
    shape.particles[c] = n;
  }
  fill(shape, "block " + std::to_string(a.particles.bodies.size()), a.particles);
  bool const is_eulerian = formulation == "eulerian", solid = formulation == "adaptle" || is_eulerian;
  bool const linear = formulation == "taylor_sph";
  a.materials.push_back(solid ? sample_metal("elastic", "elastic") : rubber(linear ? "linear_elastic" : "neo_hookean"));
  a.formulations.push_back({solid ? "adaptle" : formulation, {}, {}});
  // The central form of the viscosity conserves angular momentum.
  if (solid) a.formulations.back().words = {{"description", "total_lagrangian"}, {"viscosity_form", "central"}};
  if (is_eulerian) a.formulations.back().words = {{"description", "eulerian"}};
  a.surfaces.push_back(contact_surface(shape, a.particles, a.particles.bodies.back()));
  if (is_eulerian) a.surfaces.back().points.clear();
  with_any_law(a.materials.back(), [&](auto const& law) { a.surfaces.back().modulus = law.kappa + 4.0 / 3 * law.mu; });
}

inline double column(Diagnostics const& d, std::string_view name) {
  for (auto const& [known, value] : d.more)
    if (known == name) return value;
  ADD_FAILURE() << "no column " << name;
  return 0;
}

/// Expects that a new formulation has the same state, bit for bit, after go(f, time) on any number of threads.
template <class Go>
void expect_same_on_threads(Assembly const& a, Go const& go) {
  std::map<std::string, Values, std::less<>> first;
  for (int const threads : thread_counts) {
    Threads const shared(threads);
    auto const f = make_formulation(a);
    double time = 0;
    go(*f, time);
    auto const found = saved(*f).values;
    if (first.empty()) first = found;
    EXPECT_EQ(found, first) << threads;
  }
}

/// Expects that a new formulation that loads the state of `whole` continues like `whole`, bit for bit. go(f, time)
/// advances both.
template <class Go>
void expect_resumes(Assembly const& a, Formulation& whole, double time, Go const& go) {
  SavedState state = saved(whole);
  auto const resumed = make_formulation(a);
  resumed->load(state);
  double other = time;
  go(whole, time);
  go(*resumed, other);
  EXPECT_EQ(time, other);
  auto const expected = saved(whole).values, found = saved(*resumed).values;
  ASSERT_EQ(expected.size(), found.size());
  for (auto const& [name, values] : expected) {
    ASSERT_EQ(found.at(name).size(), values.size()) << name;
    for (std::size_t k = 0; k < values.size(); ++k) ASSERT_EQ(found.at(name)[k], values[k]) << name << " " << k;
  }
}

}  // namespace piola::testing
