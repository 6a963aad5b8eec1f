// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/estimates/case_plan.hpp"
#include "piola/input/contact_capabilities.hpp"
#include "piola/model/body_properties.hpp"
#include "piola/model/case_particles.hpp"
#include "piola/model/read_case.hpp"
#include "piola/model/region_checks.hpp"
#include "piola/particles/part_properties.hpp"
#include "commands.hpp"
#include "contact_report.hpp"
#include "cost_report.hpp"
#include "run_support.hpp"
#include "set_up_watch.hpp"
#include "solid_report.hpp"
#include "streams.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <memory>

namespace piola::app {
namespace {

std::string times(std::array<int, 3> const& n, int dimension) {
  std::string text;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
    text += (d > 0 ? " x " : "") + std::to_string(n[d]);
  return text;
}

std::string spacing_text(std::array<double, 3> const& spacing, int dimension) {
  bool same = true;
  for (std::size_t d = 1; d < static_cast<std::size_t>(dimension); ++d) {
    same = same && std::abs(spacing[d] - spacing[0]) < 1e-9 * spacing[0];
  }
  std::string text = quantity_text(spacing[0], "m");
  for (std::size_t d = 1; !same && d < static_cast<std::size_t>(dimension); ++d)
    text += " x " + quantity_text(spacing[d], "m");
  return text;
}

std::string settings_text(FormulationSpec const& spec) {
  std::vector<std::string> given;
  for (auto const& [name, value] : spec.words) given.push_back(fmt::format("{} = {}", name, value));
  for (auto const& [name, value] : spec.numbers) given.push_back(fmt::format("{} = {}", name, number_text(value)));
  for (auto const& [name, formula] : spec.formulas) given.push_back(fmt::format("{} where {}", name, formula.text()));
  return given.empty() ? "" : " (" + joined(given) + ")";
}

std::string arrangement_text(ShapeSpec const& shape, BodyProperties const& facts) {
  using enum ShapeSpec::Arrangement;
  if (shape.kind == ShapeSpec::Kind::points) return "from " + shape.files.front().given;
  if (shape.arrangement == packed) return "packed";
  if (shape.arrangement == lattice_with_rings) return "a lattice within two circles";
  if (shape.arrangement == lattice) return times(facts.lattice, shape.dimension) + " lattice";
  return shape.inner_radius > 0 ? times(facts.lattice, 2) + " polar grid" : "on circles";
}

std::string material_text(std::string const& name, MaterialParameters const& material) {
  LawInfo const law = *find_law(name);
  std::vector<std::string> values;
  for (std::size_t i = 0; i < law.choices.size(); ++i) {
    auto const word = law.choices[i].allowed[static_cast<std::size_t>(material.word[i])];
    values.push_back(std::string(law.choices[i].name) + " = " + std::string(word));
  }
  for (std::size_t i = 0; i < law.parameters.size(); ++i) {
    Parameter const& parameter = law.parameters[i];
    double const value = material.value[i];
    bool const in_words = !parameter.standard.empty() && value == parameter.default_value;
    if (in_words || !applies(law, parameter, material)) continue;
    values.push_back(std::string(parameter.name) + " = " + quantity_text(value, parameter.unit));
  }
  if (law.table != nullptr) {
    LawTable const& rows = material.table;
    values.push_back(fmt::format("{} = {} rows up to {} at {}", law.table->name, rows.count,
                                 quantity_text(rows.y[rows.count - 1], law.table->unit),
                                 quantity_text(rows.x[rows.count - 1], law.table->unit_of_argument)));
  }
  return name + ": " + joined(values);
}

Body const& body_named(ParticleSet const& particles, std::string const& name) {
  return *std::find_if(particles.bodies.begin(), particles.bodies.end(), [&](Body const& b) { return b.name == name; });
}

void say_parts(BodySpec const& body, ParticleSet const& particles) {
  auto const shares = part_properties(particles, body_named(particles, body.name), body.parts.size());
  for (std::size_t k = 0; k < body.parts.size(); ++k)
    print_result("  part \"{}\": {} particles of {}\n", body.parts[k].name, count_text(shares[k + 1].particles),
                 material_text(body.parts[k].law, body.parts[k].material));
}

/// How much of the bodies a region holds.
void say_region(RegionSpec const& region, ParticleSet const& particles) {
  std::vector<std::string> held;
  for (Body const& body : particles.bodies) {
    std::int64_t count = 0;
    for (auto id = body.first; id < body.last; ++id)
      count += region.holds(particles.X[static_cast<std::size_t>(id)]) != 0 ? 1 : 0;
    if (count > 0) held.push_back(fmt::format("{} particles of \"{}\"", count_text(count), body.name));
  }
  print_result("region \"{}\": {}\n", region.name, held.empty() ? "holds no particle" : joined(held));
}

void print_body(BodySpec const& body, BodyProperties const& facts, ParticleSet const& particles) {
  constexpr std::array<std::string_view, 5> kinds{"box", "sphere", "cylinder", "solid", "cloud"};
  int const dimension = body.shape.dimension;
  std::string_view const mass_unit = dimension == 3 || particles.axisymmetric ? "kg"
                                     : dimension == 2                         ? "kg/m"
                                                                              : "kg/m^2";
  print_result("body \"{}\": {}{} of {} particles ({}, spacing {})\n", body.name,
               body.shape.inner_radius > 0 ? "hollow " : "", kinds[static_cast<std::size_t>(body.shape.kind)],
               count_text(facts.particles), arrangement_text(body.shape, facts),
               spacing_text(facts.spacing, dimension));
  print_solid_report(body.shape, particles, body_named(particles, body.name));
  for (std::string const& note : body.shape.notes) print_result("  note: {}\n", note);
  print_result("  {}\n", material_text(body.law, body.material));
  say_parts(body, particles);
  print_result("  mass {} {}; pressure waves {:.4g} m/s", number_text(facts.mass, 4), mass_unit, facts.p_wave);
  if (facts.s_wave > 0) print_result(", shear waves {:.4g} m/s", facts.s_wave);
  print_result("; initial speed up to {:.4g} m/s\n", facts.largest_speed);
  print_result("  {}{}\n", body.formulation.name, settings_text(body.formulation));
}

std::string until_text(double until) { return std::isfinite(until) ? ", until " + quantity_text(until, "s") : ""; }

std::string held_text(SupportSpec const& support, int dimension) {
  std::string text;
  for (std::size_t d = 0; d < 3; ++d) {
    if (support.fix[d]) text += (text.empty() ? "in " : ", ") + std::string(1, "xyz"[d]);
  }
  if (support.frame != Support::Frame::axes) {
    text = std::string(support_frames[static_cast<std::size_t>(support.frame)].preposition) + " (";
    for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
      text += (d > 0 ? ", " : "") + number_text(support.normal[d], 4);
    text += ")";
  }
  if (support.velocity) return "driven " + text + " at " + vector_text(*support.velocity, dimension) + " m/s";
  return "held " + text;
}

/// The object of a support: particles, or the surface that they represent.
std::string object_text(CaseSpec const& spec, SupportSpec const& support, ParticleSet const& particles) {
  auto const count = supported_particles(particles, body_named(particles, support.body), support).size();
  std::string const some = count_text(static_cast<std::int64_t>(count)) + " particles";
  std::string const where = support.where ? " where " + support.where->text() : "";
  if (!support.patch) return some + where;
  std::string const patch = face_text(support.shape, *support.patch) + where;
  if (holds_surface(spec, support)) return "the surface of patch " + patch + ", in parts of " + some;
  return some + " along patch " + patch + ", which they lie half a spacing inside";
}

void print_supports(CaseSpec const& spec, ParticleSet const& particles) {
  for (SupportSpec const& support : spec.supports)
    print_result("support of \"{}\": {}, {}{}\n", support.body, object_text(spec, support, particles),
                 held_text(support, particles.dimension), until_text(support.until));
}

void print_loads(CaseSpec const& spec, ParticleSet const& particles) {
  constexpr std::array<std::string_view, 5> kinds{"traction", "body force", "acceleration", "pressure",
                                                  "non-reflecting, background velocity"};
  constexpr std::array<std::string_view, 5> units{"Pa", "N/m^3", "m/s^2", "Pa", "m/s"};
  for (LoadSpec const& load : spec.loads) {
    auto const kind = static_cast<std::size_t>(load.kind);
    auto const count = loaded_particles(particles, body_named(particles, load.body), load).size();
    std::string const face = load.on_face()
                                 ? std::string(load.face.part == Face::Part::patch ? " of patch " : " of face ") +
                                       face_text(load.shape, load.face)
                                 : "";
    bool const pressure = load.kind == LoadSpec::Kind::pressure;
    print_result("load on \"{}\": {} particles{}, {} {} {}{}\n", load.body,
                 count_text(static_cast<std::int64_t>(count)), face, kinds[kind],
                 pressure ? load.value[0].text() : vector_text(load.value, particles.dimension), units[kind],
                 until_text(load.until));
  }
  for (MirrorSpec const& mirror : spec.mirrors) {
    auto const count = face_particles(particles, body_named(particles, mirror.body), mirror.face).size();
    print_result("mirror of \"{}\": {} particles on face {}\n", mirror.body,
                 count_text(static_cast<std::int64_t>(count)), face_text({}, mirror.face));
  }
}

void print_cracks(ParticleSet const& particles) {
  for (Crack const& crack : particles.cracks) {
    auto const point = [](std::array<double, 3> const& X, bool tip) {
      return fmt::format("({}, {}){}", quantity_text(X[0], "m"), quantity_text(X[1], "m"), tip ? " (tip)" : "");
    };
    print_result("crack in \"{}\": from {} to {}\n", particles.bodies[static_cast<std::size_t>(crack.body)].name,
                 point(crack.from, crack.tip_at_from), point(crack.to, crack.tip_at_to));
  }
}

void print_ties(CaseSpec const& spec, ParticleSet const& particles) {
  auto const found = found_by_ties(spec, particles);
  for (std::size_t k = 0; k < found.size(); ++k) {
    TieSpec const& tie = spec.ties[k];
    print_result("tie \"{}\": {} and {} points of \"{}\" and \"{}\", {}, at most {:.2g} spacings apart{}{}\n", tie.name,
                 found[k].points[0], found[k].points[1], tie.between[0], tie.between[1],
                 quantity_text(found[k].area, particles.dimension == 3 ? "m^2" : "m", 3), found[k].farthest,
                 found[k].left > 0 ? fmt::format("; {} more are farther and stay free", found[k].left) : "",
                 tie.fails() ? ", fails at " + quantity_text(tie.strength, "Pa", 3) + " with " +
                                   quantity_text(tie.toughness, "J/m^2", 3)
                             : "");
  }
}

void print_output(CaseSpec const& spec) {
  auto const every = [&](std::string_view what, double interval) {
    if (interval > 0) {
      print_result("  {} every {} ({} in all)\n", what, quantity_text(interval, "s"),
                   count_text(static_cast<std::int64_t>(std::min(spec.run.end / interval, 1e15)) + 1));
    }
  };
  print_result("output:\n");
  every("a row of history.csv", spec.output.history_every > 0 ? spec.output.history_every : spec.run.end / 500);
  every("a frame", spec.output.frames_every);
  every("a picture of " + spec.output.pictures.field, spec.output.pictures.every);
  every("a checkpoint", spec.output.checkpoints_every);
  std::vector<std::string> probes, quantities;
  for (ProbeSpec const& probe : spec.probes) {
    for (std::string const& quantity : probe.quantities) probes.push_back(probe.name + "." + quantity);
  }
  for (QuantitySpec const& quantity : spec.quantities) quantities.push_back(quantity.name);
  if (!probes.empty()) print_result("  probes: {}\n", joined(probes));
  if (!quantities.empty()) print_result("  quantities: {}\n", joined(quantities));
}

struct CheckArguments {
  CaseOptions from;
  int ranks = 0;  ///< 0: not requested
  bool json = false;
};

/// Packings are shortened: the results hardly depend on the exact position of each particle.
CasePlan plan(CaseOptions const& options) {
  constexpr double most_packing = 15;  // s
  SetUpWatch watch("reading the case and making its particles", {.most_packing = most_packing});
  ParticleSet particles;
  auto const start = SetUpWatch::Clock::now();
  CaseSpec spec = read_case(case_file(options.file), options.overrides(), {.packing = std::ref(watch)}, &particles);
  std::chrono::duration<double> const reading = SetUpWatch::Clock::now() - start;
  watch.enter(fmt::format("looking at {} particles", count_text(particles.size())));
  CasePlan plan = plan_of_case(std::move(spec), std::move(particles), reading.count() + watch.seconds_left_out());
  for (std::string const& packing : watch.left_out()) plan.left_out.push_back(packing);
  return plan;
}

void say_plan(CasePlan const& plan, int ranks) {
  auto const& [spec, particles, facts, cost, warnings, left_out] = plan;
  print_result("{}\n", spec.title);
  print_result("{} particles {}, {} of motion\n", count_text(particles.size()), dimension_text(particles),
               quantity_text(spec.run.end, "s"));
  for (std::size_t b = 0; b < facts.size(); ++b) print_body(spec.bodies[b], facts[b], particles);
  for (RegionSpec const& region : spec.regions) say_region(region, particles);
  print_supports(spec, particles);
  print_loads(spec, particles);
  print_cracks(particles);
  print_contact(spec, particles.dimension);
  print_ties(spec, particles);
  say_cost(plan);
  if (ranks > 0) say_ranks(plan, ranks);
  print_output(spec);
  for (std::string const& what : left_out) print_result("left out: {}\n", what);
  for (std::string const& warning : warnings) print_result("warning: {}\n", warning);
  print_result(
      "{}\n", warnings.empty() ? "Nothing is wrong with this case." : "The case can run; please look at the warnings.");
}

int check(CheckArguments const& arguments) {
  if (arguments.json && arguments.ranks > 0)
    throw InputError("--json: tells nothing of ranks - leave out --ranks, or --json");
  CasePlan const found = plan(arguments.from);
  Problems problems;
  if (arguments.ranks > 1) refuse_ranks(found.spec, problems);
  problems.raise_if_any();
  if (arguments.json)
    write_out(plan_json(found));
  else
    say_plan(found, arguments.ranks);
  return with_output(completed);
}

}  // namespace

void add_check(CLI::App& program, Action& action) {
  auto const options = std::make_shared<CheckArguments>();
  CLI::App* command = program.add_subcommand("check", "Say what a case would run, what it needs and what looks odd");
  options->from.add_to(*command);
  command
      ->add_option("--ranks", options->ranks,
                   "Also estimate particles and memory of each rank (process) of a run on this number of ranks")
      ->check(CLI::Range(1, 100'000));
  command->add_flag("--json", options->json, "Print one JSON object, for scripts");
  command->callback([options, &action] { action = [options] { return check(*options); }; });
}

}  // namespace piola::app
