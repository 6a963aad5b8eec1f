// SPDX-License-Identifier: Apache-2.0
#include "piola/bench/bench_contact.hpp"
#include "piola/bench/bench_columns.hpp"
#include "piola/formulations/make_formulation.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include "piola/setup/contact_surface.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

struct ContactBenchmarkCase {
  std::string_view name;
  bool surfaces;
  double gap;  ///< between the cubes, in spacings
  double friction;
  bool self;
};

constexpr std::array contact_subjects{ContactBenchmarkCase{"no contact", false, -0.02, 0, false},
                                      ContactBenchmarkCase{"far apart", true, 10, 0, false},
                                      ContactBenchmarkCase{"pressed", true, -0.02, 0, false},
                                      ContactBenchmarkCase{"pressed, friction", true, -0.02, 0.3, false},
                                      ContactBenchmarkCase{"pressed, self", true, -0.02, 0, true}};

/// Two cubes side by side; steps are so short that nothing moves far.
Assembly two_cubes(std::string const& formulation, ContactBenchmarkCase const& subject,
                   ContactBenchOptions const& options) {
  Assembly a;
  double const spacing = 0.1, side = options.cube_side * spacing;
  for (int b = 0; b < 2; ++b) {
    ShapeSpec shape;
    shape.placement = ShapeSpec::Placement::cell_centred;
    for (std::size_t c = 0; c < 3; ++c) {
      shape.particles[c] = options.cube_side;
      shape.min[c] = c == 0 ? b * (side + subject.gap * spacing) : 0;
      shape.max[c] = shape.min[c] + side;
    }
    fill(shape, b == 0 ? "left" : "right", a.particles);
    a.materials.push_back(rubber());
    a.formulations.push_back({formulation, {}, {}});
    if (!subject.surfaces) continue;
    a.surfaces.push_back(contact_surface(shape, a.particles, a.particles.bodies.back()));
    with_any_law(a.materials.back(),
                 [&](auto const& law) { a.surfaces.back().modulus = law.kappa + 4.0 / 3 * law.mu; });
  }
  a.contact.friction.kinetic = subject.friction;
  a.contact.self = subject.self;
  a.backend = options.backend;
  if (formulation == "nodal") a.cfl = 0.1;  // so that the limit is not measured again and again
  return a;
}

}  // namespace

ContactBenchReport bench_contact(ContactBenchOptions const& options) {
  ContactBenchReport report;
  pin_to(1);
  for (std::string const formulation : {"nodal", "jst_sph"}) {
    std::vector<std::unique_ptr<Formulation>> made;
    std::vector<double> stable, cpu(contact_subjects.size(), std::numeric_limits<double>::infinity());
    for (ContactBenchmarkCase const& subject : contact_subjects) {
      Assembly const assembly = two_cubes(formulation, subject, options);
      report.particles = static_cast<long>(assembly.particles.size());
      made.push_back(make_formulation(assembly));
      stable.push_back(made.back()->stable_time_step());
    }
    // Alternating, so that disturbances of the computer affect all of them.
    for (int k = 0; k < options.repeats; ++k)
      for (std::size_t s = 0; s < made.size(); ++s) cpu[s] = std::min(cpu[s], fastest_step(*made[s], 1).cpu);
    for (std::size_t s = 0; s < made.size(); ++s)
      report.rows.push_back({fmt::format("{}, {}", formulation, contact_subjects[s].name), 1e6 * cpu[s],
                             cpu[s] / cpu[0] - 1, stable[s] / stable[0]});
  }
  return report;
}

std::string to_json(ContactBenchReport const& report) {
  nlohmann::ordered_json j{{"formulation", "contact"}, {"particles", report.particles}};
  for (auto const& row : report.rows)
    j["rows"].push_back({{"name", row.name},
                         {"cpu_seconds_per_step", 1e-6 * row.microseconds},
                         {"more_than_without", row.share},
                         {"step_over_that_without", row.step_ratio}});
  return j.dump(2) + "\n";
}

std::string to_text(ContactBenchReport const& report) {
  std::string text = fmt::format(
      "contact of surfaces, two cubes with a common face, {} particles, one thread\n"
      "{:<28} {:>14} {:>10} {:>12}\n",
      report.particles, "", "cpu ms/step", "more, %", "step, ratio");
  for (auto const& row : report.rows)
    text += fmt::format("{:<28} {:>14.3f} {:>10.1f} {:>12.2f}\n", row.name, 1e-3 * row.microseconds, 100 * row.share,
                        row.step_ratio);
  return text +
         "more: processor time of a step beside that without contact; step: the stable step beside that without "
         "contact\n";
}

}  // namespace piola
