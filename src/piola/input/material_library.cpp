// SPDX-License-Identifier: Apache-2.0
#include "piola/input/material_library.hpp"
#include "piola/base/read_file.hpp"
#include "piola/base/text.hpp"
#include "piola/input/case_files.hpp"
#include "piola/input/document_limits.hpp"
#include "piola/input/sections.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola {
namespace {

constexpr std::array<std::string_view, 5> describing_keys{"name", "about", "range", "lacks", "law"};
constexpr std::array<std::string_view, 2> moduli{"shear_modulus", "bulk_modulus"};
constexpr std::array<std::string_view, 3> number_keys{"value", "source", "checked"};

bool is_one_of(std::string_view key, std::span<std::string_view const> keys) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

std::ptrdiff_t place_of_parameter(LawInfo const& law, std::string_view name) {
  auto const found = std::find_if(law.parameters.begin(), law.parameters.end(),
                                  [&](Parameter const& parameter) { return parameter.name == name; });
  return found == law.parameters.end() ? -1 : found - law.parameters.begin();
}

void refuse_other_keys(Node const& table, std::string const& owner, std::span<std::string_view const> known,
                       Problems& problems) {
  std::vector<std::string> const words = to_strings(known);
  for (Node::Entry const& entry : table.entries)
    if (!is_one_of(entry.key, known))
      problems.add(entry.place, fmt::format("{} is not a key of {} (allowed: {}) - {}", in_quotes(entry.key), owner,
                                            joined(words), advice_for_name(entry.key, words)));
}

void set_key_and_number(Node& table, std::string_view from, std::string_view to, double value) {
  for (Node::Entry& entry : table.entries) {
    if (entry.key != from) continue;
    entry.key = to;
    entry.value.kind = Node::Kind::real;
    entry.value.real = value;
  }
}

/// Reads [[material]] of a library file.
class LibraryMaterialReader {
 public:
  LibraryMaterialReader(Node const& table, MaterialLibrary const& library, Problems& problems)
      : section_(table, "material", problems), library_(library), problems_(problems) {}

  /// Nothing if there is a problem.
  std::optional<LibraryMaterial> read() {
    std::size_t const before = problems_.count();
    read_name();
    material_.about = text("about", "what it is, in one line").value_or("");
    material_.range =
        text("range", "for which rates, temperatures, pressures and shapes the numbers hold").value_or("");
    if (section_.has("lacks")) material_.lacks = text("lacks", "").value_or("");
    Node const* const law = section_.node().find("law");
    if (law == nullptr) section_.report_missing("law", "name of the law", "law = \"johnson_cook\"");
    auto const word = law == nullptr ? std::nullopt : read_word({*law, "material.law"}, law_names(), problems_);
    if (!word) return std::nullopt;
    material_.law = *word;
    read_law(*find_law(*word));
    return problems_.count() == before ? std::optional(std::move(material_)) : std::nullopt;
  }

 private:
  std::optional<std::string> text(std::string_view key, std::string_view about) {
    Node const* const node = section_.node().find(key);
    if (node == nullptr) {
      section_.report_missing(key, about, std::string(key) + " = \"...\"");
      return std::nullopt;
    }
    auto words = read_text({*node, section_.name_of(key)}, problems_);
    if (words && words->empty())
      problems_.add(node->place, section_.name_of(key) + " is empty (allowed: a text) - write it, or remove the key");
    return words;
  }

  void read_name() {
    auto const name = text("name", "how cases call it");
    if (!name || name->empty()) return;
    material_.name = *name;
    std::string problem;
    if (!is_name(*name))
      problem = "(allowed: letters, digits and _, not starting with a digit, at most 64)";
    else if (library_.find(*name) != nullptr)
      problem = "which is taken by another material of the library (allowed: one material per name) - choose another";
    else if (find_law(*name))
      problem = "which is the name of a law (allowed: any other name) - choose another";
    if (!problem.empty())
      problems_.add(section_.place_of("name"), "material.name is " + in_quotes(*name) + " " + problem);
  }

