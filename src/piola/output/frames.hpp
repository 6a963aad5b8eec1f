// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/collective_table_writer.hpp"
#include "piola/output/field_cache.hpp"
#include "piola/output/frame_index.hpp"
#include <filesystem>
#include <string>
#include <vector>

namespace piola {

/// The tables of one frame, in single precision except for integers. With distributed particles, every rank writes
/// those of its local particles.
class FrameContent {
 public:
  /// `fields` empty: every field of the formulation; unknown names are skipped. `cache`: fields of the local particles.
  /// Both must outlive this object.
  FrameContent(std::vector<std::string> const& fields, bool compress, FieldCache& cache);
  /// Collective. Throws as CollectiveTableWriter::end().
  void put(CollectiveTableWriter& rows);
  /// Writes attributes that describe the tables. On rank 0, after put().
  void describe(hdf5::Writer& file) const;

 private:
  DistributedRows rows_of(int columns) const;  ///< of particles
  void put_cells(CollectiveTableWriter& rows) const;
  void put_field(CollectiveTableWriter& rows, FieldInfo const& info);
  FieldCache& cache_;
  std::vector<FieldInfo> chosen_;
  std::vector<Index> places_;  ///< of the particles that this rank owns
  hdf5::Storage storage_;
};

/// Frames as ParaView 5.11 opens them: one HDF5 file per frame in VTKHDF 1.0 layout, frames/000000.hdf and so on,
/// with an index over all frames that grows with each, frames.hdf.series.
class FrameWriter {
 public:
  /// `fields` empty: every field of the formulation. Names that the formulation does not have are left out.
  FrameWriter(std::filesystem::path folder, std::vector<std::string> fields, bool compress);
  /// Changes the fields of the next frames.
  void set_fields(std::vector<std::string> fields) { fields_ = std::move(fields); }
  /// Writes the next frame and its line in the index; earlier frames stay as they are. `cache`: of the particles that
  /// this rank owns. Collective. Throws FileError, on several ranks comm::CollectiveError on all.
  void write(double time, FieldCache& cache);
  /// Times of the frames written so far [s].
  std::vector<double> const& times() const { return times_; }
  /// Continues after the frames with these times; later files on the disk are removed. Returns the names of frames that
  /// should be there and are not, on rank 0. Collective.
  std::vector<std::string> continue_after(std::vector<double> times);
  /// The frames and their index, but for frames that were missing when they were continued.
  std::vector<std::filesystem::path> files() const;

 private:
  void begin(hdf5::Writer& file, double time, FieldCache const& cache) const;
  void write_index();
  std::filesystem::path folder_;
  std::vector<std::string> fields_;
  bool compress_;
  std::vector<double> times_;
  std::vector<std::string> missing_;  ///< names of frames, sorted
  FrameIndex index_;
};

/// Data set with the poses of free or rotating rigid shapes, see FrameReader::rigid_poses().
inline constexpr char const* rigid_poses_name = "/VTKHDF/FieldData/RigidPoses";

/// Path of frame `number` inside a results folder, "frames/000012.hdf".
std::string frame_name(std::size_t number);

/// Frame files and times of a results folder, in order of time, from frames.hdf.series. Throws FileError.
std::vector<std::pair<double, std::filesystem::path>> list_frames(std::filesystem::path const& folder);

}  // namespace piola
