// SPDX-License-Identifier: Apache-2.0
#include "piola/output/frames.hpp"
#include "piola/base/problems.hpp"
#include "piola/formulations/quantity_names.hpp"
#include "piola/output/files.hpp"
#include "piola/output/hdf5.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace piola {
namespace {

using hdf5::Storage;

constexpr char const* index_name = "frames.hdf.series";

template <class T>
std::span<T const> one(T const& value) {
  return {&value, 1};
}

std::vector<float> to_float(std::span<double const> values) {
  std::vector<float> out(values.size());
  std::transform(values.begin(), values.end(), out.begin(), [](double v) { return static_cast<float>(v); });
  return out;
}

bool is_integer(std::string_view field) { return field == "Body" || field == "Id"; }

/// Every particle is one cell of type VTK_VERTEX.
void put_cells(hdf5::Writer& file, std::int64_t particles, Storage storage) {
  auto const n = static_cast<std::size_t>(particles);
  std::vector<std::int64_t> offsets(n + 1);
  for (std::size_t i = 0; i <= n; ++i) offsets[i] = static_cast<std::int64_t>(i);
  constexpr std::uint8_t vtk_vertex = 1;
  std::vector<std::uint8_t> const types(n, vtk_vertex);
  for (char const* count : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"}) {
    file.dataset<std::int64_t>(fmt::format("/VTKHDF/{}", count), one(particles));
  }
  file.dataset<std::int64_t>("/VTKHDF/Connectivity", std::span<std::int64_t const>(offsets).first(n), 1, storage);
  file.dataset<std::int64_t>("/VTKHDF/Offsets", offsets, 1, storage);
  file.dataset<std::uint8_t>("/VTKHDF/Types", types, 1, storage);
}

void put_field(hdf5::Writer& file, FieldInfo const& info, std::span<double const> values, Storage storage) {
  std::string const path = "/VTKHDF/PointData/" + info.name;
  if (is_integer(info.name)) {  // a float would lose ids above 16 million
    std::vector<std::int64_t> const whole(values.begin(), values.end());
    file.dataset<std::int64_t>(path, whole, 1, storage);
  } else {
    std::vector<float> const single = to_float(values);
    file.dataset<float>(path, single, info.components, storage);
  }
  file.attribute(path, "unit", info.unit);
}

}  // namespace

std::string frame_name(std::size_t number) { return fmt::format("frames/{:06}.hdf", number); }

FrameWriter::FrameWriter(std::filesystem::path folder, std::vector<std::string> fields, bool compress)
    : folder_(std::move(folder)), fields_(std::move(fields)), compress_(compress), index_(folder_ / index_name) {}

std::vector<FieldInfo> FrameWriter::chosen(FieldCache const& cache) const {
  std::vector<FieldInfo> list;
  for (FieldInfo const& info : cache.fields()) {
    bool const always = info.name == "Id" || info.name == "Body";
    bool const asked = std::find(fields_.begin(), fields_.end(), info.name) != fields_.end();
    bool const wanted = fields_.empty() ? !is_derived(info.name) : asked;  // what follows from others only if asked for
    if (info.name != "Position" && (always || wanted)) list.push_back(info);
  }
  return list;
}

void FrameWriter::write(double time, FieldCache& cache) {
  make_folder(folder_ / "frames");
  Storage const storage = compress_ ? Storage::compressed : Storage::contiguous;
  hdf5::Writer file(folder_ / frame_name(times_.size()));
  file.group("/VTKHDF/PointData");
  file.group("/VTKHDF/CellData");
  file.group("/VTKHDF/FieldData");
  file.attribute("/", "dimension", std::array<std::int64_t, 1>{cache.particles().dimension});
  file.attribute("/VTKHDF", "Version", std::array<std::int64_t, 2>{1, 0});
  file.attribute("/VTKHDF", "Type", std::string_view("UnstructuredGrid"));
  file.dataset<float>("/VTKHDF/Points", to_float(cache.values("Position")), 3, storage);
  put_cells(file, cache.particles().size(), storage);
  auto const fields = chosen(cache);
  for (FieldInfo const& info : fields) put_field(file, info, cache.values(info.name), storage);
  file.dataset<float>("/VTKHDF/PointData/Volume", to_float(cache.particles().volume), 1, storage);
  file.dataset<double>("/VTKHDF/FieldData/TimeValue", one(time));
  file.finish();
  times_.push_back(time);
  if (times_.size() == 1 || !index_.add({time, frame_name(times_.size() - 1)})) write_index();
}

