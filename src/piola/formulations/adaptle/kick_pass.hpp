// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/point_passes.hpp"

/// From the sums at half time to velocities, positions, densities and energies at the end of a step.
namespace piola::adaptle::inline PIOLA_BACKEND {

/// Sums and extrema over the particles of a block: their order in System::partial.
struct BlockMeasures {
  static constexpr int contact = 0, hourglass = 1, rigid = 2, held = 3, load = 4, viscous = 5, artificial = 6, sums = 7,
                       dt = 7, overlap = 8, conversion_requests = 9, axis_crossings = 10, size = 11;
};

/// Data of the particles of a block that the parts of the end of a step share.
struct BlockScratch {
  Index first;
  alignas(64) double L[9][exec::block_size];        ///< velocity gradient [1/s]
  alignas(64) double heat[exec::block_size];        ///< of all sums [W]
  alignas(64) double artificial[exec::block_size];  ///< artificial stress's part of `heat` [W]
  alignas(64) double compression[exec::block_size];

  PIOLA_FN explicit BlockScratch(Index of) : first(of) {}
  PIOLA_FN Mat<3, Lanes> gradient(Group g) const {
    Mat<3, Lanes> r;
    for (int c = 0; c < 9; ++c) r.c[c] = load<Lanes>(L[c] + (g.first - first));
    return r;
  }
  PIOLA_FN Lanes heat_at(Group g) const { return load<Lanes>(heat + (g.first - first)); }
  PIOLA_FN Lanes artificial_at(Group g) const { return load<Lanes>(artificial + (g.first - first)); }
  PIOLA_FN Lanes compression_at(Group g) const { return load<Lanes>(compression + (g.first - first)); }
};

/// Kick and second drift; the velocity gradient, phi (spatial) + (1 - phi) (material), in three dimensions.
template <int D>
struct Kick {
  double dt;
  System s;  ///< optional data: results of spatial sums, supports, loads
  MaterialTable material;
  GradientAtHalfTime half;
  Components mass, force, heat, compression, phi, S_half, pressure, rho_half, turned;
  OwnComponents x, v, a;

  PIOLA_SHARED inline Kick(System const& system, MaterialTable const& table, double step)
      : dt(step),
        s(system),
        material(table),
        half(s),
        mass(read(s.field.mass)),
        force(read(s.field.force)),
        heat(read(s.field.heat)),
        compression(read(s.field.compression)),
        phi(read(s.field.phi)),
        S_half(read(s.field.S_half)),
        pressure(read(s.field.pressure)),
        rho_half(read(s.field.rho_half)),
        turned(read(s.field.turned)),
        x(write(s.field.x)),
        v(write(s.field.v)),
        a(write(s.field.a)) {}

  PIOLA_SHARED PIOLA_FN void operator()(Range block, BlockScratch& scratch, double* m) const {
    using R = SpatialResult;
    each_group(block, [&](Group g) {
      Lanes spatial[R::stride];
      for (Lanes& value : spatial) value = Lanes(0.0);
      if (s.spatial.result != nullptr)
        load_records<R::stride>(s.spatial.result, R::stride, s.spatial.result_of + g.first, spatial);
      accelerate(g, spatial + R::force, m);
      set_gradient(g, spatial + R::L, scratch);
      Index const at = g.first - block.first;
      bool const summed = heat.data != nullptr;
      store(summed ? spatial[R::heat] + heat.scalar<Lanes>(g.first) : spatial[R::heat], scratch.heat + at);
      store(spatial[R::artificial], scratch.artificial + at);
      store(summed ? maximum(spatial[R::compression], compression.scalar<Lanes>(g.first)) : spatial[R::compression],
            scratch.compression + at);
    });
  }

 private:
  PIOLA_FN void accelerate(Group g, Lanes const* spatial, double* m) const {
    Index const i = g.first;
    Lanes const per_mass = 1.0 / mass.scalar<Lanes>(i);
    double acceleration[D][lane_count], after[D][lane_count];
    for (int c = 0; c < D; ++c) {
      Lanes const total = force.data != nullptr ? spatial[c] + force.scalar<Lanes>(i, c) : spatial[c];
      Lanes rate = total * per_mass;
      if (c == 0 && s.settings.axisymmetric) rate = select(half.is_on_axis(i), Lanes(0.0), rate - hoop_pull(i));
      store(rate, acceleration[c]);
      store(v.seen().scalar<Lanes>(i, c) + dt * rate, after[c]);
    }
    if (s.boundary.load != nullptr || s.boundary.held != nullptr)
      for (int l = 0; l < g.count; ++l)
        for (int c = 0; c < D; ++c) guide(i + l, c, acceleration[c][l], after[c][l], m);
    for (int c = 0; c < D; ++c) {
      Lanes const end = load<Lanes>(after[c]);
      a.put(g, load<Lanes>(acceleration[c]), c);
      v.put(g, end, c);
      x.add(g, 0.5 * dt * end, c);
    }
    if (s.settings.axisymmetric) turn_back(g, m);
  }

