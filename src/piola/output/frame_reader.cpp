// SPDX-License-Identifier: Apache-2.0
#include "piola/output/frame_reader.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/formulations/derived_fields.hpp"
#include "piola/formulations/renamed_outputs.hpp"
#include "piola/output/frames.hpp"
#include "piola/output/hdf5.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace piola {
namespace {

constexpr char const* all_data = "/VTKHDF/PointData";

}  // namespace

struct FrameReader::File {
  hdf5::Reader reader;
  std::vector<std::string> names = {};  ///< of the stored fields, as in the file; listed at the first use

  std::vector<std::string> const& stored_names() {
    if (names.empty()) names = reader.names(all_data);
    return names;
  }
  std::string data_of(std::string const& field) {
    return fmt::format("{}/{}", all_data, stored_output_name(field, stored_names()));
  }
  std::uint64_t components_in(std::string const& field) {
    std::uint64_t const columns = reader.columns(data_of(field));
    if (columns != 1 && columns != 3 && columns != 6 && columns != 9)
      reader.fail(field, fmt::format("has {} components (1, 3, 6 or 9 are known)", columns));
    return columns;
  }
};

FrameReader::FrameReader(std::filesystem::path const& path) : file_(new File{hdf5::Reader(path)}) {
  auto const time = file_->reader.dataset<double>("/VTKHDF/FieldData/TimeValue");
  if (time.size() != 1) file_->reader.fail("TimeValue", "is not a single time");
  time_ = time.front();
  std::int64_t const dimension = file_->reader.integer("/", "dimension");
  if (dimension < 1 || dimension > 3)
    file_->reader.fail("dimension", fmt::format("is {} (1, 2 or 3 is known)", dimension));
  dimension_ = static_cast<int>(dimension);
  axisymmetric_ = dimension == 2 && file_->reader.has_attribute("/", "axisymmetric") &&
                  file_->reader.integer("/", "axisymmetric") != 0;
  auto const shape = file_->reader.shape_of_numbers("/VTKHDF/Points");
  if (shape.size() != 2 || shape[1] != 3) file_->reader.fail("/VTKHDF/Points", "has not 3 numbers per row");
  particles_ = shape[0];
}
FrameReader::FrameReader(FrameReader&&) noexcept = default;
FrameReader& FrameReader::operator=(FrameReader&&) noexcept = default;
FrameReader::~FrameReader() = default;

std::vector<float> FrameReader::points() const { return file_->reader.dataset<float>("/VTKHDF/Points", 3); }

std::vector<std::array<double, 3>> FrameReader::positions() const {
  auto const all = points();
  std::vector<std::array<double, 3>> x(particles_);
  for (std::size_t i = 0; i < all.size(); ++i) x[i / 3][i % 3] = static_cast<double>(all[i]);
  return x;
}

std::vector<int> FrameReader::bodies() const { return rows<std::int32_t>("Body", 1); }

std::vector<float> FrameReader::volumes() const { return rows<float>(source_of("Volume"), 1); }

std::vector<double> FrameReader::rigid_poses() const {
  return file_->reader.has(rigid_poses_name) ? file_->reader.dataset<double>(rigid_poses_name, 6)
                                             : std::vector<double>();
}

std::vector<std::string> FrameReader::fields() const {
  auto names = file_->stored_names();
  for (std::string& name : names) name = current_output_name(name);
  std::sort(names.begin(), names.end());
  return names;
}

bool FrameReader::knows(std::string const& field) const { return !stored_field(field, fields()).empty(); }

/// The stored field from which a field is read or computed.
std::string FrameReader::source_of(std::string const& field) const {
  auto const names = fields();
  std::string stored = stored_field(field, names);
  if (stored.empty())
    throw InputError(fmt::format("{}: the frame has no field '{}' (it has {}) - {}", file_->reader.path().string(),
                                 field, fmt::join(names, ", "), advice_for_name(field, names)));
  return stored;
}

template <class T>
std::vector<T> FrameReader::rows(std::string const& field, std::uint64_t columns) const {
  auto values = file_->reader.dataset<T>(file_->data_of(field), columns);
  if (values.size() != particles_ * columns) file_->reader.fail(field, "has not one value per point");
  return values;
}

FieldInfo FrameReader::info(std::string const& field) const {
  if (source_of(field) != field) {
    DerivedField const& derived = *find_derived(field);
    return {field, std::string(derived.unit), components_of(derived)};
  }
  bool const plain = field == "Volume";  // written without a unit
  return {field, plain ? "" : file_->reader.text(file_->data_of(field), "unit"),
          static_cast<int>(file_->components_in(field))};
}

std::vector<float> FrameReader::values(std::string const& field) const {
  std::string const source = source_of(field);
  std::uint64_t const columns = file_->components_in(source);
  if (source == field) return rows<float>(field, columns);
  DerivedField const& derived = *find_derived(field);
  auto const from = rows<double>(source, columns);
  std::vector<double> out(particles_ * static_cast<std::size_t>(components_of(derived)));
  derive(derived, from, out);
  return {out.begin(), out.end()};
}

}  // namespace piola
