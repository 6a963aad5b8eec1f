// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/formulation.hpp"
#include "piola/domain/communicator.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <stdexcept>

namespace piola {

FieldInfo const& info_of(std::span<FieldInfo const> fields, std::string_view name) {
  auto const found = std::find_if(fields.begin(), fields.end(), [&](FieldInfo const& f) { return f.name == name; });
  if (found == fields.end()) throw std::invalid_argument(fmt::format("no field is called '{}'", name));
  return *found;
}

void StateWriter::put_sized(std::string_view count, std::string_view name, std::span<double const> values) {
  put(count, std::array{static_cast<double>(values.size())});
  put(name, values);
}

std::vector<double> StateReader::get_sized(std::string_view count, std::string_view name) {
  std::array<double, 1> size{};
  get(count, size);
  std::vector<double> values(static_cast<std::size_t>(size[0]));
  get(name, values);
  return values;
}

void StateWriter::put_rows(std::string_view name, DistributedRows const& rows, std::span<double const> values) {
  if (!comm::is_parallel() && !rows.places) return put(name, values);
  std::vector<double> const all = RedistributionPlan(rows, rows.count).collect(values, rows.columns);
  if (comm::rank() == 0) put(name, all);
}

void StateReader::get_rows(std::string_view name, DistributedRows const& rows, std::span<double> values) {
  if (!comm::is_parallel() && !rows.places) return get(name, values);
  std::vector<double> all(comm::rank() == 0 ? value_count(rows) : 0);
  get_on_root(name, all);
  RedistributionPlan(rows, rows.count).from_file_order<double>(all, values, rows.columns);
}

}  // namespace piola