  /// Words and numbers: the table without sources is one that a case could have.
  void read_law(LawInfo const& law) {
    Node plain;
    plain.place = section_.place();
    for (Node::Entry const& entry : section_.node().entries) {
      if (is_one_of(entry.key, describing_keys)) continue;
      plain.entries.push_back(entry);
      bool const is_choice = std::any_of(law.choices.begin(), law.choices.end(),
                                         [&](Choice const& choice) { return choice.name == entry.key; });
      if (is_choice)
        material_.words.push_back({entry.key, entry.value.text});
      else if (place_of_parameter(law, entry.key) >= 0 || is_one_of(entry.key, moduli))
        plain.entries.back().value = read_sourced_number(entry);
    }
    if (!replace_moduli(plain) || incomplete_) return;
    std::vector<std::string> keys = to_strings(describing_keys);
    keys.insert(keys.end(), moduli.begin(), moduli.end());
    MaterialParameters const read = read_law_values(Section(plain, "material", problems_), law, std::move(keys));
    for (LibraryNumber& number : material_.numbers)
      if (auto const at = place_of_parameter(law, number.parameter); at >= 0) number.value = read.value[at];
  }

  /// Adds source and state of a number, whose value is returned.
  Node read_sourced_number(Node::Entry const& entry) {
    std::string const name = section_.name_of(entry.key);
    if (!entry.value.is_table()) {
      problems_.add(entry.value.place,
                    fmt::format("{} is {} (allowed: a table, because every number has a source) - write {} = {{ value "
                                "= ..., source = \"...\", checked = \"read\" }}",
                                name, shown(entry.value), entry.key));
      return entry.value;
    }
    refuse_other_keys(entry.value, name, number_keys, problems_);
    LibraryNumber number{entry.key, 0, "", Checked::unread, entry.value.place};
    if (Node const* const source = part(entry, "source", "key of a source, here or below [sources]"))
      number.source = read_source({*source, name + ".source"});
    if (Node const* const checked = part(entry, "checked", joined(checked_words)))
      if (auto const word = read_word({*checked, name + ".checked"}, to_strings(checked_words), problems_))
        number.checked =
            static_cast<Checked>(std::find(checked_words.begin(), checked_words.end(), *word) - checked_words.begin());
    material_.numbers.push_back(number);
    Node const* const value = part(entry, "value", "the number, in SI units or as a text with a unit");
    incomplete_ = incomplete_ || value == nullptr;
    return value != nullptr ? *value : entry.value;
  }

  Node const* part(Node::Entry const& entry, std::string_view key, std::string_view about) {
    Node const* const node = entry.value.find(key);
    if (node == nullptr)
      Section(entry.value, section_.name_of(entry.key), problems_)
          .report_missing(key, about, std::string(key) + " = \"...\"");
    return node;
  }

  std::string read_source(Value const& value) {
    auto key = read_text(value, problems_);
    if (!key || library_.find_source(*key) != nullptr) return key.value_or("");
    std::vector<std::string> known;
    for (LibrarySource const& source : library_.sources) known.push_back(source.key);
    problems_.add(value.node.place,
                  fmt::format("{} is {} (allowed: {}) - choose one of these, or add {} = \"author, title, year\" to "
                              "[sources]",
                              value.name, in_quotes(*key), known_names_text(*key, known), *key));
    return *key;
  }

  /// Young's modulus and Poisson's ratio in place of a shear modulus G and a bulk modulus K, as many sources give
  /// them. Returns whether the table has one of the two pairs, or none.
  bool replace_moduli(Node& plain) {
    Node const *const G = plain.find("shear_modulus"), *const K = plain.find("bulk_modulus");
    if (G == nullptr && K == nullptr) return true;
    bool const mixed = plain.find("youngs_modulus") != nullptr || plain.find("poissons_ratio") != nullptr;
    if (G == nullptr || K == nullptr || mixed) {
      problems_.add((G != nullptr ? G : K)->place,
                    "material has shear_modulus or bulk_modulus (allowed: both of them, without youngs_modulus and "
                    "poissons_ratio) - give one of the two pairs");
      return false;
    }
    auto const shear = read_number({*G, "material.shear_modulus"}, "Pa", positive, problems_);
    auto const bulk = read_number({*K, "material.bulk_modulus"}, "Pa", positive, problems_);
    if (!shear || !bulk) return false;
    set_key_and_number(plain, "shear_modulus", "youngs_modulus", 9 * *bulk * *shear / (3 * *bulk + *shear));
    set_key_and_number(plain, "bulk_modulus", "poissons_ratio", (3 * *bulk - 2 * *shear) / (6 * *bulk + 2 * *shear));
    for (LibraryNumber& number : material_.numbers)
      if (is_one_of(number.parameter, moduli))
        number.parameter = number.parameter == "shear_modulus" ? "youngs_modulus" : "poissons_ratio";
    return true;
  }

