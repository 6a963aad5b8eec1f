// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/text.hpp"
#include "piola/input/section.hpp"
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

/// Rows of the schema: a key of the case file with the member of a specification that it fills. From one row come the
/// reading and its messages, the default, the manual, the JSON Schema and options of the command line.
namespace piola {

/// Enumerator or flag whose value is the number of a word in KeyInfo::words.
template <class Spec>
struct WordMember {
  std::size_t (*get)(Spec const&);
  void (*set)(Spec&, std::size_t);
};

/// Number of a limit; the word "off" stands for the value `off`.
template <class Spec>
struct LimitMember {
  double& (*get)(Spec&);
  double off;
};

/// Access to the member that a key fills; none for keys with a reader of their own.
template <class Spec>
using Member = std::variant<std::monostate, double& (*)(Spec&), int& (*)(Spec&), bool& (*)(Spec&),
                            std::string& (*)(Spec&), WordMember<Spec>, LimitMember<Spec>>;

/// Stands in KeyInfo::standard of a row for the value of its member in a default Spec.
inline constexpr std::string_view default_of_member = "=";

template <class Spec>
struct BoundKey {
  KeyInfo info;
  Member<Spec> member = {};
  bool own_reader = false;  ///< read_members() skips it: the member gives the default alone
};

/// The member of `spec` at the end of a path of member pointers.
template <class Spec, auto... path>
constexpr auto& member_in(Spec& spec) {
  return (spec.*....*path);
}

/// Fills the enumerator or flag at the end of a path with the number of the word.
template <auto... path>
struct Chooses {
  template <class Spec>
  constexpr operator Member<Spec>() const {
    return WordMember<Spec>{
        [](Spec const& spec) { return static_cast<std::size_t>(member_in<Spec const, path...>(spec)); },
        [](Spec& spec, std::size_t word) {
          auto& member = member_in<Spec, path...>(spec);
          member = static_cast<std::remove_reference_t<decltype(member)>>(word);
        }};
  }
};
template <auto... path>
inline constexpr Chooses<path...> chooses{};

/// Fills the member at the end of a path, e.g. fills<&PictureSpec::appearance, &Appearance::outline>.
template <auto... path>
struct Fills {
  template <class Spec>
  constexpr operator Member<Spec>() const {
    if constexpr (std::is_enum_v<std::remove_reference_t<decltype(member_in<Spec, path...>(std::declval<Spec&>()))>>)
      return chooses<path...>;
    else
      return &member_in<Spec, path...>;
  }
};
template <auto... path>
inline constexpr Fills<path...> fills{};

/// Fills a limit, or `off` for the word "off".
template <auto... path>
struct Limits {
  double off;
  template <class Spec>
  constexpr operator Member<Spec>() const {
    return LimitMember<Spec>{&member_in<Spec, path...>, off};
  }
};

/// A number as a default: with its unit, unless that is clear.
std::string default_number(double value, std::string_view unit);
/// A view of a text that is kept until the program ends. Called only by the one thread that makes the table of keys.
std::string_view kept_text(std::string text);
/// Reads a number or the word "off".
void read_limit(Section const& section, std::string_view key, double& limit, double off);

/// The default of a row, as the manual shows it.
template <class Spec>
std::string default_text(BoundKey<Spec> const& row) {
  Spec spec{};
  struct Text {
    Spec& spec;
    KeyInfo const& info;
    std::string operator()(std::monostate) const { return ""; }
    std::string operator()(double& (*member)(Spec&)) const { return default_number(member(spec), info.unit); }
    std::string operator()(int& (*member)(Spec&)) const { return std::to_string(member(spec)); }
    std::string operator()(bool& (*member)(Spec&)) const { return member(spec) ? "true" : "false"; }
    std::string operator()(std::string& (*member)(Spec&)) const { return in_quotes(member(spec)); }
    std::string operator()(WordMember<Spec> const& member) const { return in_quotes(info.words[member.get(spec)]); }
    std::string operator()(LimitMember<Spec> const& member) const {
      double const value = member.get(spec);
      return value == member.off ? in_quotes("off") : default_number(value, info.unit);
    }
  };
  return std::visit(Text{spec, row.info}, row.member);
}

/// Appends the rows, with the texts of their defaults, to a table of keys.
template <class Spec>
void add_keys(std::span<BoundKey<Spec> const> rows, std::vector<KeyInfo>& keys) {
  for (BoundKey<Spec> const& row : rows) {
    KeyInfo& info = keys.emplace_back(row.info);
    if (info.standard == default_of_member) info.standard = kept_text(default_text(row));
  }
}

template <class... Specs>
std::vector<KeyInfo> joined_keys(std::span<BoundKey<Specs> const>... rows) {
  std::vector<KeyInfo> keys;
  (add_keys(rows, keys), ...);
  return keys;
}

/// Reads a key that only fills a member. The member of a missing or wrong key keeps its value.
template <class Spec>
void read_member(Section const& section, BoundKey<Spec> const& row, Spec& spec) {
  struct Reader {
    Section const& section;
    std::string_view key;
    Spec& spec;
    void operator()(std::monostate) const {}
    void operator()(double& (*member)(Spec&)) const { section.read(key, member(spec)); }
    void operator()(bool& (*member)(Spec&)) const { section.read(key, member(spec)); }
    void operator()(std::string& (*member)(Spec&)) const { section.read(key, member(spec)); }
    void operator()(int& (*member)(Spec&)) const {
      if (auto const number = section.whole(key)) member(spec) = static_cast<int>(*number);
    }
    void operator()(WordMember<Spec> const& member) const {
      if (int const word = section.word_index(key); word >= 0) member.set(spec, static_cast<std::size_t>(word));
    }
    void operator()(LimitMember<Spec> const& member) const { read_limit(section, key, member.get(spec), member.off); }
  };
  if (!row.own_reader) std::visit(Reader{section, row.info.key, spec}, row.member);
}

/// Reads the keys of a section that only fill a member.
template <class Spec>
void read_members(Section const& section, std::span<BoundKey<Spec> const> rows, std::type_identity_t<Spec>& spec) {
  for (BoundKey<Spec> const& row : rows)
    if (row.info.section == section.name()) read_member(section, row, spec);
}

}  // namespace piola
