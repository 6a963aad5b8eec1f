// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/conversion.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/formulations/adaptle/contact.hpp"
#include "piola/formulations/adaptle/finish_pass.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include <cmath>
#include <cstdint>
#include <span>

namespace piola::adaptle {
namespace {

double strain_of(int dimension, Mat<3> const& F, SymMat<3> const& stress, BodyConstants const& b) {
  return dimension == 2 ? equivalent_strain<2>(F, stress, b) : equivalent_strain<3>(F, stress, b);
}

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

Conversion::Conversion(ParticleData& particles, std::vector<BodyOptions> const& options,
                       ReferenceLists const& neighbours, EnergyTotals& totals)
    : particles_(particles),
      options_(options),
      neighbours_(neighbours),
      totals_(totals),
      requests_(at(particles.system().particles)) {
  if (particles.has_surface_contact()) lost_ = LostSurfaces(particles.set());
  particles.system().description.request = requests_.data();
  particles.system().contact.lost = lost_.by_slot().data();
}

bool Conversion::request_by_formula() {
  double any_request = 0;
  bool asked = false;
  for (std::size_t k = 0; k < options_.size(); ++k) {
    if (!options_[k].convert_when) continue;
    asked = true;
    if (request_by(*options_[k].convert_when, k)) any_request = 1;
  }
  if (particles_.system().shared && asked) comm::allreduce_max(any_request);
  return any_request > 0;
}

/// Requests of the local particles of a body.
bool Conversion::request_by(Expression const& formula, std::size_t body) {
  System const& s = particles_.system();
  Fields const& f = particles_.fields();
  BodyConstants const& b = particles_.bodies()[body];
  bool any_request = false;
  with_solid(b.material, [&](auto const& law) {
    PointFields const point(s.field, s.own);
    Components const F(read(s.field.F));
    for (Index i = s.part[body].first; i < s.part[body].last; ++i) {
      if (f.phi.at(i) > 0 || requests_[at(i)] == 1) continue;
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
                              strain_of(s.dimension, F.matrix<double>(i), stress, b),
                              rho};
      if (formula(particles_.set().X[at(i)], totals_.time, values) == 0) continue;
      requests_[at(i)] = 1;
      any_request = true;
    }
  });
  return any_request;
}

void Conversion::convert(double dt) {
  PIOLA_EXPECTS(dt >= 0);
  System const& s = particles_.system();
  Marks marks(s.particles);
  for (std::size_t k = 0; k < options_.size(); ++k) {
    BodyConstants const& body = particles_.bodies()[k];
    for (Index i = s.part[k].first; i < s.part[k].last; ++i) {
      if (requests_[at(i)] == 0) continue;
      bool const alone = requests_[at(i)] == 2;
      marks.set(i, alone && !body.deletes ? Marks::by_guard : Marks::changes);
      if (!alone && !body.deletes)
        neighbours_.each_neighbour(i, options_[k].conversion_radius * body.reference_h, particles_.fields(),
                                   [&](Index j) { marks.set(j, Marks::changes); });
    }
  }
  marks.share();
  std::vector<std::uint8_t> const lost_before = lost_.by_slot();
  std::int64_t const count_before = lost_.count();
  Sums sums;
  for (Index i = 0; i < s.particles; ++i) {
    bool const changes = marks.has(i, Marks::changes);
    if (changes && particles_.body_of(i).deletes)
      remove(i);
    else if (changes || marks.has(i, Marks::by_guard))
      make_eulerian(i, dt, !changes, sums);
  }
  if (s.shared) comm::allreduce_sum(sums);
  totals_.converted_mass += sums.value(0);
  totals_.energy_change += sums.value(1);
  totals_.momentum_change += sums.value(2);
  if (lost_.count() > count_before) {
    double const opened = opened_energy(s, lost_before);
    totals_.contact_energy += opened;
    totals_.energy_change += opened;
  }
}

void Conversion::resumed() {
  if (!lost_.used()) return;
  for (Index i = 0; i < particles_.system().particles; ++i)
    if (particles_.fields().phi.at(i) == 1) lose_surface(i);
}

/// Marks the particle and all that have it as a reference neighbour, because their deformation gradient now depends on
/// the positions of an Eulerian particle.
void Conversion::lose_surface(Index slot) {
  lost_.lose(particles_.set(), slot, 2 * particles_.body_of(slot).reference_h);
}

/// x, v, S, energy and history stay. rho follows from J, which belongs to half time, carried on to the end of the step.
void Conversion::make_eulerian(Index i, double dt, bool by_guard, Sums& sums) {
  Fields& f = particles_.fields();
  if (f.phi.at(i) == 1) return;
  totals_.converted += 1;
  totals_.by_guard += by_guard ? 1 : 0;
  if (lost_.used()) lose_surface(i);
  if (!particles_.system().is_local(i)) {  // remote particle: only its kernel type is stored
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

/// Bears no stress any more and leaves the sums of its neighbours; its deformation stays as it is.
void Conversion::remove(Index i) {
  Fields& f = particles_.fields();
  if (!(f.active.at(i) > 0)) return;
  f.active.at(i) = 0;
  totals_.deleted += 1;
  if (!particles_.system().is_local(i)) return;
  for (int c = 0; c < 6; ++c) f.S.at(i, c) = f.S_rate.at(i, c) = 0;
  f.rho_rate.at(i) = f.energy_rate.at(i) = 0;
  if (f.holds(f.thickness_rate)) f.thickness_rate.at(i) = 0;
  if (f.holds(f.F_rate))
    for (int c = 0; c < 9; ++c) f.F_rate.at(i, c) = 0;
}

/// Internal and kinetic [J].
double Conversion::energy_of(Index i) const {
  Fields const& f = particles_.fields();
  double energy = f.energy.at(i);
  for (int c = 0; c < 3; ++c) energy += 0.5 * f.mass.at(i) * f.v.at(i, c) * f.v.at(i, c);
  return energy;
}

std::array<double, 3> Conversion::momentum_of(Index i) const {
  Fields const& f = particles_.fields();
  double const m = f.mass.at(i);
  return {m * f.v.at(i, 0), m * f.v.at(i, 1), m * f.v.at(i, 2)};
}

}  // namespace piola::adaptle
