// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/input/material_library.hpp"
#include "manual.hpp"
#include <fmt/format.h>
#include <vector>

namespace piola::app {
namespace {

/// A number of a set as the program prints it: key, value with its unit, source, how it was checked.
struct Printed {
  std::string_view key;
  std::string value;
  std::string_view source, checked;
};

constexpr int digits = 7;  ///< as many as the longest number of a source has

std::vector<Printed> printed_numbers(LibraryMaterial const& material) {
  std::vector<Printed> lines;
  LawInfo const law = *find_law(material.law);
  for (Parameter const& parameter : law.parameters) {
    for (LibraryNumber const& number : material.numbers) {
      if (number.parameter != parameter.name) continue;
      lines.push_back({parameter.name, quantity_text(number.value, parameter.unit, digits), number.source,
                       checked_text(number.checked)});
    }
  }
  return lines;
}

std::string lacks_text(LibraryMaterial const& material) {
  return material.lacks.empty() ? "nothing that matters in an impact" : std::string(material.lacks);
}

std::string set_section(LibraryMaterial const& material) {
  std::string text = fmt::format("\n## {}\n\n{}; `law = \"{}\"`", material.name, material.about, material.law);
  for (LibraryWord const& word : material.words) text += fmt::format(", `{} = \"{}\"`", word.choice, word.word);
  text += fmt::format(".\n\n- Range: {}.\n- Lacks: {}.\n\n| key | value | source | checked |\n|---|---|---|---|\n",
                      material.range, lacks_text(material));
  for (Printed const& line : printed_numbers(material))
    text += fmt::format("| `{}` | {} | {} | {} |\n", line.key, line.value, line.source, line.checked);
  return text;
}

std::string sources_section() {
  std::string text = "\n## Sources\n\n| source | reference |\n|---|---|\n";
  for (LibrarySource const& source : material_library().sources)
    text += fmt::format("| {} | {} |\n", source.key, source.text);
  return text;
}

std::string library_page() {
  std::string text =
      "# Materials of the library\n\n"
      "This page is written by `piola describe library --markdown`. `material = { name = \"steel_4340\" }` takes a "
      "set;\n"
      "keys beside the name change it. Each number has a source and says how it was checked: `read` in the source,\n"
      "`quoted`: read in another text or program that quotes it, `unread`: seen in no text. Before you rest a result\n"
      "on an unread number, look it up; the range of an unread source was not read either.\n\n"
      "A set with `eos = \"mie_grueneisen\"` takes its bulk modulus from the shock, density times the square of\n"
      "`bulk_sound_speed`; of `youngs_modulus` and `poissons_ratio` it uses the shear modulus alone. The two bulk "
      "moduli\n"
      "differ by measurement: the wave speeds that they give are within 6 % of each other, or the range says so.\n"
      "Fracture strains are those of specimens; in coarse models they depend on the spacing of particles.\n\n";
  text += library_table(Layout::markdown);
  for (LibraryMaterial const& material : material_library().materials) text += set_section(material);
  return text + sources_section();
}

}  // namespace

std::string library_table(Layout layout) {
  bool const markdown = layout == Layout::markdown;
  std::string text = markdown ? "| name | law | what |\n|---|---|---|\n" : "";
  for (LibraryMaterial const& m : material_library().materials) {
    text += markdown ? fmt::format("| `{}` | `{}` | {} |\n", m.name, m.law, m.about)
                     : fmt::format("  {:<27} {}: {}\n", m.name, m.law, m.about);
  }
  return text;
}

std::string describe_set(LibraryMaterial const& material) {
  std::string text = fmt::format("{}\n  {}\n  law = \"{}\"\n", material.name, material.about, material.law);
  for (LibraryWord const& word : material.words) text += fmt::format("  {} = \"{}\"\n", word.choice, word.word);
  for (Printed const& line : printed_numbers(material))
    text +=
        fmt::format("  {:<42}  # {}, {}\n", fmt::format("{} = {}", line.key, line.value), line.source, line.checked);
  text += fmt::format(
      "  range: {}\n  lacks: {}\n  sources (read: the source itself; quoted: a text that quotes it; "
      "unread: no text):\n",
      material.range, lacks_text(material));
  for (LibrarySource const& source : material_library().sources_of(material))
    text += fmt::format("    {}: {}\n", source.key, source.text);
  return text;
}

void refuse_renamed(std::string const& name) {
  if (auto const now = renamed_material(name))
    throw InputError("the material " + in_quotes(name) + " is now " + in_quotes(*now));
}

std::string describe_library(std::string const& name, Layout layout) {
  if (name.empty()) return layout == Layout::markdown ? library_page() : library_table(layout);
  std::vector<std::string> known;
  for (LibraryMaterial const& material : material_library().materials) {
    known.emplace_back(material.name);
    if (name == material.name) return layout == Layout::markdown ? set_section(material) : describe_set(material);
  }
  refuse_renamed(name);
  throw InputError("no material of the library is named " + in_quotes(name) +
                   " (known: " + known_names_text(name, known) + ") - " + advice_for_name(name, known));
}

}  // namespace piola::app
