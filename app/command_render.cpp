// SPDX-License-Identifier: Apache-2.0
#include "piola/input/read_case.hpp"
#include "piola/output/files.hpp"
#include "piola/simulation/render.hpp"
#include "piola/simulation/shape_picture.hpp"
#include "commands.hpp"
#include "run_support.hpp"
#include "streams.hpp"
#include <cstdio>
#include <fmt/format.h>
#include <functional>
#include <memory>

namespace piola::app {
namespace {

struct RenderArguments {
  std::string folder, field = "Pressure", component, up = "auto", out;
  std::vector<double> range, view{30, 20};
  std::vector<int> size{1000, 800};
  std::vector<std::size_t> frames;
  bool last = false, shape = false, patches = false;
  std::size_t every = 1;
  CaseOptions with;
  bool view_given = false, size_given = false;
  std::vector<std::string> as;
  std::vector<double> cut;
  bool ghost = false, no_outline = false;
};

/// The bodies of a case instead of the frames of a run.
int render_shape(RenderArguments const& options) {
  std::filesystem::path const out = options.out.empty() ? "shape.png" : options.out;
  if (out.extension() != ".png")
    throw InputError(fmt::format("--out: {} is not the name of a picture (allowed with --shape: NAME.png) - add .png",
                                 out.string()));
  ParticleSet particles;
  PackingLine line(false);
  CaseSpec const spec =
      read_case(case_file(options.folder), options.with.overrides(), {.packing = std::ref(line)}, &particles);
  ShapePictureOptions what{.up = options.up, .patches = options.patches};
  if (options.view_given) what.view = {options.view[0], options.view[1]};
  if (options.size_given) what.size = {options.size[0], options.size[1]};
  if (out.has_parent_path()) make_folder(out.parent_path());
  write_png(out, draw_shape(spec, particles, what));
  say("the bodies are drawn to {}\n", out.string());
  return completed;
}

int render(RenderArguments const& options) {
  if (options.shape) return render_shape(options);
  RenderOptions what{.field = options.field,
                     .range = {},
                     .view = {options.view[0], options.view[1]},
                     .width = options.size[0],
                     .height = options.size[1],
                     .component = options.component,
                     .up = options.up,
                     .out = options.out,
                     .only = options.frames,
                     .last = options.last,
                     .every = options.every};
  what.as = options.as;
  what.outline = !options.no_outline;
  if (!options.cut.empty()) {
    auto const& c = options.cut;
    what.cut = CutPlane{{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, options.ghost, false};
  }
  if (!options.range.empty()) what.range = {options.range[0], options.range[1]};
  auto const paths = render_frames(options.folder, what);
  say("{} picture{} drawn, the last is {}\n", paths.size(), paths.size() == 1 ? "" : "s",
      paths.empty() ? "none" : paths.back().string());
  return completed;
}

void add_appearance_options(CLI::App& command, RenderArguments& options) {
  command
      .add_option("--as", options.as,
                  "How bodies are drawn: auto, skin, balls, points, none; BODY=skin for one body; also several")
      ->allow_extra_args(false);
  auto* const cut = command.add_option("--cut", options.cut,
                                       "Cuts bodies open: a point of the plane [m] and its normal, six numbers; what "
                                       "the normal points to is taken away");
  cut->expected(6);
  command.add_flag("--ghost", options.ghost, "With --cut: what is taken away stays as a shade")->needs(cut);
  command.add_flag("--no-outline", options.no_outline, "No dashed lines where the edges of bodies were");
}

void add_shape_options(CLI::App& command, RenderArguments& options) {
  auto* const shape =
      command.add_flag("--shape", options.shape, "Draw the bodies of a case as they stand before anything runs");
  for (char const* const of_frames :
       {"--field", "--component", "--range", "--frame", "--last", "--every", "--as", "--cut", "--no-outline"})
    shape->excludes(command.get_option(of_frames));
  command.add_flag("--patches", options.patches, "With --shape: colours by patch of the surface")->needs(shape);
  options.with.add_to(command, false);
  for (char const* const of_case : {"--set", "--threads", "--machine"}) command.get_option(of_case)->needs(shape);
}

}  // namespace

void add_render(CLI::App& program, Action& action) {
  auto const options = std::make_shared<RenderArguments>();
  CLI::App* command =
      program.add_subcommand("render", "Draw pictures from the frames of a run, or the bodies of a case");
  command->add_option("folder", options->folder, "The results folder of the run; with --shape the case")->required();
  command
      ->add_option("--field", options->field, "Field that gives the colours, e.g. Pressure, Velocity, VonMisesStress")
      ->capture_default_str();
  command->add_option("--component", options->component,
                      "Component of a vector (x, y, z) or tensor (xx, xy, ...); default: length, von Mises stress");
  command
      ->add_option("--range", options->range, "Lowest and highest value of the colours, in SI (default: of all frames)")
      ->expected(2);
  auto* const view = command->add_option("--view", options->view, "Azimuth and elevation in degrees");
  view->expected(2)->capture_default_str();
  command->add_option("--up", options->up, "Axis that points upwards: x, y, z, -x, -y, -z; auto: as the case has it")
      ->check(CLI::IsMember({"auto", "x", "y", "z", "-x", "-y", "-z"}))
      ->capture_default_str();
  auto* const frames =
      command->add_option("--frame", options->frames, "Draw this frame only, counted from 0; also several");
  auto* const last = command->add_flag("--last", options->last, "Draw the last frame only")->excludes(frames);
  command->add_option("--every", options->every, "Draw the first frame and each so many after it")
      ->check(CLI::Range(1, 1000000))
      ->excludes(frames)
      ->excludes(last);
  command->add_option("--out,-o", options->out,
                      "Folder of the pictures (default: pictures in the results folder); with --shape the picture");
  auto* const size = command->add_option("--size", options->size, "Width and height in pixels");
  size->expected(2)->check(CLI::Range(200, 20000))->capture_default_str();
  add_appearance_options(*command, *options);
  add_shape_options(*command, *options);
  command->callback([options, view, size, &action] {
    options->view_given = view->count() > 0;
    options->size_given = size->count() > 0;
    action = [options] { return render(*options); };
  });
}

}  // namespace piola::app
