// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace piola {

/// Reads one frame part by part. Fields are in single precision as stored. The checksum trailer is verified once. All
/// members throw FileError if the file is damaged.
class FrameReader {
 public:
  explicit FrameReader(std::filesystem::path const& path);
  FrameReader(FrameReader&&) noexcept;
  FrameReader& operator=(FrameReader&&) noexcept;
  ~FrameReader();
  double time() const { return time_; }                  ///< s
  int dimension() const { return dimension_; }           ///< 2 or 3 (1 for bars)
  bool axisymmetric() const { return axisymmetric_; }    ///< half sections, volumes are those of rings [m^3]
  std::size_t particles() const { return particles_; }   ///< number of them
  std::vector<float> points() const;                     ///< m, three per particle
  std::vector<std::array<double, 3>> positions() const;  ///< m, points() as doubles
  std::vector<int> bodies() const;                       ///< number of the body of each particle
  std::vector<float> volumes() const;                    ///< tributary volume of each particle [m^dimension]
  /// Centre [m] and rotation vector since the start [rad] of each free or rotating rigid shape, in the order of the
  /// case: six numbers each.
  std::vector<double> rigid_poses() const;
  std::vector<std::string> fields() const;  ///< names of what is stored, sorted
  /// Whether a field is stored, or follows from one that is.
  bool knows(std::string const& field) const;
  /// Throws InputError with the names that the frame has if the field is not known.
  FieldInfo info(std::string const& field) const;
  /// values[i * components + c], SI. Throws as info() does.
  std::vector<float> values(std::string const& field) const;

 private:
  std::string source_of(std::string const& field) const;
  template <class T>
  std::vector<T> rows(std::string const& field, std::uint64_t columns) const;
  struct File;
  std::unique_ptr<File> file_;
  double time_ = 0;
  int dimension_ = 3;
  bool axisymmetric_ = false;
  std::size_t particles_ = 0;
};

}  // namespace piola
