// SPDX-License-Identifier: Apache-2.0
// The only place with MPI. communicator_serial.cpp takes its place in builds without it.
#include "piola/base/contracts.hpp"
#include "piola/domain/error_agreement.hpp"
#include "piola/exec/cpu_time.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <map>
#include <mpi.h>
#include <numeric>
#include <thread>
#include <utility>

namespace piola::comm {
namespace {

using Clock = std::chrono::steady_clock;

/// Flags of rank 0 on their way to all ranks.
struct Flags {
  unsigned value = 0;
  bool wait = false;    // they have not travelled yet
  bool travel = false;  // behind the item of the running allreduce
};

struct World {
  bool started = false;
  int own = 0, count = 1;
  MPI_Comm troubles = MPI_COMM_NULL;  // all ranks, too
  MPI_Op op = MPI_OP_NULL;
  Combine combine = nullptr;  // combine function of the running allreduce; global because MPI_Op callbacks take no user
                              // data
  std::size_t bytes = 0;      // per item
  Flags flags;
  std::map<std::size_t, MPI_Datatype> types;  // MPI types of items, by size in bytes
  Traffic traffic;
  CommStatistics spent;
};
World world;

/// Adds its life time to a sum, and the processor time of it to what all of them take.
class Timer {
 public:
  explicit Timer(double& sum) : sum_(sum), start_(Clock::now()), processor_(exec_host::processor_time()) {}
  ~Timer() {
    sum_ += std::chrono::duration<double>(Clock::now() - start_).count();
    world.spent.processor += exec_host::processor_time() - processor_;
  }
  Timer(Timer const&) = delete;
  Timer& operator=(Timer const&) = delete;

