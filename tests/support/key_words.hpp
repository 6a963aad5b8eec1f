// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <vector>

/// Checks of messages by key words: place, key, value, allowed range and advice. A better wording passes, a message
/// about something else does not. One message of each kind is compared whole.
namespace piola::test {

using KeyWords = std::vector<std::string>;

/// The first word that does not follow the ones before it in the text; "" if all do.
inline std::string_view missing_word(std::string_view text, KeyWords const& words) {
  std::size_t at = 0;
  for (std::string const& word : words) {
    std::size_t const found = text.find(word, at);
    if (found == std::string_view::npos) return word;
    at = found + word.size();
  }
  return "";
}

/// Whether each message has its words in the given order, and there are no other messages.
inline ::testing::AssertionResult mentions_each(std::vector<std::string> const& messages,
                                                std::vector<KeyWords> const& words) {
  auto result = ::testing::AssertionFailure();
  bool good = messages.size() == words.size();
  if (!good) result << messages.size() << " messages instead of " << words.size() << '\n';
  for (std::size_t i = 0; i < std::min(messages.size(), words.size()); ++i)
    if (auto const word = missing_word(messages[i], words[i]); !word.empty()) {
      result << "message " << i << " lacks, after the words before it: " << word << '\n';
      good = false;
    }
  if (good) return ::testing::AssertionSuccess();
  for (std::string const& message : messages) result << message << '\n';
  return result;
}

/// The same of a text with a message on each line.
inline ::testing::AssertionResult mentions_each(std::string_view text, std::vector<KeyWords> const& words) {
  std::vector<std::string> messages;
  while (!text.empty()) {
    auto const end = std::min(text.find('\n'), text.size());
    messages.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return mentions_each(messages, words);
}

/// Whether the text is one message, which has these words in this order.
inline ::testing::AssertionResult mentions(std::string_view text, KeyWords const& words) {
  return mentions_each(text, std::vector<KeyWords>{words});
}

/// Expects each of these words somewhere in the text.
inline void expect_words(std::string_view text, KeyWords const& words) {
  for (std::string const& word : words) EXPECT_NE(text.find(word), std::string_view::npos) << word << "\nin: " << text;
}

}  // namespace piola::test