void FrameWriter::write_index() {
  std::vector<FrameIndex::Entry> entries;
  for (std::size_t k = 0; k < times_.size(); ++k) entries.emplace_back(times_[k], frame_name(k));
  index_.write(entries);
}

std::vector<std::string> FrameWriter::continue_after(std::vector<double> times) {
  times_ = std::move(times);
  std::error_code ignored;
  for (std::size_t k = times_.size(); std::filesystem::remove(folder_ / frame_name(k), ignored); ++k) {
  }
  std::vector<std::string> missing;
  for (std::size_t k = 0; k < times_.size(); ++k) {
    if (!std::filesystem::exists(folder_ / frame_name(k), ignored)) missing.push_back(frame_name(k));
  }
  if (!times_.empty()) write_index();
  return missing;
}

namespace {

/// One field of a frame, its shape checked against what the formulations write.
void read_field(hdf5::Reader const& file, std::string const& field, Frame& frame) {
  std::string const data = "/VTKHDF/PointData/" + field;
  std::uint64_t const columns = file.columns(data);
  if (columns != 1 && columns != 3 && columns != 6 && columns != 9)
    file.fail(data, fmt::format("has {} components (1, 3, 6 or 9 are known)", columns));
  frame.info = {field, field == "Volume" ? "1" : file.text(data, "unit"), static_cast<int>(columns)};
  frame.values = file.dataset<double>(data, columns);
  if (frame.values.size() != frame.points.size() * columns) file.fail(data, "has not one value per point");
}

/// A field of one component if the frame has it.
std::vector<double> read_if_there(hdf5::Reader const& file, Frame const& frame, std::string const& field) {
  auto const& names = frame.field_names;
  if (std::find(names.begin(), names.end(), field) == names.end()) return {};
  auto values = file.dataset<double>("/VTKHDF/PointData/" + field);
  if (values.size() != frame.points.size()) file.fail(field, "has not one value per point");
  return values;
}

}  // namespace

Frame read_frame(std::filesystem::path const& path, std::string const& field) {
  hdf5::Reader const file(path);
  Frame frame;
  auto const time = file.dataset<double>("/VTKHDF/FieldData/TimeValue");
  if (time.size() != 1) file.fail("TimeValue", "is not a single time");
  frame.time = time.front();
  auto const points = file.dataset<float>("/VTKHDF/Points", 3);
  frame.points.resize(points.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i) frame.points[i / 3][i % 3] = static_cast<double>(points[i]);
  frame.field_names = file.names("/VTKHDF/PointData");
  if (std::find(frame.field_names.begin(), frame.field_names.end(), field) == frame.field_names.end()) {
    throw InputError(fmt::format("{}: the frame has no field '{}' (it has {}) - choose one of these with --field",
                                 path.string(), field, fmt::join(frame.field_names, ", ")));
  }
  read_field(file, field, frame);
  frame.volume = file.dataset<double>("/VTKHDF/PointData/Volume");
  frame.body = file.dataset<std::int32_t>("/VTKHDF/PointData/Body");
  frame.damage = read_if_there(file, frame, "Damage");
  frame.kernel_type = read_if_there(file, frame, "KernelType");
  if (frame.volume.size() != frame.points.size()) file.fail("Volume", "has not one value per point");
  if (frame.body.size() != frame.points.size()) file.fail("Body", "has not one value per point");
  std::int64_t const dimension = file.integer("/", "dimension");
  if (dimension < 1 || dimension > 3) file.fail("dimension", fmt::format("is {} (1, 2 or 3 is known)", dimension));
  frame.dimension = static_cast<int>(dimension);
  return frame;
}

std::vector<std::pair<double, std::filesystem::path>> list_frames(std::filesystem::path const& folder) {
  std::vector<std::pair<double, std::filesystem::path>> frames;
  for (auto const& [time, name] : read_frame_index(folder / index_name)) frames.emplace_back(time, folder / name);
  return frames;
}

}  // namespace piola