  /// Radial acceleration by the hoop stress, inwards: that of V sigma_33 / r.
  PIOLA_FN Lanes hoop_pull(Index i) const {
    Lanes const stress = S_half.scalar<Lanes>(i, SymMat<3>::at(2, 2)) - pressure.scalar<Lanes>(i);
    return stress / (rho_half.scalar<Lanes>(i) * half.radius_at(i));
  }

  /// Turns particles beyond the axis, with the radial velocity, and counts those of the whole step.
  PIOLA_FN void turn_back(Group g, double* m) const {
    auto const beyond = x.seen().scalar<Lanes>(g.first) < 0.0;
    Lanes const now = select(beyond, Lanes(1.0), Lanes(0.0));
    for (int l = 0; l < g.count; ++l) m[BlockMeasures::axis_crossings] += lane(now, l) + turned.at(g.first + l);
    if (!any(g.mask() && beyond)) return;
    for (OwnComponents const* field : {&x, &v, &a}) {
      Lanes const value = field->seen().scalar<Lanes>(g.first);
      field->put(g, select(beyond, -value, value));
    }
  }

  /// Applies loads and supports.
  PIOLA_FN void guide(Index i, int c, double& acceleration, double& after, double* m) const {
    double const before = v.at(i, c), own_mass = mass.at(i);
    if (s.boundary.load != nullptr) {
      double const push = s.boundary.load[3 * i + c];
      acceleration += push;
      m[BlockMeasures::load] += own_mass * push * (before + 0.5 * dt * acceleration);
      after = before + dt * acceleration;
    }
    if (s.boundary.held == nullptr) return;
    s.boundary.reaction[3 * i + c] = 0;
    if (s.boundary.held[3 * i + c] == 0) return;
    if (!(dt > 0)) {  // before the first step: initial velocities
      acceleration = 0;
      after = before;
      return;
    }
    double const wanted = (s.boundary.held_velocity[3 * i + c] - before) / dt;
    s.boundary.reaction[3 * i + c] = own_mass * (wanted - acceleration);
    m[BlockMeasures::held] += own_mass * (wanted - acceleration) * (before + 0.5 * dt * wanted);
    acceleration = wanted;
    after = s.boundary.held_velocity[3 * i + c];
  }

 public:
  /// spatial: velocity gradient of the spatial sums.
  PIOLA_FN void set_gradient(Group g, Lanes const* spatial, BlockScratch& scratch) const {
    Index const i = g.first;
    Mat<3, Lanes> L;
    for (int c = 0; c < 9; ++c) L.c[c] = spatial[c];
    Lanes const blend = phi.scalar<Lanes>(i);
    auto const lagrangian = blend < 1.0;
    if (material.used && any(lagrangian)) {
      Mat<3, Lanes> const of_material = half.of_material(i);
      for (int c = 0; c < 9; ++c)
        L.c[c] = select(lagrangian, blend * L.c[c] + (1.0 - blend) * of_material.c[c], L.c[c]);
    }
    half.turn_around_axis(i, L);
    for (int c = 0; c < 9; ++c) store(L.c[c], scratch.L[c] + (i - scratch.first));
  }
};

/// A particle fills its kernel at most: without this limit two isolated particles would increase each other's volume
/// without bound. Of rings the volume and the section are limited, the volume to that of the kernel swept around the
/// axis.
struct FilledKernel {
  bool axisymmetric;
  double least_rho, area, least_radius;
  Components mass;

  FilledKernel(System const& s, BodyConstants const& body)
      : axisymmetric(s.settings.axisymmetric),
        least_rho(body.least_rho),
        area(4 * std::numbers::pi * body.h * body.h),
        least_radius(0.5 * body.spacing),
        mass(read(s.field.mass)) {}

