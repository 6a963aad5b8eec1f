// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/input/sections.hpp"
#include <algorithm>

namespace piola {
namespace {

std::vector<std::string> representation_list() {
  auto const words = key_info("output.pictures", "as").words;
  return {words.begin(), words.end()};
}

void read_representation(Section const& pictures, AppearanceSpec& appearance) {
  Node const* const node = pictures.node().find("as");
  if (node == nullptr) return;
  std::string const name = pictures.name_of("as");
  appearance.as = AppearanceSpec{}.as;
  appearance.of_body.clear();
  auto const words = representation_list();
  if (!node->is_table()) {
    if (auto const word = read_word({*node, name}, words, pictures.problems())) appearance.as = *word;
    return;
  }
  for (Node::Entry const& entry : node->entries)
    if (auto const word = read_word({entry.value, name + "." + entry.key}, words, pictures.problems()))
      appearance.of_body.push_back({entry.key, *word, entry.place});
}

void read_cut(Section const& section, int dimension, AppearanceSpec& appearance) {
  AppearanceSpec::Cut cut;
  if (auto const point = read_components(section, "point", dimension)) cut.point = *point;
  if (auto const normal = read_direction(section, "normal", dimension)) cut.normal = *normal;
  cut.ghost = section.word_index("show") == 1;
  cut.in_reference = section.word_index("of") == 1;
  section.refuse_unknown();
  appearance.cut = cut;
}

}  // namespace

void read_appearance(Section const& pictures, std::span<BodySpec const> bodies, AppearanceSpec& appearance) {
  read_representation(pictures, appearance);
  pictures.read("outline", appearance.outline);
  int const dimension = bodies.empty() ? 3 : bodies.front().shape.dimension;
  if (auto const cut = pictures.table("cut")) read_cut(*cut, dimension, appearance);
  for (auto const& [body, word, place] : appearance.of_body) {
    auto const named = [&, &name = body](BodySpec const& known) { return known.name == name; };
    if (std::any_of(bodies.begin(), bodies.end(), named)) continue;
    std::vector<std::string> known;
    for (BodySpec const& spec : bodies) known.push_back(spec.name);
    pictures.problems().add(place, pictures.name_of("as") + " names the body " + in_quotes(body) +
                                       " (allowed: " + joined(known) + ") - name a body of this case");
  }
}

}  // namespace piola
