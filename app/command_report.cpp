// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/formulations/renamed_outputs.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/report/page.hpp"
#include "piola/report/report.hpp"
#include "commands.hpp"
#include "signals.hpp"
#include "streams.hpp"
#include <memory>

namespace piola::app {
namespace {

struct ReportArguments {
  std::string folder, out;
  report::ReportOptions what;
  double megabytes = 30;
  bool until_ended = false;
};

constexpr int rewrite_seconds = 10;

report::ReportResult write_one(ReportArguments const& options, std::filesystem::path const& out) {
  auto const result = report::write_report(options.folder, out, options.what);
  print_result("{} frame{} in {}, {}\n", result.frames, result.frames == 1 ? "" : "s", out.string(),
               size_text(result.bytes));
  return result;
}

void tell_notes(report::ReportResult const& result) {
  for (std::string const& note : result.notes) print_message("note: {}\n", note);
}

/// Writes the page every ten seconds, until the run has ended or a signal comes.
int rewrite_until_ended(ReportArguments const& options, std::filesystem::path const& out) {
  catch_stop_signals();
  for (;;) {
    auto const result = write_one(options, out);
    if (result.status != "running") {
      tell_notes(result);
      return completed;
    }
    if (!wait_unless_stopped(rewrite_seconds)) return stopped_by_signal;
  }
}

int write_page_of_run(ReportArguments options) {
  std::filesystem::path const out =
      options.out.empty() ? std::filesystem::path(options.folder) / "report.html" : std::filesystem::path(options.out);
  report::require_page_name(out);
  if (out.has_parent_path()) make_folder(out.parent_path());
  for (std::string& field : options.what.fields) field = current_output_name(field);
  options.what.budget = options.megabytes * 1e6;
  options.what.reload = options.until_ended ? rewrite_seconds : 0;
  if (options.until_ended) return rewrite_until_ended(options, out);
  tell_notes(write_one(options, out));
  return completed;
}

}  // namespace

void add_report(CLI::App& program, Action& action) {
  auto const options = std::make_shared<ReportArguments>();
  CLI::App* command = program.add_subcommand(
      "report", "Write one HTML page about a run: particles in space over time, plots, tables; any browser shows it");
  command->add_option("folder", options->folder, "The results folder of the run")->required();
  command->add_option("--out,-o", options->out, "The page (default: report.html in the folder)");
  command
      ->add_option("--fields", options->what.fields,
                   "Fields of the frames to show (default: the most informative ones)")
      ->delimiter(',');
  command->add_option("--frames", options->what.frames, "Largest number of frames, evenly chosen (default: 200)")
      ->check(CLI::Range(1, 100000));
  command->add_option("--bits", options->what.bits, "Bits of a coordinate")
      ->check(CLI::Range(8, 16))
      ->capture_default_str();
  command->add_flag("--surface", options->what.surface, "Show the surfaces of bodies in place of all their particles");
  command->add_option("--budget", options->megabytes, "Megabytes that the page may have")
      ->check(CLI::Range(1.0, 2000.0))
      ->capture_default_str();
  command->add_option("--checks", options->what.checks,
                      "A checks.toml to judge the run by (default: that in the folder)");
  command->add_option("--variant", options->what.variant, "Its variant that the run is (default: found by the case)");
  command->add_flag("--follow", options->until_ended, "Write the page again every 10 s until the run has ended");
  command->callback([options, &action] { action = [options] { return write_page_of_run(*options); }; });
}

}  // namespace piola::app
