// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/point_fields.hpp"
#include "piola/formulations/adaptle/reference_pair_sums.hpp"

/// Operations at one particle between the sweeps, a group of lanes at a time. The scheme drifts half a step, evaluates
/// everything once at half time with predicted rates, kicks, and drifts the other half. Law-independent parts are
/// separate structs, so that they are compiled once.
namespace piola::adaptle::inline PIOLA_BACKEND {

/// Factor of the viscosity, never zero: its sign encodes the kernel type.
PIOLA_FN Lanes positive_factor(Lanes const& viscosity) { return maximum(viscosity, Lanes(1e-300)); }

/// Drifts to half time; writes the neighbour data of the first sweep, and clears sums.
template <int D>
struct Drift {
  double dt;
  bool axisymmetric;
  double smallest_radius;
  Components X, weight, a, viscosity, phi, active, thickness, thickness_rate;
  OwnComponents x, v, v_half, thickness_half, force, heat, hourglass, compression, contact, turned;
  double* position;
  MaterialTable material;
  EquationSet equations;
  FailureSlot* failure;

  PIOLA_SHARED inline Drift(System const& s, MaterialTable const& table, double step)
      : dt(step),
        axisymmetric(s.settings.axisymmetric),
        smallest_radius(s.smallest_radius),
        X(read(s.field.X)),
        weight(read(s.field.weight())),
        a(read(s.field.a)),
        viscosity(read(s.field.viscosity)),
        phi(read(s.field.phi)),
        active(read(s.field.active)),
        thickness(read(s.field.thickness)),
        thickness_rate(read(s.field.thickness_rate)),
        x(write(s.field.x)),
        v(write(s.field.v)),
        v_half(write(s.field.v_half)),
        thickness_half(write(s.field.thickness_half)),
        force(write(s.field.force)),
        heat(write(s.field.heat)),
        hourglass(write(s.field.hourglass)),
        compression(write(s.field.compression)),
        contact(write(s.field.contact)),
        turned(write(s.field.turned)),
        position(s.position),
        material(table),
        equations(s.settings.equations),
        failure(s.failure) {}

  PIOLA_SHARED PIOLA_FN void operator()(Range block, Index) const {
    each_group(block, [&](Group g) { move(g); });
  }

 private:
  PIOLA_FN void move(Group g) const {
    Index const i = g.first;
    double const step = 0.5 * dt;
    Vec<3, Lanes> place, speed;
    double places[3][lane_count];
    auto finite = g.mask();
    for (int c = 0; c < 3; ++c) {
      Lanes const before = v.seen().scalar<Lanes>(i, c);
      speed[c] = before + step * a.scalar<Lanes>(i, c);
      place[c] = x.seen().scalar<Lanes>(i, c) + step * before;
      v_half.put(g, speed[c], c);
      x.put(g, place[c], c);
      store(place[c], places[c]);
      finite = finite && magnitude(place[c]) < 1e30 && magnitude(speed[c]) < 1e30;
    }
    if (axisymmetric) turn_back(g, place[0], speed[0], places[0]);
    for (int l = 0; l < g.count; ++l)
      for (int c = 0; c < 3; ++c) position[3 * (i + l) + c] = places[c][l];
    if (any(g.mask() && !finite)) report(g, places);
    if (thickness_half.data != nullptr) thickness_half.put(g, thickness_at(i, step, place[0]));
    clear(g);
    if (material.used) write_record(g, place, speed);
  }

  /// Turns particles beyond the axis, with the radial velocity.
  PIOLA_FN void turn_back(Group g, Lanes& radius, Lanes& speed, double (&radii)[lane_count]) const {
    auto const beyond = radius < 0.0;
    turned.put(g, select(beyond, Lanes(1.0), Lanes(0.0)));
    if (!any(g.mask() && beyond)) return;
    Lanes const before = v.seen().scalar<Lanes>(g.first);
    radius = select(beyond, -radius, radius);
    speed = select(beyond, -speed, speed);
    store(radius, radii);
    x.put(g, radius);
    v_half.put(g, speed);
    v.put(g, select(beyond, -before, before));
  }

  /// At half time. That of total-Lagrangian rings is known.
  PIOLA_FN Lanes thickness_at(Index i, double step, Lanes const& radius) const {
    Lanes const predicted = thickness.scalar<Lanes>(i) + step * thickness_rate.scalar<Lanes>(i);
    return axisymmetric ? select(phi.scalar<Lanes>(i) > 0.0, predicted, circle(maximum(radius, Lanes(smallest_radius))))
                        : predicted;
  }

  PIOLA_FN void report(Group g, double const (&places)[3][lane_count]) const {
    for (int l = 0; l < g.count; ++l)
      for (int c = 0; c < 3; ++c)
        if (!(std::fabs(places[c][l]) < 1e30 && std::fabs(v_half.at(g.first + l, c)) < 1e30))
          exec::record(failure, g.first + l, not_a_number);
  }

  PIOLA_FN void clear(Group g) const {
    for (int c = 0; c < 3 && force.data != nullptr; ++c) force.put(g, Lanes(0.0), c);
    for (int c = 0; c < ContactSum::size && contact.data != nullptr; ++c) contact.put(g, Lanes(0.0), c);
    if (heat.data == nullptr) return;
    heat.put(g, Lanes(0.0));
    hourglass.put(g, Lanes(0.0));
    compression.put(g, Lanes(0.0));
  }

