// SPDX-License-Identifier: Apache-2.0
#include "piola/input/renamed_keys.hpp"
#include "piola/base/text.hpp"
#include "piola/formulations/renamed_outputs.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace piola {
namespace {

constexpr std::array keys{
    RenamedKey{"run", "machine", "instruction_set"},
    RenamedKey{"run", "rest", "relax_tolerance"},
    RenamedKey{"run.guards", "strangers", "proximity"},
    RenamedKey{"run.guards", "parting_warn", "strain_drift_warn"},
    RenamedKey{"run.guards", "parting_stop", "strain_drift_stop"},
    RenamedKey{"body.material", "share", "c10_fraction"},
    RenamedKey{"body.formulation", "cell_memory", "stress_retention"},
    RenamedKey{"body.formulation", "initial_pressure_lasts", "initial_pressure_duration"},
    RenamedKey{"body.formulation", "least_mass", "min_mass_ratio"},
    RenamedKey{"body.formulation", "tether", "conversion_separation"},
    RenamedKey{"load", "follows", "follower"},
    RenamedKey{"mirror", "skew", "antisymmetric"},
    RenamedKey{"probe", "least_particles", "min_particles"},
};

constexpr std::array words{
    RenamedWord{"body.formulation", "exchange", "estimates", "kernel_sums"},
    RenamedWord{"body.formulation", "gradient", "printed", "published"},
    RenamedWord{"body.formulation", "interface", "printed", "published"},
    RenamedWord{"body.formulation", "viscosity_form", "printed", "published"},
    RenamedWord{"contact", "law", "printed", "published"},
};

/// Keys whose texts name columns of history.csv, quantities of probes or fields.
constexpr std::array<std::array<std::string_view, 2>, 6> keys_of_outputs{{{"output.frames", "fields"},
                                                                          {"output.pictures", "field"},
                                                                          {"output.pictures.panel", "field"},
                                                                          {"probe", "field"},
                                                                          {"probe", "quantities"},
                                                                          {"quantity", "column"}}};

std::string current_text(std::string_view section, std::string_view key, std::string const& text) {
  auto const word = std::find_if(words.begin(), words.end(), [&](RenamedWord const& w) {
    return w.section == section && w.key == key && w.before == text;
  });
  if (word != words.end()) return std::string(word->now);
  bool const names_output =
      std::find(keys_of_outputs.begin(), keys_of_outputs.end(), std::array{section, key}) != keys_of_outputs.end();
  return names_output ? current_output_name(text) : text;
}

/// Goes through the tables of a document.
class SpellingUpdate {
 public:
  SpellingUpdate(Document& document, Problems& problems) : document_(document), problems_(problems) {}

  void update_table(Node& table, std::string const& section) {
    for (std::size_t k = 0; k < table.entries.size();) {
      Node::Entry& entry = table.entries[k];
      auto const now = renamed_key(section, entry.key);
      if (now && table.find(*now) != nullptr) {
        problems_.add(entry.place,
                      fmt::format("{} is now {}, and both are given (allowed: {}) - remove {}", in_quotes(entry.key),
                                  in_quotes(*now), in_quotes(*now), in_quotes(entry.key)));
        table.entries.erase(table.entries.begin() + static_cast<std::ptrdiff_t>(k));
        continue;
      }
      if (now) {
        note_old_spelling(document_, entry.place, entry.key, *now);
        entry.key = *now;
      }
      update_value(entry.value, section, entry.key);
      ++k;
    }
  }

 private:
  void update_value(Node& value, std::string const& section, std::string const& key) {
    if (value.is_table()) return update_table(value, section_below(section, key));
    for (Node& item : value.items) update_value(item, section, key);
    if (!value.is_text()) return;
    std::string const now = current_text(section, key, value.text);
    if (now == value.text) return;
    note_old_spelling(document_, value.place, value.text, now);
    value.text = now;
    value.text_offset = 0;
  }

  Document& document_;
  Problems& problems_;
};

}  // namespace

std::span<RenamedKey const> renamed_keys() { return keys; }
std::span<RenamedWord const> renamed_words() { return words; }

std::optional<std::string_view> renamed_key(std::string_view section, std::string_view key) {
  auto const found = std::find_if(keys.begin(), keys.end(),
                                  [&](RenamedKey const& k) { return k.section == section && k.before == key; });
  if (found == keys.end()) return std::nullopt;
  return found->now;
}

std::string section_below(std::string_view section, std::string_view key) {
  std::string const above(section == "body.part" ? "body" : section);
  return above.empty() ? std::string(key) : above + "." + std::string(key);
}

void note_old_spelling(Document& document, Place const& place, std::string_view before, std::string_view now) {
  document.old_spellings.push_back(
      {place, fmt::format("{} is now {} - write this, since the next minor release refuses the other",
                          in_quotes(before), in_quotes(now))});
}

void use_current_spellings(Document& document, Problems& problems) {
  std::size_t const before = document.old_spellings.size();
  SpellingUpdate(document, problems).update_table(document.root, "");
  if (document.old_spellings.size() > before) document.source = toml_text(document.root);
}

}  // namespace piola
