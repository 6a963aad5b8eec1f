// SPDX-License-Identifier: Apache-2.0
// Total-Lagrangian particles that become Eulerian, or fail.
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/formulations/adaptle/contact.hpp"
#include "piola/formulations/adaptle/finish_pass.hpp"
#include "piola/formulations/adaptle/particles.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace piola::adaptle {
namespace {

double strain_of(int dimension, Mat<3> const& F, SymMat<3> const& stress, BodyConstants const& b) {
  return dimension == 2 ? equivalent_strain<2>(F, stress, b) : equivalent_strain<3>(F, stress, b);
}

}  // namespace

/// Evaluates convert_when; returns whether a particle of any rank is to convert by it.
bool Particles::requests_by_formula() {
  double any_request = 0;
  bool asked = false;
  for (std::size_t k = 0; k < body_.size(); ++k) {
    BodyConstants const& b = body_[k];
    if (!options_.bodies[k].convert_when) continue;
    asked = true;
    Expression const& formula = *options_.bodies[k].convert_when;
    with_solid(b.material, [&](auto const& law) {
      PointFields const point(system_.field, system_.own);
      Components const F(read(system_.field.F));
      Fields const& f = fields_;
      for (Index i = own_[k].first; i < own_[k].last; ++i) {
        if (f.phi.at(i) > 0 || conversion_requests_[at(i)] == 1) continue;
        double const rho = f.rho.at(i), p = point.pressure<double>(law, i, rho, f.energy.at(i) / f.mass.at(i));
        SymMat<3> const S = point.S.symmetric<double>(i);
        SymMat<3> stress = S;
        for (int c = 0; c < 3; ++c) stress.c[c] -= p;
        std::array const values{f.damage.at(i),
                                f.plastic_strain.at(i),
                                b.rho0 / rho,
                                -p,
                                von_mises(S),
                                f.temperature.at(i),
                                strain_of(system_.dimension, F.matrix<double>(i), stress, b),
                                rho};
        if (formula(X(i), energy_totals_.time, values) == 0) continue;
        conversion_requests_[at(i)] = 1;
        any_request = 1;
      }
    });
  }
  if (exchanges_ && asked) comm::allreduce_max(any_request);
  return any_request > 0;
}

namespace {

/// Marks of two kinds for each particle, of any rank.
class Marks {
 public:
  enum Kind { changes, by_guard };
  explicit Marks(Index particles) : bits_(2 * at(particles) / 64 + 1, 0) {}
  void set(Index i, Kind kind) { bits_[place(i, kind) / 64] |= bit(i, kind); }
  bool has(Index i, Kind kind) const { return (bits_[place(i, kind) / 64] & bit(i, kind)) != 0; }
  /// Combines the marks of all ranks. Collective.
  void share() {
    comm::allreduce(std::span(bits_), [](void const* other, void* mine) {
      *static_cast<std::uint64_t*>(mine) |= *static_cast<std::uint64_t const*>(other);
    });
  }

 private:
  static std::size_t place(Index i, Kind kind) { return 2 * at(i) + static_cast<std::size_t>(kind); }
  static std::uint64_t bit(Index i, Kind kind) { return std::uint64_t{1} << (place(i, kind) % 64); }
  std::vector<std::uint64_t> bits_;
};

}  // namespace

