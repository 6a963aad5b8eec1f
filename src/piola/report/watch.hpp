// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/report/run_folder.hpp"
#include <filesystem>
#include <string>
#include <vector>

namespace piola::report {

/// State of a run as lines for a terminal: energies as fractions of the largest total, a column over time in one line,
/// and the last row of the history. Reads all files again at each call, so the run may be on another machine.
class Watch {
 public:
  struct Look {
    std::string text;
    bool over = false;  ///< the run has ended
  };
  /// `column` is drawn over time. Throws InputError if the folder holds no run, FileError.
  Watch(std::filesystem::path const& folder, std::string column) : run_(open_run(folder)), column_(std::move(column)) {}
  /// Lines of at most `width` characters. Throws InputError if the history has no such column, FileError.
  Look look(std::size_t width);

 private:
  RunFolder run_;
  std::string column_;
};

/// Values over x in one line of block characters, lowest to highest; blank where there is none.
std::string line_plot(std::vector<double> const& x, std::vector<double> const& y, std::size_t width);

}  // namespace piola::report
