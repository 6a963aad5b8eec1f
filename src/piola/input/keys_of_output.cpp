// SPDX-License-Identifier: Apache-2.0
#include "piola/input/key_tables.hpp"
#include "piola/input/output_keys.hpp"
#include <algorithm>
#include <array>
#include <vector>

namespace piola {
namespace {

using enum KeyInfo::Kind;

constexpr std::array<std::string_view, 7> up_axis_words{"auto", "x", "y", "z", "-x", "-y", "-z"};
constexpr Interval turn{-360, 360, false, false};  // degree
constexpr std::array<std::string_view, 2> cut_words{"clip", "ghost"};
constexpr std::array<std::string_view, 2> configuration_words{"current", "reference"};

constexpr std::array output_rows{
    OutputKey{{"output", "frames", table, "", any_value, "no frames", "files for ParaView"}},
    OutputKey{{"output", "history", table, "", any_value, "500 rows", "the table history.csv"}},
    OutputKey{{"output", "pictures", table, "", any_value, "no pictures", "PNG pictures"}},
    OutputKey{{"output", "checkpoints", table, "", any_value, "at the end only", "files to resume from"}},
    OutputKey{{"output.frames", "every", quantity, "s", not_negative, "", "time between two frames; 0 for none"},
              fills<&OutputSpec::frames_every>},
    OutputKey{{"output.frames", "fields", list, "", any_value, "the formulation's", "names of the fields to write"}},
    OutputKey{
        {"output.frames", "compress", flag, "", any_value, default_of_member, "smaller files, a little more time"},
        fills<&OutputSpec::compress>},
    OutputKey{{"output.history", "every", quantity, "s", not_negative, "", "time between two rows"},
              fills<&OutputSpec::history_every>},
    OutputKey{{"output.checkpoints", "every", quantity, "s", not_negative, "",
               "time between two checkpoints; 0 for none but the last"},
              fills<&OutputSpec::checkpoints_every>},
};

constexpr std::array picture_rows{
    PictureKey{{"output.pictures", "field", text, "", any_value, default_of_member, "field that gives the colour"},
               fills<&PictureSpec::field>,
               true},
    PictureKey{{"output.pictures", "component", text, "", any_value, "magnitude",
                "x, y, z of a vector, xx, yy, zz, xy, yz, xz (and yx, zy, zx) of a tensor; without it vectors give "
                "their length, symmetric tensors the von Mises stress, others their largest component"}},
    PictureKey{{"output.pictures", "up", word, "", any_value, default_of_member,
                "axis that points upwards; auto: against gravity (a constant acceleration of a whole body), else the "
                "normal of a resting rigid plane, else y",
                up_axis_words},
               fills<&PictureSpec::up>},
    PictureKey{{"output.pictures", "range", list, "", any_value, "that of the whole run",
                "values at the two ends of the colour bar, in the field's unit"}},
    PictureKey{{"output.pictures", "view", list, "degree", turn, "[30, 20]",
                "azimuth and elevation, or one of \"x\", \"y\", \"z\", \"-x\", \"-y\", \"-z\" (from that end of an "
                "axis), \"iso\", \"iso2\"",
                view_words}},
    PictureKey{
        {"output.pictures", "azimuth", quantity, "degree", turn, default_of_member, "about what points up, as in view"},
        +[](PictureSpec& picture) -> double& { return picture.view[0]; },
        true},
    PictureKey{{"output.pictures", "elevation", quantity, "degree", turn, default_of_member,
                "above the plane across it, as in view"},
               +[](PictureSpec& picture) -> double& { return picture.view[1]; },
               true},
    PictureKey{
        {"output.pictures", "roll", quantity, "degree", turn, default_of_member, "turns the picture anticlockwise"},
        fills<&PictureSpec::roll>},
    PictureKey{{"output.pictures", "perspective", quantity, "degree", closed(0, 120), default_of_member,
                "angle under which the bodies are seen at the start; 0: parallel lines stay parallel"},
               fills<&PictureSpec::perspective>},
    PictureKey{
        {"output.pictures", "zoom", quantity, "1", closed(0.01, 1000), default_of_member, "2 shows all twice as large"},
        fills<&PictureSpec::zoom>},
    PictureKey{{"output.pictures", "look_at", point, "m", place_range, "the middle of all", "point in the middle"}},
    PictureKey{{"output.pictures", "follow", name, "", any_value, "none",
                "name of a body that stays in the middle and fills the picture"}},
    PictureKey{{"output.pictures", "map", word, "", any_value, default_of_member,
                "colours; auto: heat_on_grey for plastic strain and damage, else blue_red where zero lies well inside "
                "the range, else viridis",
                palette_words},
               fills<&PictureSpec::map>},
    PictureKey{
        {"output.pictures", "theme", word, "", any_value, default_of_member, "background and letters", theme_words},
        fills<&PictureSpec::theme>},
    PictureKey{{"output.pictures", "labels", flag, "", any_value, default_of_member,
                "title, time, colour bar, axes and scale bar"},
               fills<&PictureSpec::labels>},
    PictureKey{{"output.pictures", "size", list, "", closed(16, 16384), "that of what is shown",
                "width and height in pixels; without it, a column has an upright picture, a beam a flat one"}},
    PictureKey{{"output.pictures", "as", word, "", any_value, "\"auto\"",
                "how bodies are drawn, all of them or a table { BODY = one of these }; auto: a skin where particles "
                "hang together, balls for the rest",
                representation_words}},
    PictureKey{{"output.pictures", "outline", flag, "", any_value, default_of_member,
                "dashed lines where the edges of bodies were that have moved"},
               fills<&PictureSpec::appearance, &Appearance::outline>},
    PictureKey{
        {"output.pictures", "quality", word, "", any_value, default_of_member,
         "high: pixels are the mean of 4 x 4 samples in place of 2 x 2, and the light from around has more directions",
         quality_words},
        fills<&PictureSpec::appearance, &Appearance::quality>},
    PictureKey{{"output.pictures", "warp", quantity, "1", closed(0, 1e6), default_of_member,
                "magnification of displacements; the title states it"},
               fills<&PictureSpec::warp>},
    PictureKey{
        {"output.pictures", "revolve", quantity, "degree", Interval{0, 360, true, false}, "none",
         "of axisymmetric bodies: sweeps the half section about the axis, 270 for a body cut open; without it the "
         "section and its mirror image are drawn"},
        fills<&PictureSpec::revolve>},
    PictureKey{{"output.pictures", "ground", flag, "", any_value, default_of_member,
                "a plane below the bodies as they stand at the start, with their shadow; three dimensions only"},
               fills<&PictureSpec::ground>},
    PictureKey{{"output.pictures", "supports", flag, "", any_value, default_of_member, "what supports hold is hatched"},
               fills<&PictureSpec::supports>},
    PictureKey{{"output.pictures", "cut", table, "", any_value, "none", "a plane that cuts bodies open"}},
};

constexpr std::array pictures_rows{
    PicturesKey{{"output.pictures", "every", quantity, "s", not_negative, "", "time between two pictures; 0 for none"},
                fills<&PicturesSpec::every>},
    PicturesKey{{"output.pictures", "panel", list, "", any_value, "one picture",
                 "[[output.pictures.panel]]: several views or fields beside each other in each picture, at most 16"}},
    PicturesKey{{"output.pictures", "columns", whole, "", closed(1, 16), "as fits", "of panels"},
                fills<&PicturesSpec::columns>},
    PicturesKey{
        {"output.pictures", "times", list, "s", not_negative, "none",
         "one more picture at the end, FIELD-times.png, with the pictures nearest to these times beside each other"}},
};

constexpr std::array cut_rows{
    CutKey{{"output.pictures.cut", "point", point, "m", place_range, "", "a point of the plane"}},
    CutKey{{"output.pictures.cut", "normal", point, "1", place_range, "",
            "towards the side that is taken away, of any length"}},
    CutKey{{"output.pictures.cut", "show", word, "", any_value, default_of_member,
            "clip: that side is not drawn; ghost: it is drawn as a shade", cut_words},
           chooses<&CutPlane::ghost>},
    CutKey{{"output.pictures.cut", "of", word, "", any_value, default_of_member,
            "whether the plane cuts the bodies as they are, or where it lay in them at the start", configuration_words},
           chooses<&CutPlane::in_reference>},
};

constexpr PictureKey caption_row{
    {"output.pictures.panel", "caption", text, "", any_value, "the view, if it has a name", "what stands at the panel"},
    fills<&PictureSpec::caption>};

std::vector<PictureKey> rows_of_panels() {
  constexpr std::array<std::string_view, 4> of_pictures_alone{"up", "size", "theme", "labels"};
  std::vector<PictureKey> rows;
  for (PictureKey row : picture_rows) {
    if (std::find(of_pictures_alone.begin(), of_pictures_alone.end(), row.info.key) != of_pictures_alone.end())
      continue;
    row.info.section = "output.pictures.panel";
    row.info.standard = "as the picture";
    rows.push_back(row);
  }
  rows.push_back(caption_row);
  return rows;
}

std::vector<CutKey> rows_of_cuts() {
  std::vector<CutKey> rows(cut_rows.begin(), cut_rows.end());
  for (CutKey row : cut_rows) {
    row.info.section = "output.pictures.panel.cut";
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

std::span<OutputKey const> output_keys() { return output_rows; }
std::span<PictureKey const> picture_keys() { return picture_rows; }
std::span<PicturesKey const> pictures_keys() { return pictures_rows; }

std::span<PictureKey const> panel_keys() {
  static std::vector<PictureKey> const rows = rows_of_panels();
  return rows;
}

std::span<CutKey const> cut_keys() {
  static std::vector<CutKey> const rows = rows_of_cuts();
  return rows;
}

std::vector<KeyInfo> keys_of_output() {
  return joined_keys(output_keys(), pictures_keys().first(1), picture_keys(), pictures_keys().subspan(1), cut_keys(),
                     panel_keys());
}

}  // namespace piola
