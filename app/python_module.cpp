// SPDX-License-Identifier: Apache-2.0
#include "python_module.hpp"
#include "piola/base/errors.hpp"
#include <array>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <unistd.h>

namespace piola::app {
namespace {

std::filesystem::path own_path() {
  std::array<char, PATH_MAX> program{};
  ::ssize_t const length = ::readlink("/proc/self/exe", program.data(), program.size() - 1);
  return length > 0 ? program.data() : "";
}

/// Beside the program in a build folder, below share where it is installed.
std::filesystem::path start_of(std::string const& module) {
  std::filesystem::path const folder = own_path().parent_path();
  std::error_code ignored;
  for (char const* const place : {"python", "../share/piola/python"}) {
    auto found = folder / place / module / "__main__.py";
    if (std::filesystem::exists(found, ignored)) return found;
  }
  throw InputError("the Python module " + module + " is neither in " + (folder / "python").string() + " nor in " +
                   (folder / "../share/piola/python").lexically_normal().string() + " - install Piola again");
}

/// The Python for which the distribution installs its packages, unless the variable PIOLA_PYTHON names another one.
std::string interpreter() {
  char const* const named = std::getenv("PIOLA_PYTHON");
  if (named != nullptr && *named != '\0') return named;
  return ::access("/usr/bin/python3", X_OK) == 0 ? "/usr/bin/python3" : "python3";
}

}  // namespace

int continue_in_python(std::string const& module, std::vector<std::string> const& arguments,
                       std::string const& packages) {
  std::vector<std::string> words{interpreter(), "-B", start_of(module).string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::setenv("PIOLA_PROGRAM", own_path().c_str(), 1);  // for modules that start runs
  ::execvp(pointers[0], pointers.data());
  throw InputError("this command needs Python, and " + words[0] + " cannot be started (" + std::strerror(errno) +
                   ") - install the packages " + packages);
}

}  // namespace piola::app
