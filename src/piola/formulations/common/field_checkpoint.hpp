// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/slot_collectives.hpp"
#include "piola/exec/field.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/formulation.hpp"
#include <cstdint>
#include <string>
#include <vector>

/// Saves fields and parts of a body in checkpoints and loads them.
namespace piola {

/// Calls f(position in values, slot, component) for all particles of the body, in a parallel loop.
template <class Body, class F>
void each_in_id_order(Body const& body, int components, F const& f) {
  exec_host::parallel_for(body.particles(), [&](Index i) {
    for (int c = 0; c < components; ++c)
      f(static_cast<std::size_t>((body.id(i) - body.body().first) * components + c), i, c);
  });
}

/// Returns value(slot, c) of the local particles, in the order of slots.
template <class Body, class F>
std::vector<double> in_slot_order(Body const& body, int components, F const& value) {
  auto const n = static_cast<std::size_t>(components);
  Range const own = body.own();
  std::vector<double> mine(static_cast<std::size_t>(own.last - own.first) * n);
  exec_host::parallel_for(own.last - own.first, [&](Index k) {
    for (std::size_t c = 0; c < n; ++c)
      mine[static_cast<std::size_t>(k) * n + c] = value(own.first + k, static_cast<int>(c));
  });
  return mine;
}
/// Inverse of in_slot_order(): calls put(slot, c, value).
template <class Body, class F>
void from_slot_order(Body const& body, int components, std::span<double const> mine, F const& put) {
  auto const n = static_cast<std::size_t>(components);
  Range const own = body.own();
  exec_host::parallel_for(own.last - own.first, [&](Index k) {
    for (std::size_t c = 0; c < n; ++c)
      put(own.first + k, static_cast<int>(c), mine[static_cast<std::size_t>(k) * n + c]);
  });
}

/// Gathers value(slot, c) of all particles on rank 0, in the order of ids; empty on other ranks. Collective.
template <class Body, class F>
std::vector<double> in_id_order(Body const& body, int components, F const& value) {
  auto const n = static_cast<std::size_t>(components);
  std::vector<double> all(comm::rank() == 0 ? static_cast<std::size_t>(body.particles()) * n : 0);
  if (!comm::is_parallel()) {
    each_in_id_order(body, components, [&](std::size_t at, Index i, int c) { all[at] = value(i, c); });
    return all;
  }
  std::vector<double> mine = in_slot_order(body, components, value);
  DistributedSlots{body.slots(), body.particles()}.collect(
      n, std::move(mine), [&](Range part, std::span<double const> of) {
        exec_host::parallel_for(part.last - part.first, [&](Index k) {
          auto const id = static_cast<std::size_t>(body.id(part.first + k) - body.body().first);
          for (std::size_t c = 0; c < n; ++c) all[id * n + c] = of[static_cast<std::size_t>(k) * n + c];
        });
      });
  return all;
}

/// Inverse of in_id_order(): scatters `all` of rank 0 and calls put(slot, c, value) for the local particles.
/// Collective.
template <class Body, class F>
void from_id_order(Body const& body, int components, std::span<double const> all, F const& put) {
  auto const n = static_cast<std::size_t>(components);
  if (!comm::is_parallel()) {
    each_in_id_order(body, components, [&](std::size_t at, Index i, int c) { put(i, c, all[at]); });
    return;
  }
  auto const mine = DistributedSlots{body.slots(), body.particles()}.deal(n, [&](Range part, std::span<double> of) {
    exec_host::parallel_for(part.last - part.first, [&](Index k) {
      auto const id = static_cast<std::size_t>(body.id(part.first + k) - body.body().first);
      for (std::size_t c = 0; c < n; ++c) of[static_cast<std::size_t>(k) * n + c] = all[id * n + c];
    });
  });
  from_slot_order(body, components, mine, put);
}

/// The rows of the local particles of a body in a table in the order of ids.
class LocalRows {
 public:
  template <class Body>
  explicit LocalRows(Body const& body) : set_(body.body().first), count_(body.particles()) {
    if (!comm::is_parallel()) return;
    Range const own = body.own();
    for (Index i = own.first; i < own.last; ++i) places_.push_back(static_cast<Index>(body.id(i) - body.body().first));
  }
  DistributedRows of(int columns) const {
    DistributedRows rows{set_, count_, std::nullopt, columns};
    if (comm::is_parallel()) rows.places = places_;
    return rows;
  }

 private:
  std::int64_t set_;
  Index count_;
  std::vector<Index> places_;
};

/// Saves a field of a body. Collective.
template <class Body>
void save_local(StateWriter& writer, std::string const& name, Body const& body, FieldRef const& field, int components) {
  LocalRows const rows(body);
  auto const value = [&](Index i, int c) { return value_at(field, i, c); };
  if (!comm::is_parallel()) return writer.put_rows(name, rows.of(components), in_id_order(body, components, value));
  writer.put_rows(name, rows.of(components), in_slot_order(body, components, value));
}
template <class Body>
void load_local(StateReader& reader, std::string const& name, Body const& body, FieldRef const& field, int components) {
  Index const rows = comm::is_parallel() ? body.own().last - body.own().first : body.particles();
  std::vector<double> mine(static_cast<std::size_t>(rows) * static_cast<std::size_t>(components));
  reader.get_rows(name, LocalRows(body).of(components), mine);
  auto const put = [&](Index i, int c, double value) { value_at(field, i, c) = value; };
  comm::is_parallel() ? from_slot_order(body, components, mine, put) : from_id_order(body, components, mine, put);
}

/// Loads a part whose state() is a fixed number of values and which restore() accepts.
template <class Part>
void load_part(StateReader& reader, std::string const& name, Part& part) {
  std::vector<double> values = part.state();
  reader.get(name, values);
  part.restore(values);
}

}  // namespace piola