  Section section_;
  MaterialLibrary const& library_;
  Problems& problems_;
  LibraryMaterial material_;
  bool incomplete_ = false;  ///< a number without value
};

void read_sources(Node const& table, MaterialLibrary& library, Problems& problems) {
  if (!table.is_table())
    problems.add(table.place, "sources is " + shown(table) + " (allowed: a table) - write [sources]");
  for (Node::Entry const& entry : table.entries) {
    std::string const name = "sources." + entry.key;
    auto const text = read_text({entry.value, name}, problems);
    if (!text) continue;
    LibrarySource const* const other = library.find_source(entry.key);
    if (!is_name(entry.key))
      problems.add(entry.place, in_quotes(entry.key) +
                                    " is not a name (allowed: letters, digits and _) - choose "
                                    "another name");
    else if (text->empty())
      problems.add(entry.value.place, name + " is empty (allowed: a reference) - write author, title, year");
    else if (other == nullptr)
      library.sources.push_back({entry.key, *text});
    else if (other->text != *text)
      problems.add(entry.place, fmt::format("the source {} is in the library with another text (allowed: one text per "
                                            "source) - choose another name",
                                            in_quotes(entry.key)));
  }
}

void read_materials(Node const& list, MaterialLibrary& library, Problems& problems) {
  if (!list.is_list_of_tables()) {
    problems.add(list.place, "material is " + shown(list) + " (allowed: a list of tables) - write [[material]]");
    return;
  }
  for (Node const& table : list.items)
    if (auto material = LibraryMaterialReader(table, library, problems).read())
      library.materials.push_back(std::move(*material));
}

}  // namespace

MaterialLibrary const& material_library() {
  static MaterialLibrary const library = [] {
    MaterialLibrary all;
    Problems problems;
    for (BuiltInLibraryFile const& file : built_in_library_files())
      read_library_file(file.text, std::string(file.name), all, problems);
    problems.raise_if_any();
    for (LibraryMaterial& material : all.materials)
      for (LibraryNumber& number : material.numbers) number.place = {};  // in files that users do not have
    return all;
  }();
  return library;
}

void read_library_file(std::string_view text, std::string const& name, MaterialLibrary& library, Problems& problems) {
  auto const document = parse_document(text, name, problems);
  if (!document) return;
  constexpr std::array<std::string_view, 2> keys{"material", "sources"};
  refuse_other_keys(document->root, "a library", keys, problems);
  Node const *const sources = document->root.find("sources"), *const materials = document->root.find("material");
  if (sources != nullptr) read_sources(*sources, library, problems);
  if (materials != nullptr) read_materials(*materials, library, problems);
  if (document->root.entries.empty())
    problems.add({name, 0, 0}, "the library is empty (allowed: materials and sources) - add [[material]]");
}

CaseLibrary read_case_library(Section const& top) {
  auto const value = top.find("library");
  if (!value) return std::nullopt;
  MaterialLibrary library = material_library();
  std::size_t const before = top.problems().count();
  auto const items = read_list(*value, 1, 1000, top.problems());
  for (std::size_t k = 0; items && k < items->size(); ++k) {
    Value const& item = (*items)[k];
    if (!read_text(item, top.problems())) continue;
    CaseFile const file = case_file(item.node);
    try {
      read_library_file(read_text_file(file.path, most_case_bytes), file.path.string(), library, top.problems());
    } catch (FileError const& error) {
      top.problems().add(item.node.place, error.what());
    }
  }
  if (top.problems().count() > before) top.problems().raise_if_any();
  return library;
}

}  // namespace piola
