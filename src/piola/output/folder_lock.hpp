// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>

namespace piola {

/// Exclusive write access to a results folder: an flock on the file "lock" in it, which names the process. The system
/// releases the lock when the process ends for any reason, so the file of a killed run does not block later runs.
class FolderLock {
 public:
  /// Throws InputError if another process (or another lock of this one) has the folder, FileError if the file cannot be
  /// written.
  explicit FolderLock(std::filesystem::path const& folder);
  FolderLock(FolderLock const&) = delete;
  FolderLock& operator=(FolderLock const&) = delete;
  ~FolderLock();
  /// False if the file system does not support locks; the folder is then unprotected.
  bool held() const { return held_; }

 private:
  bool take();
  std::filesystem::path file_;
  int descriptor_ = -1;
  bool held_ = false;
};

/// Name of the file inside the folder.
inline constexpr char const* lock_name = "lock";

}  // namespace piola
