// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace piola {

/// Named arrays of doubles in memory, saved by a formulation or an observer.
class NamedState : public StateWriter, public StateReader {
 public:
  void put(std::string_view name, std::span<double const> values) override;
  void get(std::string_view name, std::span<double> values) override;
  /// All values of a name, however many. Throws FileError if there is no such name.
  std::vector<double> const& all(std::string_view name) const;
  bool has(std::string_view name) const { return arrays_.find(name) != arrays_.end(); }
  std::map<std::string, std::vector<double>, std::less<>> const& arrays() const { return arrays_; }

 private:
  std::map<std::string, std::vector<double>, std::less<>> arrays_;
};

/// Everything that a run needs to continue bit for bit.
struct Checkpoint {
  double time = 0;  ///< s
  std::int64_t step = 0;
  double dt = 0;                                  ///< s, the last step
  double first_dt = 0;                            ///< s, the first stable step: the measure of a collapsed one
  double wall_seconds = 0, stepping_seconds = 0;  ///< spent so far; in a file of their own (durations_name)
  bool cut_to_end = false;                        ///< the last step has its length from the end of the run
  std::string version;                   ///< of the program that wrote it; with its build if the run has an identity
  std::string backend;                   ///< instruction sets used and available when it was written
  std::string source;                    ///< the case as run
  std::string particles;                 ///< particle_record of them in reference configuration
  NamedState state;                      ///< of the formulation
  std::shared_ptr<StateReader> in_file;  ///< source of the formulation's state in place of `state`; reads it array by
                                         ///< array
  NamedState observers;                  ///< next output times, twist angles, times of frames
};

/// Writes one file (whole, synced, renamed). Throws FileError. `save`: writes the state of the formulation array by
/// array in place of checkpoint.state, which avoids a second copy of it in memory. On several ranks, writing and using
/// a checkpoint are collective, the file is that of rank 0, and an error on a rank is comm::CollectiveError on all.
void write_checkpoint(std::filesystem::path const& path, Checkpoint const& checkpoint,
                      std::function<void(StateWriter&)> const& save = {});
/// Reads one file after its checksum trailer has been verified. Throws FileError.
Checkpoint read_checkpoint(std::filesystem::path const& path);

/// checkpoints/000001234.h5 in a results folder, for this step.
std::filesystem::path checkpoint_path(std::filesystem::path const& results, std::int64_t step);
/// Checkpoint files of a results folder, newest first; excludes that of a failed state.
std::vector<std::filesystem::path> list_checkpoints(std::filesystem::path const& results);
/// File next to the checkpoints with the wall time of the run up to each of them. Wall times alone differ between two
/// runs of a case on one machine, so the checkpoints themselves are equal byte by byte.
inline constexpr char const* durations_name = "wall_times.txt";

/// Writes a checkpoint and its wall times; removes all but the last two checkpoints. Throws FileError.
void keep_checkpoint(std::filesystem::path const& results, Checkpoint const& checkpoint,
                     std::function<void(StateWriter&)> const& save = {});
/// Calls use(checkpoint) for the newest checkpoint, with its state in `in_file`. Falls back to the previous one if the
/// file is damaged or `use` throws, with a line in `warnings`, or if `use` returns false, without a warning. Returns
/// whether one was used. InputError and std::bad_alloc of `use` propagate. Throws InputError with the reasons if no
/// checkpoint remains. The texts of the checkpoint are on rank 0 only.
bool use_newest_checkpoint(std::filesystem::path const& results, std::vector<std::string>& warnings,
                           std::function<bool(Checkpoint&)> const& use);

/// The name of the last state of a run that failed; it is kept for study, never resumed from.
inline constexpr char const* failed_checkpoint = "checkpoints/failed.h5";

}  // namespace piola
