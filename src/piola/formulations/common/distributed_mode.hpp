// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/communicator.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/common/field_checkpoint.hpp"
#include "piola/mechanics/step_limit_modes.hpp"
#include <cstdint>
#include <span>
#include <vector>

/// Vibration modes of a distributed body: D values per local particle, in the order of slots.
namespace piola {

template <class Body>
std::size_t size_of_mode(Body const& body) {
  return static_cast<std::size_t>(body.own().last - body.own().first) *
         static_cast<std::size_t>(body.state().dimension);
}

template <class Body>
std::size_t mode_place(Body const& body, Index slot, int c) {
  return static_cast<std::size_t>(slot - body.own().first) * static_cast<std::size_t>(body.state().dimension) +
         static_cast<std::size_t>(c);
}

/// The largest |u_k| over all ranks. Collective.
template <class Body>
double global_max_norm(Body const& body, std::vector<double> const& u) {
  double most = largest_of(u);
  if (body.shared()) comm::allreduce_max(most);
  return most;
}

/// Calls f(value, number) for the local values of a mode; numbers follow the ids.
template <class Body, class F>
void each_of_mode(Body const& body, std::vector<double>& mode, F const& f) {
  int const D = body.state().dimension;
  exec_host::parallel_for(body.own(), [&](Index slot) {
    auto const number = static_cast<std::uint64_t>(body.id(slot) - body.body().first) * static_cast<unsigned>(D);
    for (int c = 0; c < D; ++c) f(mode[mode_place(body, slot, c)], number + static_cast<unsigned>(c));
  });
}

/// Applies refreshed() to all values. Collective.
template <class Body>
void refresh_mode(Body const& body, std::vector<double>& mode) {
  double const most = global_max_norm(body, mode);
  each_of_mode(body, mode, [&](double& value, std::uint64_t number) { value = refreshed(value, most, number); });
}

/// Gathers on rank 0: `numbers`, then the mode in the order of ids. Collective.
template <class Body>
std::vector<double> with_mode(Body const& body, std::vector<double> numbers, std::vector<double> const& mode) {
  auto const all =
      in_id_order(body, body.state().dimension, [&](Index i, int c) { return mode[mode_place(body, i, c)]; });
  numbers.insert(numbers.end(), all.begin(), all.end());
  return numbers;
}

/// Inverse of with_mode(). Scatters the mode from `of_first` on rank 0 into `mode`; broadcasts and returns the first
/// `numbers` values. Collective.
template <class Body>
std::vector<double> without_mode(Body const& body, std::size_t numbers, std::span<double const> of_first,
                                 std::vector<double>& mode) {
  std::vector<double> received(of_first.begin(), of_first.begin() + static_cast<std::ptrdiff_t>(numbers));
  if (body.shared()) comm::broadcast_bytes(received.data(), numbers * sizeof(double));
  from_id_order(body, body.state().dimension, of_first.subspan(numbers),
                [&](Index i, int c, double value) { mode[mode_place(body, i, c)] = value; });
  return received;
}

}  // namespace piola
