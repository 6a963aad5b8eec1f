// SPDX-License-Identifier: Apache-2.0
// The passes of the nodal formulation for a GPU. Compiled, not yet run: launching them needs fields in device memory.
// What this file proves is that the same source makes device code for every dimension and law.
#include "piola/exec/device_launch.hpp"
#include "piola/formulations/nodal/boundary_passes.hpp"
#include "piola/formulations/nodal/mirror_passes.hpp"
#include "piola/formulations/nodal/stress_points.hpp"

namespace piola::nodal::inline PIOLA_BACKEND {
namespace {

template <class Sweep>
void launch_sweep(Range r, void const* passes, exec::Scratch const& scratch) {
  exec::for_each(r, exec::WithScratch<Sweep>{exec::as<Sweep>(passes), scratch});
}

template <int D, class... Law>
void launch_laws(Range r, void const* passes, exec::Scratch const& scratch, LawList<Law...>) {
  (launch_sweep<UpdateStress<D, Law, false>>(r, passes, scratch), ...);
}

template <class Pass>
void launch_each(Range r, void const* passes) {
  exec::for_each(r, exec::as<Pass>(passes));
}

template <int D>
void launch_all(Range r, void const* passes, exec::Scratch const& scratch) {
  launch_sweep<SumMotion<D>>(r, passes, scratch);
  launch_laws<D>(r, passes, scratch, Laws{});
  launch_each<SumForces<D>>(r, passes);
  launch_sweep<SumLatticeMotion<D>>(r, passes, scratch);
  launch_each<SumLatticeForces<D>>(r, passes);
  launch_sweep<SubtractGradients<D>>(r, passes, scratch);
  launch_each<KickAndDrift<D>>(r, passes);
  launch_each<Kick<D>>(r, passes);
  launch_each<CopyMotion<D>>(r, passes);
  launch_each<CopyLeast>(r, passes);
  launch_each<CopyValues>(r, passes);
  launch_each<TurnLoads<D>>(r, passes);
  launch_each<DriveDirections<D>>(r, passes);
  launch_each<ArriveAlongDirections<D>>(r, passes);
  launch_each<AddLoads<D>>(r, passes);
  launch_each<KeepEven<D>>(r, passes);
  launch_each<StayOnPlanes<D>>(r, passes);
}

}  // namespace

void launch(int dimension, Range r, void const* passes, exec::Scratch const& scratch) {
  if (dimension == 1) launch_all<1>(r, passes, scratch);
  if (dimension == 2) launch_all<2>(r, passes, scratch);
  if (dimension == 3) launch_all<3>(r, passes, scratch);
}

}  // namespace piola::nodal::inline PIOLA_BACKEND
