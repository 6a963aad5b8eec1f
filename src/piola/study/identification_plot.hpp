// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/plot.hpp"
#include <filesystem>

namespace piola {

/// Path of curves.csv in the folder that `piola identify` wrote to; empty if the folder has none.
std::filesystem::path identified_curves_at(std::filesystem::path const& folder);

/// Plots measured curves as rings, those of the runs with the start values as broken lines, with the values found as
/// whole lines. The columns of the file are: name of the curve, x, measured y, y at the start, fitted y; the titles of
/// x and measured y name the axes. Throws InputError for another table, FileError if the file cannot be read.
Plot identification_plot(std::filesystem::path const& table, bool log_x, bool log_y);

}  // namespace piola
