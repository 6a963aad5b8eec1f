// SPDX-License-Identifier: Apache-2.0
// Without MPI: one rank. communicator_mpi.cpp is the other one.
#include "piola/base/contracts.hpp"
#include "piola/domain/error_agreement.hpp"
#include <cstring>

namespace piola::comm {

void start() {}
void finish() {}
int rank() { return 0; }
int size() { return 1; }
void send_flags(unsigned) {}
unsigned received_flags() { return 0; }
void allreduce_bytes(void*, std::size_t, std::size_t, Combine) {}
void allreduce_max(double&) {}
void allreduce_or(std::span<double>) {}
std::vector<double> gather(std::span<double const> values) { return {values.begin(), values.end()}; }
void allgather(std::span<double>, std::span<std::size_t const>) {}
void broadcast_bytes(void*, std::size_t) {}
bool all_equal(std::uint64_t) { return true; }
std::vector<std::vector<Index>> alltoall(std::vector<std::vector<Index>> const& to) {
  PIOLA_EXPECTS(to.size() == 1);
  return to;
}
void alltoall_items(void const* out, std::span<Index const> sent, void* in, std::span<Index const> received,
                    std::size_t bytes) {
  PIOLA_EXPECTS(sent.size() == 1 && received.size() == 1 && sent.front() == received.front());
  std::memcpy(in, out, static_cast<std::size_t>(sent.front()) * bytes);
}
void exchange(std::span<Message const>, std::span<Message const>) {}
void send_to(int, int, std::span<double>) {}
Traffic traffic() { return {}; }
CommStatistics comm_statistics() { return {}; }
ErrorReport agree(ErrorReport const& own) { return own; }
std::optional<ErrorReport> agree_within(double, ErrorReport const& own) { return own; }
void abort_all(int) {}

}  // namespace piola::comm
