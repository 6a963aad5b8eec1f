// SPDX-License-Identifier: Apache-2.0
#include "support/library_laws.hpp"
#include "piola/materials/piola_strain.h"
#include <algorithm>
#include <cmath>
#include <map>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"  // usual in C
namespace {
namespace neo_hookean {
#define piola_materials laws_of_neo_hookean
#include "../../examples/user-materials/neo_hookean.c"
#undef piola_materials
}  // namespace neo_hookean
namespace voce {
#define piola_materials laws_of_voce
#include "../../examples/user-materials/voce.c"
#undef piola_materials
}  // namespace voce
}  // namespace
#pragma GCC diagnostic pop

namespace piola::testing {

piola_material const& example_neo_hookean() {
  int count = 0;
  return *neo_hookean::laws_of_neo_hookean(PIOLA_MATERIAL_INTERFACE, &count);
}
piola_material const& example_voce() {
  int count = 0;
  return *voce::laws_of_voce(PIOLA_MATERIAL_INTERFACE, &count);
}

MaterialParameters material_of(piola_material const& law, std::vector<double> const& values) {
  static std::map<piola_material const*, int> known;
  auto const found = known.find(&law);
  MaterialParameters m;
  m.law = found != known.end()
              ? found->second
              : add_law({.name = law.name, .about = "", .block = &law, .library = "test"}).value().index;
  known[&law] = m.law;
  std::copy(values.begin(), values.end(), m.value);
  return m;
}

}  // namespace piola::testing