 private:
  double& sum_;
  Clock::time_point start_;
  double processor_;
};

/// Waits as MPI does, by asking again and again, which is quickest; after a while it sleeps in between, so that ranks
/// that wait for slower ones leave their core to them where there are more of them than cores.
void wait_for(std::span<MPI_Request> requests) {
  constexpr auto awake = std::chrono::microseconds(100), asleep = std::chrono::microseconds(20);
  auto const start = Clock::now();
  for (int there = 0; there == 0;) {
    MPI_Testall(static_cast<int>(requests.size()), requests.data(), &there, MPI_STATUSES_IGNORE);
    if (there == 0 && Clock::now() - start > awake) std::this_thread::sleep_for(asleep);
  }
}
void wait_for(MPI_Request& request) { wait_for(std::span(&request, 1)); }

/// Called by MPI with items of other ranks.
void combine_items(void* others, void* mine, int* count, MPI_Datatype*) {
  for (int k = 0; k < *count; ++k) {
    std::size_t const at = static_cast<std::size_t>(k) * world.bytes;
    world.combine(static_cast<char const*>(others) + at, static_cast<char*>(mine) + at);
  }
  if (!world.flags.travel) return;
  unsigned flags[2];
  std::memcpy(&flags[0], static_cast<char const*>(others) + world.bytes, sizeof flags[0]);
  std::memcpy(&flags[1], static_cast<char*>(mine) + world.bytes, sizeof flags[1]);
  flags[1] |= flags[0];
  std::memcpy(static_cast<char*>(mine) + world.bytes, &flags[1], sizeof flags[1]);
}

MPI_Datatype type_of(std::size_t bytes) {
  auto const [at, is_new] = world.types.try_emplace(bytes);
  if (is_new) {
    MPI_Type_contiguous(static_cast<int>(bytes), MPI_BYTE, &at->second);
    MPI_Type_commit(&at->second);
  }
  return at->second;
}

/// Whether a launcher has started this process as one of several: MPI is left alone otherwise.
bool launched() {
  for (char const* const size : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MPI_LOCALNRANKS", "SLURM_STEP_NUM_TASKS"})
    if (char const* const text = std::getenv(size); text != nullptr && std::atoi(text) > 1) return true;
  return false;
}

/// Offset of each rank's part, from the number of items per rank.
std::vector<int> starts_of(std::vector<int> const& counts) {
  std::vector<int> starts(counts.size(), 0);
  std::partial_sum(counts.begin(), counts.end() - 1, starts.begin() + 1);
  return starts;
}

/// Allreduce of items of world.bytes bytes by world.combine.
void reduce_items(void* items, std::size_t count, std::size_t bytes) {
  MPI_Request request;
  MPI_Iallreduce(MPI_IN_PLACE, items, static_cast<int>(count), type_of(bytes), world.op, MPI_COMM_WORLD, &request);
  wait_for(request);
}

/// Broadcasts the error of rank `lowest`, the lowest one that has failed.
ErrorReport trouble_of(int lowest, ErrorReport const& own) {
  if (lowest == world.count) return {};
  ErrorReport r = own;
  int sizes[2] = {own.code, static_cast<int>(own.message.size())};
  MPI_Bcast(sizes, 2, MPI_INT, lowest, world.troubles);
  r.code = sizes[0];
  r.message.resize(static_cast<std::size_t>(sizes[1]));
  MPI_Bcast(r.message.data(), sizes[1], MPI_CHAR, lowest, world.troubles);
  if (lowest != 0) r.message = "on rank " + std::to_string(lowest) + ": " + r.message;
  return r;
}

constexpr int halo_tag = 1, carry_tag = 2;
/// MPI counts are ints.
constexpr std::size_t most_items = std::numeric_limits<int>::max();

bool is_rank(int r) { return r >= 0 && r < world.count; }

}  // namespace

void start() {
  PIOLA_EXPECTS(!world.started);
  if (!launched()) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  world.started = true;
  MPI_Comm_rank(MPI_COMM_WORLD, &world.own);
  MPI_Comm_size(MPI_COMM_WORLD, &world.count);
  MPI_Comm_dup(MPI_COMM_WORLD, &world.troubles);
  MPI_Op_create(&combine_items, 1, &world.op);
}

void finish() {
  if (!world.started) return;
  for (auto& [bytes, type] : world.types) MPI_Type_free(&type);
  MPI_Op_free(&world.op);
  MPI_Comm_free(&world.troubles);
  MPI_Finalize();
  world = {};
}

int rank() { return world.own; }
int size() { return world.count; }

void allreduce_bytes(void* items, std::size_t count, std::size_t bytes, Combine combine) {
  PIOLA_EXPECTS(items != nullptr || count == 0);
  PIOLA_EXPECTS(count <= most_items && bytes > 0);
  PIOLA_EXPECTS(combine != nullptr);
  if (!is_parallel()) return;
  Timer const timer(world.spent.in_collectives);
  world.combine = combine;
  world.bytes = bytes;
  world.spent.collectives += 1;
  if (count != 1 || !world.flags.wait) return reduce_items(items, count, bytes);
  // One item, with the flags behind it.
  static std::vector<std::byte> both;
  both.resize(bytes + sizeof world.flags.value);
  std::memcpy(both.data(), items, bytes);
  std::memcpy(both.data() + bytes, &world.flags.value, sizeof world.flags.value);
  world.flags.travel = true;
  reduce_items(both.data(), 1, both.size());
  world.flags.wait = world.flags.travel = false;
  std::memcpy(items, both.data(), bytes);
  std::memcpy(&world.flags.value, both.data() + bytes, sizeof world.flags.value);
}

void send_flags(unsigned own) {
  PIOLA_EXPECTS(is_parallel() && (own == 0 || world.own == 0));
  world.flags = {.value = own, .wait = true};
}

unsigned received_flags() {
  if (std::exchange(world.flags.wait, false)) broadcast_bytes(&world.flags.value, sizeof world.flags.value);
  return world.flags.value;
}

void allreduce_max(double& value) {
  allreduce(value, [](void const* other, void* mine) {
    max_or_nan(*static_cast<double const*>(other), *static_cast<double*>(mine));
  });
}

void allreduce_or(std::span<double> values) {
  PIOLA_EXPECTS(values.size() <= most_items);
  if (!is_parallel() || values.empty()) return;
  static_assert(sizeof(double) == sizeof(std::uint64_t));
  Timer const timer(world.spent.in_collectives);
  world.spent.collectives += 1;
  world.spent.replicated_bytes += static_cast<std::int64_t>(values.size_bytes());
  MPI_Request request;
  MPI_Iallreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_UINT64_T, MPI_BOR, MPI_COMM_WORLD,
                 &request);
  wait_for(request);
}

std::vector<double> gather(std::span<double const> values) {
  PIOLA_EXPECTS(values.size() <= most_items);
  if (!is_parallel()) return {values.begin(), values.end()};
  int const mine = static_cast<int>(values.size());
  std::vector<int> counts(static_cast<std::size_t>(world.count), 0);
  MPI_Gather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
  std::vector<int> const starts = starts_of(counts);
  std::vector<double> all;
  if (world.own == 0) all.resize(static_cast<std::size_t>(starts.back() + counts.back()));
  MPI_Gatherv(values.data(), mine, MPI_DOUBLE, all.data(), counts.data(), starts.data(), MPI_DOUBLE, 0, MPI_COMM_WORLD);
  return all;
}

void allgather(std::span<double> values, std::span<std::size_t const> starts) {
  PIOLA_EXPECTS(!is_parallel() || starts.size() == static_cast<std::size_t>(world.count) + 1);
  PIOLA_EXPECTS(!is_parallel() || (starts.front() == 0 && starts.back() <= values.size()));
  PIOLA_EXPECTS(starts.empty() || starts.back() <= most_items);
  if (!is_parallel()) return;
  world.spent.collectives += 1;
  world.spent.replicated_bytes += static_cast<std::int64_t>(starts.back() * sizeof(double));
  Timer const timer(world.spent.in_collectives);
  std::vector<int> counts, first;
  for (std::size_t r = 0; r + 1 < starts.size(); ++r) {
    first.push_back(static_cast<int>(starts[r]));
    counts.push_back(static_cast<int>(starts[r + 1] - starts[r]));
  }
  MPI_Request request;
  MPI_Iallgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, values.data(), counts.data(), first.data(), MPI_DOUBLE,
                  MPI_COMM_WORLD, &request);
  wait_for(request);
}

