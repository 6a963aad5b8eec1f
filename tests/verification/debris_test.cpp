// SPDX-License-Identifier: Apache-2.0
#include "piola/model/read_case.hpp"
#include "piola/simulation/build.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

/// A steel disc breaks through an aluminium plate. Apart from them a body without a surface touches another one, so
/// that colour contact acts from the start, before particles of the plate lose their surface.
constexpr char const* disc_through_plate = R"toml(title = "A disc breaks through a plate"
[run]
end = "30 us"
[[body]]
name = "disc"
shape = { sphere = { centre = ["-4.6 mm", "0 mm"], radius = "4 mm" }, spacing = "0.5 mm" }
material = { name = "steel_linear_hardening" }
formulation = { name = "nodal" }
initial_velocity = ["500", "0"]
[[body]]
name = "plate"
shape = { box = { min = ["0 mm", "-15 mm"], max = ["3 mm", "15 mm"] }, placement = "cell_centred", spacing = "0.5 mm" }
material = { name = "aluminium_spall" }
formulation = { name = "nodal" }
[[support]]
body = "plate"
where = "abs(Y) > 0.014"
fix = "xy"
[[body]]
name = "gel"
shape = { box = { min = ["50 mm", "5 mm"], max = ["53 mm", "11 mm"] }, placement = "cell_centred", spacing = "0.5 mm" }
material = { law = "elastic", density = 1000, youngs_modulus = "1 GPa", poissons_ratio = 0.3 }
formulation = { name = "adaptle", description = "eulerian" }
[[body]]
name = "post"
shape = { box = { min = ["53 mm", "5 mm"], max = ["56 mm", "11 mm"] }, placement = "cell_centred", spacing = "0.5 mm" }
material = { law = "elastic", density = 1000, youngs_modulus = "1 GPa", poissons_ratio = 0.3 }
formulation = { name = "nodal" }
[[contact]]
between = ["gel", "disc"]
law = "none"
[[contact]]
between = ["gel", "plate"]
law = "none"
)toml";

TEST(Debris, IsKeptApartBesideBodiesWithoutASurface) {
  Simulation s = build(read_case_text(disc_through_plate, "case.toml"));
  double const start = s.formulation->diagnose().total_energy();
  double time = 0;
  while (time < s.spec.run.end && !s.formulation->failure()) {
    double const dt = s.formulation->stable_time_step();
    s.formulation->step(time, dt);
    time += dt;
  }
  EXPECT_FALSE(s.formulation->failure().has_value());
  Diagnostics const end = s.formulation->diagnose();
  EXPECT_NEAR((end.total_energy() - end.external_work) / start, 1, 1e-3);
  EXPECT_TRUE(end.uncovered.empty());
}

}  // namespace
}  // namespace piola
