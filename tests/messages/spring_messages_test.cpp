// SPDX-License-Identifier: Apache-2.0
// Messages about forces, torques and springs of rigid shapes: place, key, value, advice.
#include "support/key_words.hpp"
#include "support/sample_case.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::mentions;
using test::mentions_each;
using test::message_of;
using test::sample_case;

// The sample has 22 lines; the ball begins in line 23, the anvil in line 28, the spring in line 32.
std::string const ball =
    "[[rigid]]\nname = \"ball\"\nmotion = \"free\"\nmass = 1\nsphere = { centre = [20, 0, 0], radius = 1 }\n";
std::string const anvil =
    "[[rigid]]\nname = \"anvil\"\nsphere = { centre = [30, 0, 0], radius = 1 }\nvelocity = [1, 0, 0]\n";

std::string spring(std::string const& keys) { return message_of(sample_case() + ball + anvil + "[[spring]]\n" + keys); }
std::string pushed(std::string const& keys) { return message_of(sample_case() + ball + keys); }

constexpr char const* ends = "points = [[20, 0, 0], [\"25 m\", 0, 0]]\n";

TEST(SpringMessages, SpringsAreBetweenShapesOneOfThemFree) {
  std::string const stiff = std::string(ends) + "stiffness = \"1 kN/m\"\n";
  EXPECT_EQ(spring("between = [\"ball\"]\n" + stiff), "");
  EXPECT_EQ(spring("between = [\"anvil\", \"ball\"]\n" + stiff + "damping = \"2 N s/m\"\nrest_length = \"1 mm\"\n"),
            "");
  EXPECT_TRUE(mentions(spring("between = [\"anvil\"]\n" + stiff),
                       {"case.toml:33:11: spring.between", "no free shape", "motion = \"free\"", "remove"}));
  EXPECT_TRUE(
      mentions(spring("between = [\"ball\", \"ball\"]\n" + stiff), {"33:11", "\"ball\" twice", "another shape"}));
  EXPECT_TRUE(mentions(spring("between = [\"ball\", \"anvli\"]\n" + stiff),
                       {"33:20: spring.between[1]", "\"anvli\"", "ball, anvil", "did you mean \"anvil\"?"}));
  EXPECT_TRUE(mentions(spring("between = [\"column\"]\n" + stiff), {"\"column\"", "allowed: ball, anvil"}));
}

TEST(SpringMessages, AllThatIsWrongIsListed) {
  EXPECT_TRUE(mentions_each(spring("between = [\"ball\"]\npoints = [[20, 0], [25, 0, \"1 s\"]]\nstiffness = -1\n"
                                   "damping = \"1 N/m\"\nlenght = 1\n"),
                            {{"34:11: spring.points[0]", "list of 2", "list of 3"},
                             {"34:28: spring.points[1][2]", "1 s", "length"},
                             {"35:13: spring.stiffness", "-1", "at least 0"},
                             {"36:11: spring.damping", "1 N/m", "N s/m"},
                             {"37:1:", "lenght", "rest_length"}}));
  EXPECT_TRUE(
      mentions_each(spring("name = \"ball\"\nbetween = [\"ball\"]\n" + std::string(ends)),
                    {{"spring needs \"stiffness\" or \"damping\"", "add"}, {"the name \"ball\"", "rigid shape"}}));
  std::string const same = "between = [\"ball\"]\npoints = [[20, 0, 0], [20, 0, 0]]\nstiffness = 1\n";
  EXPECT_EQ(spring(same + "rest_length = 0\n"), "");
  EXPECT_EQ(spring(same), "") << "the default length is 0, too";
  EXPECT_TRUE(
      mentions(spring(same + "rest_length = 1\n"), {"34:10: spring.points", "coincide", "no direction", "move"}));
  EXPECT_TRUE(mentions(spring(same + "damping = 1\n"), {"coincide", "without damping"}));
}

TEST(SpringMessages, ForcesAndTorquesActOnFreeShapes) {
  EXPECT_EQ(pushed("force = [0, \"5 N\", \"sin(t)\"]\ntorque = [0, 0, { table = [[0, 0], [1, \"2 N m\"]] }]\n"), "");
  EXPECT_TRUE(mentions_each(pushed("force = [\"X\", \"5 N m\", 1]\ntorque = [1]\ntorque_axes = \"body\"\n"),
                            {{"28:9: rigid.force[0]", "uses X", "moves as one"},
                             {"28:15: rigid.force[1]", "5 N m", "N"},
                             {"29:10: rigid.torque", "list of 1", "list of 3"}}));
  EXPECT_TRUE(
      mentions(pushed("torque_axes = \"body\"\n"), {"28:15: rigid.torque_axes", "only with a torque", "remove"}));
  EXPECT_TRUE(mentions(pushed("turns = false\ntorque = [0, 0, 1]\n"), {"rigid.torque", "turns = false", "remove"}));
  EXPECT_TRUE(mentions(message_of(sample_case() + anvil + "force = [1, 0, 0]\n"),
                       {"rigid.force", "only with motion = \"free\"", "remove"}));
  EXPECT_TRUE(mentions(pushed("force = [\"1/t\", 0, 0]\n"), {"28:9: rigid.force[0]", "1/t", "inf", "finite"}));
}

}  // namespace
}  // namespace piola
