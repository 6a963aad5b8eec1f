// SPDX-License-Identifier: Apache-2.0
#include "piola/output/frame_index.hpp"
#include "piola/base/errors.hpp"
#include "piola/output/atomic_file.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

constexpr std::string_view head = "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [\n";
constexpr std::string_view tail = "\n  ]\n}\n";

std::string line_of(FrameIndex::Entry const& entry) {
  return fmt::format(R"(    {{ "name": "{}", "time": {} }})", entry.second, entry.first);
}

nlohmann::json parsed(std::string const& text) { return nlohmann::json::parse(text, nullptr, false); }

}  // namespace

void FrameIndex::write(std::vector<Entry> const& entries) {
  std::string text(head);
  for (std::size_t k = 0; k < entries.size(); ++k) text += (k > 0 ? ",\n" : "") + line_of(entries[k]);
  text += tail;
  write_whole_file(file_, text);
  size_ = text.size();
}

bool FrameIndex::add(Entry const& entry) {
  if (size_ <= head.size() + tail.size()) return false;
  std::string const text = ",\n" + line_of(entry) + std::string(tail);
  if (!overwrite_end(file_, size_, tail.size(), text)) return false;
  size_ += text.size() - tail.size();
  return true;
}

std::vector<FrameIndex::Entry> read_frame_index(std::filesystem::path const& file) {
  std::string const text = read_text_file(file);
  auto document = parsed(text);
  if (document.is_discarded()) document = parsed(text.substr(0, text.rfind(" }") + 2) + std::string(tail));
  std::vector<FrameIndex::Entry> entries;
  try {
    for (auto const& entry : document.at("files"))
      entries.emplace_back(entry.at("time").get<double>(), entry.at("name").get<std::string>());
  } catch (nlohmann::json::exception const&) {
    throw FileError(fmt::format("{}: is not an index of frames - run the case again, or open the frames one by one",
                                file.string()));
  }
  return entries;
}

}  // namespace piola
