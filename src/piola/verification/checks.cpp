// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/expression.hpp"
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "piola/formulations/renamed_outputs.hpp"
#include "piola/input/document.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/verification/verify.hpp"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace piola {
namespace {

constexpr std::uint64_t most_checks_bytes = 4'000'000;

/// One [[variant]] or [[check]] while it is read.
class Entry {
 public:
  Entry(Node const& table, std::string what, Problems& problems)
      : table_(table), what_(std::move(what)), problems_(problems) {}

  void only(std::vector<std::string> const& known) {
    for (Node::Entry const& e : table_.entries) {
      if (std::find(known.begin(), known.end(), e.key) != known.end()) continue;
      problems_.add(e.place, fmt::format("{} does not know '{}' (known: {}) - {}", what_, e.key, joined(known),
                                         advice_for_name(e.key, known)));
    }
  }
  Node const* find(std::string_view key, bool required) {
    Node const* node = table_.find(key);
    if (!node && required) problems_.add(table_.place, fmt::format("{} needs '{}' - add it", what_, key));
    return node;
  }
  std::string text(std::string_view key, bool required) {
    Node const* node = find(key, required);
    if (!node) return {};
    if (!node->is_text()) wrong(*node, key, "a text in quotes");
    return node->text;
  }
  bool flag(std::string_view key) {
    Node const* node = find(key, false);
    if (node && node->kind != Node::Kind::flag) wrong(*node, key, "true or false");
    return node && node->flag;
  }
  void complain(Node const& node, std::string const& text) { problems_.add(node.place, what_ + ": " + text); }
  void wrong(Node const& node, std::string_view key, std::string_view expected) {
    complain(node, fmt::format("'{}' has the wrong kind ({} is expected) - correct it", key, expected));
  }

 private:
  Node const& table_;
  std::string what_;
  Problems& problems_;
};

/// Names of variants become names of folders (folder_of): invalid ones are rejected.
bool can_be_a_folder(std::string const& name) {
  constexpr std::size_t longest = 100;
  bool const plain = std::none_of(
      name.begin(), name.end(), [](char c) { return c == '\\' || static_cast<unsigned char>(c) < ' ' || c == '\x7f'; });
  bool const bare = name.empty() || name.front() == ' ' || name.back() == ' ' || name == "." || name == "..";
  return plain && !bare && name.size() <= longest;
}

void check_name(Entry& entry, Node const* node, std::vector<CheckVariant> const& before) {
  if (node == nullptr || !node->is_text()) return;
  if (!can_be_a_folder(node->text)) {
    entry.complain(*node, fmt::format("'name' is {}, which cannot name a folder (allowed: 1 to 100 characters without "
                                      "backslashes, line breaks or blanks at the ends, not . or ..) - choose another",
                                      in_quotes(node->text)));
  }
  bool const taken = std::any_of(before.begin(), before.end(),
                                 [&](CheckVariant const& v) { return folder_of(v.name) == folder_of(node->text); });
  if (taken)
    entry.complain(
        *node, fmt::format("the name {} gives the folder of a variant above - choose another", in_quotes(node->text)));
}

void read_override(Entry& entry, Node const& item, CheckVariant& variant) {
  if (item.is_text() && item.text.find('=', 1) != std::string::npos)
    variant.set.push_back(item.text);
  else
    entry.wrong(item, "set", "a list of \"key=value\"");
}

CheckVariant read_variant(Node const& table, std::vector<CheckVariant> const& before, Problems& problems) {
  Entry entry(table, "variant", problems);
  entry.only({"name", "set", "short"});
  CheckVariant variant{entry.text("name", true), {}, entry.flag("short")};
  check_name(entry, entry.find("name", false), before);
  if (Node const* set = entry.find("set", false)) {
    if (!set->is_array()) entry.wrong(*set, "set", "a list of \"key=value\"");
    for (Node const& item : set->items) read_override(entry, item, variant);
  }
  return variant;
}

/// "1 %" is relative, a number is absolute.
void read_tolerance(Entry& entry, Check& check) {
  Node const* node = entry.find("tolerance", check.kind == Check::Kind::within);
  if (!node) return;
  if (node->is_number()) {
    check.tolerance = node->number();
  } else {
    std::string_view text = node->text;
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), check.tolerance);
    std::string_view rest(end, static_cast<std::size_t>(text.data() + text.size() - end));
    while (rest.starts_with(' ')) rest.remove_prefix(1);
    check.relative = true;
    check.tolerance /= 100;
    if (!node->is_text() || error != std::errc() || rest != "%")
      return entry.wrong(*node, "tolerance", "a number, or \"1 %\" of the reference");
  }
  if (!(check.tolerance >= 0) || std::isinf(check.tolerance)) {
    entry.complain(*node, fmt::format("'tolerance' is {}, with which no check could {} (allowed: 0 or more, finite) - "
                                      "give what the source grants",
                                      number_text(check.tolerance), check.tolerance > 0 ? "fail" : "pass"));
  }
}

