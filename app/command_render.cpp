// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/render.hpp"
#include "commands.hpp"
#include "streams.hpp"
#include <cstdio>
#include <fmt/format.h>
#include <memory>

namespace piola::app {
namespace {

struct Options {
  std::string folder, field = "Pressure";
  std::vector<double> range, view{30, 20};
  std::vector<int> size{1000, 800};
};

int render(Options const& options) {
  RenderOptions what{.field = options.field,
                     .range = {},
                     .view = {options.view[0], options.view[1]},
                     .width = options.size[0],
                     .height = options.size[1]};
  if (!options.range.empty()) what.range = {options.range[0], options.range[1]};
  auto const paths = render_frames(options.folder, what);
  say("{} picture{} drawn, the last is {}\n", paths.size(), paths.size() == 1 ? "" : "s",
      paths.empty() ? "none" : paths.back().string());
  return completed;
}

}  // namespace

void add_render(CLI::App& program, Action& action) {
  auto const options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("render", "Draw pictures from the frames of a run");
  command->add_option("folder", options->folder, "The results folder of the run")->required();
  command
      ->add_option("--field", options->field, "Field that gives the colours, e.g. Pressure, Velocity, VonMisesStress")
      ->capture_default_str();
  command
      ->add_option("--range", options->range, "Lowest and highest value of the colours, in SI (default: of all frames)")
      ->expected(2);
  command->add_option("--view", options->view, "Azimuth and elevation in degrees")->expected(2)->capture_default_str();
  command->add_option("--size", options->size, "Width and height in pixels")
      ->expected(2)
      ->check(CLI::Range(200, 20000))
      ->capture_default_str();
  command->callback([options, &action] { action = [options] { return render(*options); }; });
}

}  // namespace piola::app