void broadcast_bytes(void* data, std::size_t bytes) {
  PIOLA_EXPECTS(bytes <= most_items && (data != nullptr || bytes == 0));
  if (!is_parallel()) return;
  Timer const timer(world.spent.in_collectives);
  world.spent.collectives += 1;
  MPI_Request request;
  MPI_Ibcast(data, static_cast<int>(bytes), MPI_BYTE, 0, MPI_COMM_WORLD, &request);
  wait_for(request);
}

bool all_equal(std::uint64_t number) {
  if (!is_parallel()) return true;
  std::uint64_t both[2]{number, ~number};  // the largest, and the smallest
  MPI_Allreduce(MPI_IN_PLACE, both, 2, MPI_UINT64_T, MPI_MAX, MPI_COMM_WORLD);
  return both[0] == ~both[1];
}

std::vector<std::vector<Index>> alltoall(std::vector<std::vector<Index>> const& to) {
  PIOLA_EXPECTS(to.size() == static_cast<std::size_t>(world.count));
  if (!is_parallel()) return to;
  static_assert(sizeof(Index) == sizeof(int));
  auto const n = static_cast<std::size_t>(world.count);
  std::vector<int> sent(n), received(n);
  std::vector<Index> out;
  for (std::size_t r = 0; r < n; ++r) {
    sent[r] = static_cast<int>(to[r].size());
    out.insert(out.end(), to[r].begin(), to[r].end());
  }
  MPI_Alltoall(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, MPI_COMM_WORLD);
  std::vector<int> const out_at = starts_of(sent), in_at = starts_of(received);
  std::vector<Index> in(static_cast<std::size_t>(in_at.back() + received.back()));
  MPI_Alltoallv(out.data(), sent.data(), out_at.data(), MPI_INT, in.data(), received.data(), in_at.data(), MPI_INT,
                MPI_COMM_WORLD);
  std::vector<std::vector<Index>> from(n);
  for (std::size_t r = 0; r < n; ++r) from[r].assign(in.begin() + in_at[r], in.begin() + in_at[r] + received[r]);
  return from;
}