  /// Deleted particles have no volume; their other values are irrelevant.
  PIOLA_FN void write_record(Group g, Vec<3, Lanes> const& place, Vec<3, Lanes> const& speed) const {
    using R = MaterialRecord<D>;
    Lanes r[R::A];
    for (int c = 0; c < D; ++c) {
      r[R::X + c] = X.scalar<Lanes>(g.first, c);
      r[R::u + c] = place[c] - r[R::X + c];
      r[R::v + c] = speed[c];
    }
    auto const there = active.scalar<Lanes>(g.first) > 0.0;
    r[R::volume] = select(there, weight.scalar<Lanes>(g.first), Lanes(0.0));
    Lanes const factor = positive_factor(viscosity.scalar<Lanes>(g.first));
    r[R::viscosity] = select(phi.scalar<Lanes>(g.first) > 0.0 && there, -factor, factor);
    store_in_records<D>(material, equations, g, 0, r);
  }
};

/// The part of a pass that depends on the law, called once per block. It has no type of the law, so that passes are
/// compiled once for all laws and the part once for all dimensions. The part must outlive this.
template <class... Data>
struct LawPart {
  void const* part;
  void (*run)(void const* part, Range block, Data&... data);

  template <class Part>
  explicit LawPart(Part const& of_law) : part(&of_law), run(&call<Part>) {}
  PIOLA_FN void operator()(Range block, Data&... data) const { run(part, block, data...); }

 private:
  template <class Part>
  static PIOLA_FN void call(void const* part, Range block, Data&... data) {
    (*static_cast<Part const*>(part))(block, data...);
  }
};

/// Velocity gradient of total-Lagrangian particles at half time, dF/dt F^-1 [1/s], and its component around the axis.
/// Only after the first sweep over reference neighbours.
struct GradientAtHalfTime {
  bool axisymmetric;
  double smallest_radius;
  double const* position;
  Components X, v_half, F, F_rate;

  explicit GradientAtHalfTime(System const& s)
      : axisymmetric(s.settings.axisymmetric),
        smallest_radius(s.smallest_radius),
        position(s.position),
        X(read(s.field.X)),
        v_half(read(s.field.v_half)),
        F(read(s.field.F)),
        F_rate(read(s.field.F_rate)) {}

  PIOLA_FN Mat<3, Lanes> of_material(Index i) const { return F_rate.matrix<Lanes>(i) * inverse(F.matrix<Lanes>(i)); }
  PIOLA_FN auto is_on_axis(Index i) const { return X.scalar<Lanes>(i) < smallest_radius; }
  /// Radii at half time, never zero [m].
  PIOLA_FN Lanes radius_at(Index i) const {
    double radius[lane_count];
    for (int l = 0; l < lane_count; ++l) radius[l] = maximum(position[std::ptrdiff_t{3} * (i + l)], smallest_radius);
    return load<Lanes>(radius);
  }
  /// L: the components in the section, of all particles.
  PIOLA_FN void turn_around_axis(Index i, Mat<3, Lanes>& L) const {
    if (axisymmetric) L(2, 2) = select(is_on_axis(i), L(0, 0), v_half.scalar<Lanes>(i) / radius_at(i));
  }
};

/// Density and volume at half time.
struct HalfVolume {
  double rho0, step;  ///< step: half of a time step [s]
  MaterialTable material;
  Components mass, rho, rho_rate, thickness_half, phi, F;
  OwnComponents rho_half, volume_half;
  FailureSlot* failure;

  PIOLA_SHARED inline HalfVolume(System const& s, BodyConstants const& body, MaterialTable const& table, double dt)
      : rho0(body.rho0),
        step(0.5 * dt),
        material(table),
        mass(read(s.field.mass)),
        rho(read(s.field.rho)),
        rho_rate(read(s.field.rho_rate)),
        thickness_half(read(s.field.thickness_half)),
        phi(read(s.field.phi)),
        F(read(s.field.F)),
        rho_half(write(s.field.rho_half)),
        volume_half(write(s.field.volume_half)),
        failure(s.failure) {}

  PIOLA_FN Lanes thickness_at(Index i) const { return thickness_half.scalar_or<Lanes>(i, 1.0); }

  PIOLA_SHARED PIOLA_FN void operator()(Range block) const {
    each_group(block, [&](Group g) {
      Index const i = g.first;
      Lanes const blend = phi.scalar<Lanes>(i);
      Lanes density = rho.scalar<Lanes>(i) + step * rho_rate.scalar<Lanes>(i);
      if (material.used) {
        Lanes const J = determinant(F.matrix<Lanes>(i));
        fail(g, blend < 1.0 && !(J > 0.0), inverted);
        density = select(blend > 0.0, density, rho0 / J);
      }
      fail(g, !(density > 0.0), negative_density);
      rho_half.put(g, density);
      volume_half.put(g, mass.scalar<Lanes>(i) / (density * thickness_at(i)));
    });
  }

 private:
  template <class Mask>
  PIOLA_FN void fail(Group g, Mask const& where, int code) const {
    record_where(failure, g, where, code);
  }
};

}  // namespace piola::adaptle::inline PIOLA_BACKEND
