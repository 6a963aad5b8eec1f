// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "piola/formulations/renamed_outputs.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/pictures/history_plot.hpp"
#include "piola/report/checks_of_run.hpp"
#include "piola/report/plot_references.hpp"
#include "piola/study/identification_plot.hpp"
#include "piola/study/study_plot.hpp"
#include "commands.hpp"
#include "streams.hpp"
#include <algorithm>
#include <memory>

namespace piola::app {
namespace {

struct PlotArguments {
  std::string folder, out, checks, variant;
  std::vector<std::string> columns, with, log;
  std::string against;
  std::vector<int> size{800, 500};
};

/// Adds the expected values of a checks.toml for the drawn quantities; ignores the rest of the file.
void add_references_of(PlotArguments const& options, Plot& drawn) {
  report::RunFolder const run = report::open_run(options.folder);
  std::string note;
  auto const rows = report::rows_of_run(run, options.checks, options.variant, note);
  if (!note.empty()) print_result("{}\n", note);
  int const count = report::add_references(drawn, run, rows, options.columns);
  print_result("{} reference{} of {}\n", count, count == 1 ? "" : "s", options.checks);
}

bool is_logarithmic(PlotArguments const& options, char const* axis) {
  return std::find(options.log.begin(), options.log.end(), axis) != options.log.end();
}

Plot plot_of_study(PlotArguments const& options, std::filesystem::path const& table) {
  if (!options.with.empty() || !options.checks.empty())
    throw InputError("--with and --checks are for runs, and " + table.string() + " is of a study - leave them out");
  return study_plot(table, {.quantities = options.columns,
                            .against = options.against,
                            .log_x = is_logarithmic(options, "x"),
                            .log_y = is_logarithmic(options, "y")});
}

Plot plot_of_identification(PlotArguments const& options, std::filesystem::path const& table) {
  if (!options.columns.empty() || !options.with.empty() || !options.checks.empty() || !options.against.empty())
    throw InputError(table.string() + " is of an identification: columns, --with, --against and --checks are for runs" +
                     " - leave them out");
  return identification_plot(table, is_logarithmic(options, "x"), is_logarithmic(options, "y"));
}

Plot plot_of_run(PlotArguments const& options) {
  bool const over_time = options.against.empty() || options.against == "time";
  Plot drawn = history_plot(options.folder, {.columns = options.columns,
                                             .against = over_time ? "time" : options.against,
                                             .with = {options.with.begin(), options.with.end()},
                                             .log_x = is_logarithmic(options, "x"),
                                             .log_y = is_logarithmic(options, "y")});
  if (!options.checks.empty()) {
    if (!over_time)
      throw InputError("--checks: references stand over time (here: --against " + options.against +
                       ") - leave one out");
    add_references_of(options, drawn);
  }
  return drawn;
}

/// Writes the plot to `--out`, or beside what it is drawn from.
int write_drawing(PlotArguments const& options, Plot drawn, std::filesystem::path const& beside, std::size_t curves) {
  drawn.width = options.size[0];
  drawn.height = options.size[1];
  std::filesystem::path const out = options.out.empty() ? beside : std::filesystem::path(options.out);
  if (out.has_parent_path()) make_folder(out.parent_path());
  write_plot(out, drawn);
  print_result("{} curve{} drawn to {}\n", curves, curves == 1 ? "" : "s", out.string());
  return completed;
}

int plot(PlotArguments options) {
  if (auto const curves = identified_curves_at(options.folder); !curves.empty()) {
    Plot const drawn = plot_of_identification(options, curves);
    return write_drawing(options, drawn, curves.parent_path() / "curves.svg", drawn.curves.size() / 3);
  }
  std::filesystem::path const table = study_table_at(options.folder);
  if (table.empty()) {
    for (std::string& column : options.columns) column = current_output_name(column);
    options.against = current_output_name(options.against);
  }
  Plot const drawn = table.empty() ? plot_of_run(options) : plot_of_study(options, table);
  std::string const name = !options.columns.empty() ? options.columns.front() : table.empty() ? "energies" : "study";
  std::filesystem::path const folder = table.empty() ? std::filesystem::path(options.folder) : table.parent_path();
  // Rings at the runs of a study belong to its curves.
  std::size_t const curves = table.empty() ? drawn.curves.size() : drawn.curves.size() / 2;
  return write_drawing(options, drawn, folder / (name + (options.columns.size() > 1 ? "-and-more.svg" : ".svg")),
                       curves);
}

}  // namespace

void add_plot(CLI::App& program, Action& action) {
  auto const options = std::make_shared<PlotArguments>();
  CLI::App* command = program.add_subcommand(
      "plot",
      "Draw columns of the history of a run, by default its energies, quantities of a study, or identified curves");
  command
      ->add_option(
          "folder", options->folder,
          "The results folder of the run, the folder or the study.csv of a study, or that of an identification")
      ->required();
  command->add_option("columns", options->columns,
                      "Columns of history.csv (default: the energies as a ledger); quantities of the study");
  command->add_option("--against", options->against,
                      "The column of the horizontal axis (default: time), or the parameter of the study (default: the "
                      "first that changes)");
  command->add_option("--with", options->with, "Another results folder to draw beside it; may be repeated")
      ->type_size(1)
      ->allow_extra_args(false);
  command->add_option("--log", options->log, "A logarithmic axis: x, y; may be repeated")
      ->type_size(1)
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"x", "y"}));
  auto* const checks = command->add_option(
      "--checks", options->checks, "A checks.toml: what it expects of quantities of these columns is drawn, too");
  command->add_option("--variant", options->variant, "With --checks: the variant of that file that the run is of")
      ->needs(checks);
  command->add_option("--out,-o", options->out, "The file: NAME.svg, NAME.png or NAME.pdf (default: in the folder)");
  command->add_option("--size", options->size, "Width and height in pixels; a PNG has twice as many")
      ->expected(2)
      ->check(CLI::Range(200, 20000))
      ->capture_default_str();
  command->callback([options, &action] { action = [options] { return plot(*options); }; });
}

}  // namespace piola::app
