// SPDX-License-Identifier: Apache-2.0
#include "piola/input/key_tables.hpp"
#include <algorithm>
#include <array>
#include <vector>

namespace piola {
namespace {

using enum KeyInfo::Kind;

constexpr std::array<std::string_view, 7> up_words{"auto", "x", "y", "z", "-x", "-y", "-z"};
constexpr std::array<std::string_view, 8> view_words{"x", "y", "z", "-x", "-y", "-z", "iso", "iso2"};
constexpr Interval turn{-360, 360, false, false};  // degree
constexpr std::array<std::string_view, 8> map_words{"auto", "viridis",  "cividis",    "magma",
                                                    "grey", "blue_red", "blue_brown", "heat_on_grey"};
constexpr std::array<std::string_view, 3> theme_words{"light", "dark", "transparent"};
constexpr std::array<std::string_view, 5> representation_words{"auto", "skin", "balls", "points", "none"};
constexpr std::array<std::string_view, 2> quality_words{"normal", "high"};
constexpr std::array<std::string_view, 2> cut_words{"clip", "ghost"};
constexpr std::array<std::string_view, 2> configuration_words{"current", "reference"};

constexpr std::array output_keys{
    KeyInfo{"output", "frames", table, "", {}, "no frames", "files for ParaView", {}},
    KeyInfo{"output", "history", table, "", {}, "500 rows", "the table history.csv", {}},
    KeyInfo{"output", "pictures", table, "", {}, "no pictures", "PNG pictures", {}},
    KeyInfo{"output", "checkpoints", table, "", {}, "at the end only", "files to resume from", {}},
    KeyInfo{"output.frames", "every", quantity, "s", not_negative, "", "time between two frames; 0 for none", {}},
    KeyInfo{"output.frames", "fields", list, "", {}, "the formulation's", "names of the fields to write", {}},
    KeyInfo{"output.frames", "compress", flag, "", {}, "true", "smaller files, a little more time", {}},
    KeyInfo{"output.history", "every", quantity, "s", not_negative, "", "time between two rows", {}},
    KeyInfo{"output.pictures", "every", quantity, "s", not_negative, "", "time between two pictures; 0 for none", {}},
    KeyInfo{"output.pictures", "field", text, "", {}, "\"Pressure\"", "field that gives the colour", {}},
    KeyInfo{"output.pictures",
            "component",
            text,
            "",
            {},
            "magnitude",
            "x, y, z of a vector, xx, yy, zz, xy, yz, xz (and yx, zy, zx) of a tensor; without it vectors give their "
            "length, symmetric tensors the von Mises stress, others their largest component",
            {}},
    KeyInfo{
        "output.pictures",
        "up",
        word,
        "",
        {},
        "\"auto\"",
        "axis that points upwards; auto: against gravity (a constant acceleration of a whole body), else the normal of "
        "a resting rigid plane, else y",
        up_words},
    KeyInfo{"output.pictures",
            "range",
            list,
            "",
            any_value,
            "that of the whole run",
            "values at the two ends of the colour bar, in the field's unit",
            {}},
    KeyInfo{"output.pictures", "view", list, "degree", turn, "[30, 20]",
            "azimuth and elevation, or one of \"x\", \"y\", \"z\", \"-x\", \"-y\", \"-z\" (from that end of an "
            "axis), \"iso\", \"iso2\"",
            view_words},
    KeyInfo{"output.pictures", "azimuth", quantity, "degree", turn, "30", "about what points up, as in view", {}},
    KeyInfo{
        "output.pictures", "elevation", quantity, "degree", turn, "20", "above the plane across it, as in view", {}},
    KeyInfo{"output.pictures", "roll", quantity, "degree", turn, "0", "turns the picture anticlockwise", {}},
    KeyInfo{"output.pictures",
            "perspective",
            quantity,
            "degree",
            {0, 120, false, false},
            "0",
            "angle under which the bodies are seen at the start; 0: parallel lines stay parallel",
            {}},
    KeyInfo{
        "output.pictures", "zoom", quantity, "1", {0.01, 1000, false, false}, "1", "2 shows all twice as large", {}},
    KeyInfo{"output.pictures", "look_at", point, "m", place_range, "the middle of all", "point in the middle", {}},
    KeyInfo{"output.pictures",
            "follow",
            name,
            "",
            {},
            "none",
            "name of a body that stays in the middle and fills the picture",
            {}},
    KeyInfo{"output.pictures",
            "map",
            word,
            "",
            {},
            "\"auto\"",
            "colours; auto: heat_on_grey for plastic strain and damage, else blue_red where zero lies well inside the "
            "range, else viridis",
            map_words},
    KeyInfo{"output.pictures", "theme", word, "", {}, "\"light\"", "background and letters", theme_words},
    KeyInfo{"output.pictures", "labels", flag, "", {}, "true", "title, time, colour bar, axes and scale bar", {}},
    KeyInfo{"output.pictures",
            "size",
            list,
            "",
            {16, 16384, false, false},
            "that of what is shown",
            "width and height in pixels; without it, a column has an upright picture, a beam a flat one",
            {}},
    KeyInfo{"output.pictures",
            "as",
            word,
            "",
            {},
            "\"auto\"",
            "how bodies are drawn, all of them or a table { BODY = one of these }; auto: a skin where particles hang "
            "together, balls for the rest",
            representation_words},
    KeyInfo{"output.pictures",
            "outline",
            flag,
            "",
            {},
            "true",
            "dashed lines where the edges of bodies were that have moved",
            {}},
    KeyInfo{
        "output.pictures",
        "quality",
        word,
        "",
        {},
        "\"normal\"",
        "high: pixels are the mean of 4 x 4 samples in place of 2 x 2, and the light from around has more directions",
        quality_words},
    KeyInfo{"output.pictures",
            "warp",
            quantity,
            "1",
            {0, 1e6, false, false},
            "1",
            "magnification of displacements; the title states it",
            {}},
    KeyInfo{"output.pictures",
            "ground",
            flag,
            "",
            {},
            "false",
            "a plane below the bodies as they stand at the start, with their shadow; three dimensions only",
            {}},
    KeyInfo{"output.pictures", "supports", flag, "", {}, "false", "what supports hold is hatched", {}},
    KeyInfo{"output.pictures", "cut", table, "", {}, "none", "a plane that cuts bodies open", {}},
    KeyInfo{"output.pictures",
            "panel",
            list,
            "",
            {},
            "one picture",
            "[[output.pictures.panel]]: several views or fields beside each other in each picture, at most 16",
            {}},
    KeyInfo{"output.pictures", "columns", whole, "", {1, 16, false, false}, "as fits", "of panels", {}},
    KeyInfo{"output.pictures",
            "times",
            list,
            "s",
            not_negative,
            "none",
            "one more picture at the end, FIELD-times.png, with the pictures nearest to these times beside each other",
            {}},
    KeyInfo{"output.pictures.cut", "point", point, "m", place_range, "", "a point of the plane", {}},
    KeyInfo{"output.pictures.cut",
            "normal",
            point,
            "1",
            place_range,
            "",
            "towards the side that is taken away, of any length",
            {}},
    KeyInfo{"output.pictures.cut",
            "show",
            word,
            "",
            {},
            "\"clip\"",
            "clip: that side is not drawn; ghost: it is drawn as a shade",
            cut_words},
    KeyInfo{"output.pictures.cut",
            "of",
            word,
            "",
            {},
            "\"current\"",
            "whether the plane cuts the bodies as they are, or where it lay in them at the start",
            configuration_words},
    KeyInfo{"output.checkpoints",
            "every",
            quantity,
            "s",
            not_negative,
            "",
            "time between two checkpoints; 0 for none but the last",
            {}},
};

constexpr KeyInfo caption_key{"output.pictures.panel",    "caption", text, "", {}, "the view, if it has a name",
                              "what stands at the panel", {}};

/// Keys common to a picture and its panels. A panel takes missing values from the picture.
bool is_of_panels(KeyInfo const& info) {
  constexpr std::array<std::string_view, 8> not_these{"every",   "up",    "size",   "theme",
                                                      "columns", "times", "labels", "panel"};
  return info.section == "output.pictures" &&
         std::find(not_these.begin(), not_these.end(), info.key) == not_these.end();
}

std::vector<KeyInfo> with_keys_of_panels() {
  std::vector<KeyInfo> keys(output_keys.begin(), output_keys.end());
  for (KeyInfo info : output_keys) {
    if (is_of_panels(info)) {
      info.section = "output.pictures.panel";
      info.standard = "as the picture";
    } else if (info.section == "output.pictures.cut") {
      info.section = "output.pictures.panel.cut";
    } else {
      continue;
    }
    keys.push_back(info);
  }
  keys.push_back(caption_key);
  return keys;
}

}  // namespace

std::span<KeyInfo const> keys_of_output() {
  static std::vector<KeyInfo> const keys = with_keys_of_panels();
  return keys;
}

}  // namespace piola
