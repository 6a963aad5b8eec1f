// SPDX-License-Identifier: Apache-2.0
#include "piola/output/frame_reader.hpp"
#include "piola/formulations/derived_fields.hpp"
#include "piola/formulations/renamed_outputs.hpp"
#include "piola/output/hdf5.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola {
namespace {

constexpr char const* all_data = "/VTKHDF/PointData";

std::string data_of(hdf5::Reader const& file, std::string const& field) {
  return fmt::format("{}/{}", all_data, stored_output_name(field, file.names(all_data)));
}

}  // namespace

struct FrameReader::File {
  hdf5::Reader reader;
};

FrameReader::FrameReader(std::filesystem::path const& path) : file_(new File{hdf5::Reader(path)}) {
  auto const time = file_->reader.dataset<double>("/VTKHDF/FieldData/TimeValue");
  if (time.size() != 1) file_->reader.fail("TimeValue", "is not a single time");
  time_ = time.front();
  std::int64_t const dimension = file_->reader.integer("/", "dimension");
  if (dimension < 1 || dimension > 3) file_->reader.fail("dimension", "is not 1, 2 or 3");
  dimension_ = static_cast<int>(dimension);
}
FrameReader::FrameReader(FrameReader&&) noexcept = default;
FrameReader& FrameReader::operator=(FrameReader&&) noexcept = default;
FrameReader::~FrameReader() = default;

std::vector<float> FrameReader::points() const { return file_->reader.dataset<float>("/VTKHDF/Points", 3); }

std::vector<std::string> FrameReader::fields() const {
  auto names = file_->reader.names(all_data);
  for (std::string& name : names) name = current_output_name(name);
  std::sort(names.begin(), names.end());
  return names;
}

bool FrameReader::knows(std::string const& field) const { return !stored_field(field, fields()).empty(); }

FieldInfo FrameReader::info(std::string const& field) const {
  if (stored_field(field, fields()) != field)
    if (DerivedField const* const made = find_derived(field))
      return {field, std::string(made->unit), components_of(*made)};
  std::uint64_t const columns = file_->reader.columns(data_of(file_->reader, field));
  if (columns != 1 && columns != 3 && columns != 6 && columns != 9)
    file_->reader.fail(field, fmt::format("has {} components (1, 3, 6 or 9 are known)", columns));
  bool const plain = field == "Volume";  // written without a unit
  return {field, plain ? "" : file_->reader.text(data_of(file_->reader, field), "unit"), static_cast<int>(columns)};
}

std::vector<float> FrameReader::values(std::string const& field) const {
  std::string const stored = stored_field(field, fields());
  if (DerivedField const* const made = find_derived(field); made != nullptr && stored == made->from) {
    auto const from = file_->reader.dataset<double>(data_of(file_->reader, stored),
                                                    file_->reader.columns(data_of(file_->reader, stored)));
    std::vector<double> out(points().size() / 3 * static_cast<std::size_t>(components_of(*made)));
    derive(*made, from, out);
    return {out.begin(), out.end()};
  }
  return file_->reader.dataset<float>(data_of(file_->reader, field),
                                      file_->reader.columns(data_of(file_->reader, field)));
}

}  // namespace piola
