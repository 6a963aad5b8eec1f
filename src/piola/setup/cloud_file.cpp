// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/cloud_file.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/output/checksum_trailer.hpp"
#include "piola/output/frame_reader.hpp"
#include "piola/setup/cloud_checks.hpp"
#include "piola/setup/cloud_datasets.hpp"
#include "piola/setup/cloud_table.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace piola {
namespace {

enum class CloudFormat { table, hdf5, other };

CloudFormat cloud_format(std::string const& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  auto const is_one_of = [&](std::initializer_list<std::string_view> endings) {
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
  };
  if (is_one_of({".hdf", ".h5", ".hdf5", ".vtkhdf"})) return CloudFormat::hdf5;
  if (is_one_of({".vtk", ".vtu", ".vtp", ".npy", ".npz", ".stl", ".obj", ".ply"})) return CloudFormat::other;
  return CloudFormat::table;
}

/// The particles of a frame. Its bodies are called by their numbers.
CloudTable read_cloud_frame(std::string const& path, CloudOptions const& options, std::vector<std::string>& problems) {
  CloudTable table;
  table.source = {path, false, {}};
  if (options.length_unit != 1)
    problems.push_back(path + ": is a frame, whose lengths are in m, and the case gives a unit for it - leave it out");
  try {
    FrameReader const frame(path);
    auto const volume = frame.volumes();
    auto body = frame.bodies();
    table.dimension = frame.dimension();
    table.X = frame.positions();
    table.volume.assign(volume.begin(), volume.end());
    int const last = body.empty() ? -1 : *std::max_element(body.begin(), body.end());
    int const first = body.empty() ? 0 : *std::min_element(body.begin(), body.end());
    if (first < 0 || static_cast<std::size_t>(last) + 1 > std::max<std::size_t>(table.X.size(), 1)) {
      problems.push_back(path + ": numbers its bodies in a way no frame does - the file is damaged");
      return {};
    }
    for (int b = 0; b <= last; ++b) table.bodies.push_back(std::to_string(b));
    table.body = std::move(body);
  } catch (FileError const& error) {
    problems.emplace_back(error.what());
  } catch (InputError const&) {
    problems.push_back(path + ": is a frame without volumes - give another file");
  }
  table.source.row.resize(table.X.size());
  std::iota(table.source.row.begin(), table.source.row.end(), std::int64_t{0});
  for (auto& x : table.X)
    for (auto c = static_cast<std::size_t>(table.dimension); c < 3; ++c) x[c] = 0;
  return table;
}

/// Frames are sealed, files of other programs are not. Truncated frames are recognised by their name.
CloudTable read_cloud_hdf5(std::string const& path, CloudOptions const& options, std::vector<std::string>& problems) {
  bool const is_frame = has_checksum_trailer(path) || std::filesystem::path(path).extension() == ".vtkhdf";
  if (!is_frame) return read_cloud_datasets(path, options.group, options.length_unit, problems);
  if (!options.group.empty())
    problems.push_back(path +
                       ": is a frame, which has no groups to choose from, and the case gives one - leave it out");
  return read_cloud_frame(path, options, problems);
}

/// Keeps the rows of one body.
void keep_body(CloudTable& table, std::string const& wanted, std::vector<std::string>& problems) {
  std::string const& file = table.source.file;
  if (wanted.empty()) {
    if (table.bodies.size() > 1)
      table.notes.push_back(fmt::format("{}: the {} bodies in it are taken as one; with a body, only its points are",
                                        file, table.bodies.size()));
    return;
  }
  auto const found = std::find(table.bodies.begin(), table.bodies.end(), wanted);
  if (found == table.bodies.end()) {
    problems.push_back(
        table.bodies.empty()
            ? fmt::format("{}: has no column \"body\" to choose {} from - add one, or leave out the body", file,
                          in_quotes(wanted))
            : fmt::format("{}: has no rows of the body {} (it has {}) - {}", file, in_quotes(wanted),
                          in_quotes(known_names_text(wanted, table.bodies)), advice_for_name(wanted, table.bodies)));
    return;
  }
  int const chosen = static_cast<int>(found - table.bodies.begin());
  auto const keep = [&](auto& values) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (table.body[i] == chosen) values[kept++] = values[i];
    values.resize(kept);
  };
  keep(table.X);
  keep(table.volume);
  keep(table.kernel_volume);
  keep(table.source.row);
}

