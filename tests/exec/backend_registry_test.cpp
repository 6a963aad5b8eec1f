// SPDX-License-Identifier: Apache-2.0
#include "piola/exec/backend_registry.hpp"
#include <gtest/gtest.h>
#include <string>

namespace piola::exec_host {
namespace {

TEST(InstructionSets, ThatEveryProcessorHasAreUsable) {
  EXPECT_TRUE(processor_can_run("scalar"));
  EXPECT_TRUE(processor_can_run("native"));
  EXPECT_FALSE(processor_can_run("v2"));
  EXPECT_FALSE(processor_can_run("v5"));
  EXPECT_FALSE(processor_can_run("auto"));
  EXPECT_FALSE(processor_can_run(""));
}

TEST(InstructionSets, ContainEachOther) { EXPECT_TRUE(!processor_can_run("v4") || processor_can_run("v3")); }

TEST(InstructionSets, OfThisProgramAreListedBestFirst) {
  auto const usable = usable_backends();
  ASSERT_FALSE(usable.empty());
  for (std::string const& name : usable) EXPECT_TRUE(processor_can_run(name));
  EXPECT_TRUE(backend_text("auto").starts_with(usable.front() + " of a processor with "));
}

struct Fake {
  char const* name;
};
constexpr Fake abacus{"abacus"}, native{"native"}, scalar{"scalar"};

TEST(BackendRegistry, LeavesOutWhatTheProcessorCannotRun) {
  BackendRegistry<Fake> const choice({&abacus, &native, &scalar});
  char const* const* const names = choice.names();
  ASSERT_NE(names[0], nullptr);
  ASSERT_NE(names[1], nullptr);
  EXPECT_EQ(std::string(names[0]), "native");
  EXPECT_EQ(std::string(names[1]), "scalar");
  EXPECT_EQ(names[2], nullptr);
  EXPECT_EQ(choice.find("abacus"), nullptr);
}

TEST(BackendRegistry, FindsByNameAndTakesTheFirstForAuto) {
  BackendRegistry<Fake> const choice({&abacus, &native, &scalar});
  EXPECT_EQ(choice.find("auto"), &native);
  EXPECT_EQ(choice.find("native"), &native);
  EXPECT_EQ(choice.find("scalar"), &scalar);
  EXPECT_EQ(choice.find("v4"), nullptr) << "not in this list";
  EXPECT_EQ(choice.find(""), nullptr);
}

TEST(BackendRegistry, SaysWhichMachinesAreUsable) {
  char const* const names[] = {"v4", "scalar", nullptr};
  EXPECT_EQ(not_usable("v9", names),
            "instruction set 'v9' is unknown or not usable on this processor (usable: auto, v4, scalar)");
}

TEST(BackendRegistry, SaysThatAProgramWasBuiltForAnotherProcessor) {
  char const* const none[] = {nullptr};
  EXPECT_TRUE(not_usable("auto", none).starts_with("this program was built for another processor")) << "and what to do";
}

TEST(BackendRegistry, OfNothingFindsNothing) {
  BackendRegistry<Fake> const choice({});
  EXPECT_EQ(choice.names()[0], nullptr);
  EXPECT_EQ(choice.find("auto"), nullptr);
}

}  // namespace
}  // namespace piola::exec_host
