// SPDX-License-Identifier: Apache-2.0
#include "piola/base/controls.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

TEST(Controls, AreFoundInWhateverWayUtf8WritesThem) {
  EXPECT_EQ(find_control("plain\ttext\nof two lines \xc3\xa9"), std::string::npos);
  EXPECT_EQ(find_control("two\r\nlines"), std::string::npos);
  EXPECT_EQ(find_control("a\x1b[31m"), 1U);
  EXPECT_EQ(find_control("ab\rc"), 2U);
  EXPECT_EQ(find_control("abc\x7f"), 3U);
  EXPECT_EQ(find_control("a\xc2\x9b"), 1U) << "U+009B, which some terminals take for an escape sequence";
  EXPECT_EQ(find_control(std::string_view("\0", 1)), 0U);
}

TEST(Controls, AreWrittenOutAndNothingElseChanges) {
  EXPECT_EQ(without_controls("a\x1b[31mb\x7f\xc2\x9b\n"), "a\\x1b[31mb\\x7f\\x9b\n");
  EXPECT_EQ(without_controls("caf\xc3\xa9\t1 \xc2\xb5m\n"), "caf\xc3\xa9\t1 \xc2\xb5m\n");
  EXPECT_EQ(without_controls("\rline renewed\r"), "\rline renewed\r");
  EXPECT_EQ(without_controls("a\rb"), "a\\x0db");
}

}  // namespace
}  // namespace piola
