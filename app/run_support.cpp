// SPDX-License-Identifier: Apache-2.0
#include "run_support.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "piola/domain/communicator.hpp"
#include "commands.hpp"
#include "signals.hpp"
#include "streams.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <unistd.h>

namespace piola::app {

WallLimit::Clock::time_point const program_start = WallLimit::Clock::now();

namespace {

std::string percent(double share) { return fmt::format("{:3.0f} %", 100 * std::clamp(share, 0.0, 1.0)); }

std::string rate_text(double stages_per_second) { return fmt::format("{:.2f} M stages/s", stages_per_second / 1e6); }

std::string progress_line(Progress const& p) {
  return fmt::format("{}  t = {} of {}  step {}  dt = {}  energy {}  {}  {} left", percent(p.moment.time / p.end),
                     quantity_text(p.moment.time, "s"), quantity_text(p.end, "s"), count_text(p.moment.step),
                     quantity_text(p.moment.dt, "s", 3), quantity_text(p.total_energy, "J"),
                     rate_text(p.stages_per_second), duration_text(p.seconds_left));
}

std::string body_line(Body const& body, BodySpec const& spec, int dimension) {
  auto const [least, most] = std::minmax_element(body.spacing.begin(), body.spacing.begin() + dimension);
  double const finest = *least, coarsest = *most;
  std::string const text = finest == coarsest
                               ? quantity_text(finest, "m")
                               : fmt::format("{} to {}", quantity_text(finest, "m"), quantity_text(coarsest, "m"));
  return fmt::format("  {}: {} particles, spacing {}, {}\n", body.name, count_text(body.last - body.first), text,
                     spec.law);
}

}  // namespace

StatusLine::StatusLine() : terminal_(::isatty(STDERR_FILENO) != 0), last_(std::chrono::steady_clock::now()) {}
StatusLine::~StatusLine() { clear(); }

void StatusLine::clear() {
  if (shown_ > 0) print_message("\r{:{}}\r", "", shown_);
  shown_ = 0;
}

void StatusLine::show(std::string const& line) {
  if (terminal_) {
    print_message("\r{:<{}}", line, shown_);
    shown_ = std::max(shown_, line.size());
    return;
  }
  auto const now = std::chrono::steady_clock::now();
  if (now - last_ < std::chrono::seconds(10)) return;
  last_ = now;
  print_message("{}\n", line);
}

void Console::progress(Progress const& progress) {
  if (!quiet_) line_.show(progress_line(progress));
}

void Console::warning(std::string const& text) {
  clear();
  print_message("warning: {}\n", text);
}

std::string dimension_text(ParticleSet const& particles) {
  return particles.axisymmetric ? "axisymmetric" : fmt::format("in {}D", particles.dimension);
}

std::string start_report(Simulation const& s, std::filesystem::path const& folder) {
  std::string text =
      fmt::format("{}\n{} {}, {} particles, {} thread{}\n", s.spec.title, s.formulation_name,
                  dimension_text(s.particles), count_text(s.particles.size()), s.threads, s.threads == 1 ? "" : "s");
  for (std::size_t b = 0; b < s.spec.bodies.size() && b < s.particles.bodies.size(); ++b)
    text += body_line(s.particles.bodies[b], s.spec.bodies[b], s.particles.dimension);
  text += fmt::format("  first step {}, end {}\n  results in {}\n",
                      quantity_text(s.formulation->stable_time_step(), "s", 3), quantity_text(s.spec.run.end, "s"),
                      folder.string());
  return text;
}

namespace {

/// Energy change by the scheme, as measured by the guard of dissipation.
std::string dissipation_text(Summary const& summary) {
  if (!summary.guards) return "";
  for (GuardNumbers const& guard : *summary.guards)
    for (auto const& [name, value] : guard.values)
      if (guard.name == "dissipation" && name == "share" && value > 0)
        return fmt::format("; viscosity and other stabilisation took {:.2g} %", 100 * value);
  return "";
}

}  // namespace

std::string end_report(CaseOutcome const& outcome, std::filesystem::path const& folder) {
  Summary const& s = outcome.summary;
  std::string text =
      fmt::format("{} at t = {} after {} steps, {} of wall time, {}\n", s.status, quantity_text(s.end_time, "s"),
                  count_text(s.steps), duration_text(s.wall_seconds), rate_text(s.stages_per_second));
  text +=
      fmt::format("  energy: {} at start, {} at end, largest rise {} of it{}\n", quantity_text(s.energy_initial, "J"),
                  quantity_text(s.energy_final, "J"), number_text(s.energy_max_increase, 2), dissipation_text(s));
  if (s.relaxation && s.relaxation->at_rest)
    text += fmt::format("  at rest: forces out of balance {} of their largest, {} of the displacement left\n",
                        number_text(s.relaxation->residual, 2), number_text(s.relaxation->left, 2));
  if (s.linear_drift && s.angular_drift)
    text += fmt::format("  momentum drift: linear {}, angular {} of its scale\n", number_text(*s.linear_drift, 2),
                        number_text(*s.angular_drift, 2));
  if (s.cracks)
    text += fmt::format("  cracks: {} took {}, {} times the fracture_energy of the material\n",
                        quantity_text(s.cracks->area, "m^2"), quantity_text(s.cracks->energy, "J/m^2"),
                        number_text(s.cracks->energy / s.cracks->of_material, 3));
  for (MeasuredQuantity const& q : s.quantities)
    text += fmt::format("  {} = {}{}\n", q.name, number_text(q.value),
                        q.unit == "1" || std::isnan(q.value) ? "" : " " + q.unit);
  if (!s.warnings.empty())
    text += fmt::format(
        "  {}: see log.txt\n",
        s.warnings.size() == 1 ? "1 warning" : count_text(static_cast<std::int64_t>(s.warnings.size())) + " warnings");
  if (!outcome.last_picture.empty()) text += fmt::format("  picture: {}\n", outcome.last_picture.string());
  if (!outcome.index.empty()) text += fmt::format("  for ParaView: {}\n", outcome.index.string());
  if (outcome.out_of_time) text += "  the wall time is used up\n";
  if (outcome.ending == RunStatus::stopped)
    text += fmt::format("  a checkpoint was written; continue with: piola resume {}\n", folder.string());
  return text;
}

void add_wall_time(CLI::App& command, std::string& text) {
  command
      .add_option("--wall-time", text,
                  "Stop with a checkpoint before this wall time has passed, e.g. \"2 h\" (exit code 4)")
      ->check([](std::string const& given) { return given.empty() ? "a time such as \"2 h\" is needed" : ""; }, "TIME");
}

double read_wall_time(std::string const& text) {
  if (text.empty()) return WallLimit::none;
  Quantity const time = read_quantity(text, "s");
  if (time.problem) throw InputError("--wall-time: " + *time.problem + " - give a time such as \"2 h\"");
  if (!(time.value > 0))
    throw InputError("--wall-time: " + in_quotes(text) +
                     " leaves no time (above 0 is allowed) - give one such as \"2 h\"");
  return time.value;
}

int run_and_report(Simulation& simulation, RunOptions options, bool quiet) {
  quiet = quiet || comm::rank() != 0;
  options.started = program_start;
  options.checkpoint_request = &checkpoint_signal;
  if (!quiet) write_out(start_report(simulation, options.folder));
  Console console(quiet);
  CaseOutcome const outcome = run_case(simulation, options, console, stop_signal);
  console.clear();
  if (!quiet) write_out(end_report(outcome, options.folder));
  if (outcome.ending == RunStatus::failed) print_message("piola: {}\n", outcome.failure);
  switch (outcome.ending) {
    case RunStatus::failed: return physics_failed;
    case RunStatus::stopped: return stopped_by_signal;
    default: return completed;
  }
}

void refuse_link_loop(std::filesystem::path const& path, std::error_code const& error) {
  if (error != std::errc::too_many_symbolic_link_levels) return;
  throw InputError(
      fmt::format("{}: is a link that leads back to itself (a file or folder is needed) - correct the link "
                  "('readlink' shows where it leads)",
                  path.string()));
}

std::filesystem::path data_folder(std::string const& name, std::string const& source) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::path const program = fs::read_symlink("/proc/self/exe", error);
  for (fs::path at = program.parent_path(); !error && at.has_relative_path(); at = at.parent_path())
    for (fs::path const& place : {fs::path("share/piola") / name, fs::path(source)})
      if (fs::is_directory(at / place)) return at / place;
  return source;
}

std::filesystem::path case_file(std::filesystem::path const& given) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::path file = fs::is_directory(given, error) ? given / "case.toml" : given;
  if (fs::exists(file, error)) return file;
  refuse_link_loop(file, error);
  if (error) throw InputError(fmt::format("{}: cannot be used, {} - check the path", file.string(), error.message()));
  throw InputError(fmt::format("{}: there is no such case file - check the path", file.string()));
}

}  // namespace piola::app
