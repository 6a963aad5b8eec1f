// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace piola::report {

/// Content of the folder of a run, as far as present: a running one has no summary yet.
struct RunFolder {
  std::filesystem::path path;
  std::string title = {};   ///< of the case; the name of the folder if it is not known
  std::string status = {};  ///< "completed", "failed", "stopped", "running", or "broken off": no summary and no writing
                            ///< process
  std::string summary = {};           ///< text of summary.json; empty: none, or damaged
  std::string log = {};               ///< text of log.txt
  std::string case_text = {};         ///< text of case.toml
  std::string failure = {};           ///< why it failed; empty: it did not
  std::optional<CaseSpec> spec = {};  ///< nothing: there is no case, or it cannot be read any more
  std::vector<std::pair<double, std::filesystem::path>> frames = {};  ///< times [s] and files
};

/// Throws InputError if the folder holds no run, FileError if its files cannot be read.
RunFolder open_run(std::filesystem::path const& folder);

/// Reads title, status, summary, log, case and failure again, not the rest.
void read_texts(RunFolder& run);

/// The number of the particle that a failure names; -1 if it names none.
long failed_particle(std::string const& failure);

}  // namespace piola::report
