// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/halo.hpp"
#include "piola/exec/device_loops.hpp"
#include "piola/exec/field_view.hpp"
#include "piola/formulations/jst_sph/state.hpp"
#include "piola/neighbours/loaders.hpp"

/// Filtered volumetric energy: sweeps that read only the kernel. Derivation: docs/theory/jst-sph-filtered.md.
namespace piola::jst_sph::inline PIOLA_BACKEND {

/// sum_{b != a} W_ab f_b, or sum_{b != a} W_ab (f_b - f_a), of N values.
template <int N, bool Difference>
struct KernelSums {
  static constexpr bool smooths = true;
  static constexpr int fields = N, outer_fields = N, sums = N;
  View gathered;

  template <class V>
  PIOLA_FN Vec<N, V> own(Index a) const {
    if constexpr (Difference) return gathered.vector<N, V>(a);
    return {};
  }
  template <bool Masked, class O, class G, class V>
  PIOLA_FN void pair(V* sum, O const& own, G const& g, V const* f) const {
    V kernel = g.kernel;
    if constexpr (Masked) kernel = g.weight * kernel;
    for (int c = 0; c < N; ++c) sum[c] = sum[c] + kernel * (Difference ? f[c] - own[c] : f[c]);
  }
  template <bool Masked, class O, class G, class V>
  PIOLA_FN void outer(V* sum, O const& own, G const& g, V const* f) const {
    pair<Masked>(sum, own, g, f);
  }
};

/// Output of the last pass of B: q = kappa_f (Jf - 1), with Jf the smoothed value or, for an evolved volume ratio, Jf
/// plus the smoothed increment.
struct Compression {
  enum class Kind { none, ratio, increment } kind = Kind::none;
  double kappa_filtered = 0;
  View filtered_ratio;
  WriteView filtered_ratio_out, q;
};

/// One pass of the filter S, symmetric and doubly stochastic in the tributary volumes:
///   (S f)_a = f_a (1 - sum_{b != a} s_ab V_b) + sum_{b != a} s_ab V_b f_b,   s_ab = d_a W_ab d_b,
/// of an input that is given as f and, for neighbours, as g = d V f; the output in both forms, or q in both forms.
template <class Loader>
struct Smooth {
  Loader loader;
  KernelSums<1, false> body;
  ReferenceView V;
  View f, d, sum;
  WriteView f_out, g_out;
  Compression compression;

  PIOLA_FN void operator()(Index i) const {
    Lanes total[1];
    loader(i, body, total);
    Lanes const scaling = d.scalar<Lanes>(i);
    Lanes smooth = f.scalar<Lanes>(i) * (1.0 - sum.scalar<Lanes>(i)) + scaling * total[0];
    if (compression.kind == Compression::Kind::none)
      f_out.scalar(i, smooth);
    else
      smooth = compress(i, smooth);
    g_out.scalar(i, scaling * V.scalar<Lanes>(i) * smooth);
  }

 private:
  PIOLA_FN Lanes compress(Index i, Lanes const& smooth) const {
    Lanes ratio = smooth;
    if (compression.kind == Compression::Kind::increment) ratio = ratio + compression.filtered_ratio.scalar<Lanes>(i);
    compression.filtered_ratio_out.scalar(i, ratio);
    Lanes const q = compression.kappa_filtered * (ratio - 1.0);
    compression.q.scalar(i, q);
    return q;
  }
};

/// g = d V f, the neighbour data of the first filter pass.
struct PrepareFilter {
  ReferenceView V;
  View f, d;
  WriteView g;
  PIOLA_FN void operator()(Index i) const { g.scalar(i, d.scalar<Lanes>(i) * V.scalar<Lanes>(i) * f.scalar<Lanes>(i)); }
};

/// q = B* kappa_f (B J - 1), B = S^n; S is its own adjoint in the tributary volumes.
template <class Loader>
class Filter {
 public:
  Filter(BodyState& body, Loader const& loader) : b_(body), loader_(loader), halo_{body.halo} {}

  /// Computes g of the first pass, unless another pass has, and sends it to the ranks with ghosts.
  void prepare() const {
    exec::for_each(b_.slots, PrepareFilter{read_reference(b_.V), read(b_.volume_ratio), read(b_.filter_scale),
                                           write(b_.filter_source[0])});
    halo_.refresh(b_.filter_source[0]);
  }
  /// Jf = B J of the volume ratios, and q.
  void smooth_ratio() const {
    smooth_all(b_.constants.hourglass.bulk_ahead > 0 ? b_.filter_input : b_.volume_ratio, Compression::Kind::ratio);
  }
  /// Jf += B (J increment), and q: for an evolved volume ratio.
  void add_increment() const { smooth_all(b_.ratio_increment, Compression::Kind::increment); }
  /// Writes B J into `out`.
  void smooth_ratio_into(FieldRef const& out) const {
    for (int k = 0; k < b_.constants.filter_passes; ++k)
      smooth(k, k == 0 ? b_.volume_ratio : out, out, Compression::Kind::none);
  }

 private:
  /// The source of the first pass is buffer 0, with valid ghosts; every pass reads one buffer and writes the other.
  void smooth_all(FieldRef const& input, Compression::Kind kind) const {
    int const n = b_.constants.filter_passes;
    FieldRef const& between = kind == Compression::Kind::ratio ? b_.filtered_ratio : b_.ratio_increment;
    for (int k = 0; k < n; ++k)
      smooth(k, k == 0 ? input : between, between, k == n - 1 ? kind : Compression::Kind::none);
    for (int k = n; k < 2 * n; ++k) smooth(k, b_.filtered_pressure, b_.filtered_pressure, Compression::Kind::none);
  }

  void smooth(int pass_number, FieldRef const& from, FieldRef const& to, Compression::Kind kind) const {
    FieldRef const &source = b_.filter_source[pass_number % 2], &next = b_.filter_source[(pass_number + 1) % 2];
    if (pass_number > 0) halo_.refresh(source);
    Compression const compression{kind, b_.constants.kappa_filtered, read(b_.filtered_ratio), write(b_.filtered_ratio),
                                  write(b_.filtered_pressure)};
    exec::for_each(b_.slots, Smooth<Loader>{loader_,
                                            {read_neighbours(source)},
                                            read_reference(b_.V),
                                            read(from),
                                            read(b_.filter_scale),
                                            read(b_.filter_sum),
                                            write(to),
                                            write(next),
                                            compression});
  }

  BodyState& b_;
  Loader loader_;
  Halo halo_;
};

/// v_a = factor sum_{b != a} W_ab (u_b - u_a)   or   v_a = factor sum_{b != a} W_ab f_b + at_zero f_a.
template <int D, bool Difference, class Loader>
struct SumKernel {
  Loader loader;
  KernelSums<D, Difference> body;
  double factor, at_zero;
  View own;
  WriteView out;
  PIOLA_FN void operator()(Index i) const {
    Lanes sum[D];
    loader(i, body, sum);
    for (int c = 0; c < D; ++c) {
      Lanes value = factor * sum[c];
      if constexpr (!Difference) value = value + at_zero * own.scalar<Lanes>(i, c);
      out.scalar(i, value, c);
    }
  }
};

/// f_a = A_a gamma_a: summed by the internal force of the corrected kernel in addition to A_b r.
template <int D>
struct ContractWithGamma {
  View A;
  ReferenceView gamma;
  WriteView out;
  PIOLA_FN void operator()(Index i) const { out.vector<D>(i, A.matrix<D, Lanes>(i) * gamma.vector<D, Lanes>(i)); }
};

}  // namespace piola::jst_sph::inline PIOLA_MACHINE
