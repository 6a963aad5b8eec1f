// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/law_library.hpp"
#include "piola/materials/block_law.hpp"
#include "piola/materials/elastic_constants.hpp"
#include <algorithm>
#include <cctype>
#include <cstring>
#include <dlfcn.h>
#include <fmt/format.h>
#include <list>
#include <map>
#include <string>

namespace piola {
namespace {

/// Texts and tables of a law, which LawInfo refers to.
struct LoadedLaw {
  std::string name, file;
  std::vector<Parameter> parameters;
};

bool is_name(char const* text) {
  if (text == nullptr || *text == 0 || std::isdigit(static_cast<unsigned char>(*text)) != 0) return false;
  for (char const* c = text; *c != 0; ++c)
    if (std::isalnum(static_cast<unsigned char>(*c)) == 0 && *c != '_') return false;
  return true;
}

/// Collects what breaks the rules of piola_material.h.
class Examination {
 public:
  Examination(std::string file, piola_material const& law) : file_(std::move(file)), law_(law) {
    if (law.interface_version != PIOLA_MATERIAL_INTERFACE) {
      add(fmt::format("has interface_version {} (allowed: {})", law.interface_version, PIOLA_MATERIAL_INTERFACE));
      return;  // the rest may lie elsewhere
    }
    examine();
  }
  void raise_if_any() const {
    if (!problems_.empty()) throw LawLibraryError(problems_);
  }

 private:
  void add(std::string const& what) {
    problems_ += (problems_.empty() ? "" : "; ") +
                 fmt::format("{}: the law {} {}", file_, is_name(law_.name) ? law_.name : "without a valid name", what);
  }
  void examine() {
    if (!is_name(law_.name)) add("needs a name of letters, digits and _");
    if (law_.stress != PIOLA_FIRST_PIOLA && law_.stress != PIOLA_COROTATED_CAUCHY)
      add(fmt::format("has stress = {} (allowed: PIOLA_FIRST_PIOLA, PIOLA_COROTATED_CAUCHY)", law_.stress));
    if (law_.update == nullptr) add("has no function update");
    count("parameter", law_.parameter_count, law_.parameters != nullptr, BlockLaw::most_parameters);
    count("history", law_.history_count, law_.history != nullptr, BlockLaw::most_history);
    bool const elastic = (law_.properties & PIOLA_ELASTIC) != 0;
    if (elastic && law_.history_count > 0) add("is PIOLA_ELASTIC and has a history (allowed: one of both)");
    if (elastic && (law_.properties & PIOLA_YIELDS) != 0)
      add("is PIOLA_ELASTIC and PIOLA_YIELDS (allowed: one of both)");
    if (!problems_.empty()) return;
    for (int k = 0; k < law_.parameter_count; ++k) parameter(law_.parameters[k], k);
    for (int k = 0; k < law_.history_count; ++k)
      if (!is_name(law_.history[k].name) || law_.history[k].unit == nullptr)
        add(fmt::format("has history value {} without a name of letters, digits and _, or without a unit", k));
  }
  void count(char const* of, int number, bool given, int most) {
    if (number < 0 || number > most || (number > 0 && !given))
      add(fmt::format("has {}_count = {} (allowed: 0 to {}, with a list)", of, number, most));
  }
  void parameter(piola_parameter const& p, int k) {
    if (!is_name(p.name) || p.unit == nullptr || p.meaning == nullptr) {
      add(fmt::format("has parameter {} without a name of letters, digits and _, a unit or a meaning", k));
      return;
    }
    for (std::string_view const taken : {"density", "library", "name", "law"})
      if (p.name == taken) add(fmt::format("has a parameter {}, which is a key of Piola's", taken));
    if (!(p.least <= p.most) || p.preset < p.least || p.preset > p.most)
      add(fmt::format("has the parameter {} with least, most or preset out of order", p.name));
  }

  std::string file_;
  piola_material const& law_;
  std::string problems_;
};

LawInfo added(piola_material const& law, std::filesystem::path const& file) {
  static std::list<LoadedLaw> kept;  // addresses stay
  Examination(file.string(), law).raise_if_any();
  LoadedLaw& of = kept.emplace_back();
  of.file = file.string();
  of.name = fmt::format("{} of {}", law.name, file.filename().string());
  of.parameters.push_back(ElasticConstants::parameters[0]);
  for (int k = 0; k < law.parameter_count; ++k) {
    piola_parameter const& p = law.parameters[k];
    of.parameters.push_back({p.name, p.unit, p.meaning, Interval{p.least, p.most}, p.preset});
  }
  auto const info = add_law({.name = of.name,
                             .about = law.about != nullptr ? law.about : "",
                             .parameters = of.parameters,
                             .block = &law,
                             .library = of.file});
  if (!info) throw LawLibraryError(file.string() + ": too many laws of libraries in one run of the program");
  return *info;
}

std::vector<LawInfo> loaded(std::filesystem::path const& file) {
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw LawLibraryError(fmt::format("cannot load the library: {}", dlerror()));
  decltype(&piola_materials) list = nullptr;
  void* const symbol = dlsym(library, "piola_materials");
  static_assert(sizeof(list) == sizeof(symbol));
  std::memcpy(&list, &symbol, sizeof(list));  // POSIX allows it; C++ has no cast from data to functions
  if (list == nullptr)
    throw LawLibraryError(file.string() +
                          ": it has no function piola_materials() - write one, as piola_material.h says, and keep C++ "
                          "from changing its name: extern \"C\"");
  int count = 0;
  piola_material const* const laws = list(PIOLA_MATERIAL_INTERFACE, &count);
  if (laws == nullptr || count < 1)
    throw LawLibraryError(fmt::format("{}: piola_materials() gives no law for version {} of the interface",
                                      file.string(), PIOLA_MATERIAL_INTERFACE));
  std::vector<LawInfo> infos;
  for (int k = 0; k < count; ++k) infos.push_back(added(laws[k], file));
  return infos;
}

}  // namespace

std::vector<LawInfo> load_laws(std::filesystem::path const& file) {
  static std::map<std::filesystem::path, std::vector<LawInfo>> known;
  std::error_code none;
  auto const path = std::filesystem::canonical(file, none);
  if (none) throw LawLibraryError(fmt::format("no file {} - build the library first", file.string()));
  auto const found = known.find(path);
  if (found != known.end()) return found->second;
  return known[path] = loaded(path);
}

}  // namespace piola
