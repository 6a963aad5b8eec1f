// SPDX-License-Identifier: Apache-2.0
// The passes of AdapTLE for a GPU. Compiled, not yet run: launching them needs fields in device memory. What this file
// proves is that the same source makes device code for both dimensions, every strength and every equation of state.
#include "piola/exec/device_launch.hpp"
#include "piola/formulations/adaptle/step.hpp"

namespace piola::adaptle::inline PIOLA_BACKEND {
namespace {

template <int D, class Law>
void launch_law(Range r, void const* pass) {
  exec::for_each_block(r, exec::as<HalfState<D, false, HalfStress<Law>>>(pass));
  exec::for_each_block(r, exec::as<HalfState<D, true, HalfStress<Law>>>(pass));
  exec::for_each_block(r, exec::as<Finish<D, FinishStress<Law>>>(pass));
}

template <int D, MaterialForm Form>
void launch_material(Range r, void const* pass) {
  exec::for_each_block(r, exec::as<DeformLists<D, Form>>(pass));
  exec::for_each_block(r, exec::as<DeformRows<D, Form>>(pass));
  exec::for_each_block(r, exec::as<ForceLists<D, Form>>(pass));
  exec::for_each_block(r, exec::as<ForceRows<D, Form>>(pass));
}

template <int D, class Shape>
void launch_space(Range r, void const* pass) {
  exec::for_each_block(r, exec::as<SpatialSweep<D, false, false, Shape>>(pass));
  exec::for_each_block(r, exec::as<SpatialSweep<D, false, true, Shape>>(pass));
  exec::for_each_block(r, exec::as<SpatialSweep<D, true, false, Shape>>(pass));
  exec::for_each_block(r, exec::as<SpatialSweep<D, true, true, Shape>>(pass));
  exec::for_each_block(r, exec::as<RiemannSweep<D, Shape>>(pass));
  exec::for_each_block(r, exec::as<CorrectSpatial<D, Shape>>(pass));
}

template <int D>
void launch_all(Range r, void const* pass) {
  launch_law<D, Solid<NoPlasticity, ElasticEos>>(r, pass);
  launch_law<D, Solid<JohnsonCook, MieGrueneisen>>(r, pass);
  launch_law<D, Solid<ZerilliArmstrong, StiffenedGas>>(r, pass);
  launch_law<D, Solid<JohnsonHolmquist, PolynomialEos>>(r, pass);
  launch_law<D, Solid<SteinbergGuinan, MieGrueneisen>>(r, pass);
  launch_law<D, Solid<PerfectPlasticity, JwlEos>>(r, pass);
  launch_material<D, MaterialForm::corrected>(r, pass);
  launch_material<D, MaterialForm::plain>(r, pass);
  launch_material<D, MaterialForm::published>(r, pass);
  launch_material<D, MaterialForm::published_plain>(r, pass);
  launch_space<D, CubicSpline>(r, pass);
  launch_space<D, WendlandC2>(r, pass);
  exec::for_each_block(r, exec::as<Drift<D>>(pass));
  exec::for_each_block(r, exec::as<FoldCorrection<D>>(pass));
  exec::for_each_block(r, exec::as<ContactSweep<D>>(pass));
  exec::for_each_block(r, exec::as<RigidSweep<D>>(pass));
}

}  // namespace

void launch(int dimension, Range r, void const* pass) {
  exec::for_each_block(r, exec::as<FindNeighbours>(pass));
  if (dimension == 2) launch_all<2>(r, pass);
  if (dimension == 3) launch_all<3>(r, pass);
}

}  // namespace piola::adaptle::inline PIOLA_BACKEND
