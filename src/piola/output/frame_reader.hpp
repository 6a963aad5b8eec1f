// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace piola {

/// Reads one frame part by part, in single precision as stored; for callers that need several fields or only a part of
/// it in memory. The seal is checked once. All members throw FileError if the file is damaged.
class FrameReader {
 public:
  explicit FrameReader(std::filesystem::path const& path);
  FrameReader(FrameReader&&) noexcept;
  FrameReader& operator=(FrameReader&&) noexcept;
  ~FrameReader();
  double time() const { return time_; }         ///< s
  int dimension() const { return dimension_; }  ///< 2 or 3 (1 for bars)
  std::vector<float> points() const;            ///< m, three per particle
  std::vector<std::string> fields() const;      ///< names of what is stored, sorted
  /// Whether a field is stored, or follows from one that is.
  bool knows(std::string const& field) const;
  FieldInfo info(std::string const& field) const;
  /// values[i * components + c], SI
  std::vector<float> values(std::string const& field) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
  double time_ = 0;
  int dimension_ = 3;
};

}  // namespace piola