/// Takes volumes from the file, or divides the total volume of the case equally.
void take_volumes(PointCloud& cloud, CloudSource const& source, CloudOptions const& options,
                  std::vector<std::string>& problems) {
  auto const n = static_cast<double>(cloud.X.size());
  bool const shared = cloud.volume.empty() && options.total_volume;
  if (options.total_volume && !cloud.volume.empty()) {
    problems.push_back(source.file + ": gives volumes, and the case gives a total volume - leave out one of them");
  } else if (shared && !(*options.total_volume > 0 && std::isfinite(*options.total_volume))) {
    problems.push_back(fmt::format("{}: the total volume is {} (expected a positive number) - correct it", source.file,
                                   number_text(*options.total_volume)));
  } else if (shared) {
    cloud.volume.assign(cloud.X.size(), *options.total_volume / n);
  } else if (cloud.volume.empty()) {
    problems.push_back(
        fmt::format("{}: has no column \"volume\" - add one, or give the total volume of the body, of "
                    "which every point gets an equal share",
                    source.file));
  }
  if (cloud.kernel_volume.empty()) cloud.kernel_volume = cloud.volume;
}

/// The cloud of a table, if nothing is wrong with it.
PointCloud make_cloud(CloudTable table, CloudOptions const& options, std::vector<std::string>& problems) {
  PointCloud cloud;
  keep_body(table, options.body, problems);
  std::size_t const before = problems.size();
  cloud.dimension = table.dimension;
  cloud.X = std::move(table.X);
  cloud.volume = std::move(table.volume);
  cloud.kernel_volume = std::move(table.kernel_volume);
  cloud.notes = std::move(table.notes);
  auto const least = static_cast<std::size_t>(cloud.dimension) + 1;
  if (cloud.X.size() < least)
    problems.push_back(fmt::format("{}: holds {} point{} (at least {} in {}D) - give more", table.source.file,
                                   cloud.X.size(), cloud.X.size() == 1 ? "" : "s", least, cloud.dimension));
  check_cloud_numbers(cloud, table.source, problems);
  take_volumes(cloud, table.source, options, problems);
  if (problems.size() > before) return cloud;
  double const total = std::accumulate(cloud.volume.begin(), cloud.volume.end(), 0.0);
  cloud.spacing = std::pow(total / static_cast<double>(cloud.X.size()), 1.0 / cloud.dimension);
  cloud.min = cloud.max = cloud.X.front();
  for (auto const& x : cloud.X)
    for (std::size_t c = 0; c < 3; ++c) {
      cloud.min[c] = std::min(cloud.min[c], x[c]);
      cloud.max[c] = std::max(cloud.max[c], x[c]);
    }
  check_cloud_places(cloud, table.source, problems);
  return cloud;
}

/// Skips further checks of an unreadable table, whose problems would be reported twice.
PointCloud checked_cloud(CloudTable table, CloudOptions const& options, std::vector<std::string>& problems,
                         std::size_t before) {
  if (problems.size() > before) return {};
  return make_cloud(std::move(table), options, problems);
}

}  // namespace

PointCloud read_cloud_text(std::string_view text, std::string const& name, CloudOptions const& options,
                           std::vector<std::string>& problems) {
  std::size_t const before = problems.size();
  return checked_cloud(read_cloud_table(text, name, options.length_unit, problems), options, problems, before);
}

PointCloud read_cloud(std::string const& path, CloudOptions const& options, std::vector<std::string>& problems) {
  std::size_t const before = problems.size();
  switch (cloud_format(path)) {
    case CloudFormat::hdf5: return checked_cloud(read_cloud_hdf5(path, options, problems), options, problems, before);
    case CloudFormat::other:
      problems.push_back(path +
                         ": is of a kind that cannot be read as points (expected CSV, HDF5 or a frame) - convert it to "
                         "CSV with a header such as \"x [mm],y [mm],z [mm]\"");
      return {};
    case CloudFormat::table: break;
  }
  if (!options.group.empty())
    problems.push_back(path +
                       ": is a table, which has no groups to choose from, and the case gives one - leave it out");
  try {
    return read_cloud_text(read_text_file(path), path, options, problems);
  } catch (FileError const& error) {
    problems.emplace_back(error.what());
    return {};
  }
}

}  // namespace piola
