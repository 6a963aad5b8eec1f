// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/reproducible_sum.hpp"
#include "piola/exec/threads.hpp"
#include "piola/math/lanes.hpp"
#include <type_traits>

namespace piola {

/// Particles [first, last).
struct Range {
  Index first = 0, last = 0;
};

/// Record of the first particle (lowest id) of a parallel loop whose state is not admissible.
struct FailureSlot {
  static constexpr Index none = 2147483647;
  Index index = none;
  int code = 0;
  std::int64_t const* id = nullptr;  ///< per slot, negative where there is no particle; nullptr: in the order of slots

  void clear() {
    index = none;
    code = 0;
  }
  bool is_after(Index i) const {
    if (index == none || id == nullptr) return i < index;
    return static_cast<std::uint64_t>(id[i]) < static_cast<std::uint64_t>(id[index]);
  }
};

}  // namespace piola

/// Launchers of loops over particles; all OpenMP and CUDA code of such loops is here.
namespace piola::inline PIOLA_BACKEND {
namespace exec {

/// Particles per block, the unit of work of a thread. The scratch of fused sweeps stays in the first-level cache, and
/// partial sums belong to blocks, not threads, so that results do not depend on the number of threads.
inline constexpr Index block_size = 64;

inline Index block_count(Range r) { return (r.last - r.first + block_size - 1) / block_size; }

PIOLA_FN Range block(Range r, Index k) {
  Index const first = r.first + k * block_size;
  return {first, first + block_size < r.last ? first + block_size : r.last};
}

/// Results of the first half of a fused sweep, for the particles of one block: sum c of particle i.
struct Scratch {
  double* data;
  Index first;   ///< particle of data[0]
  Index stride;  ///< between sums
  PIOLA_FN double* at(Index i, int c) const { return data + static_cast<std::ptrdiff_t>(c) * stride + (i - first); }
};

/// The second half of a fused sweep, chosen once per group of particles (its law) and called once per block.
struct PointPass {
  void const* pass;
  void (*run)(void const* pass, Range block, Scratch const& sums);
};

#if defined(__CUDACC__)
inline constexpr unsigned threads_per_block = 128;

template <class Pass>
__global__ void each(Range r, Pass pass) {
  Index const i = r.first + static_cast<Index>(blockIdx.x * threads_per_block + threadIdx.x);
  if (i < r.last) pass(i);
}
template <class Pass>
__global__ void each_block(Range r, Pass pass) {
  Index const k = static_cast<Index>(blockIdx.x * threads_per_block + threadIdx.x);
  if (k < (r.last - r.first + block_size - 1) / block_size) pass(block(r, k), k);
}
inline unsigned grid(Index n) { return (static_cast<unsigned>(n) + threads_per_block - 1) / threads_per_block; }

template <class Pass>
void for_each(Range r, Pass const& pass) {
  static_assert(std::is_trivially_copyable_v<Pass>, "a pass is copied to the device by value");
  if (r.last > r.first) each<<<grid(r.last - r.first), threads_per_block>>>(r, pass);
}
template <class Pass>
void for_each_item(Index n, Pass const& pass) {
  for_each(Range{0, n}, pass);
}
template <class Pass>
void for_each_block(Range r, Pass const& pass) {
  static_assert(std::is_trivially_copyable_v<Pass>, "a pass is copied to the device by value");
  if (r.last > r.first) each_block<<<grid(block_count(r)), threads_per_block>>>(r, pass);
}
#else
/// Threads for the particles of r.
inline int team_size(Range r) { return exec_host::team_size(r.last - r.first); }

/// pass(i) for every group of lanes in r. Ranges start and end at multiples of the lane count.
template <class Pass>
void for_each(Range r, Pass const& pass) {
  static_assert(std::is_trivially_copyable_v<Pass>, "a pass is copied to the device by value");
#pragma omp parallel for schedule(static) num_threads(team_size(r))
  for (Index i = r.first; i < r.last; i += lane_count) pass(i);
}

/// pass(k) for k = 0 ... n - 1, for short lists that are not particles.
template <class Pass>
void for_each_item(Index n, Pass const& pass) {
  static_assert(std::is_trivially_copyable_v<Pass>, "a pass is copied to the device by value");
  for (Index k = 0; k < n; ++k) pass(k);
}

/// pass(block, number of the block) for every block of r.
template <class Pass>
void for_each_block(Range r, Pass const& pass) {
  static_assert(std::is_trivially_copyable_v<Pass>, "a pass is copied to the device by value");
  Index const n = block_count(r);
#pragma omp parallel for schedule(static) num_threads(team_size(r))
  for (Index k = 0; k < n; ++k) pass(block(r, k), k);
}
#endif

/// A sweep over neighbours (sums into scratch) fused block by block with the point-wise pass that uses the sums.
template <class Sweep>
struct Fused {
  Sweep sweep;
  PointPass then;
  void operator()(Range b, Index) const {
    alignas(64) double sums[Sweep::sums * block_size];
    Scratch const scratch{sums, b.first, block_size};
    for (Index i = b.first; i < b.last; i += lane_count) sweep(i, scratch);
    then.run(then.pass, b, scratch);
  }
};

template <class Pass>
void run_point_pass(void const* pass, Range b, Scratch const& sums) {
  for (Index i = b.first; i < b.last; i += lane_count) (*static_cast<Pass const*>(pass))(i, sums);
}
/// The pass without its type, so that a sweep is compiled once for all laws. The pass must outlive the result.
template <class Pass>
PointPass erased(Pass const& pass) {
  return {&pass, &run_point_pass<Pass>};
}

#if !defined(__CUDACC__)
/// sweep(i, scratch) for the lanes of a block, then `then` for the same block: see Fused.
template <class Sweep>
PIOLA_SHARED inline void for_each_then(Range r, Sweep const& sweep, PointPass const& then) {
  for_each_block(r, Fused<Sweep>{sweep, then});
}
#endif

/// N sums over particles.
template <int N>
struct Totals {
  double v[N]{};
};

/// Slots per leaf, the unit of rounded partial sums before reproducible summation. Leaves may have any place in the
/// order of a body, so that partitions can be finely grained.
inline constexpr Index leaf_size = 16;
static_assert(block_size % leaf_size == 0 && leaf_size % lane_count == 0);

inline Index leaf_count(Range r) { return (r.last - r.first + leaf_size - 1) / leaf_size; }

/// Partial sums of one block, leaf by leaf: lanes are added first, then particles, in fixed order.
template <int N, class Pass>
struct LeafSums {
  Pass pass;
  double* partial;  ///< [leaf][N]
  PIOLA_FN void operator()(Range b, Index k) const {
    double* out = partial + static_cast<std::ptrdiff_t>(k) * (block_size / leaf_size * N);
    for (Index first = b.first; first < b.last; first += leaf_size, out += N) {
      Index const last = first + leaf_size < b.last ? first + leaf_size : b.last;
      Lanes sums[N];
      for (int c = 0; c < N; ++c) sums[c] = Lanes(0.0);
      for (Index i = first; i < last; i += lane_count) pass(i, sums);
      for (int c = 0; c < N; ++c) {
        double total = 0;
        for (int l = 0; l < lane_count; ++l) total += lane(sums[c], l);
        out[c] = total;
      }
    }
  }
};

/// Reproducible sums of n partial sums. The bits do not depend on the number of threads or on the order of the leaves.
template <int N>
ReproducibleSums<N> sum_of_partials(double const* partial, Index n) {
  ReproducibleSums<N> sums;
#if defined(__CUDACC__)
  for (Index k = 0; k < n; ++k) sums.add(partial + static_cast<std::ptrdiff_t>(k) * N);
#else
#pragma omp parallel num_threads(exec_host::team_size(n* leaf_size))
  {
    ReproducibleSums<N> own;
#pragma omp for schedule(static) nowait
    for (Index k = 0; k < n; ++k) own.add(partial + static_cast<std::ptrdiff_t>(k) * N);
#pragma omp critical(piola_sums)
    sums.add(own);
  }
#endif
  return sums;
}

template <int N>
Totals<N> add_partials(double const* partial, Index n) {
  ReproducibleSums<N> const sums = sum_of_partials<N>(partial, n);
  Totals<N> r;
  for (int c = 0; c < N; ++c) r.v[c] = sums.value(c);
  return r;
}

/// pass(i, sums): does its work for the lanes at i and adds to N sums; returns the totals. `partial` holds
/// N values per leaf.
template <int N, class Pass>
Totals<N> reduce(Range r, Pass const& pass, double* partial) {
  for_each_block(r, LeafSums<N, Pass>{pass, partial});
  return add_partials<N>(partial, leaf_count(r));
}

/// Records a failure at particle i; the lowest id wins, so the report does not depend on threads or the order in
/// memory.
PIOLA_FN void record(FailureSlot* slot, Index i, int code) {
#if defined(__CUDA_ARCH__)
  if (atomicMin(&slot->index, i) > i) slot->code = code;
#else
#pragma omp critical(piola_failure)
  if (slot->is_after(i)) {
    slot->index = i;
    slot->code = code;
  }
#endif
}

}  // namespace exec
}  // namespace piola::inline PIOLA_BACKEND
