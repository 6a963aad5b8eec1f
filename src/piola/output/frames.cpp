// SPDX-License-Identifier: Apache-2.0
#include "piola/output/frames.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/error_agreement.hpp"
#include "piola/formulations/derived_fields.hpp"
#include "piola/formulations/field_signs.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/output/hdf5.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <optional>

namespace piola {
namespace {

using hdf5::Storage;

constexpr char const* index_name = "frames.hdf.series";

std::vector<float> to_float(std::span<double const> values) {
  std::vector<float> out(values.size());
  std::transform(values.begin(), values.end(), out.begin(), [](double v) { return static_cast<float>(v); });
  return out;
}

bool is_integer(std::string_view field) { return field == "Body" || field == "Id"; }

/// Rows of [0, count) that this rank computes, for tables whose rows follow from their index alone.
std::vector<Index> own_rows(Index count) {
  std::int64_t const n = comm::size(), rank = comm::rank();
  auto const first = static_cast<Index>(count * rank / n), last = static_cast<Index>(count * (rank + 1) / n);
  std::vector<Index> rows(static_cast<std::size_t>(last - first));
  std::iota(rows.begin(), rows.end(), first);
  return rows;
}

std::string path_of(std::string const& field) { return "/VTKHDF/PointData/" + field; }

/// Sets of tables of a frame whose rows have the same distribution over ranks.
enum Set : int { of_particles, of_cells, of_offsets };

}  // namespace

std::string frame_name(std::size_t number) { return fmt::format("frames/{:06}.hdf", number); }

FrameWriter::FrameWriter(std::filesystem::path folder, std::vector<std::string> fields, bool compress)
    : folder_(std::move(folder)), fields_(std::move(fields)), compress_(compress), index_(folder_ / index_name) {}

FrameContent::FrameContent(std::vector<std::string> const& fields, bool compress, FieldCache& cache)
    : cache_(cache), storage_(compress ? Storage::compressed : Storage::contiguous) {
  for (FieldInfo const& info : cache.fields()) {
    bool const always = info.name == "Id" || info.name == "Body";
    bool const asked = std::find(fields.begin(), fields.end(), info.name) != fields.end();
    bool const wanted = fields.empty() ? !is_derived(info.name) : asked;  // derived fields only on request
    if (info.name != "Position" && (always || wanted)) chosen_.push_back(info);
  }
  if (cache.local_particles()) places_.assign(cache.local_particles()->begin(), cache.local_particles()->end());
}

/// Every particle is one cell of type VTK_VERTEX.
void FrameContent::put_cells(CollectiveTableWriter& rows) const {
  auto const n = static_cast<Index>(cache_.particles().size());
  auto const whole = [](std::vector<Index> const& of) { return std::vector<std::int64_t>(of.begin(), of.end()); };
  std::vector<Index> const cells = own_rows(n), offsets = own_rows(n + 1);
  constexpr std::uint8_t vtk_vertex = 1;
  std::vector<std::uint8_t> const types(cells.size(), vtk_vertex);
  auto const table = [](Set set, Index count, std::vector<Index> const& own) {
    DistributedRows of{set, count};
    if (comm::is_parallel()) of.places = own;
    return of;
  };
  rows.put<std::int64_t>("/VTKHDF/Connectivity", table(of_cells, n, cells), whole(cells), storage_);
  rows.put<std::int64_t>("/VTKHDF/Offsets", table(of_offsets, n + 1, offsets), whole(offsets), storage_);
  rows.put<std::uint8_t>("/VTKHDF/Types", table(of_cells, n, cells), types, storage_);
}

DistributedRows FrameContent::rows_of(int columns) const {
  DistributedRows rows{of_particles, static_cast<Index>(cache_.particles().size()), std::nullopt, columns};
  if (cache_.local_particles()) rows.places = places_;
  return rows;
}

void FrameContent::put_field(CollectiveTableWriter& rows, FieldInfo const& info) {
  std::span<double const> const values = cache_.values(info.name);
  DistributedRows const table = rows_of(info.components);
  if (is_integer(info.name)) {  // a float would lose ids above 16 million
    std::vector<std::int64_t> const whole(values.begin(), values.end());
    rows.put<std::int64_t>(path_of(info.name), table, whole, storage_);
  } else {
    rows.put<float>(path_of(info.name), table, to_float(values), storage_);
  }
}

void FrameContent::put(CollectiveTableWriter& rows) {
  rows.put<float>("/VTKHDF/Points", rows_of(3), to_float(cache_.values("Position")), storage_);
  put_cells(rows);
  for (FieldInfo const& info : chosen_) put_field(rows, info);
  auto const& volume = cache_.particles().volume;
  std::vector<float> own;
  if (cache_.local_particles())
    for (Index const id : places_) own.push_back(static_cast<float>(volume[static_cast<std::size_t>(id)]));
  else
    own = to_float(volume);
  rows.put<float>(path_of("Volume"), rows_of(1), own, storage_);
  rows.end();
}

void FrameContent::describe(hdf5::Writer& file) const {
  for (FieldInfo const& info : chosen_) {
    file.attribute(path_of(info.name), "unit", info.unit);
    int const first_normal = info.components > 1 ? 0 : whole_field;
    if (auto const sign = sign_of(info.name, first_normal); !sign.empty())
      file.attribute(path_of(info.name), "sign", sign);
  }
}

/// Writes all but the tables of particles.
void FrameWriter::begin(hdf5::Writer& file, double time, FieldCache const& cache) const {
  file.group("/VTKHDF/PointData");
  file.group("/VTKHDF/CellData");
  file.group("/VTKHDF/FieldData");
  file.attribute("/", "dimension", std::array<std::int64_t, 1>{cache.particles().dimension});
  if (cache.particles().axisymmetric) file.attribute("/", "axisymmetric", std::array<std::int64_t, 1>{1});
  file.attribute("/VTKHDF", "Version", std::array<std::int64_t, 2>{1, 0});
  file.attribute("/VTKHDF", "Type", std::string_view("UnstructuredGrid"));
  for (char const* count : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"})
    file.dataset<std::int64_t>(fmt::format("/VTKHDF/{}", count), std::array{cache.particles().size()});
  file.dataset<double>("/VTKHDF/FieldData/TimeValue", std::array{time});
  std::vector<double> poses;
  for (RigidState const& rigid : cache.observables().rigids())
    for (auto const& part : {rigid.centre, rigid.turn}) poses.insert(poses.end(), part.begin(), part.end());
  if (!poses.empty()) file.dataset<double>(rigid_poses_name, poses, 6);
}

void FrameWriter::write(double time, FieldCache& cache) {
  PIOLA_EXPECTS(std::isfinite(time));
  std::optional<hdf5::Writer> file;  // on rank 0
  comm::on_root([&] {
    make_folder(folder_ / "frames");
    file.emplace(folder_ / frame_name(times_.size()));
    begin(*file, time, cache);
  });
  FrameContent content(fields_, compress_, cache);
  CollectiveTableWriter rows(file ? &*file : nullptr);
  content.put(rows);
  comm::on_root([&] {
    content.describe(*file);
    file->finish();
  });
  times_.push_back(time);
  comm::on_root([&] {
    if (times_.size() == 1 || !index_.add({time, frame_name(times_.size() - 1)})) write_index();
  });
}

void FrameWriter::write_index() {
  std::vector<FrameIndex::Entry> entries;
  for (std::size_t k = 0; k < times_.size(); ++k) entries.emplace_back(times_[k], frame_name(k));
  index_.write(entries);
}

std::vector<std::string> FrameWriter::continue_after(std::vector<double> times) {
  times_ = std::move(times);
  missing_.clear();
  comm::on_root([&] {
    std::error_code ignored;
    for (std::size_t k = times_.size(); std::filesystem::remove(folder_ / frame_name(k), ignored); ++k) {
    }
    for (std::size_t k = 0; k < times_.size(); ++k) {
      if (!std::filesystem::exists(folder_ / frame_name(k), ignored)) missing_.push_back(frame_name(k));
    }
    if (!times_.empty()) write_index();
  });
  return missing_;
}

std::vector<std::filesystem::path> FrameWriter::files() const {
  std::vector<std::filesystem::path> list;
  if (!times_.empty()) list.push_back(folder_ / index_name);
  for (std::size_t k = 0; k < times_.size(); ++k)
    if (!std::binary_search(missing_.begin(), missing_.end(), frame_name(k))) list.push_back(folder_ / frame_name(k));
  return list;
}

std::vector<std::pair<double, std::filesystem::path>> list_frames(std::filesystem::path const& folder) {
  std::vector<std::pair<double, std::filesystem::path>> frames;
  for (auto const& [time, name] : read_frame_index(folder / index_name)) frames.emplace_back(time, folder / name);
  return frames;
}

}  // namespace piola
