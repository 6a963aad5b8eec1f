// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/exec/set_up_loop.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/parallel/own_slots.hpp"
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

/// value(slot, c) of all particles in the order of ids; on ranks that share the body on rank 0 alone, elsewhere
/// nothing.
template <class Body, class F>
std::vector<double> in_id_order(Body const& body, int components, F const& value) {
  auto const n = static_cast<std::size_t>(components);
  std::vector<double> all(ranks::own() == 0 ? static_cast<std::size_t>(body.particles()) * n : 0);
  if (!ranks::several()) {
    each_in_id_order(body, components, [&](std::size_t at, Index i, int c) { all[at] = value(i, c); });
    return all;
  }
  Range const own = body.own();
  std::vector<double> mine(static_cast<std::size_t>(own.last - own.first) * n);
  exec_host::for_each_in_set_up(own.last - own.first, [&](Index k) {
    for (std::size_t c = 0; c < n; ++c)
      mine[static_cast<std::size_t>(k) * n + c] = value(own.first + k, static_cast<int>(c));
  });
  SharedSlots{body.slots(), body.particles()}.collect(n, std::move(mine), [&](Range part, std::span<double const> of) {
    exec_host::for_each_in_set_up(part.last - part.first, [&](Index k) {
      auto const id = static_cast<std::size_t>(body.id(part.first + k) - body.body().first);
      for (std::size_t c = 0; c < n; ++c) all[id * n + c] = of[static_cast<std::size_t>(k) * n + c];
    });
  });
  return all;
}

/// The way back: put(slot, c, value) of the particles of this rank. `all`: on ranks that of rank 0.
template <class Body, class F>
void from_id_order(Body const& body, int components, std::span<double const> all, F const& put) {
  auto const n = static_cast<std::size_t>(components);
  if (!ranks::several()) {
    each_in_id_order(body, components, [&](std::size_t at, Index i, int c) { put(i, c, all[at]); });
    return;
  }
  Range const own = body.own();
  auto const mine = SharedSlots{body.slots(), body.particles()}.deal(n, [&](Range part, std::span<double> of) {
    exec_host::for_each_in_set_up(part.last - part.first, [&](Index k) {
      auto const id = static_cast<std::size_t>(body.id(part.first + k) - body.body().first);
      for (std::size_t c = 0; c < n; ++c) of[static_cast<std::size_t>(k) * n + c] = all[id * n + c];
    });
  });
  exec_host::for_each_in_set_up(own.last - own.first, [&](Index k) {
    for (std::size_t c = 0; c < n; ++c)
      put(own.first + k, static_cast<int>(c), mine[static_cast<std::size_t>(k) * n + c]);
  });
}

/// Puts values(slot, c) of a body, of which ranks that share it have their own particles. Collective.
template <class Body, class F>
void save_own(StateWriter& writer, std::string const& name, Body const& body, int components, F const& value) {
  RowsOfRanks rows{static_cast<int>(body.body().first), body.particles(), std::nullopt, components};
  if (!ranks::several()) return writer.put_rows(name, rows, in_id_order(body, components, value));
  auto const n = static_cast<std::size_t>(components);
  Range const own = body.own();
  std::vector<Index> places(static_cast<std::size_t>(own.last - own.first));
  std::vector<double> mine(places.size() * n);
  exec_host::for_each_in_set_up(own.last - own.first, [&](Index k) {
    auto const at = static_cast<std::size_t>(k);
    places[at] = static_cast<Index>(body.id(own.first + k) - body.body().first);
    for (std::size_t c = 0; c < n; ++c) mine[at * n + c] = value(own.first + k, static_cast<int>(c));
  });
  rows.places = places;
  writer.put_rows(name, rows, mine);
}
template <class Body>
void save_own(StateWriter& writer, std::string const& name, Body const& body, FieldRef const& field, int components) {
  save_own(writer, name, body, components, [&](Index i, int c) { return value_at(field, i, c); });
}
template <class Body>
void load_own(StateReader& reader, std::string const& name, Body const& body, FieldRef const& field, int components) {
  std::vector<double> all(ranks::own() == 0 ? static_cast<std::size_t>(body.particles() * components) : 0);
  reader.get_to_deal(name, all);
  from_id_order(body, components, all, [&](Index i, int c, double value) { value_at(field, i, c) = value; });
}

/// Of what says its state in numbers, always as many, and takes it back.
template <class Part>
void load_part(StateReader& reader, std::string const& name, Part& part) {
  std::vector<double> values = part.state();
  reader.get(name, values);
  part.restore(values);
}

}  // namespace piola
