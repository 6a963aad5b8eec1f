// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/registry.hpp"
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace piola {

/// A library of material laws cannot be used. what(): the reason, and what to do.
class LawLibraryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The laws of a shared library with the interface piola_material.h, which stays loaded: loaded and added to the
/// registry the first time. Throws LawLibraryError: no such file, not a library, another interface, a description that
/// breaks the rules of the interface. Not for several threads at a time.
std::vector<LawInfo> load_laws(std::filesystem::path const& file);

}  // namespace piola
