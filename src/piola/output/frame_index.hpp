// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace piola {

/// The list of frames that ParaView opens, frames.hdf.series (JSON). A new frame costs the same however many there are:
/// its line goes over the closing brackets, together with new ones, in one write.
class FrameIndex {
 public:
  using Entry = std::pair<double, std::string>;  ///< time [s], name of the file
  explicit FrameIndex(std::filesystem::path file) : file_(std::move(file)) {}
  /// Replaces the file by one with these frames. Throws FileError.
  void write(std::vector<Entry> const& entries);
  /// Adds a frame in place. Returns false, with nothing changed, if the file was modified since the last call; use
  /// write() then. Throws FileError if it cannot be written; its previous content is then preserved.
  bool add(Entry const& entry);

 private:
  std::filesystem::path file_;
  std::uint64_t size_ = 0;  ///< bytes, as left here
};

/// Reads an index back; one that was cut off while it was written gives the frames that are whole in it. Throws
/// FileError.
std::vector<FrameIndex::Entry> read_frame_index(std::filesystem::path const& file);

}  // namespace piola
