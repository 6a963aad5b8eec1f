// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/render.hpp"
#include "piola/base/problems.hpp"
#include "piola/simulation/run_case.hpp"
#include "support/fake_formulation.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

TEST(Render, DrawsOnePictureForEachFrame) {
  testing::TemporaryFolder const folder;
  Simulation s = testing::make_springs();
  Listener listener;
  std::atomic<int> const none{0};
  run_case(s, {.folder = folder / "r"}, listener, none);
  auto const paths =
      render_frames(folder / "r", {.field = "Velocity", .range = {}, .view = {}, .width = 300, .height = 250});
  ASSERT_EQ(paths.size(), 5U);
  EXPECT_EQ(paths[4].filename(), "Velocity-000004.png");
  Image const image = read_png(paths[4]);
  EXPECT_EQ(image.width, 300);
  EXPECT_EQ(image.height, 250);
  EXPECT_THROW(render_frames(folder / "r", {.field = "Colour"}), InputError);
}

TEST(Render, SaysWhenThereAreNoFrames) {
  testing::TemporaryFolder const folder;
  EXPECT_THROW(render_frames(folder.path(), {}), InputError);
}

}  // namespace
}  // namespace piola
