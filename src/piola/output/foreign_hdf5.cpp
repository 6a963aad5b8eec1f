// SPDX-License-Identifier: Apache-2.0
#include "piola/output/foreign_hdf5.hpp"
#include "piola/base/byte_stream.hpp"
#include "piola/base/child_process.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/output/hdf5.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace piola {
namespace {

constexpr std::uint64_t most_columns = 3;  // of a table of places

bool is_called_places(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  constexpr std::array<std::string_view, 6> names{"points", "positions", "position", "coordinates", "xyz", "x"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Result of the child process, in lists that can be serialised.
struct FoundColumns {
  std::vector<std::string> names, units, others, problems;
  std::vector<std::vector<double>> values;
};

class ColumnSearch {
 public:
  ColumnSearch(std::filesystem::path const& path, std::string const& group)
      : reader_(hdf5::Reader::unsealed(path)), group_(group) {}

  FoundColumns operator()() {
    if (group_ != "/" && !reader_.has(group_)) {
      found_.problems.push_back(fmt::format("has no group {} (it has {}) - correct the group", in_quotes(group_),
                                            in_quotes(joined(reader_.names("/")))));
      return std::move(found_);
    }
    for (std::string const& name : reader_.names(group_)) take(name);
    return std::move(found_);
  }

 private:
  void take(std::string const& name) {
    std::string const path = group_ == "/" ? name : group_ + "/" + name;
    auto const shape = reader_.shape_of_numbers(path);
    if (shape.size() == 1)
      put(name, path, reader_.dataset<double>(path));
    else if (shape.size() == 2 && shape[1] > 1 && shape[1] <= most_columns && is_called_places(name))
      split(path, shape[1]);
    else
      found_.others.push_back(name);
  }

  void split(std::string const& path, std::uint64_t columns) {
    auto const all = reader_.dataset<double>(path, columns);
    for (std::uint64_t c = 0; c < columns; ++c) {
      std::vector<double> values(all.size() / columns);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = all[i * columns + c];
      put(std::string(1, static_cast<char>('x' + c)), path, std::move(values));
    }
  }
  void put(std::string const& name, std::string const& path, std::vector<double> values) {
    found_.names.push_back(name);
    found_.units.push_back(unit_of(path));
    found_.values.push_back(std::move(values));
  }
  std::string unit_of(std::string const& path) const {
    for (char const* const name : {"unit", "units"})
      if (reader_.has_attribute(path, name)) return reader_.text(path, name);
    return {};
  }

  hdf5::Reader reader_;
  std::string group_;
  FoundColumns found_;
};

std::string packed_columns(std::filesystem::path const& path, std::string const& group) {
  FoundColumns found;
  try {
    found = ColumnSearch(path, group)();
  } catch (FileError const& error) {
    found = {};
    found.problems.emplace_back(std::string_view(error.what()).substr(path.string().size() + 2));
  }
  ByteWriter all;
  all.put(found.problems);
  all.put(found.names);
  all.put(found.units);
  all.put(found.others);
  for (auto const& values : found.values) all.put(values);
  return all.take();
}

}  // namespace

DataColumns read_data_columns(std::filesystem::path const& path, std::string const& group) {
  std::error_code error;
  auto const bytes = std::filesystem::is_regular_file(path, error) ? std::filesystem::file_size(path, error) : 0;
  if (error || bytes == 0)
    throw FileError(fmt::format("{}: cannot be read - it is missing, empty or not a file", path.string()));
  constexpr double time_limit = 30, per_byte = 1e-6;
  ChildLimits const limits{time_limit + per_byte * static_cast<double>(bytes), std::size_t{2'000'000'000} + 60 * bytes};
  ChildAnswer answer = run_in_child_process([&] { return packed_columns(path, group); }, limits);
  ByteReader all(answer.bytes);
  std::vector<std::string> problems, names, units;
  DataColumns found;
  bool good = answer.trouble.empty() && all.take(problems) && all.take(names) && all.take(units) &&
              all.take(found.others) && names.size() == units.size();
  for (std::size_t k = 0; good && k < names.size(); ++k) {
    found.columns.push_back({names[k], units[k], {}});
    good = all.take(found.columns.back().values);
  }
  if (!good)
    throw FileError(fmt::format("{}: is damaged or no HDF5 file (the reader {}) - write it again", path.string(),
                                answer.trouble.empty() ? "answered nonsense" : answer.trouble));
  if (!problems.empty()) throw FileError(fmt::format("{}: {}", path.string(), problems.front()));
  return found;
}

}  // namespace piola