/// Converts flagged particles to Eulerian, or deletes them in bodies with failed = "delete". In bodies without
/// deletion, reference neighbours within conversion_radius of a particle flagged by a criterion convert too (not
/// recursively). A conversion counts as a guard conversion only if no criterion asked for it. Flags are combined over
/// ranks.
void Particles::convert(double dt) {
  PIOLA_EXPECTS(dt >= 0);
  Marks marks(system_.particles);
  for (std::size_t k = 0; k < body_.size(); ++k)
    for (Index i = own_[k].first; i < own_[k].last; ++i) {
      if (conversion_requests_[at(i)] == 0) continue;
      bool const alone = conversion_requests_[at(i)] == 2;
      marks.set(i, alone && !body_[k].deletes ? Marks::by_guard : Marks::changes);
      if (!alone && !body_[k].deletes)
        material_.each_neighbour(i, options_.bodies[k].conversion_radius * body_[k].reference_h, fields_,
                                 [&](Index j) { marks.set(j, Marks::changes); });
    }
  marks.share();
  std::vector<std::uint8_t> const lost_before = lost_.by_slot();
  std::int64_t const count_before = lost_.count();
  ConversionSums sums;
  for (Index i = 0; i < system_.particles; ++i) {
    bool const changes = marks.has(i, Marks::changes);
    if (changes && body_[at(body_of_[at(i)])].deletes)
      remove(i);
    else if (changes || marks.has(i, Marks::by_guard))
      make_eulerian(i, dt, !changes, sums);
  }
  if (exchanges_) comm::allreduce_sum(sums);
  energy_totals_.converted_mass += sums.value(0);
  energy_totals_.energy_change += sums.value(1);
  energy_totals_.momentum_change += sums.value(2);
  if (lost_.count() > count_before) {
    double const opened = opened_energy(system_, lost_before);
    energy_totals_.contact_energy += opened;
    energy_totals_.energy_change += opened;
  }
  choose_material();
}

/// Marks the particle and all that have it as a reference neighbour, because their deformation gradient now depends on
/// the positions of an Eulerian particle.
void Particles::lose_surface(Index slot) { lost_.lose(set_, slot, 2 * body_[at(body_of_[at(slot)])].reference_h); }

/// x, v, S, energy and history stay. rho follows from J, which belongs to half time, carried on to the end of the step.
void Particles::make_eulerian(Index i, double dt, bool by_guard, ConversionSums& sums) {
  Fields& f = fields_;
  if (f.phi.at(i) == 1) return;
  energy_totals_.converted += 1;
  energy_totals_.by_guard += by_guard ? 1 : 0;
  if (lost_.used()) lose_surface(i);
  if (!is_local(i)) {  // remote particle: only its kernel type is stored
    f.phi.at(i) = 1;
    return;
  }
  double const before = energy_of(i);
  std::array const momentum = momentum_of(i);
  double const rho = f.rho_half.at(i), divergence = -f.rho_rate.at(i) / rho;
  if (f.phi.at(i) == 0) f.rho.at(i) = rho * std::exp(-0.5 * dt * divergence);
  f.phi.at(i) = 1;
  std::array const after = momentum_of(i);
  double const jump[3]{f.mass.at(i), std::abs(energy_of(i) - before),
                       std::hypot(after[0] - momentum[0], after[1] - momentum[1], after[2] - momentum[2])};
  sums.add(jump);
}

/// Internal and kinetic [J].
double Particles::energy_of(Index i) const {
  double energy = fields_.energy.at(i);
  for (int c = 0; c < 3; ++c) energy += 0.5 * fields_.mass.at(i) * fields_.v.at(i, c) * fields_.v.at(i, c);
  return energy;
}

std::array<double, 3> Particles::momentum_of(Index i) const {
  double const m = fields_.mass.at(i);
  return {m * fields_.v.at(i, 0), m * fields_.v.at(i, 1), m * fields_.v.at(i, 2)};
}

/// Bears no stress any more and leaves the sums of its neighbours; its deformation stays as it is.
void Particles::remove(Index i) {
  Fields& f = fields_;
  if (!(f.active.at(i) > 0)) return;
  f.active.at(i) = 0;
  energy_totals_.deleted += 1;
  if (!is_local(i)) return;
  for (int c = 0; c < 6; ++c) f.S.at(i, c) = f.S_rate.at(i, c) = 0;
  f.rho_rate.at(i) = f.energy_rate.at(i) = 0;
  if (f.holds(f.thickness_rate)) f.thickness_rate.at(i) = 0;
  if (f.holds(f.F_rate))
    for (int c = 0; c < 9; ++c) f.F_rate.at(i, c) = 0;
}

}  // namespace piola::adaptle
