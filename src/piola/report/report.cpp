// SPDX-License-Identifier: Apache-2.0
#include "piola/report/report.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/report/checks_of_run.hpp"
#include "piola/report/frame_content.hpp"
#include "piola/report/page.hpp"
#include "piola/report/page_budget.hpp"
#include "piola/report/page_json.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <set>

namespace piola::report {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_frames = 200, most_fields = 5, least_fields = 2, most_plots = 12;
constexpr std::size_t most_stretched = 300'000, most_stretches = 10'000'000;
constexpr std::uintmax_t most_picture_bytes = 3'000'000;

/// The frames of a page: what is known of them, and what of them it holds.
struct Shown {
  FrameStatistics statistics;
  Plan plan;
  SurfaceData surface_data;
};

/// Finds surfaces if they are asked for, else how balls are stretched, as far as that takes seconds only.
void shape(RunFolder const& run, ReportOptions const& options, Shown& shown) {
  FrameStatistics& statistics = shown.statistics;
  bool const soon =
      statistics.particles <= most_stretched && statistics.particles * statistics.frames.size() <= most_stretches;
  if (!options.surface && !(soon && statistics.dimension > 1)) return;
  shown.surface_data.shapes = BodyShapes::of(run, statistics.dimension, statistics.body);
  shown.plan.stretched = !options.surface && shown.surface_data.shapes;
  if (!options.surface) return;
  if (shown.surface_data.shapes) {
    shown.surface_data.shapes->find_torn_cells(run);
    shown.surface_data.surfaces = find_surfaces(run, *shown.surface_data.shapes, statistics);
  }
  auto const triangles = [](auto const& list) { return !list.empty(); };
  if (!shown.surface_data.surfaces ||
      std::none_of(shown.surface_data.surfaces->lists.begin(), shown.surface_data.surfaces->lists.end(), triangles))
    throw InputError(
        fmt::format("{}: its bodies have no surface (a case.toml that makes these particles is needed, in "
                    "2D or 3D) - leave out --surface",
                    run.path.string()));
}

Shown shown_of(RunFolder const& run, ReportOptions const& options) {
  auto const wanted = options.frames > 0 ? options.frames : most_frames;
  auto const numbers = spread(run.frames.size(), wanted);
  FrameReader const first(run.frames[numbers.front()].second);
  auto const fields = options.fields.empty()
                          ? usual_fields(first, run.spec ? run.spec->output.pictures.field : "Pressure", most_fields)
                          : options.fields;
  Shown shown{read_statistics(run, numbers, fields), {}, {}};
  shown.plan = {.frames = std::vector<std::size_t>(numbers.size()), .fields = fields.size(), .bits = options.bits};
  std::iota(shown.plan.frames.begin(), shown.plan.frames.end(), std::size_t{0});
  shape(run, options, shown);
  return shown;
}

/// All but the frames. Same files, same text.
Json about_all(RunFolder const& run, ReportOptions const& options, std::vector<std::string>& notes) {
  Json about = about_run(run);
  std::size_t left = 0;
  about["plots"] = about_plots(run, most_plots, left);
  about["plots_left"] = left;
  std::string note;
  about["pictures"] = about_pictures(run, most_picture_bytes);
  fs::path const own = run.path / "checks.toml";
  fs::path const checks = !options.checks.empty() ? options.checks : fs::exists(own) ? own : fs::path();
  auto rows = options.rows;
  if (!checks.empty()) {
    auto const more = rows_of_run(run, checks, options.variant, note);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  if (!note.empty()) notes.push_back(note);
  about["rows"] = about_rows(rows);
  about["reload"] = run.status == "running" ? options.reload : 0;
  return about;
}

/// Bytes of a page, and those of them that are frames.
struct PageSize {
  double all = 0, frames = 0;
};

void put_surfaces(PageFile& file, PageSurfaces const& surfaces, Plan const& plan) {
  file.data("particles", packed_text(encode_large_numbers(surfaces.particles)));
  std::set<std::size_t> needed;
  for (std::size_t const k : plan.frames) needed.insert(surfaces.list_of[k]);
  for (std::size_t const list : needed)
    file.data(fmt::format("facets-{}", list), packed_text(encode_large_numbers(surfaces.lists[list])));
}

PageSize write_page(fs::path const& page, RunFolder const& run, Json const& about, Shown const* shown) {
  PageFile file(page, run.title);
  double before = 0, after = 0;
  file.data("about", script_text(about), true);
  if (shown != nullptr) {
    auto const& [statistics, plan, surface_data] = *shown;
    file.data("frames", script_text(about_frames(run, statistics, plan, surface_data)), true);
    file.data("bodies", packed_text(encode_numbers(planned_bodies(statistics, plan, surface_data))));
    if (surface_data.surfaces) put_surfaces(file, *surface_data.surfaces, plan);
    Lattice const lattice = Lattice::of(statistics.low, statistics.high, plan.bits);
    FrameCodec coder;
    before = file.size();
    for (std::size_t k = 0; k < plan.frames.size(); ++k) {
      FrameReader const frame(run.frames[statistics.frames[plan.frames[k]]].second);
      auto const codes = planned_codes(frame, statistics, lattice, plan, surface_data);
      file.data(fmt::format("frame-{}", k), packed_text(coder.encode(codes, k % FrameCodec::key_every == 0)));
    }
    after = file.size();
  }
  file.finish();
  return {file.size(), after - before};
}

/// The size of a plan is known only after writing. Then the expectation is corrected and a smaller plan written if
/// necessary.
void write_within_budget(fs::path const& page, RunFolder const& run, ReportOptions const& options, Json& about,
                         std::vector<std::string> const& notes, ReportResult& result) {
  Shown shown = shown_of(run, options);
  Plan const all = shown.plan;
  constexpr double own_sources = 100'000;
  double const rest = static_cast<double>(script_text(about).size()) + own_sources, least = 0.02 * options.budget;
  PageBudget limits{.bytes = std::max(options.budget - rest, least),
                    .least_fields = options.fields.empty() ? least_fields : all.fields};
  for (int attempt = 0; attempt < 4; ++attempt) {
    shown.plan = fitting_plan(run, shown.statistics, all, limits, shown.surface_data);
    result.notes = notes;
    if (all.frames.size() < run.frames.size() && options.frames == 0)
      result.notes.push_back(
          fmt::format("{} of {} frames are shown; --frames chooses otherwise", all.frames.size(), run.frames.size()));
    for (auto& note : plan_notes(shown.plan, all, shown.statistics, options.budget)) result.notes.push_back(note);
    about["notes"] = result.notes;
    PageSize const size = write_page(page, run, about, &shown);
    result.bytes = size.all;
    result.frames = shown.plan.frames.size();
    if (size.all <= options.budget) return;
    if (shown.surface_data.surfaces && attempt == 3)
      result.notes.push_back(fmt::format("the page has {}: surfaces are not thinned out", size_text(size.all)));
    limits.correction *= std::max(1.02 * size.frames / limits.bytes, 1.0);
    limits.bytes = std::max(options.budget - (size.all - size.frames), least);
  }
}

}  // namespace

ReportResult write_report(fs::path const& folder, fs::path const& page, ReportOptions const& options) {
  RunFolder const run = open_run(folder);
  std::vector<std::string> notes;
  Json about = about_all(run, options, notes);
  ReportResult result{.status = run.status};
  if (run.frames.empty()) {
    notes.push_back("the run has no frames to show; output.frames.every in the case writes some");
    about["notes"] = notes;
    result.bytes = write_page(page, run, about, nullptr).all;
    result.notes = notes;
    return result;
  }
  write_within_budget(page, run, options, about, notes, result);
  return result;
}

}  // namespace piola::report