void read_kind(Entry& entry, Check& check) {
  std::string const word = entry.text("kind", false);
  if (word == "below")
    check.kind = Check::Kind::below;
  else if (word == "above")
    check.kind = Check::Kind::above;
  else if (word == "between")
    check.kind = Check::Kind::between;
  else if (!word.empty() && word != "within")
    entry.wrong(*entry.find("kind", false), "kind", "\"within\", \"below\", \"above\" or \"between\"");
}

// Comparison of two variants: "ratio", or "order" with the `ratio` of their spacings.
void read_comparison(Entry& entry, Check& check) {
  check.relative_to = entry.text("relative_to", entry.find("as", false) != nullptr);
  std::string const word = entry.text("as", !check.relative_to.empty());
  if (word == "ratio")
    check.as = Check::Comparison::ratio;
  else if (word == "order")
    check.as = Check::Comparison::order;
  else if (word == "field_error")
    check.as = Check::Comparison::field_error;
  else if (!word.empty())
    entry.wrong(*entry.find("as", false), "as", "\"order\", \"ratio\" or \"field_error\"");
  Node const* node = entry.find("ratio", check.as == Check::Comparison::order);
  if (node == nullptr) return;
  check.refinement = node->is_number() ? node->number() : 0;
  if (check.as != Check::Comparison::order)
    entry.complain(*node, "'ratio' is only for as = \"order\" - remove it");
  else if (!(check.refinement > 1) || std::isinf(check.refinement))
    entry.wrong(*node, "ratio", "a number above 1: the spacing of the other variant by that of this one");
}

// Comparison point by point: `field` at a `time`, optionally only `where` a condition holds.
void read_field(Entry& entry, Check& check) {
  bool const used = check.as == Check::Comparison::field_error;
  for (char const* key : {"field", "time", "where", "beside"}) {
    Node const* const node = entry.find(key, false);
    if (node && !used) entry.complain(*node, fmt::format("'{}' is only for as = \"field_error\" - remove it", key));
  }
  check.quantity = entry.text("quantity", !used);
  if (!used) return;
  if (Node const* const node = entry.find("quantity", false))
    entry.complain(*node, "'quantity' is not for as = \"field_error\", which compares a 'field' - remove it");
  check.field = current_output_name(entry.text("field", true));
  if (Node const* const node = entry.find("time", true)) {
    Quantity const time = read_quantity(node->is_number() ? exact_text(node->number()) : node->text, "s");
    check.time = time.value;
    if (time.problem) entry.wrong(*node, "time", "a time such as \"0.1 s\"");
  }
  check.beside = entry.text("beside", false);
  check.where = entry.text("where", false);
  try {
    Expression const tried(check.where.empty() ? "1" : check.where);
  } catch (ExpressionError const& error) {
    entry.complain(*entry.find("where", true),
                   fmt::format("'where' {} - correct the condition in X, Y, Z", error.text));
  }
}

std::string reference_text(Entry& entry, Node const& node) {
  if (node.is_number() && std::isfinite(node.number())) return exact_text(node.number());
  if (node.is_text() && !read_any_quantity(node.text).problem) return node.text;
  entry.wrong(node, "reference", "a number, or a number with unit in quotes");
  return {};
}

void read_reference(Entry& entry, Check& check) {
  Node const* const node = entry.find("reference", true);
  if (node == nullptr) return;
  if (check.kind != Check::Kind::between) {
    check.reference = reference_text(entry, *node);
  } else if (!node->is_array() || node->items.size() != 2) {
    entry.wrong(*node, "reference", "[lowest, highest]");
  } else {
    check.reference = reference_text(entry, node->items[0]);
    check.upper = reference_text(entry, node->items[1]);
    if (Node const* const tolerance = entry.find("tolerance", false))
      entry.complain(*tolerance, "'tolerance' is not for kind = \"between\" - remove it");
  }
}

