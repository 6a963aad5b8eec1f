// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/exec/set_up_loop.hpp"
#include "piola/formulations/formulation.hpp"
#include <string>
#include <vector>

/// How fields and parts of a body go into checkpoints and come back.
namespace piola {

/// f(position in values, slot, component) for the values of the body's particles; threads share the particles.
template <class Body, class F>
void each_in_id_order(Body const& body, int components, F const& f) {
  exec_host::for_each_in_set_up(body.particles(), [&](Index i) {
    for (int c = 0; c < components; ++c)
      f(static_cast<std::size_t>((body.id(i) - body.body().first) * components + c), i, c);
  });
}

template <class Body>
void save_field(StateWriter& writer, std::string const& name, Body const& body, FieldRef const& field, int components) {
  std::vector<double> values(static_cast<std::size_t>(body.particles()) * static_cast<std::size_t>(components));
  each_in_id_order(body, components, [&](std::size_t at, Index i, int c) { values[at] = value_at(field, i, c); });
  writer.put(name, values);
}

template <class Body>
void load_field(StateReader& reader, std::string const& name, Body const& body, FieldRef const& field, int components) {
  std::vector<double> values(static_cast<std::size_t>(body.particles()) * static_cast<std::size_t>(components));
  reader.get(name, values);
  each_in_id_order(body, components, [&](std::size_t at, Index i, int c) { value_at(field, i, c) = values[at]; });
}

/// Of what says its state in numbers, always as many, and takes it back.
template <class Part>
void load_part(StateReader& reader, std::string const& name, Part& part) {
  std::vector<double> values = part.state();
  reader.get(name, values);
  part.restore(values);
}

}  // namespace piola
