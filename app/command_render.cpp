// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "piola/formulations/renamed_outputs.hpp"
#include "piola/input/output_keys.hpp"
#include "piola/model/read_case.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/pictures/render.hpp"
#include "piola/pictures/shape_picture.hpp"
#include "commands.hpp"
#include "run_support.hpp"
#include "set_up_watch.hpp"
#include "streams.hpp"
#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <memory>

namespace piola::app {
namespace {

struct RenderArguments {
  std::string folder, component, out, times;
  std::vector<std::string> folders, fields{"Pressure"};
  bool side_by_side = false;
  std::vector<double> range;
  std::vector<std::string> view;
  FilmOptions film;
  PictureOverrides look;  ///< by options of one value
  std::vector<std::size_t> frames;
  bool last = false, shape = false, patches = false;
  std::size_t every = 1;
  CaseOptions with;
  std::vector<std::string> as;
  std::vector<double> cut;
  bool ghost = false, panels = false;
};

/// The changes of the picture settings that all options ask for. The view is known when the folder is.
PictureOverrides look_of(RenderArguments const& options) {
  PictureOverrides look = options.look;
  if (options.view.size() == 1)
    look.emplace_back([name = options.view[0]](PictureSpec& picture) { picture.named_view = name; });
  if (options.view.size() == 2) {
    double azimuth = 0, elevation = 0;
    if (!CLI::detail::lexical_cast(options.view[0], azimuth) || !CLI::detail::lexical_cast(options.view[1], elevation))
      throw InputError(
          fmt::format("--view: {} {} is no direction (allowed: two angles in degrees, or a name) - e.g. 30 20",
                      options.view[0], options.view[1]));
    look.emplace_back([azimuth, elevation](PictureSpec& picture) {
      picture.named_view.clear();
      picture.view = {azimuth, elevation};
    });
  }
  if (!options.cut.empty())
    look.emplace_back([c = options.cut, ghost = options.ghost](PictureSpec& picture) {
      picture.appearance.cut = CutPlane{{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, ghost, false};
    });
  return look;
}

/// The bodies of a case instead of the frames of a run.
int render_shape(RenderArguments const& options) {
  std::filesystem::path const out = options.out.empty() ? "shape.png" : options.out;
  if (out.extension() != ".png")
    throw InputError(fmt::format("--out: {} is not the name of a picture (allowed with --shape: NAME.png) - add .png",
                                 out.string()));
  ParticleSet particles;
  SetUpWatch watch("reading the case and making its particles", {});
  CaseSpec const spec =
      read_case(case_file(options.folder), options.with.overrides(), {.packing = std::ref(watch)}, &particles);
  watch.enter("drawing the bodies");
  ShapePictureOptions const what{.look = look_of(options), .patches = options.patches};
  if (out.has_parent_path()) make_folder(out.parent_path());
  write_png(out, draw_shape(spec, particles, what));
  print_result("the bodies are drawn to {}\n", out.string());
  return completed;
}

/// "10 ms, 20 ms" in seconds.
std::vector<double> times_of(std::string const& text) {
  std::vector<double> times;
  std::size_t from = 0;
  while (from <= text.size()) {
    std::size_t const end = std::min(text.find(',', from), text.size());
    std::string part = text.substr(from, end - from);
    part.erase(0, part.find_first_not_of(' '));
    Quantity const time = read_quantity(part, "s");
    if (time.problem) throw InputError(fmt::format("--times: {} - e.g. \"10 ms, 20 ms\"", *time.problem));
    times.push_back(time.value);
    from = end + 1;
  }
  return times;
}

/// Checks the options that concern a single field.
void check_fields(RenderArguments const& options) {
  bool const more = options.fields.size() > 1;
  if (more && (!options.component.empty() || !options.range.empty() || !options.times.empty() || options.side_by_side))
    throw InputError(
        "--field: there are several (allowed with --component, --range, --times, --side-by-side: one) - "
        "choose one");
}

/// Draws the first folder. "--view iso DIR": a named view takes one word, and the word after it is a folder.
void give_folder_back(RenderArguments& options) {
  bool const named = !options.view.empty() && named_view(options.view[0], Up::y);
  if (!named || options.view.size() < 2) return;
  options.folders.insert(options.folders.begin(), options.view[1]);
  options.view.resize(1);
}

void check_folders(RenderArguments const& options) {
  if (options.folders.empty())
    throw InputError(options.shape ? "folder is required - name the case"
                                   : "folder is required - name the results folder of the run");
  if (options.range.size() == 2 && !(options.range[0] < options.range[1]))
    throw InputError(fmt::format("--range: {} {} is empty (allowed: the lower value first) - write --range {} {}",
                                 options.range[0], options.range[1], std::min(options.range[0], options.range[1]),
                                 std::max(options.range[0], options.range[1])));
  if (options.side_by_side && options.folders.size() < 2)
    throw InputError("--side-by-side: there is one folder only (allowed: two or more) - name the others, too");
  if (!options.side_by_side && options.folders.size() > 1)
    throw InputError(fmt::format("{} folders are given (allowed: one, or more with --side-by-side) - choose one",
                                 options.folders.size()));
}

int render(RenderArguments options) {
  give_folder_back(options);
  check_folders(options);
  check_fields(options);
  for (std::string& field : options.fields) field = current_output_name(field);
  options.folder = options.folders.front();
  if (options.shape) return render_shape(options);
  RenderOptions what{.field = options.fields.front(),
                     .range = {},
                     .look = look_of(options),
                     .component = options.component,
                     .out = options.out,
                     .only = options.frames,
                     .last = options.last,
                     .every = options.every,
                     .more_fields = {options.fields.begin() + 1, options.fields.end()},
                     .beside = {options.folders.begin() + 1, options.folders.end()}};
  what.as = options.as;
  what.panels = options.panels;
  if (!options.range.empty()) what.range = {options.range[0], options.range[1]};
  if (!options.film.file.empty()) {
    if (options.film.file.has_parent_path()) make_folder(options.film.file.parent_path());
    std::size_t const count = render_film(options.folder, what, options.film);
    print_result("a film of {} pictures is drawn to {}\n", count, options.film.file.string());
    return completed;
  }
  if (!options.times.empty()) {
    print_result("the picture is drawn to {}\n", render_times(options.folder, what, times_of(options.times)).string());
    return completed;
  }
  auto const paths = render_frames(options.folder, what);
  print_result("{} picture{} drawn, the last is {}\n", paths.size(), paths.size() == 1 ? "" : "s",
               paths.empty() ? "none" : paths.back().string());
  return completed;
}

/// Adds an option each of whose values changes the picture settings.
template <class Value, class Change>
CLI::Option* add_change(CLI::App& command, PictureOverrides& look, std::string const& name, std::string const& help,
                        Change change) {
  auto const note = [&look, change](Value const& value) {
    look.emplace_back([change, value](PictureSpec& picture) { change(picture, value); });
  };
  return command.add_option_function<Value>(name, note, help);
}

/// Adds the options of the view that are no single number, word or flag, or have words of their own.
void add_view_options(CLI::App& command, RenderArguments& options) {
  PictureOverrides& look = options.look;
  command
      .add_option("--view", options.view,
                  "Azimuth and elevation in degrees, or x, y, z, -x, -y, -z, iso, iso2 (default: that of the case)")
      ->expected(1, 2);
  add_change<std::string>(command, look, "--up",
                          "Axis that points upwards: x, y, z, -x, -y, -z; auto: that of the case",
                          [](PictureSpec& picture, std::string const& up) {
                            if (up != "auto") picture.up = up;
                          })
      ->check(CLI::IsMember({"auto", "x", "y", "z", "-x", "-y", "-z"}))
      ->default_str("auto");
  add_change<std::vector<double>>(command, look, "--look-at", "The point in the middle, in m",
                                  [](PictureSpec& picture, std::vector<double> const& at) {
                                    picture.look_at = {at[0], at[1], at[2]};
                                  })
      ->expected(3);
  add_change<std::string>(command, look, "--follow", "Name of a body that stays in the middle and fills the picture",
                          [](PictureSpec& picture, std::string const& body) { picture.followed_body = body; });
  add_change<std::vector<int>>(command, look, "--size",
                               "Width and height in pixels (default: that of the case, else fitted to the content)",
                               [](PictureSpec& picture, std::vector<int> const& size) {
                                 picture.width = size[0];
                                 picture.height = size[1];
                               })
      ->expected(2)
      ->check(CLI::Range(200, 20000));
}

/// The option of a row of the schema: --KEY VALUE; of a flag --KEY, or --no-KEY if it is on by default.
struct SettingOption {
  CLI::App& command;
  KeyInfo const& info;
  PictureOverrides& look;

  std::string name() const { return "--" + std::string(info.key); }
  std::string help() const {
    std::string text(info.meaning);
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return info.unit.empty() || info.unit == "1" ? text : fmt::format("{} [{}]", text, info.unit);
  }
  void operator()(double& (*member)(PictureSpec&)) const {
    add_change<double>(command, look, name(), help(), [member](PictureSpec& p, double value) {
      member(p) = value;
    })->check(CLI::Range(info.allowed.low, info.allowed.high));
  }
  void operator()(bool& (*member)(PictureSpec&)) const {
    PictureSpec standard;
    bool const on = member(standard);
    auto const note = [&look = look, member, on] {
      look.emplace_back([member, on](PictureSpec& picture) { member(picture) = !on; });
    };
    command.add_flag_callback(on ? "--no-" + std::string(info.key) : name(), note,
                              on ? "Without " + std::string(info.meaning) : help());
  }
  void operator()(WordMember<PictureSpec> const& member) const {
    auto const change = [set = member.set, words = info.words](PictureSpec& picture, std::string const& word) {
      set(picture, static_cast<std::size_t>(std::find(words.begin(), words.end(), word) - words.begin()));
    };
    add_change<std::string>(command, look, name(), help(), change)->check(CLI::IsMember(to_strings(info.words)));
  }
  template <class Other>
  void operator()(Other const&) const {}  // has an option of its own
};

void add_setting_options(CLI::App& command, PictureOverrides& look) {
  for (PictureKey const& row : picture_keys())
    if (!row.own_reader) std::visit(SettingOption{command, row.info, look}, row.member);
}

void add_film_options(CLI::App& command, RenderArguments& options) {
  auto* const film = command.add_option(
      "--film", options.film.file, "Draw a film in place of pictures: NAME.webp, or NAME.mp4 by the program ffmpeg");
  command.add_option("--fps", options.film.pictures_per_second, "With --film: pictures per second (default: 20)")
      ->check(CLI::Range(0.1, 120.0))
      ->needs(film);
  command.add_option("--seconds", options.film.seconds, "With --film: its length in seconds")
      ->check(CLI::Range(0.1, 3600.0))
      ->needs(film);
  command.add_option("--hold-end", options.film.hold_end, "With --film: how long the last picture stays, in seconds")
      ->check(CLI::Range(0.0, 60.0))
      ->capture_default_str()
      ->needs(film);
  film->excludes(command.get_option("--out"));
  auto* const beside =
      command.add_flag("--side-by-side", options.side_by_side, "Draw several runs beside each other, at equal times");
  command
      .add_option("--times", options.times,
                  "Draw the frames nearest to these times into one picture, e.g. \"10 ms, 20 ms, 40 ms\"")
      ->excludes(film)
      ->excludes(beside)
      ->excludes(command.get_option("--frame"))
      ->excludes(command.get_option("--last"))
      ->excludes(command.get_option("--every"));
  for (char const* const one : {"--side-by-side", "--times", "--component", "--range"})
    command.get_option("--panels")->excludes(command.get_option(one));
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
}

void add_shape_options(CLI::App& command, RenderArguments& options) {
  auto* const shape =
      command.add_flag("--shape", options.shape, "Draw the bodies of a case as they stand before anything runs");
  for (char const* const of_frames : {"--field", "--component", "--range", "--frame", "--last", "--every", "--film",
                                      "--side-by-side", "--times", "--as", "--cut", "--no-outline", "--panels"})
    shape->excludes(command.get_option(of_frames));
  command.add_flag("--patches", options.patches, "With --shape: colours by patch of the surface")->needs(shape);
  options.with.add_to(command, false);
  for (char const* const of_case : {"--set", "--threads", "--instruction-set", "--machine"})
    command.get_option(of_case)->needs(shape);
}

}  // namespace

void add_render(CLI::App& program, Action& action) {
  auto const options = std::make_shared<RenderArguments>();
  CLI::App* command =
      program.add_subcommand("render", "Draw pictures from the frames of a run, or the bodies of a case");
  command->add_option("folder", options->folders, "The results folder of the run; with --shape the case");
  command
      ->add_option("--field", options->fields,
                   "Field that gives the colours, e.g. Pressure, Velocity, VonMisesStress; given several times, "
                   "the pictures stand beside each other")
      ->allow_extra_args(false)
      ->capture_default_str();
  command->add_flag("--panels", options->panels, "Draw the panels that the case has for its pictures")
      ->excludes(command->get_option("--field"));
  command->add_option("--component", options->component,
                      "Component of a vector (x, y, z) or tensor (xx, xy, ...); default: length, von Mises stress");
  command
      ->add_option("--range", options->range, "Lowest and highest value of the colours, in SI (default: of all frames)")
      ->expected(2);
  auto* const frames =
      command->add_option("--frame", options->frames, "Draw this frame only, counted from 0; also several");
  auto* const last = command->add_flag("--last", options->last, "Draw the last frame only")->excludes(frames);
  command->add_option("--every", options->every, "Draw the first frame and every N-th after it")
      ->check(CLI::Range(1, 1000000))
      ->excludes(frames)
      ->excludes(last);
  command->add_option("--out,-o", options->out,
                      "Folder of the pictures (default: pictures in the results folder); with --shape the picture");
  add_view_options(*command, *options);
  add_setting_options(*command, options->look);
  add_film_options(*command, *options);
  add_appearance_options(*command, *options);
  add_shape_options(*command, *options);
  command->callback([options, &action] { action = [options] { return render(*options); }; });
}

}  // namespace piola::app