void read_evidence(Entry& entry, Check& check) {
  std::string const word = entry.text("evidence", true);
  auto const& known = evidence_words();
  auto const at = std::find(known.begin(), known.end(), word);
  if (at != known.end())
    check.evidence = static_cast<Evidence>(at - known.begin());
  else if (!word.empty())
    entry.complain(*entry.find("evidence", true), fmt::format("'{}' is no kind of evidence (known: {}) - {}", word,
                                                              joined(known), advice_for_name(word, known)));
}

void read_expectation(Entry& entry, Check& check) {
  std::string const word = entry.text("expected", false);
  if (word.empty()) return;
  check.expected_to_fall_short = word == "falls short";
  if (!check.expected_to_fall_short) entry.wrong(*entry.find("expected", true), "expected", "\"falls short\"");
  if (check.note.empty())
    entry.complain(*entry.find("expected", true),
                   "what is expected to fall short needs a 'note' that says why - add it");
}

bool is_variant(CheckFile const& file, std::string const& name) {
  return std::any_of(file.variants.begin(), file.variants.end(),
                     [&](CheckVariant const& variant) { return variant.name == name; });
}

Check read_check(Node const& table, CheckFile const& file, Problems& problems) {
  Entry entry(table, "check", problems);
  entry.only({"variant", "quantity", "field", "time", "where", "beside", "reference", "tolerance", "kind",
              "relative_to", "as", "ratio", "expected", "evidence", "source", "note"});
  Check check;
  check.variant = entry.text("variant", file.variants.size() > 1);
  if (check.variant.empty() && !file.variants.empty()) check.variant = file.variants.front().name;
  check.source = entry.text("source", true);
  check.note = entry.text("note", false);
  read_kind(entry, check);
  read_tolerance(entry, check);
  read_reference(entry, check);
  read_evidence(entry, check);
  read_comparison(entry, check);
  read_field(entry, check);
  read_expectation(entry, check);
  for (std::string const& name : {check.variant, check.relative_to, check.beside}) {
    if (name.empty() || is_variant(file, name)) continue;
    problems.add(table.place, fmt::format("check: there is no variant '{}' - give the name of a [[variant]]", name));
  }
  if (!check.relative_to.empty() && check.relative_to == check.variant)
    problems.add(table.place, "check: 'relative_to' is the variant itself - name another [[variant]]");
  return check;
}

/// The tables of [[key]]; complains about anything else under that key.
std::vector<Node const*> tables_of(Node const& root, std::string const& key, Problems& problems) {
  std::vector<Node const*> tables;
  Node const* const list = root.find(key);
  if (list == nullptr) return tables;
  for (Node const& item : list->items) {
    if (item.is_table()) tables.push_back(&item);
  }
  if (!list->is_array() || tables.size() != list->items.size())
    problems.add(list->place, fmt::format("'{}' is {} (a list of tables is needed) - write [[{}]] in double brackets",
                                          key, list->is_table() ? "one table" : "a value", key));
  return tables;
}

}  // namespace

std::vector<std::string> const& evidence_words() {
  static std::vector<std::string> const words{"theory",    "finite elements", "experiment",     "paper", "other code",
                                              "own trial", "own refinement",  "own regression", "code"};
  return words;
}

std::string const& evidence_word(Evidence evidence) {
  PIOLA_EXPECTS(static_cast<std::size_t>(evidence) < evidence_words().size());
  return evidence_words()[static_cast<std::size_t>(evidence)];
}

std::string folder_of(std::string variant) {
  std::replace(variant.begin(), variant.end(), '/', '_');
  return variant;
}

CheckFile read_checks(std::filesystem::path const& path) {
  Problems problems;
  CheckFile file;
  auto const document = parse_document(read_input_file(path, most_checks_bytes), path.string(), problems);
  problems.raise_if_any();
  for (Node::Entry const& e : document->root.entries) {
    if (e.key != "variant" && e.key != "check")
      problems.add(e.place, fmt::format("checks do not know '{}' (known: variant, check) - remove it", e.key));
  }
  for (Node const* table : tables_of(document->root, "variant", problems))
    file.variants.push_back(read_variant(*table, file.variants, problems));
  if (file.variants.empty()) file.variants.push_back({"as is", {}, true});
  for (Node const* table : tables_of(document->root, "check", problems))
    file.checks.push_back(read_check(*table, file, problems));
  Node const* const list = document->root.find("check");
  if (list == nullptr || (list->is_array() && list->items.empty()))
    problems.add({path.string(), 0, 0}, "holds no check, so that it could never fail - add a [[check]]");
  problems.raise_if_any();
  return file;
}

}  // namespace piola