void alltoall_items(void const* out, std::span<Index const> sent, void* in, std::span<Index const> received,
                    std::size_t bytes) {
  PIOLA_EXPECTS(sent.size() == static_cast<std::size_t>(world.count));
  PIOLA_EXPECTS(received.size() == sent.size());
  Timer const timer(world.spent.in_exchanges);
  std::vector<int> const to(sent.begin(), sent.end()), from(received.begin(), received.end());
  std::vector<int> const to_at = starts_of(to), from_at = starts_of(from);
  MPI_Request request;
  MPI_Ialltoallv(out, to.data(), to_at.data(), type_of(bytes), in, from.data(), from_at.data(), type_of(bytes),
                 MPI_COMM_WORLD, &request);
  wait_for(request);
}

void exchange(std::span<Message const> receives, std::span<Message const> sends) {
  Timer const timer(world.spent.in_exchanges);
  std::vector<MPI_Request> requests(receives.size() + sends.size(), MPI_REQUEST_NULL);
  std::size_t k = 0;
  for (Message const& m : receives) {
    PIOLA_EXPECTS(is_rank(m.rank) && m.rank != world.own && m.count <= most_items);
    MPI_Irecv(m.values, static_cast<int>(m.count), MPI_DOUBLE, m.rank, halo_tag, MPI_COMM_WORLD, &requests[k++]);
  }
  for (Message const& m : sends) {
    PIOLA_EXPECTS(is_rank(m.rank) && m.rank != world.own && m.count <= most_items);
    MPI_Isend(m.values, static_cast<int>(m.count), MPI_DOUBLE, m.rank, halo_tag, MPI_COMM_WORLD, &requests[k++]);
    world.traffic.messages += 1;
    world.traffic.bytes += static_cast<std::int64_t>(m.count * sizeof(double));
  }
  wait_for(requests);
}

void send_to(int from, int to, std::span<double> values) {
  PIOLA_EXPECTS(is_rank(from) && is_rank(to) && from != to);
  PIOLA_EXPECTS(values.size() <= most_items);
  if (!is_parallel() || values.empty() || (world.own != from && world.own != to)) return;
  Timer const timer(world.spent.in_exchanges);
  int const size = static_cast<int>(values.size());
  MPI_Request request;
  if (world.own == from)
    MPI_Isend(values.data(), size, MPI_DOUBLE, to, carry_tag, MPI_COMM_WORLD, &request);
  else
    MPI_Irecv(values.data(), size, MPI_DOUBLE, from, carry_tag, MPI_COMM_WORLD, &request);
  wait_for(request);
}

Traffic traffic() { return world.traffic; }
CommStatistics comm_statistics() { return world.spent; }

ErrorReport agree(ErrorReport const& own) { return *agree_within(std::numeric_limits<double>::infinity(), own); }

std::optional<ErrorReport> agree_within(double seconds, ErrorReport const& own) {
  PIOLA_EXPECTS(seconds > 0);
  if (!is_parallel()) return own;
  // Static: a rank that times out leaves the request pending, and MPI may write to its buffer until the process ends.
  static int lowest;
  lowest = own.code != 0 ? world.own : world.count;
  MPI_Request request;
  MPI_Iallreduce(MPI_IN_PLACE, &lowest, 1, MPI_INT, MPI_MIN, world.troubles, &request);
  auto const start = Clock::now();
  for (int there = 0; there == 0;) {
    MPI_Test(&request, &there, MPI_STATUS_IGNORE);
    if (there != 0) break;
    if (std::chrono::duration<double>(Clock::now() - start).count() > seconds) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return trouble_of(lowest, own);
}

void abort_all(int code) {
  if (world.started) MPI_Abort(MPI_COMM_WORLD, code);
}

}  // namespace piola::comm
