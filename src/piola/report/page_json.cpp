// SPDX-License-Identifier: Apache-2.0
#include "piola/report/page_json.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/version.hpp"
#include "piola/drawing/colour_map.hpp"
#include "piola/drawing/picture.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/output/history.hpp"
#include "piola/pictures/case_scene.hpp"
#include "piola/pictures/history_plot.hpp"
#include "piola/pictures/picture_overrides.hpp"
#include "piola/pictures/rounding_levels.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace piola::report {
namespace {

namespace fs = std::filesystem;

constexpr int table_size = 64;

/// Logs may be long; the relevant lines are at the end.
std::string end_of(std::string const& log) {
  constexpr std::size_t most = 200'000;
  return log.size() <= most ? log : "...\n" + log.substr(log.find('\n', log.size() - most) + 1);
}

/// A table of colours from low to high, as in pictures.
Json colours_between(double low, double high) {
  ColourMap const map(low, high);
  Json list = Json::array();
  for (int k = 0; k < table_size; ++k) {
    Colour const c = map(low + (high - low) * k / (table_size - 1));
    for (std::uint8_t const part : c) list.push_back(part);
  }
  return list;
}

Json shape_json(RigidShape const& shape) {
  char const* const kinds[] = {"plane", "sphere", "cylinder", "box"};
  return {{"name", shape.name},         {"kind", kinds[static_cast<int>(shape.kind)]},
          {"half", shape.half_lengths}, {"radius", shape.radius},
          {"axis", shape.axis},         {"turns", shape.turns()}};
}

/// Poses of shapes: centre, then the three edges, 12 numbers each.
Json poses_json(std::vector<RigidShape> const& shapes) {
  Json list = Json::array();
  for (RigidShape const& shape : shapes) {
    for (double const x : shape.centre) list.push_back(x);
    for (auto const& edge : shape.edges)
      for (double const x : edge) list.push_back(x);
  }
  return list;
}

/// Entries of a list for the frames of a plan.
Json chosen(Plan const& plan, auto const& list) {
  Json some = Json::array();
  for (std::size_t const k : plan.frames) some.push_back(list[k]);
  return some;
}

Json fields_json(FrameStatistics const& statistics, Plan const& plan) {
  Json fields = Json::array();
  for (std::size_t f = 0; f < plan.fields; ++f) {
    ShownField const& field = statistics.fields[f];
    fields.push_back({{"name", field.info.name},
                      {"label", field.label},
                      {"unit", field.info.unit},
                      {"low", field.scale.low},
                      {"high", field.scale.high},
                      {"extremes", chosen(plan, field.extremes)}});
  }
  return fields;
}

/// If only some particles are shown, their balls are enlarged to fill the space of the omitted ones.
Json bodies_json(RunFolder const& run, FrameStatistics const& statistics, Plan const& plan) {
  double const growth = std::pow(static_cast<double>(plan.every), 1.0 / statistics.dimension);
  Json bodies = Json::array();
  for (std::size_t b = 0; b < statistics.radius.size(); ++b) {
    bool const named = run.spec && b < run.spec->bodies.size();
    bodies.push_back({{"name", named ? run.spec->bodies[b].name : fmt::format("body {}", b)},
                      {"radius", growth * statistics.radius[b]}});
  }
  return bodies;
}

/// Columns in the order in which they are worth a plot; the energies have one together.
std::vector<std::string> columns_to_plot(RunFolder const& run, HistoryTable const& table) {
  std::vector<std::string> order;
  auto const add = [&](std::string const& name) {
    bool const there = table.find(name) && unit_of_column(name) != "J";
    if (there && std::find(order.begin(), order.end(), name) == order.end()) order.push_back(name);
  };
  if (run.spec) {
    for (QuantitySpec const& quantity : run.spec->quantities) add(quantity.column);
    for (ProbeSpec const& probe : run.spec->probes)
      for (HistoryColumn const& column : table.columns)
        if (column.name.starts_with(probe.name + ".")) add(column.name);
  }
  for (HistoryColumn const& column : table.columns)
    if (column.name.find('.') != std::string::npos) add(column.name);
  add("dt");
  for (HistoryColumn const& column : table.columns)
    if (column.name != "time" && column.name != "step") add(column.name);
  return order;
}

/// Nothing if there is nothing to draw of these columns.
std::optional<Json> one_plot(RunFolder const& run, std::vector<std::string> const& columns) try {
  Plot plot = history_plot(run.path, {.columns = columns});
  std::string const name = columns.empty() ? "energies" : plot.y.name;
  plot.title.clear();
  plot.note.clear();
  if (plot.curves.size() == 1) plot.curves.front().label.clear();  // its axis has the name
  plot.width = 560;
  plot.height = 300;
  PlotText const text = plot_text(plot);
  std::vector<std::uint8_t> const bytes(text.svg.begin(), text.svg.end());
  return Json{{"name", name},      {"svg", packed_text(bytes)}, {"width", plot.width}, {"height", plot.height},
              {"left", text.left}, {"right", text.right},       {"top", text.top},     {"bottom", text.bottom},
              {"low", text.low},   {"high", text.high}};
} catch (InputError const&) {
  return std::nullopt;
}

/// The ends of the bytes of V, component by component; null where balls are round.
Json stretch_json(Plan const& plan, SurfaceData const& surface_data) {
  if (!plan.stretched || !surface_data.shapes || surface_data.surfaces) return {};
  Json list = Json::array();
  for (std::size_t c = 0; c < BodyShapes::stretch_components; ++c) {
    ByteScale const scale = BodyShapes::stretch_scale(c);
    list.push_back({scale.low, scale.high});
  }
  return list;
}

/// The number of each frame's list of triangles; null where there are no surfaces.
Json facets_json(Plan const& plan, SurfaceData const& surface_data) {
  return surface_data.surfaces ? chosen(plan, surface_data.surfaces->list_of) : Json();
}

/// Direction of view of the pictures of the case, given by angles or by a name.
View view_of(RunFolder const& run) {
  if (!run.spec) return {30, 20, Up::y};
  return camera_of(run.spec->output.pictures, upwards(*run.spec), run.spec->bodies, 3).view;
}

}  // namespace

