// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/report/frame_content.hpp"
#include "piola/report/frame_statistics.hpp"
#include "piola/report/run_folder.hpp"
#include "piola/verification/verify.hpp"
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace piola::report {

using Json = nlohmann::ordered_json;

/// Texts and numbers of a page, in the format of its script (web/): title, outcome, summary, warnings, failure, case,
/// log.
Json about_run(RunFolder const& run);

/// Data for the script to show the frames: coding, times, fields with their ranges, bodies, rigid shapes.
Json about_frames(RunFolder const& run, FrameStatistics const& statistics, Plan const& plan,
                  SurfaceData const& surface_data = {});

/// Plots of the history: energies as a ledger, columns used by quantities, probes, other columns of parts; at most
/// `most`. `left`: number of columns without a plot. Empty if there is no history yet.
Json about_plots(RunFolder const& run, std::size_t most, std::size_t& left);

/// The last pictures of the run, at most `most_bytes` bytes in total.
Json about_pictures(RunFolder const& run, std::uintmax_t most_bytes);

Json about_rows(std::vector<VerificationRow> const& rows);

/// JSON as text that is safe inside a script element: it cannot contain an end tag.
std::string script_text(Json const& json);

}  // namespace piola::report
