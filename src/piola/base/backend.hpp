// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The back end for which a translation unit is compiled: `host` (plain, everything but the loops),
/// `scalar`, `v3`, `v4` (the loops, one instruction set each), `cuda`. All code that may be inlined into loops lives in
/// an inline namespace of that name, so that the same source compiled for several instruction sets fits in one program.
#ifndef PIOLA_BACKEND
#define PIOLA_BACKEND host
#define PIOLA_INLINE_FN PIOLA_FN
#else
#define PIOLA_INLINE_FN __attribute__((always_inline)) PIOLA_FN
#endif
#define PIOLA_TEXT_OF(x) #x
#define PIOLA_TEXT(x) PIOLA_TEXT_OF(x)
#define PIOLA_BACKEND_NAME PIOLA_TEXT(PIOLA_BACKEND)

/// PIOLA_FN: a function for all back ends. PIOLA_INLINE_FN: one that loops call per particle or per pair, which a back
/// end always inlines. g++ 12 reaches its limits of growth in these files, and calls pass tensors of lanes through
/// memory: jst_sph with AVX2 ran at 0.8 of its rate. PIOLA_SHARED: one that loops call once per block, or steps once
/// per body, which is never inlined: it is compiled once, and not once for each law of its callers.
#if defined(__CUDACC__)
#define PIOLA_FN __host__ __device__ inline
#else
#define PIOLA_FN inline
#endif
#define PIOLA_SHARED __attribute__((noinline))
