// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/atomic_file.hpp"
#include "piola/report/page_json.hpp"
#include <filesystem>
#include <string_view>

namespace piola::report {

/// A page that is written piece by piece to "PATH.part" and renamed when it is complete. The page is self-contained and
/// may not fetch anything (Content-Security-Policy). Texts of a case occur in JSON only, or escaped. All members throw
/// FileError; a previous page is then kept.
class PageFile {
 public:
  PageFile(std::filesystem::path path, std::string const& title);
  PageFile(PageFile const&) = delete;
  PageFile& operator=(PageFile const&) = delete;
  ~PageFile();
  /// A script element that is data: `name` by which the page's script finds it.
  void data(std::string const& name, std::string_view text, bool json = false);
  /// Everything that is left; the file gets its name.
  void finish();
  double size() const { return size_; }  ///< bytes so far

 private:
  void put(std::string_view text);
  [[noreturn]] void fail();
  std::filesystem::path path_, part_;
  ResultFile file_;
  double size_ = 0;
};

/// Throws InputError unless the file name is NAME.html, so that no case or table is overwritten by mistake.
void require_page_name(std::filesystem::path const& path);

/// &, <, > and quotes as what HTML shows so.
std::string escaped(std::string_view text);

}  // namespace piola::report
