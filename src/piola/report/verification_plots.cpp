// SPDX-License-Identifier: Apache-2.0
#include "piola/report/verification_plots.hpp"
#include "piola/base/errors.hpp"
#include "piola/pictures/history_plot.hpp"
#include "piola/report/plot_references.hpp"
#include <algorithm>
#include <array>
#include <optional>

namespace piola::report {
namespace {

constexpr std::array curve_colours{0, 1, 2, 3, 5, 6};  // black is what is expected

/// A variant with the rows that need it alone.
struct CheckedRun {
  std::string variant;
  RunFolder folder;
  std::vector<VerificationRow> rows;
};

std::vector<CheckedRun> checked_runs(CaseVerification const& c, std::filesystem::path const& results) {
  std::vector<CheckedRun> runs;
  for (VariantRun const& run : c.runs) {
    if (run.summary.empty()) continue;  // it could not be made; its folder may hold the results of an earlier run
    std::vector<VerificationRow> rows;
    for (VerificationRow const& row : c.rows)
      if (row.variant == run.variant) rows.push_back(row);
    try {
      runs.push_back({run.variant, open_run(results / c.name / folder_of(run.variant)), std::move(rows)});
    } catch (InputError const&) {  // a run that left no folder
    }
  }
  return runs;
}

/// The columns that quantities with rows are taken from, in their order.
std::vector<std::string> checked_columns(std::vector<CheckedRun> const& runs) {
  std::vector<std::string> columns;
  for (CheckedRun const& run : runs) {
    if (!run.folder.spec) continue;
    for (QuantitySpec const& quantity : run.folder.spec->quantities) {
      bool const looked_at = std::any_of(run.rows.begin(), run.rows.end(),
                                         [&](VerificationRow const& row) { return row.quantity == quantity.name; });
      bool const known = std::find(columns.begin(), columns.end(), quantity.column) != columns.end();
      if (looked_at && !known) columns.push_back(quantity.column);
    }
  }
  return columns;
}

std::optional<Plot> plot_of_run(CheckedRun const& run, std::string const& column) try {
  return history_plot(run.folder.path, {.columns = {column}});
} catch (InputError const&) {  // it left no history, or has no such column
  return std::nullopt;
}

/// Expectations of all runs are black; those of one of several runs have the colour of its curve. The plot holds the
/// curves of the runs, in their order.
void add_expected(Plot& plot, std::vector<CheckedRun const*> const& runs, std::string const& column) {
  PlotEnds const ends = ends_of(plot);
  std::vector<Curve> expected;
  for (std::size_t k = 0; k < runs.size(); ++k)
    for (Curve& curve : reference_curves(runs[k]->folder, runs[k]->rows, {column}, ends)) {
      auto const known = std::find_if(expected.begin(), expected.end(), [&](Curve const& other) {
        return other.label == curve.label && other.x == curve.x && other.y == curve.y;
      });
      if (known != expected.end()) {
        known->colour = curve.colour;
        continue;
      }
      if (runs.size() > 1) curve.colour = plot.curves[k].colour;
      expected.push_back(std::move(curve));
    }
  plot.curves.insert(plot.curves.end(), expected.begin(), expected.end());
}

void add_plots(std::vector<Plot>& plots, CaseVerification const& c, std::vector<CheckedRun> const& runs,
               std::string const& column) {
  std::vector<CheckedRun const*> drawn;
  Plot plot;
  auto const finish = [&] {
    if (drawn.empty()) return;
    add_expected(plot, drawn, column);
    plot.note = c.name;
    plots.push_back(std::move(plot));
    plot = {};
    drawn.clear();
  };
  for (CheckedRun const& run : runs) {
    auto own = plot_of_run(run, column);
    if (!own || reference_curves(run.folder, run.rows, {column}, ends_of(*own)).empty()) continue;
    Curve curve = std::move(own->curves.front());
    curve.label = run.variant;
    curve.colour = curve_colours[drawn.size()];
    if (drawn.empty()) {
      plot = std::move(*own);
      plot.remark.clear();
      plot.curves.clear();
    }
    plot.curves.push_back(std::move(curve));
    drawn.push_back(&run);
    if (drawn.size() == curve_colours.size()) finish();
  }
  finish();
}

}  // namespace

std::vector<Plot> verification_plots(CaseVerification const& c, std::filesystem::path const& results) {
  std::vector<Plot> plots;
  auto const runs = checked_runs(c, results);
  for (std::string const& column : checked_columns(runs)) add_plots(plots, c, runs, column);
  return plots;
}

}  // namespace piola::report
