// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/laws.hpp"
#include <gtest/gtest.h>
#include <string>

/// The registered laws as types of a GoogleTest typed test, and their names.
namespace piola::inline PIOLA_BACKEND {

template <class List>
struct TypesOf;
template <class... Law>
struct TypesOf<LawList<Law...>> {
  using type = ::testing::Types<Law...>;
};
struct LawNames {
  template <class Law>
  static std::string GetName(int) {
    return std::string(Law::name);
  }
};

}  // namespace piola::inline PIOLA_BACKEND
