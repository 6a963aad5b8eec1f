// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/blocked_sweeps.hpp"
#include "piola/formulations/nodal/lattice.hpp"
#include "piola/formulations/nodal/quadratic.hpp"
#include <utility>
#if PIOLA_HAS_PACKS && defined(__AVX512F__)
#include <immintrin.h>
#endif

/// For lambdas in loop bodies: sums stay in registers only if the lambdas are inlined.
#define PIOLA_INLINED __attribute__((always_inline))

/// Sums over the neighbours of particles that fill a lattice. Lanes are consecutive particles of rows along the first
/// direction, r = (i, j, k) with i along the row. Weights s P(r) are constants. Sums over j and k come first, once for
/// every particle of a block: over the rows at +-(j, k) even monomials need sums, odd ones differences. Then these are
/// added along i. This needs a third of the loads and operations of a sum over pairs.
namespace piola::nodal::inline PIOLA_BACKEND {

/// s of two particles of a lattice by their squared distance; zero outside the support.
constexpr double lattice_weight(int square) {
  constexpr double distance[6]{0, 1, 1.4142135623730951, 1.7320508075688772, 2, 2.23606797749979};
  if (square < 1 || square > 5) return 0;
  double const inside = 1 - square / (usual_reach * usual_reach);
  return inside * inside / (square * distance[square]);
}

/// Calls f(integral_constant k) for k = 0 ... N - 1.
template <int N, class F>
[[gnu::always_inline]] PIOLA_FN void unrolled(F const& f) {
  [&]<int... n>(std::integer_sequence<int, n...>) PIOLA_INLINED { (f(std::integral_constant<int, n>{}), ...); }
  (std::make_integer_sequence<int, N>{});
}

/// Values of the lanes whose bit is set, zero for the others.
#if PIOLA_HAS_PACKS && defined(__AVX512F__)
PIOLA_FN Lanes load_present(double const* p, std::uint8_t bits) { return Lanes(_mm512_maskz_loadu_pd(bits, p)); }
#elif PIOLA_HAS_PACKS
struct LanesPresent {
  double of[1 << lane_count][lane_count]{};
  constexpr LanesPresent() {
    for (int bits = 0; bits < 1 << lane_count; ++bits)
      for (int l = 0; l < lane_count; ++l) of[bits][l] = (bits >> l) % 2;
  }
};
inline constexpr LanesPresent lanes_present{};
/// Not a product: memory beside a row may hold NaN.
PIOLA_FN Lanes load_present(double const* p, std::uint8_t bits) {
  return select(load<Lanes>(lanes_present.of[bits]) > 0.5, load<Lanes>(p), Lanes(0.0));
}
#else
PIOLA_FN Lanes load_present(double const* p, std::uint8_t bits) { return bits != 0 ? *p : 0.0; }
#endif

/// Quantities summed over j and k: monomials up to degree two in them, the constant first, times i^d / d!.
template <int D>
struct RowSums {
  using T = Quadratic<D - 1>;
  static constexpr int across = T::values;  ///< monomials of j and k
  static constexpr int pairs = LatticeRows<D>::pairs;
  /// Number of particles beside a block whose sums over j and k it needs: whole groups of lanes.
  static constexpr Index margin = (2 + lane_count - 1) / lane_count * lane_count;
  static constexpr Index room = exec::block_size + 2 * margin;

