// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/input/output_keys.hpp"
#include "piola/input/sections.hpp"
#include <algorithm>

namespace piola {
namespace {

/// One word for all bodies, or a table of words by body.
void read_representations(Section const& pictures, std::span<BodySpec const> bodies, Appearance& appearance) {
  Node const* const node = pictures.node().find("as");
  if (node == nullptr) return;
  std::string const key = pictures.name_of("as");
  appearance.as.assign(std::max<std::size_t>(bodies.size(), 1), Representation::automatic);
  auto const read_one = [&](Node const& value, std::string const& name, std::span<Representation> targets) {
    auto const word = read_word({value, name}, to_strings(representation_words), pictures.problems());
    if (!word) return;
    auto const number = std::find(representation_words.begin(), representation_words.end(), *word);
    std::fill(targets.begin(), targets.end(), static_cast<Representation>(number - representation_words.begin()));
  };
  if (!node->is_table()) return read_one(*node, key, appearance.as);
  std::vector<std::string> known;
  for (BodySpec const& body : bodies) known.push_back(body.name);
  for (Node::Entry const& entry : node->entries) {
    auto const body = static_cast<std::size_t>(std::find(known.begin(), known.end(), entry.key) - known.begin());
    std::size_t const count = body < known.size() ? 1 : 0;
    read_one(entry.value, key + "." + entry.key, std::span(appearance.as).subspan(count * body, count));
    if (count == 0)
      pictures.problems().add(entry.place, key + " names the body " + in_quotes(entry.key) +
                                               " (allowed: " + joined(known) + ") - name a body of this case");
  }
}

void read_cut(Section const& section, int dimension, Appearance& appearance) {
  CutPlane cut;
  read_components(section, "point", dimension, cut.point);
  read_direction(section, "normal", dimension, cut.normal);
  read_members(section, cut_keys(), cut);
  section.refuse_unknown();
  appearance.cut = cut;
}

}  // namespace

void read_appearance(Section const& pictures, std::span<BodySpec const> bodies, Appearance& appearance) {
  read_representations(pictures, bodies, appearance);
  int const dimension = bodies.empty() ? 3 : bodies.front().shape.dimension;
  if (auto const cut = pictures.table("cut")) read_cut(*cut, dimension, appearance);
}

}  // namespace piola
