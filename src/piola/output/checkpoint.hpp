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

/// Named arrays of doubles in memory: what a formulation or an observer saves.
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
  std::string machine;                   ///< instruction sets used and available when it was written
  std::string source;                    ///< the case as run
  std::string particles;                 ///< particle_record of them in reference configuration
  NamedState state;                      ///< of the formulation
  std::shared_ptr<StateReader> in_file;  ///< has it in place of `state`, and reads it array by array
  NamedState observers;                  ///< next output times, twist angles, times of frames
};

/// Writes one file (whole, synced, renamed). Throws FileError. `save`: puts the state of the formulation, which is not
/// in the checkpoint then: array by array it goes into the file, so that it stands once more in memory and not twice.
void write_checkpoint(std::filesystem::path const& path, Checkpoint const& checkpoint,
                      std::function<void(StateWriter&)> const& save = {});
/// Reads one file after its seal has been verified. Throws FileError.
Checkpoint read_checkpoint(std::filesystem::path const& path);

/// checkpoints/000001234.h5 in a results folder, for this step.
std::filesystem::path checkpoint_path(std::filesystem::path const& results, std::int64_t step);
/// Checkpoint files of a results folder, newest first; that of a failed state is not among them.
std::vector<std::filesystem::path> list_checkpoints(std::filesystem::path const& results);
/// Beside the checkpoints: how long the run took up to each of them, which is all that differs between two runs of the
/// same case on the same machine, so that their checkpoints are equal byte by byte.
inline constexpr char const* durations_name = "wall_times.txt";

/// Writes the checkpoint of its step and how long the run took, and removes all but the last two.
void keep_checkpoint(std::filesystem::path const& results, Checkpoint const& checkpoint,
                     std::function<void(StateWriter&)> const& save = {});
/// Hands the newest checkpoint to `use`, with its state in_file. One that is damaged, or that `use` throws at, is
/// passed over for the one before it, with a line in `warnings`; one for which `use` returns false without a word.
/// Returns whether one was used. InputError and std::bad_alloc come through; throws InputError with the reasons if
/// there is none to choose from.
bool use_newest_checkpoint(std::filesystem::path const& results, std::vector<std::string>& warnings,
                           std::function<bool(Checkpoint&)> const& use);

/// The name of the last state of a run that failed; it is kept for study, never resumed from.
inline constexpr char const* failed_checkpoint = "checkpoints/failed.h5";

}  // namespace piola
