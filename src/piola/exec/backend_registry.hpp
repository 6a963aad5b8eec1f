// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include <string>
#include <string_view>
#include <vector>

namespace piola::exec_host {

/// Whether this processor supports the instruction set of that name (see base/backend.hpp).
bool processor_can_run(std::string_view backend);

/// The instruction sets of this program that the processor supports, best first.
std::vector<std::string> usable_backends();

/// Describes the instruction set of a run ("auto" too) and of the processor: "v3 of a processor with v4". Two runs have
/// equal bits only if this text is equal. The processor counts too, because mathematical functions of the system choose
/// by processor.
std::string backend_text(std::string_view asked);

/// Error text of an InputError for an instruction set that is not among `usable` (names that end with nullptr).
std::string not_usable(std::string_view backend, char const* const* usable);

/// The back ends of one formulation, one per instruction set of this program that the processor supports. `Backend` has
/// a member `name`; the objects must outlive the choice.
template <class Backend>
class BackendRegistry {
 public:
  /// `all`: best first.
  explicit BackendRegistry(std::vector<Backend const*> const& all) {
    for (Backend const* backend : all) {
      PIOLA_EXPECTS(backend != nullptr);
      if (!processor_can_run(backend->name)) continue;
      usable_.push_back(backend);
      names_.push_back(backend->name);
    }
    names_.push_back(nullptr);
  }
  /// The back end of that name, the best one for "auto"; nullptr if it is not usable here.
  Backend const* find(std::string_view name) const {
    for (Backend const* backend : usable_)
      if (name == "auto" || name == backend->name) return backend;
    return nullptr;
  }
  /// As find(); throws InputError if it is not usable here.
  Backend const& choose(std::string_view name) const {
    if (Backend const* backend = find(name)) return *backend;
    throw InputError(not_usable(name, names()));
  }
  char const* const* names() const { return names_.data(); }

 private:
  std::vector<Backend const*> usable_;
  std::vector<char const*> names_;
};

}  // namespace piola::exec_host

// PIOLA_EACH_BACKEND(use): use(NAME) for every instruction set in this program, best first. Each is defined by a
// formulation's backend.cpp, compiled for that instruction set.
#if defined(PIOLA_HAS_BACKEND_V4)
#define PIOLA_USE_V4(use) use(v4)
#else
#define PIOLA_USE_V4(use)
#endif
#if defined(PIOLA_HAS_BACKEND_V3)
#define PIOLA_USE_V3(use) use(v3)
#else
#define PIOLA_USE_V3(use)
#endif
#if defined(PIOLA_HAS_BACKEND_NATIVE)
#define PIOLA_USE_NATIVE(use) use(native)
#else
#define PIOLA_USE_NATIVE(use)
#endif
#if defined(PIOLA_HAS_BACKEND_SCALAR)
#define PIOLA_USE_SCALAR(use) use(scalar)
#else
#define PIOLA_USE_SCALAR(use)
#endif
#define PIOLA_EACH_BACKEND(use) PIOLA_USE_V4(use) PIOLA_USE_V3(use) PIOLA_USE_NATIVE(use) PIOLA_USE_SCALAR(use)

// PIOLA_CHOOSE_BACKEND(formulation): find_backend(), backend_names() and choose_backend(), which the formulation's
// state.hpp declares.
#define PIOLA_DECLARE_BACKEND(NAME) \
  namespace NAME {                  \
  extern Backend const backend;     \
  }
#define PIOLA_POINT_TO_BACKEND(NAME) &NAME::backend,
#define PIOLA_CHOOSE_BACKEND(FORMULATION)                                                               \
  namespace piola::FORMULATION {                                                                        \
  PIOLA_EACH_BACKEND(PIOLA_DECLARE_BACKEND)                                                             \
  static exec_host::BackendRegistry<Backend> const& backends() {                                        \
    static exec_host::BackendRegistry<Backend> const all({PIOLA_EACH_BACKEND(PIOLA_POINT_TO_BACKEND)}); \
    return all;                                                                                         \
  }                                                                                                     \
  Backend const* find_backend(char const* name) { return backends().find(name); }                       \
  char const* const* backend_names() { return backends().names(); }                                     \
  Backend const& choose_backend(char const* name) { return backends().choose(name); }                   \
  }
