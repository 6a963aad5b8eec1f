// SPDX-License-Identifier: Apache-2.0
#include "piola/report/page.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/report/page_sources.hpp"
#include <cerrno>
#include <fmt/format.h>

namespace piola::report {

std::string escaped(std::string_view text) {
  std::string out;
  for (char const c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      case '\'': out += "&#39;"; break;
      default: out += c;
    }
  }
  return out;
}

void require_page_name(std::filesystem::path const& path) {
  if (path.extension() == ".html" || path.extension() == ".htm") return;
  throw InputError(
      fmt::format("{}: is not the name of a page (allowed: names that end in .html) - choose one", path.string()));
}

PageFile::PageFile(std::filesystem::path path, std::string const& title)
    : path_(std::move(path)), part_(path_.string() + ".part"), file_(open_result_file(part_, Opening::replace)) {
  if (!file_) throw FileError(write_error_text(path_, errno));
  put("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; "
      "style-src 'unsafe-inline'; img-src data:\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>");
  put(escaped(title));
  put("</title>\n<style>\n");
  put(web::style);
  put("</style>\n</head>\n<body>\n");
  put(web::body);
}

PageFile::~PageFile() {
  if (!file_) return;
  file_.reset();
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void PageFile::fail() { throw FileError(write_error_text(path_, errno)); }

void PageFile::put(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail();
  size_ += static_cast<double>(text.size());
}

void PageFile::data(std::string const& name, std::string_view text, bool json) {
  PIOLA_EXPECTS(file_ != nullptr);
  put(json ? "<script type=\"application/json\" id=\"data-" : "<script type=\"application/octet-stream\" id=\"data-");
  put(name + "\">");
  put(text);
  put("</script>\n");
}

void PageFile::finish() {
  PIOLA_EXPECTS(file_ != nullptr);
  put("<script>\n(function () {\n\"use strict\";\n");
  put(web::script);
  put("}());\n</script>\n</body>\n</html>\n");
  if (std::fflush(file_.get()) != 0) fail();
  if (std::fclose(file_.release()) != 0) fail();
  std::error_code error;
  std::filesystem::rename(part_, path_, error);
  if (error) throw FileError(write_error_text(path_, error.value()));
}

}  // namespace piola::report
