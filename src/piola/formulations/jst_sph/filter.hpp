// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/halo.hpp"
#include "piola/exec/device_loops.hpp"
#include "piola/exec/field_view.hpp"
#include "piola/formulations/jst_sph/state.hpp"
#include "piola/neighbours/loaders.hpp"

/// Filtered volumetric energy: sweeps that read only the kernel. Derivation: docs/theory/jst-sph-filtered.md.
namespace piola::jst_sph::inline PIOLA_BACKEND {

/// sum_{b != a} W_ab f_b
struct KernelSums {
  static constexpr bool smooths = true;
  static constexpr int fields = 1, outer_fields = 1, sums = 1;
  View gathered;

  template <class V>
  PIOLA_INLINE_FN Vec<1, V> own(Index) const {
    return {};
  }
  template <bool Masked, class O, class G, class V>
  PIOLA_INLINE_FN void pair(V* sum, O const&, G const& g, V const* f) const {
    V kernel = g.kernel;
    if constexpr (Masked) kernel = g.weight * kernel;
    sum[0] = sum[0] + kernel * f[0];
  }
  template <bool Masked, class O, class G, class V>
  PIOLA_INLINE_FN void outer(V* sum, O const& own, G const& g, V const* f) const {
    pair<Masked>(sum, own, g, f);
  }
};

/// One pass of the filter S, symmetric and doubly stochastic in the tributary volumes:
///   (S f)_a = f_a (1 - sum_{b != a} s_ab V_b) + sum_{b != a} s_ab V_b f_b,   s_ab = d_a W_ab d_b,
/// of an input that is given as f and, for neighbours, as g = d V f; the output in both forms. The last pass of B also
/// turns its output, the filtered volume ratio Jf, into the pressure q = kappa_f (Jf - 1), and gives that to
/// neighbours.
template <class Loader>
struct Smooth {
  Loader loader;
  KernelSums body;
  ReferenceView V;
  View f, d, sum;
  WriteView f_out, g_out;
  double kappa_filtered;  ///< 0: not the last pass of B
  WriteView q;

  PIOLA_INLINE_FN void operator()(Index i) const {
    Lanes total[1];
    loader(i, body, total);
    Lanes const scaling = d.scalar<Lanes>(i);
    Lanes smooth = f.scalar<Lanes>(i) * (1.0 - sum.scalar<Lanes>(i)) + scaling * total[0];
    f_out.scalar(i, smooth);
    if (kappa_filtered > 0) {
      smooth = kappa_filtered * (smooth - 1.0);
      q.scalar(i, smooth);
    }
    g_out.scalar(i, scaling * V.scalar<Lanes>(i) * smooth);
  }
};

/// q = B* kappa_f (B J - 1), B = S^n, n = filter_passes; S is its own adjoint in the tributary volumes.
template <class Loader>
class Filter {
 public:
  Filter(BodyState& body, Loader const& loader) : b_(body), loader_(loader), halo_{body.halo} {}

  /// The source of the first pass is buffer 0, with valid ghosts; every pass reads one buffer and writes the other.
  void operator()() const {
    constexpr int n = filter_passes;
    for (int k = 0; k < n; ++k) smooth(k, k == 0 ? b_.volume_ratio : b_.filtered_ratio, b_.filtered_ratio, k == n - 1);
    for (int k = n; k < 2 * n; ++k) smooth(k, b_.filtered_pressure, b_.filtered_pressure, false);
  }

 private:
  void smooth(int pass_number, FieldRef const& from, FieldRef const& to, bool last_of_B) const {
    FieldRef const &source = b_.filter_source[pass_number % 2], &next = b_.filter_source[(pass_number + 1) % 2];
    if (pass_number > 0) halo_.refresh(source);
    exec::for_each(b_.slots, Smooth<Loader>{loader_,
                                            {read_neighbours(source)},
                                            read_reference(b_.V),
                                            read(from),
                                            read(b_.filter_scale),
                                            read(b_.filter_sum),
                                            write(to),
                                            write(next),
                                            last_of_B ? b_.constants.kappa_filtered : 0,
                                            write(b_.filtered_pressure)});
  }

  BodyState& b_;
  Loader loader_;
  Halo halo_;
};

}  // namespace piola::jst_sph::inline PIOLA_BACKEND
