// SPDX-License-Identifier: Apache-2.0
#include "piola/observers/run_log.hpp"
#include "piola/base/controls.hpp"
#include "piola/base/errors.hpp"
#include <cerrno>
#include <cstdio>
#include <utility>

namespace piola {

void RunLog::write(std::string const& line, Opening how) {
  if (file_.empty()) return;
  std::error_code error;
  // The log of a run that is resumed may have been removed; one that this run began may not.
  if (!std::exchange(begun_, true) && !std::filesystem::exists(std::filesystem::symlink_status(file_, error)))
    how = Opening::replace;
  ResultFile const file = open_result_file(file_, how);
  std::string const text = without_controls(line) + "\n";
  bool const good =
      file && std::fwrite(text.data(), 1, text.size(), file.get()) == text.size() && std::fflush(file.get()) == 0;
  if (!good) throw FileError(write_error_text(file_, errno));
}

void RunLog::start(std::string const& first_line) { write(first_line, Opening::replace); }

void RunLog::note(std::string const& line) { write(line, Opening::append); }

void RunLog::report(std::string const& text) {
  note("warning: " + text);
  listener_.warning(text);
}

void RunLog::warn(std::string const& text) {
  if (!known_.insert(text).second) return;
  warnings_.push_back(text);
  note("warning: " + text);
  listener_.warning(text);
}

}  // namespace piola