  static constexpr int degree(int m) { return m == 0 ? 0 : m < D ? 1 : 2; }
  static constexpr bool even(int m) { return degree(m) != 1; }
  /// Monomial m at (j, k).
  static constexpr double value(int m, LatticeRow r) {
    if (m == 0) return 1;
    if (m < D) return m == 1 ? r.j : r.k;
    if (m == D) return 0.5 * r.j * r.j;
    return m == D + 1 ? 0.5 * r.k * r.k : 1.0 * r.j * r.k;
  }
  static constexpr LatticeRow row(int h) { return LatticeRows<D>::pair[h]; }
  static constexpr double weight(int d, int h) {
    return lattice_weight(d * d + row(h).j * row(h).j + row(h).k * row(h).k);
  }
  /// Whether sums over rows at +-d contain monomial m.
  static constexpr bool has(int d, int m) {
    if (d > 0 && m == 0) return true;
    for (int h = 0; h < pairs; ++h)
      if (weight(d, h) * value(m, row(h)) != 0) return true;
    return false;
  }
};

/// Both sweeps. Fields are stored component after component.
template <int D>
struct LatticeSums {
  using S = RowSums<D>;
  static constexpr int values = Quadratic<D>::values, used = values + D;
  static constexpr int across = S::across;
  using Buffer = double[S::room];

  LatticeTable table;
  Index slots;
  View x, products, own;  ///< products: x_c mu_J; without data if there is no mu
  View mu, stress;
  bool corrected;  ///< whether there is mu; else N is not computed

  /// out (T_c, N_c) per component c:  T = sum_b s (x_b - x_a) P(r),  N = sum_b s (x_b - x_a) mu_b.
  PIOLA_FN void of_motion(Range b, exec::Scratch const& out) const {
    alignas(64) Buffer q[3 * across];
    for (int c = 0; c < D; ++c) {
      each_with_margin(b, [&](Index i, Index at) PIOLA_INLINED { fill_rows(x, i, c, q, at); });
      for (Index i = b.first; i < b.last; i += lane_count) add_rows(q, i, i - b.first + S::margin, c, out);
      for (int J = 0; J < D && corrected; ++J) {
        convolve(b, products, c * D + J, q);
        for (Index i = b.first; i < b.last; i += lane_count) {
          Lanes const sum = along_row(q, i, i - b.first + S::margin);
          Lanes const rest = lanes_of(x, i)[c] * lanes_of(own, i)[values + J];
          store(Lanes(sum - rest), out.at(i, c * used + values + J));
        }
      }
    }
  }

  /// sum_b s ( Y_b P(-r) + Z_b mu_a ), component c, for the particles of a block.
  PIOLA_FN void of_stress(Range b, int c, double* sums) const {
    alignas(64) Buffer q[5];
    each_with_margin(b, [&](Index i, Index at) PIOLA_INLINED { fill_stress_rows(i, c, q, at); });
    for (Index i = b.first; i < b.last; i += lane_count) {
      std::uint8_t const* const shift = shifts(i);
      Index const at = i - b.first + S::margin;
      Lanes const near = load_present(q[1] + at + 1, shift[0]) + load_present(q[2] + at - 1, shift[1]);
      Lanes const far = load_present(q[3] + at + 2, shift[2]) + load_present(q[4] + at - 2, shift[3]);
      store(Lanes(load<Lanes>(q[0] + at) + near + far), sums + (i - b.first));
    }
    for (int J = 0; J < D && corrected; ++J) {
      convolve(b, stress, c * used + values + J, q);
      for (Index i = b.first; i < b.last; i += lane_count) {
        double* const to = sums + (i - b.first);
        Lanes const sum = along_row(q, i, i - b.first + S::margin);
        store(Lanes(load<Lanes>(to) + sum * lanes_of(mu, i)[J]), to);
      }
    }
  }

 private:
  PIOLA_FN std::uint8_t const* bits(Index i) const {
    return table.present + static_cast<std::ptrdiff_t>(i / lane_count) * LatticeRows<D>::bits;
  }
  PIOLA_FN std::uint8_t const* shifts(Index i) const { return bits(i) + 2 * S::pairs; }
  PIOLA_FN static double const* component(View const& f, Index i, int c) { return f.data + c * f.component_stride + i; }

  /// Calls f(group of lanes, index in buffers) for the block and its margin in the body.
  template <class F>
  PIOLA_FN void each_with_margin(Range b, F const& f) const {
    Index const first = b.first < S::margin ? 0 : b.first - S::margin;
    Index const last = b.last + S::margin < slots ? b.last + S::margin : slots;
    for (Index i = first; i < last; i += lane_count) f(i, i - b.first + S::margin);
  }

