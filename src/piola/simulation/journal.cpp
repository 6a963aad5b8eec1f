// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/journal.hpp"
#include "piola/base/problems.hpp"
#include "piola/output/files.hpp"
#include <cerrno>
#include <cstdio>
#include <memory>

namespace piola {

void Journal::write(std::string const& line, char const* mode) {
  if (file_.empty()) return;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> const file(std::fopen(file_.c_str(), mode), &std::fclose);
  std::string const text = line + "\n";
  bool const good =
      file && std::fwrite(text.data(), 1, text.size(), file.get()) == text.size() && std::fflush(file.get()) == 0;
  if (!good) throw FileError(cannot_write(file_, errno));
}

void Journal::start(std::string const& first_line) { write(first_line, "w"); }

void Journal::note(std::string const& line) { write(line, "a"); }

void Journal::tell(std::string const& text) {
  note("warning: " + text);
  listener_.warning(text);
}

void Journal::warn(std::string const& text) {
  if (!known_.insert(text).second) return;
  warnings_.push_back(text);
  note("warning: " + text);
  listener_.warning(text);
}

}  // namespace piola
