// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/report/frame_content.hpp"
#include "piola/report/run_folder.hpp"
#include "piola/report/survey.hpp"
#include "piola/simulation/verify.hpp"
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace piola::report {

using Json = nlohmann::ordered_json;

/// All that a page says in words and numbers, as the script of the page reads it (web/): title, outcome, summary,
/// warnings, failure, case, log.
Json about_run(RunFolder const& run);

/// What the script needs to show the frames: coding, times, fields with their ranges, bodies, rigid shapes.
Json about_frames(RunFolder const& run, Survey const& survey, Plan const& plan, Shaping const& shaping = {});

/// Plots of the history: the energies as a ledger, what quantities look at, probes, other columns of parts; at most
/// `most`; `left` counts the columns without one. Empty if there is no history yet.
Json about_plots(RunFolder const& run, std::size_t most, std::size_t& left);

/// The last pictures of the run, up to so many bytes.
Json about_pictures(RunFolder const& run, std::uintmax_t most_bytes);

Json about_rows(std::vector<VerificationRow> const& rows);

/// JSON as text that may stand inside a script element: no end tag can arise.
std::string script_text(Json const& json);

}  // namespace piola::report
