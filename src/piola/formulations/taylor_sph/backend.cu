// SPDX-License-Identifier: Apache-2.0
// The passes of Taylor-SPH for a GPU. Compiled, not yet run: launching them needs fields in device memory. What this
// file proves is that the same source makes device code for every dimension, kernel and rate-form law.
#include "piola/exec/device_launch.hpp"
#include "piola/formulations/taylor_sph/adjoint_passes.hpp"
#include "piola/formulations/taylor_sph/boundary_passes.hpp"
#include "piola/formulations/taylor_sph/cell_passes.hpp"
#include "piola/formulations/taylor_sph/filter_passes.hpp"
#include "piola/formulations/taylor_sph/momentum_passes.hpp"

namespace piola::taylor_sph::inline PIOLA_BACKEND {
namespace {

template <int D, class Kernel, class Law>
void launch_law(Range r, void const* pass) {
  if constexpr (RateForm<Law>) {
    exec::for_each(r, exec::as<HalfStep<D, Kernel, Law>>(pass));
    exec::for_each(r, exec::as<FullStep<D, Kernel, Law>>(pass));
    exec::for_each(r, exec::as<BoundaryStep<D, Kernel, Law>>(pass));
    if constexpr (D > 1) exec::for_each_block(r, exec::as<DampPatterns<D, Law>>(pass));
  }
}

template <int D, class Law>
void launch_adjoint(Range r, void const* pass) {
  if constexpr (RateForm<Law>) {
    exec::for_each(r, exec::as<CornerForces<D, Law>>(pass));
    exec::for_each_block(r, exec::as<StrainCells<D, Law>>(pass));
    exec::for_each_block(r, exec::as<AdvanceStresses<D, Law>>(pass));
    exec::for_each_block(r, exec::as<CellEnergies<D, Law>>(pass));
  }
}

template <int D, class... Law>
void launch_laws(Range r, void const* pass, LawList<Law...>) {
  (launch_law<D, CubicSpline, Law>(r, pass), ...);
  (launch_law<D, WendlandC2, Law>(r, pass), ...);
  (launch_adjoint<D, Law>(r, pass), ...);
}

template <int D>
void launch_all(Range r, void const* pass) {
  launch_laws<D>(r, pass, Laws{});
  exec::for_each_item(r.last, exec::as<Impose<D>>(pass));
  exec::for_each_block(r, exec::as<PlaceVirtuals<D>>(pass));
  exec::for_each_block(r, exec::as<LargestVolume<D>>(pass));
  exec::for_each_block(r, exec::as<SumMotion<D>>(pass));
  exec::for_each_block(r, exec::as<AdvanceVelocities<D>>(pass));
  exec::for_each_block(r, exec::as<GatherVolumes<D>>(pass));
  exec::for_each(r, exec::as<AddRigidMotion<D>>(pass));
  if constexpr (D > 1) exec::for_each(r, exec::as<MeasurePatterns<D>>(pass));
}

}  // namespace

void launch(int dimension, Range r, void const* pass) {
  if (dimension == 1) launch_all<1>(r, pass);
  if (dimension == 2) launch_all<2>(r, pass);
  if (dimension == 3) launch_all<3>(r, pass);
}

}  // namespace piola::taylor_sph::inline PIOLA_BACKEND