  /// q[d across + m]: the field's sums over rows at distance +-d in i, times monomial m.
  PIOLA_FN void fill_rows(View const& field, Index i, int c, Buffer* q, Index at) const {
    double const* const f = component(field, i, c);
    std::uint8_t const* const present = bits(i);
    Lanes sum[3][across];
    Lanes const middle = load<Lanes>(f);
    unrolled<3>([&](auto d) PIOLA_INLINED {
      unrolled<across>([&](auto m) PIOLA_INLINED {
        sum[d][m] = m == 0 && d > 0 ? Lanes(lattice_weight(d * d) * middle) : Lanes(0.0);
      });
    });
    unrolled<S::pairs>([&](auto h) PIOLA_INLINED {
      constexpr LatticeRow r = S::row(h);
      std::ptrdiff_t const to = r.j * table.row + r.k * table.plane;
      Lanes const plus = load_present(f + to, present[2 * h]), minus = load_present(f - to, present[2 * h + 1]);
      Lanes const even = plus + minus, odd = plus - minus;
      unrolled<3>([&](auto d) PIOLA_INLINED {
        unrolled<across>([&](auto m) PIOLA_INLINED {
          constexpr double weight = S::weight(d, h) * S::value(m, r);
          if constexpr (weight != 0) sum[d][m] = sum[d][m] + weight * (S::even(m) ? even : odd);
        });
      });
    });
    unrolled<3>([&](auto d) PIOLA_INLINED {
      unrolled<across>([&](auto m) PIOLA_INLINED {
        if constexpr (S::has(d, m)) store(sum[d][m], q[d * across + m] + at);
      });
    });
  }

  /// Computes T of component c from sums over j and k.
  PIOLA_FN void add_rows(Buffer const* q, Index i, Index at, int c, exec::Scratch const& out) const {
    std::uint8_t const* const shift = shifts(i);
    Lanes const middle = lanes_of(x, i)[c];
    LanesOfField const sums = lanes_of(own, i);
    auto const put = [&](int place, Lanes const& sum)
                         PIOLA_INLINED { store(Lanes(sum - middle * sums[place]), out.at(i, c * used + place)); };
    unrolled<across>([&](auto m) PIOLA_INLINED {
      Lanes const zero(0.0);
      Lanes sum = zero, near[2]{zero, zero}, far[2]{zero, zero};
      if constexpr (S::has(0, m)) sum = load<Lanes>(q[m] + at);
      if constexpr (S::has(1, m)) {
        near[0] = load_present(q[across + m] + at + 1, shift[0]);
        near[1] = load_present(q[across + m] + at - 1, shift[1]);
      }
      if constexpr (S::has(2, m)) {
        far[0] = load_present(q[2 * across + m] + at + 2, shift[2]);
        far[1] = load_present(q[2 * across + m] + at - 2, shift[3]);
      }
      Lanes const near_sum = near[0] + near[1], far_sum = far[0] + far[1];
      put(table.place[0][m], sum + near_sum + far_sum);
      if constexpr (S::degree(m) <= 1) put(table.place[1][m], (near[0] - near[1]) + 2.0 * (far[0] - far[1]));
      if constexpr (S::degree(m) == 0) put(table.place[2][m], 0.5 * near_sum + 2.0 * far_sum);
    });
  }