  PIOLA_FN Lanes least_density(Index i, Lanes const& radius) const {
    if (!axisymmetric) return Lanes(least_rho);
    return mass.scalar<Lanes>(i) / (circle(maximum(radius, Lanes(least_radius))) * area);
  }
  /// Least length of the circle of a ring [m].
  PIOLA_FN Lanes least_thickness(Index i, Lanes const& rho) const { return mass.scalar<Lanes>(i) / (rho * area); }
};

/// Updates density, thickness and internal energy to the end of the step.
struct Balance {
  Settings settings;
  double dt;
  FilledKernel filled;
  Components x, mass, phi, active, S_half, pressure, rho_half, volume_half, thickness_half;
  OwnComponents rho, rho_rate, thickness, thickness_rate, energy, energy_rate;

  PIOLA_SHARED inline Balance(System const& s, BodyConstants const& body, double step)
      : settings(s.settings),
        dt(step),
        filled(s, body),
        x(read(s.field.x)),
        mass(read(s.field.mass)),
        phi(read(s.field.phi)),
        active(read(s.field.active)),
        S_half(read(s.field.S_half)),
        pressure(read(s.field.pressure)),
        rho_half(read(s.field.rho_half)),
        volume_half(read(s.field.volume_half)),
        thickness_half(read(s.field.thickness_half)),
        rho(write(s.field.rho)),
        rho_rate(write(s.field.rho_rate)),
        thickness(write(s.field.thickness)),
        thickness_rate(write(s.field.thickness_rate)),
        energy(write(s.field.energy)),
        energy_rate(write(s.field.energy_rate)) {}

  PIOLA_SHARED PIOLA_FN void operator()(Range block, BlockScratch const& scratch) const {
    each_group(block, [&](Group g) {
      Index const i = g.first;
      Mat<3, Lanes> const L = scratch.gradient(g);
      Lanes const here = rho_half.scalar<Lanes>(i);
      auto const evolves = phi.scalar<Lanes>(i) > 0.0;
      Lanes rate = -here * trace(L);
      Lanes next = select(evolves, rho.seen().scalar<Lanes>(i) + dt * rate, here);
      Lanes const least = filled.least_density(i, x.scalar<Lanes>(i));
      auto const alone = evolves && next < least;
      next = select(alone, least, next);
      rate = select(alone && rate < 0.0, Lanes(0.0), rate);
      rho.put(g, next);
      rho_rate.put(g, rate);
      Lanes const width = thickness_of<Lanes>(i);
      Lanes power = select(active.scalar<Lanes>(i) > 0.0, stress_power(i, L) * width, Lanes(0.0)) + scratch.heat_at(g);
      if (settings.viscosity == Viscosity::riemann) power = scratch.heat_at(g);
      energy_rate.put(g, power);
      energy.add(g, dt * power);
      if (thickness.data == nullptr) return;
      thickness_rate.put(g, width * L(2, 2));
      if (settings.axisymmetric)
        thickness.put(g, select(evolves, ring_thickness(i, width * L(2, 2), next), circle(x.scalar<Lanes>(i))));
      else
        thickness.add(g, dt * width * L(2, 2));
    });
  }

  /// At the end of the step, which an Eulerian ring evolves instead of its section.
  PIOLA_FN Lanes ring_thickness(Index i, Lanes const& rate, Lanes const& density) const {
    return maximum(thickness.seen().scalar<Lanes>(i) + dt * rate, filled.least_thickness(i, density));
  }

  /// V sigma : L, over the thickness.
  template <class V>
  PIOLA_FN V stress_power(Index i, Mat<3, V> const& L) const {
    SymMat<3, V> const S = S_half.symmetric<V>(i);
    V const p = pressure.scalar<V>(i);
    V power = (S(0, 0) - p) * L(0, 0) + (S(1, 1) - p) * L(1, 1) + (S(2, 2) - p) * L(2, 2);
    power += S(0, 1) * (L(0, 1) + L(1, 0)) + S(0, 2) * (L(0, 2) + L(2, 0)) + S(1, 2) * (L(1, 2) + L(2, 1));
    return volume_half.scalar<V>(i) * power;
  }

  /// At half time.
  template <class V>
  PIOLA_FN V thickness_of(Index i) const {
    return thickness_half.scalar_or<V>(i, 1.0);
  }
};

}  // namespace piola::adaptle::inline PIOLA_BACKEND
