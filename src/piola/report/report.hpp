// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/verification/verify.hpp"
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace piola::report {

struct ReportOptions {
  std::vector<std::string> fields = {};  ///< empty: usual_fields()
  std::size_t frames = 0;                ///< largest number, evenly chosen; 0: as many as fit
  int bits = 14;                         ///< of a coordinate
  double budget = 30e6;                  ///< bytes of the page
  std::filesystem::path checks = {};     ///< a checks.toml; empty: the one in the folder, if there is one
  std::string variant = {};              ///< of it; empty: the one that the case in the folder is
  int reload = 0;        ///< [s] after which the page checks for a newer one while the run continues; 0: never
  bool surface = false;  ///< skins of bodies in place of their particles
  std::vector<VerificationRow> rows = {};  ///< shown in addition to those of `checks`
};

struct ReportResult {
  double bytes = 0;
  std::size_t frames = 0;
  std::string status = {};              ///< of the run: "running" as long as it goes on
  std::vector<std::string> notes = {};  ///< what is left out, and why
};

/// Writes one self-contained HTML page that shows a run: particles in space over time, plots, tables (web/). Same
/// files, same bytes. Throws InputError (no run, no such field, check or variant, no surface), FileError.
ReportResult write_report(std::filesystem::path const& folder, std::filesystem::path const& page,
                          ReportOptions const& options);

}  // namespace piola::report
