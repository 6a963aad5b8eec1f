// SPDX-License-Identifier: Apache-2.0
// The passes of JST-SPH for a GPU. Compiled, not yet run: launching them needs fields in device memory. What this file
// proves is that the same source makes device code for every dimension, law and stabilisation.
#include "piola/exec/device_launch.hpp"
#include "piola/formulations/jst_sph/stress_passes.hpp"
#include "piola/materials/laws.hpp"

namespace piola::jst_sph::inline PIOLA_BACKEND {
namespace {

template <int D, class Law>
void launch_law(Range r, UpdateStress<D, Law> const& stress, exec::Scratch const& scratch) {
  exec::for_each(r, exec::WithScratch<UpdateStress<D, Law>>{stress, scratch});
}

template <int D, class... Law>
void launch_laws(Range r, void const* passes, exec::Scratch const& scratch, LawList<Law...>) {
  (launch_law<D>(r, *static_cast<UpdateStress<D, Law> const*>(passes), scratch), ...);
}

template <int D, Biharmonic B>
void launch_forces(Range r, SumForces<D, B, D, ListLoader<D>> const& pass, double* partial) {
  exec::for_each_block(r, exec::LeafSums<ForceTotals<D>::size, SumForces<D, B, D, ListLoader<D>>>{pass, partial});
}

template <int D>
void launch_all(Range r, void const* passes, exec::Scratch const& scratch, double* partial) {
  using Sweep = DifferentiateVelocity<D, D, ListLoader<D>>;
  using Unstabilised = DifferentiateVelocity<D, 0, ListLoader<D>>;
  exec::for_each(r, exec::WithScratch<Sweep>{exec::as<Sweep>(passes), scratch});
  exec::for_each(r, exec::WithScratch<Unstabilised>{*static_cast<Unstabilised const*>(passes), scratch});
  launch_laws<D>(r, passes, scratch, Laws{});
  launch_forces<D, Biharmonic::none>(r, *static_cast<SumForces<D, Biharmonic::none, D, ListLoader<D>> const*>(passes),
                                     partial);
  launch_forces<D, Biharmonic::adjoint>(
      r, *static_cast<SumForces<D, Biharmonic::adjoint, D, ListLoader<D>> const*>(passes), partial);
  launch_forces<D, Biharmonic::literal>(
      r, *static_cast<SumForces<D, Biharmonic::literal, D, ListLoader<D>> const*>(passes), partial);
  exec::for_each(r, *static_cast<AdvanceMomentum<D> const*>(passes));
  exec::for_each(r, *static_cast<ComputeWaveSpeed<D, NeoHookean> const*>(passes));
  exec::for_each(r, exec::WithScratch<StoreDeformation<D>>{*static_cast<StoreDeformation<D> const*>(passes), scratch});
  exec::for_each_item(r.last, *static_cast<HoldSupports const*>(passes));
}

}  // namespace

void launch(int dimension, Range r, void const* passes, exec::Scratch const& scratch, double* partial) {
  if (dimension == 1) launch_all<1>(r, passes, scratch, partial);
  if (dimension == 2) launch_all<2>(r, passes, scratch, partial);
  if (dimension == 3) launch_all<3>(r, passes, scratch, partial);
}

}  // namespace piola::jst_sph::inline PIOLA_BACKEND