  /// Sums with the weights alone over j and k: q[d] for rows at +-d.
  PIOLA_FN void convolve(Range b, View const& field, int c, Buffer* q) const {
    each_with_margin(b, [&](Index i, Index at) PIOLA_INLINED {
      double const* const f = component(field, i, c);
      std::uint8_t const* const present = bits(i);
      Lanes const middle = load<Lanes>(f);
      Lanes sum[3]{Lanes(0.0), Lanes(lattice_weight(1) * middle), Lanes(lattice_weight(4) * middle)};
      unrolled<S::pairs>([&](auto h) PIOLA_INLINED {
        constexpr LatticeRow r = S::row(h);
        std::ptrdiff_t const to = r.j * table.row + r.k * table.plane;
        Lanes const both = load_present(f + to, present[2 * h]) + load_present(f - to, present[2 * h + 1]);
        unrolled<3>([&](auto d) PIOLA_INLINED {
          constexpr double weight = S::weight(d, h);
          if constexpr (weight != 0) sum[d] = sum[d] + weight * both;
        });
      });
      unrolled<3>([&](auto d) PIOLA_INLINED { store(sum[d], q[d] + at); });
    });
  }
  PIOLA_FN Lanes along_row(Buffer const* q, Index i, Index at) const {
    std::uint8_t const* const shift = shifts(i);
    Lanes const near = load_present(q[1] + at + 1, shift[0]) + load_present(q[1] + at - 1, shift[1]);
    Lanes const far = load_present(q[2] + at + 2, shift[2]) + load_present(q[2] + at - 2, shift[3]);
    return load<Lanes>(q[0] + at) + near + far;
  }

  /// q: contributions of the row at +-(j, k) to particles of this row at i = 0, +1, -1, +2, -2 before it.
  PIOLA_FN void fill_stress_rows(Index i, int c, Buffer* q, Index at) const {
    std::uint8_t const* const present = bits(i);
    auto const field = [&](int d, int m) PIOLA_INLINED { return component(stress, i, c * used + table.place[d][m]); };
    Lanes even[3], odd[3];  // per |i|: parts even and odd in i
    unrolled<3>([&](auto d) PIOLA_INLINED {
      even[d] = odd[d] = Lanes(0.0);
      if constexpr (d > 0) {
        even[d] = lattice_weight(d * d) * (load<Lanes>(field(0, 0)) + (0.5 * d * d) * load<Lanes>(field(2, 0)));
        odd[d] = (lattice_weight(d * d) * d) * load<Lanes>(field(1, 0));
      }
    });
    unrolled<S::pairs>([&](auto h) PIOLA_INLINED {
      constexpr LatticeRow r = S::row(h);
      std::ptrdiff_t const to = r.j * table.row + r.k * table.plane;
      // sum over both rows of Y P(-r), of one monomial: odd ones change their sign
      auto const both = [&](double const* f, bool symmetric) PIOLA_INLINED {
        Lanes const plus = load_present(f + to, present[2 * h]), minus = load_present(f - to, present[2 * h + 1]);
        return symmetric ? Lanes(plus + minus) : Lanes(minus - plus);
      };
      Lanes still(0.0), slope(0.0);
      unrolled<across>([&](auto m) PIOLA_INLINED {
        constexpr double value = S::value(m, r);
        if constexpr (value != 0) still = still + value * both(field(0, m), S::even(m));
        if constexpr (value != 0 && S::degree(m) <= 1 && S::weight(1, h) != 0)
          slope = slope + value * both(field(1, m), S::even(m));
      });
      Lanes bent(0.0);
      if constexpr (S::weight(1, h) != 0) bent = both(field(2, 0), true);
      unrolled<3>([&](auto d) PIOLA_INLINED {
        constexpr double weight = S::weight(d, h);
        if constexpr (weight != 0) {
          even[d] = even[d] + weight * (still + (0.5 * d * d) * bent);
          odd[d] = odd[d] + (weight * d) * slope;
        }
      });
    });
    store_stress_rows(even, odd, q, at);
  }
  [[gnu::always_inline]] PIOLA_FN static void store_stress_rows(Lanes const (&even)[3], Lanes const (&odd)[3],
                                                                Buffer* q, Index at) {
    store(even[0], q[0] + at);
    store(Lanes(even[1] - odd[1]), q[1] + at);
    store(Lanes(even[1] + odd[1]), q[2] + at);
    store(Lanes(even[2] - odd[2]), q[3] + at);
    store(Lanes(even[2] + odd[2]), q[4] + at);
  }
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