Json about_run(RunFolder const& run) {
  View const view = view_of(run);
  Json about{{"title", run.title},
             {"status", run.status},
             {"failure", run.failure},
             {"version", version()},
             {"failed_particle", failed_particle(run.failure)},
             {"up", std::string(up_words[static_cast<std::size_t>(view.upwards)])},
             {"view", {view.azimuth, view.elevation}},
             {"perspective", run.spec && run.spec->output.pictures.perspective > 0},
             {"case", run.case_text},
             {"log", end_of(run.log)}};
  about["summary"] = run.summary.empty() ? Json() : Json::parse(run.summary);
  return about;
}

Json about_frames(RunFolder const& run, FrameStatistics const& statistics, Plan const& plan,
                  SurfaceData const& surface_data) {
  Lattice const lattice = Lattice::of(statistics.low, statistics.high, plan.bits);
  Json frames{{"dimension", statistics.dimension},
              {"all", statistics.particles},
              {"every", plan.every},
              {"particles", planned_bodies(statistics, plan, surface_data).size()},
              {"stretched", stretch_json(plan, surface_data)},
              {"facets", facets_json(plan, surface_data)},
              {"key_every", FrameCodec::key_every},
              {"low", lattice.low},
              {"step", lattice.step},
              {"missing", lattice.missing()},
              {"stage", {statistics.first_low, statistics.first_high}},
              {"times", chosen(plan, statistics.times)},
              {"numbers", chosen(plan, statistics.frames)},
              {"fields", fields_json(statistics, plan)},
              {"bodies", bodies_json(run, statistics, plan)},
              {"shapes", Json::array()},
              {"poses", Json::array()},
              {"maps", {{"rising", colours_between(0, 1)}, {"around zero", colours_between(-1, 1)}}}};
  if (statistics.axisymmetric) frames["mirrored"] = true;
  auto const rigids = run.spec ? run.spec->rigids : std::vector<RigidSpec>();
  for (RigidShape const& shape : shapes_at(rigids, 0)) frames["shapes"].push_back(shape_json(shape));
  for (std::size_t const k : plan.frames)
    frames["poses"].push_back(poses_json(shapes_at(rigids, statistics.times[k], statistics.rigid_poses[k])));
  return frames;
}

Json about_plots(RunFolder const& run, std::size_t most, std::size_t& left) {
  Json plots = Json::array();
  HistoryTable const table = read_history(run.path / "history.csv");
  if (table.columns.empty() || table.rows.empty()) return plots;
  if (auto plot = one_plot(run, {})) plots.push_back(std::move(*plot));
  auto columns = columns_to_plot(run, table);
  RoundingLevels const levels(table, run.path);
  std::stable_partition(columns.begin(), columns.end(),
                        [&](std::string const& column) { return !levels.is_rounding(column); });
  for (std::string const& column : columns) {
    if (plots.size() >= most)
      ++left;
    else if (auto plot = one_plot(run, {column}))
      plots.push_back(std::move(*plot));
  }
  return plots;
}

Json about_pictures(RunFolder const& run, std::uintmax_t most_bytes) {
  std::map<std::string, fs::path> last;  // last picture of each field, by the file name before the number
  std::error_code error;
  for (auto const& entry : fs::directory_iterator(run.path / "pictures", error)) {
    std::string const name = entry.path().stem().string();
    if (entry.path().extension() != ".png" || name.rfind('-') == std::string::npos) continue;
    fs::path& newest = last[name.substr(0, name.rfind('-'))];
    if (newest.filename() < entry.path().filename()) newest = entry.path();
  }
  Json pictures = Json::array();
  for (auto const& [field, path] : last) {
    std::uintmax_t const size = fs::file_size(path, error);
    if (error || size > most_bytes) continue;
    most_bytes -= size;
    std::string const png = read_text_file(path, size);
    pictures.push_back(
        {{"name", path.filename().string()}, {"png", base64(std::vector<std::uint8_t>(png.begin(), png.end()))}});
  }
  return pictures;
}

Json about_rows(std::vector<VerificationRow> const& rows) {
  Json list = Json::array();
  for (VerificationRow const& row : rows)
    list.push_back({{"case", row.case_name},
                    {"variant", row.variant},
                    {"quantity", row.quantity},
                    {"unit", row.unit},
                    {"reference", row.reference},
                    {"measured", row.measured ? Json(*row.measured) : Json()},
                    {"tolerance", row.tolerance},
                    {"verdict", row.verdict},
                    {"accepted", row.accepted},
                    {"evidence", row.evidence},
                    {"source", row.source},
                    {"note", row.note}});
  return list;
}

std::string script_text(Json const& json) {
  std::string const text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (char const c : text) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

}  // namespace piola::report
