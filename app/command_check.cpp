// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/exec/threads.hpp"
#include "piola/input/case_facts.hpp"
#include "piola/input/check_case.hpp"
#include "piola/input/read_case.hpp"
#include "piola/simulation/build.hpp"
#include "piola/simulation/warnings.hpp"
#include "commands.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <limits>
#include <memory>

namespace piola::app {
namespace {

/// What a run would cost; measured on the first steps where that is cheap.
struct Cost {
  double step = 0;     ///< s of the simulation
  double bytes = 0;    ///< memory
  double seconds = 0;  ///< wall time of the whole run
  int threads = 1;
  bool measured = false;
  std::vector<std::string> warnings = {};
};

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
  for (auto const& [name, value] : spec.words) given.push_back(name + " = " + value);
  for (auto const& [name, value] : spec.numbers) given.push_back(name + " = " + number_text(value));
  for (auto const& [name, formula] : spec.formulas) given.push_back(name + " where " + formula.text());
  return given.empty() ? "" : " (" + joined(given) + ")";
}

std::string arrangement_text(ShapeSpec const& shape, BodyFacts const& facts) {
  using enum ShapeSpec::Arrangement;
  if (shape.arrangement == lattice_with_rings) return "a lattice within two circles";
  if (shape.arrangement == lattice) return times(facts.lattice, shape.dimension) + " lattice";
  return shape.inner_radius > 0 ? times(facts.lattice, 2) + " polar grid" : "on circles";
}

std::string material_text(BodySpec const& body) {
  LawInfo const law = *find_law(body.law);
  std::vector<std::string> values;
  for (std::size_t i = 0; i < law.choices.size(); ++i) {
    auto const word = law.choices[i].allowed[static_cast<std::size_t>(body.material.word[i])];
    values.push_back(std::string(law.choices[i].name) + " = " + std::string(word));
  }
  for (std::size_t i = 0; i < law.parameters.size(); ++i) {
    Parameter const& parameter = law.parameters[i];
    double const value = body.material.value[i];
    bool const in_words = !parameter.standard.empty() && value == parameter.default_value;
    if (in_words || !applies(law, parameter, body.material)) continue;
    values.push_back(std::string(parameter.name) + " = " + quantity_text(value, parameter.unit));
  }
  return body.law + ": " + joined(values);
}

void print_body(BodySpec const& body, BodyFacts const& facts) {
  constexpr std::array<std::string_view, 3> kinds{"box", "sphere", "cylinder"};
  int const dimension = body.shape.dimension;
  std::string_view const mass_unit = dimension == 3 ? "kg" : dimension == 2 ? "kg/m" : "kg/m^2";
  fmt::print("body \"{}\": {}{} of {} particles ({}, spacing {})\n", body.name,
             body.shape.inner_radius > 0 ? "hollow " : "", kinds[static_cast<std::size_t>(body.shape.kind)],
             count_text(facts.particles), arrangement_text(body.shape, facts), spacing_text(facts.spacing, dimension));
  fmt::print("  {}\n", material_text(body));
  fmt::print("  mass {} {}; pressure waves {:.4g} m/s", number_text(facts.mass, 4), mass_unit, facts.p_wave);
  if (facts.s_wave > 0) fmt::print(", shear waves {:.4g} m/s", facts.s_wave);
  fmt::print("; initial speed up to {:.4g} m/s\n", facts.largest_speed);
  fmt::print("  {}{}\n", body.formulation.name, settings_text(body.formulation));
}

Body const& body_named(ParticleSet const& particles, std::string const& name) {
  return *std::find_if(particles.bodies.begin(), particles.bodies.end(), [&](Body const& b) { return b.name == name; });
}

std::string vector_text(std::array<Expression, 3> const& formulas, int dimension) {
  std::string text = "(";
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
    text += (d > 0 ? ", " : "") + formulas[d].text();
  return text + ")";
}

std::string until_text(double until) { return std::isfinite(until) ? ", until " + quantity_text(until, "s") : ""; }

std::string held_text(SupportSpec const& support, int dimension) {
  std::string text;
  for (std::size_t d = 0; d < 3; ++d) {
    if (support.fix[d]) text += (text.empty() ? "in " : ", ") + std::string(1, "xyz"[d]);
  }
  if (support.frame != Support::Frame::axes) {
    text = support.frame == Support::Frame::normal ? "along (" : "across (";
    for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
      text += (d > 0 ? ", " : "") + number_text(support.normal[d], 4);
    text += ")";
  }
  if (support.velocity) return "driven " + text + " at " + vector_text(*support.velocity, dimension) + " m/s";
  return "held " + text;
}

void print_supports(CaseSpec const& spec, ParticleSet const& particles) {
  for (SupportSpec const& support : spec.supports) {
    auto const count = select_particles(particles, body_named(particles, support.body), &support.where).size();
    fmt::print("support of \"{}\": {} particles where {}, {}{}\n", support.body,
               count_text(static_cast<std::int64_t>(count)), support.where.text(),
               held_text(support, particles.dimension), until_text(support.until));
  }
}

void print_loads(CaseSpec const& spec, ParticleSet const& particles) {
  constexpr std::array<std::string_view, 3> kinds{"traction", "body force", "acceleration"};
  constexpr std::array<std::string_view, 3> units{"Pa", "N/m^3", "m/s^2"};
  for (LoadSpec const& load : spec.loads) {
    auto const kind = static_cast<std::size_t>(load.kind);
    auto const count = loaded_particles(particles, body_named(particles, load.body), load).size();
    std::string const face = load.kind == LoadSpec::Kind::traction ? " of face " + face_text(load.face) : "";
    fmt::print("load on \"{}\": {} particles{}, {} {} {}{}\n", load.body, count_text(static_cast<std::int64_t>(count)),
               face, kinds[kind], vector_text(load.value, particles.dimension), units[kind], until_text(load.until));
  }
  for (MirrorSpec const& mirror : spec.mirrors) {
    auto const count = face_particles(particles, body_named(particles, mirror.body), mirror.face).size();
    fmt::print("mirror of \"{}\": {} particles on face {}\n", mirror.body, count_text(static_cast<std::int64_t>(count)),
               face_text(mirror.face));
  }
}

void print_cracks(ParticleSet const& particles) {
  for (Crack const& crack : particles.cracks) {
    auto const point = [](std::array<double, 3> const& X, bool tip) {
      return fmt::format("({}, {}){}", quantity_text(X[0], "m"), quantity_text(X[1], "m"), tip ? " (tip)" : "");
    };
    fmt::print("crack in \"{}\": from {} to {}\n", particles.bodies[static_cast<std::size_t>(crack.body)].name,
               point(crack.from, crack.tip_at_from), point(crack.to, crack.tip_at_to));
  }
}

std::string shape_text(RigidShape const& shape, int dimension) {
  auto const point = [&](std::array<double, 3> const& x, char const* unit) {
    std::string text;
    for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
      text += (d > 0 ? ", " : "") + number_text(x[d], 4);
    return "(" + text + ")" + unit;
  };
  std::string const centre = point(shape.centre, " m"), radius = "radius " + quantity_text(shape.radius, "m");
  switch (shape.kind) {
    case RigidShape::Kind::plane: return "plane through " + centre + ", normal " + point(shape.axis, "");
    case RigidShape::Kind::sphere: return "sphere about " + centre + ", " + radius;
    case RigidShape::Kind::cylinder:
      return "cylinder about " + centre + ", axis " + point(shape.axis, "") + ", " + radius + ", length " +
             quantity_text(2 * shape.half_lengths[0], "m");
    case RigidShape::Kind::box: break;
  }
  std::array<double, 3> lengths = shape.half_lengths;
  for (double& length : lengths) length *= 2;
  return "box about " + centre + ", edges " + point(lengths, " m");
}

void print_contact(CaseSpec const& spec, int dimension) {
  for (RigidSpec const& rigid : spec.rigids) {
    bool const moves = std::any_of(rigid.velocity.begin(), rigid.velocity.end(),
                                   [](Expression const& component) { return component.text() != "0"; });
    fmt::print("rigid shape \"{}\": {}{}\n", rigid.name, shape_text(rigid, dimension),
               moves ? ", driven at " + vector_text(rigid.velocity, dimension) + " m/s" : "");
  }
  auto const info = find_formulation(spec.bodies.front().formulation.name);
  if (!info || !info->contact) return;
  constexpr std::array<std::string_view, 4> laws{"none", "kernel", "linear", "printed"};
  ContactRule const rule = spec.contact ? ContactRule(*spec.contact) : ContactRule();
  std::string text;
  if (rule.scale != 1) text += ", scale " + number_text(rule.scale);
  if (rule.law == ContactRule::Law::printed)
    text += ", stiffness " + quantity_text(rule.stiffness, "Pa/m^" + std::to_string(dimension));
  if (std::isfinite(rule.closing_speed)) text += ", closing speed " + quantity_text(rule.closing_speed, "m/s");
  fmt::print("contact: law {}{}\n", laws[static_cast<std::size_t>(rule.law)], text);
}

void print_output(CaseSpec const& spec) {
  auto const every = [&](std::string_view what, double interval) {
    if (interval > 0) {
      fmt::print("  {} every {} ({} in all)\n", what, quantity_text(interval, "s"),
                 count_text(static_cast<std::int64_t>(std::min(spec.run.end / interval, 1e15)) + 1));
    }
  };
  fmt::print("output:\n");
  every("a row of history.csv", spec.output.history_every > 0 ? spec.output.history_every : spec.run.end / 500);
  every("a frame", spec.output.frames_every);
  every("a picture of " + spec.output.picture_field, spec.output.pictures_every);
  every("a checkpoint", spec.output.checkpoints_every);
  std::vector<std::string> probes, quantities;
  for (ProbeSpec const& probe : spec.probes) {
    for (std::string const& quantity : probe.quantities) probes.push_back(probe.name + "." + quantity);
  }
  for (QuantitySpec const& quantity : spec.quantities) quantities.push_back(quantity.name);
  if (!probes.empty()) fmt::print("  probes: {}\n", joined(probes));
  if (!quantities.empty()) fmt::print("  quantities: {}\n", joined(quantities));
}

/// Wall time of one step: the shortest of a few, because other programs disturb the others.
double seconds_per_step(Formulation& formulation, double step) {
  using Clock = std::chrono::steady_clock;
  double shortest = std::numeric_limits<double>::infinity(), total = 0;
  for (int i = 0; i < 2 || (i < 20 && total < 0.2); ++i) {
    auto const start = Clock::now();
    formulation.step(i * step, step);
    double const seconds = std::chrono::duration<double>(Clock::now() - start).count();
    shortest = std::min(shortest, seconds);
    total += seconds;
  }
  return shortest;
}

// Builds the case and makes a few steps of it, which tells more than any formula about this machine.
Cost measured_cost(CaseSpec const& spec) {
  Simulation simulation = build(spec);
  Cost cost{.measured = true};
  cost.threads = simulation.threads;
  cost.step = std::min(simulation.formulation->settled_time_step(), spec.run.max_step);
  cost.bytes = static_cast<double>(simulation.formulation->memory_bytes());
  cost.seconds = seconds_per_step(*simulation.formulation, cost.step) * spec.run.end / cost.step;
  cost.warnings = simulation.warnings;
  return cost;
}

// For cases too large to build just for a look: bytes and rate of the JST-SPH solver.
Cost estimated_cost(CaseSpec const& spec, std::vector<BodyFacts> const& facts, std::int64_t particles) {
  constexpr double bytes_per_particle = 1500, steps_per_second_and_core = 1.2e6;
  Cost cost;
  cost.threads = exec_host::set_threads(spec.run.threads);
  cost.step = step_estimate(spec, facts);
  cost.warnings = warnings_of(spec, assemble(spec), {.step = cost.step});
  cost.bytes = bytes_per_particle * static_cast<double>(particles);
  cost.seconds = spec.run.end / cost.step * static_cast<double>(particles) / (steps_per_second_and_core * cost.threads);
  return cost;
}

int check(CaseOptions const& options) {
  constexpr std::int64_t cheap = 1'000'000;
  CaseSpec const spec = read_case(options.file, options.overrides());
  ParticleSet const particles = make_particles(spec);
  std::vector<BodyFacts> const facts = body_facts(spec, particles);
  Cost const cost = particles.size() <= cheap ? measured_cost(spec) : estimated_cost(spec, facts, particles.size());
  fmt::print("{}\n", spec.title);
  fmt::print("{} particles in {}D, {} of motion\n", count_text(particles.size()), particles.dimension,
             quantity_text(spec.run.end, "s"));
  for (std::size_t b = 0; b < facts.size(); ++b) print_body(spec.bodies[b], facts[b]);
  print_supports(spec, particles);
  print_loads(spec, particles);
  print_cracks(particles);
  print_contact(spec, particles.dimension);
  fmt::print("step: about {}, about {} steps\n", quantity_text(cost.step, "s", 3),
             count_text(static_cast<std::int64_t>(std::min(std::ceil(spec.run.end / cost.step), 1e18))));
  fmt::print("needs: about {} of memory and {} with {} {} ({})\n", size_text(cost.bytes), duration_text(cost.seconds),
             cost.threads, cost.threads == 1 ? "thread" : "threads",
             cost.measured ? "from a few steps; without output" : "estimated");
  print_output(spec);
  std::vector<std::string> const& warnings = cost.warnings;
  for (std::string const& warning : warnings) fmt::print("warning: {}\n", warning);
  fmt::print("{}\n",
             warnings.empty() ? "Nothing is wrong with this case." : "The case can run; please look at the warnings.");
  return completed;
}

}  // namespace

void add_check(CLI::App& program, Action& action) {
  auto const options = std::make_shared<CaseOptions>();
  CLI::App* command = program.add_subcommand("check", "Say what a case would run, what it needs and what looks odd");
  options->add_to(*command);
  command->callback([options, &action] { action = [options] { return check(*options); }; });
}

}  // namespace piola::app
