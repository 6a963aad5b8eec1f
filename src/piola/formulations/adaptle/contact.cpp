// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/contact.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/formulations/adaptle/contact_sweep.hpp"
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace piola::adaptle {
namespace {

template <int D>
double number_of(double h, double dp, double n) {
  Kernel<D> const kernel(h);
  double const reference = kernel(dp);
  int const reach = static_cast<int>(std::ceil(2 * h / dp));
  double sum = 0;
  for (int m = 0; m <= reach; ++m)
    for (int i = -reach; i <= reach; ++i)
      for (int k = D == 3 ? -reach : 0; k <= (D == 3 ? reach : 0); ++k) {
        double const z = (m + 1) * dp, square = z * z + (i * i + k * k) * dp * dp;
        double s = 0, W = 0;
        kernel.evaluate(square, s, W);
        // |W'| z / r = s z; there are m + 1 pairs of layers at distance m.
        sum += (m + 1) * n * std::pow(W / reference, n - 1) * s * z / reference;
      }
  return dp * sum;
}

/// U of one pair.
template <int D>
double potential(System const& s, Index i, Index j, double r) {
  KernelContactPair const& pair = s.contact.pair[s.body_of[i] * s.bodies + s.body_of[j]];
  if (s.contact.law == ContactLaw::linear) return r < pair.dp ? 0.5 * pair.eps * std::pow(1 - r / pair.dp, 2) : 0;
  Kernel<D> const kernel(pair.h);
  double const eps = s.contact.law == ContactLaw::kernel
                         ? pair.eps
                         : s.contact.published_stiffness * value_at(s.field.volume, i) * value_at(s.field.volume, j);
  return eps * std::pow(kernel(r) / kernel(pair.dp), pair.exponent);
}

template <int D>
void add_rigid_contacts(System const& s, Index i, exec::ReproducibleSums<1>& sum) {
  for (int k = 0; k < s.rigid.count; ++k) {
    double normal[3];
    BodyConstants const& b = s.body[s.body_of[i]];
    double const depth = 0.5 * b.spacing - distance_to<D>(s.rigid.pose[k], point_at(s.field.x, i, 3).data(), normal);
    double const around = s.settings.axisymmetric ? circle(ring_radius(value_at(s.field.x, i), b.spacing)) : 1;
    double const energy = around * s.contact.scale * b.bulk_modulus * std::pow(b.spacing, D - 2) * depth * depth;
    if (depth > 0) sum.add(&energy);
  }
}

/// Sums the energies of the pairs with counts(pair, i, j), at the positions at half time, which ghosts have, too.
template <int D, class Counts>
exec::ReproducibleSums<1> energy_of_pairs(System const& s, Counts const& counts) {
  exec::ReproducibleSums<1> sum;
  for (Index t = 0; t < s.contact.targets; ++t) {
    Index const i = s.spatial.slot[s.contact.target[t]];
    for (Index k = 0; k < s.contact.length[t]; ++k) {
      Index const j = s.spatial.slot[s.contact.list[static_cast<std::ptrdiff_t>(t) * s.contact.capacity + k]];
      if (!counts(s.contact.pair[s.body_of[i] * s.bodies + s.body_of[j]], i, j)) continue;
      double square = 0;
      for (int c = 0; c < D; ++c)
        square += std::pow(s.position[std::ptrdiff_t{3} * i + c] - s.position[std::ptrdiff_t{3} * j + c], 2);
      double half = 0.5 * potential<D>(s, i, j, std::sqrt(square));
      if (s.settings.axisymmetric)
        half *= 0.5 * circle(s.position[std::ptrdiff_t{3} * i] + std::fabs(s.position[std::ptrdiff_t{3} * j]));
      sum.add(&half);
    }
  }
  return sum;
}

template <int D>
exec::ReproducibleSums<1> energy_of_contacts(System const& s) {
  exec::ReproducibleSums<1> sum = energy_of_pairs<D>(
      s, [&](KernelContactPair const& pair, Index i, Index j) { return s.contact.acts(pair, i, s.source_of(j)); });
  for (Range const& own : s.local())
    for (Index i = own.first; i < own.last; ++i) add_rigid_contacts<D>(s, i, sum);
  return sum;
}

/// The largest pressure of two half spaces that collide at the speed v [Pa].
double shock_pressure(BodyConstants const& a, BodyConstants const& b, double v) {
  double const c_a = std::sqrt(a.bulk_modulus / a.rho0), c_b = std::sqrt(b.bulk_modulus / b.rho0);
  double const Z_a = a.rho0 * c_a, Z_b = b.rho0 * c_b;
  return Z_a * Z_b / (Z_a + Z_b) * v * (1 + v / (2 * std::min(c_a, c_b)));
}

/// Pressure at which a body yields at the closing speed v, 3 sy + rho v^2 / 2 [Pa].
double flow_pressure(BodyConstants const& a, double v) { return 3 * a.yield_stress + 0.5 * a.rho0 * v * v; }

}  // namespace

double contact_number(int dimension, double h, double dp, double exponent) {
  PIOLA_EXPECTS(h > 0 && dp > 0);
  return dimension == 2 ? number_of<2>(h, dp, exponent) : number_of<3>(h, dp, exponent);
}

double reference_pressure(BodyConstants const& a, BodyConstants const& b, double v) {
  double const shock = shock_pressure(a, b, v);
  double const flow = std::min(flow_pressure(a, v), flow_pressure(b, v));
  return std::max({std::clamp(flow, 0.25 * shock, shock), 0.01 * std::min(a.bulk_modulus, b.bulk_modulus),
                   a.burst_pressure, b.burst_pressure});
}

double contact_exponent(BodyConstants const& a, BodyConstants const& b, double v) {
  double const shock = shock_pressure(a, b, v);
  // If both yield at the same pressure, the softer one, independent of their order.
  auto const [flow, yield] =
      std::min(std::pair(flow_pressure(a, v), a.yield_stress), std::pair(flow_pressure(b, v), b.yield_stress));
  if (!(shock > flow)) return 4;
  double const x = std::clamp((3 * yield / flow - 0.4) / 0.5, 0.0, 1.0), aside = 1 - flow / shock;
  return 4 * (1 + x * x * (3 - 2 * x) * aside * aside);
}

double contact_energy(System const& system) {
  exec::ReproducibleSums<1> sum = system.dimension == 2 ? energy_of_contacts<2>(system) : energy_of_contacts<3>(system);
  if (system.shared) comm::allreduce_sum(sum);
  return sum.value();
}

double opened_energy(System const& system, std::vector<std::uint8_t> const& lost_before) {
  auto const opened = [&](KernelContactPair const& pair, Index i, Index image) {
    Index const j = system.source_of(image);
    auto const before = [&](Index k) { return lost_before[static_cast<std::size_t>(k)] != 0; };
    return pair.surfaces && system.contact.acts(pair, i, j) && !before(i) && !before(j);
  };
  exec::ReproducibleSums<1> sum =
      system.dimension == 2 ? energy_of_pairs<2>(system, opened) : energy_of_pairs<3>(system, opened);
  if (system.shared) comm::allreduce_sum(sum);
  return sum.value();
}

std::vector<KernelContactPair> contact_pairs(int dimension, ContactRule const& rule,
                                             std::vector<BodyConstants> const& bodies,
                                             std::vector<std::array<double, 3>> const& mean_velocity) {
  PIOLA_EXPECTS(mean_velocity.size() == bodies.size());
  std::vector<KernelContactPair> pairs(bodies.size() * bodies.size());
  for (std::size_t a = 0; a < bodies.size(); ++a)
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (a == b) continue;
      KernelContactPair& p = pairs[a * bodies.size() + b];
      p.h = 0.5 * (bodies[a].h + bodies[b].h);
      p.dp = 0.5 * (bodies[a].spacing + bodies[b].spacing);
      double square = 0;
      for (std::size_t c = 0; c < 3; ++c) square += std::pow(mean_velocity[a][c] - mean_velocity[b][c], 2);
      double const v = std::isnan(rule.closing_speed) ? std::sqrt(square) : rule.closing_speed;
      p.exponent = rule.exponent;
      if (std::isnan(p.exponent))
        p.exponent = rule.law == ContactRule::Law::kernel ? contact_exponent(bodies[a], bodies[b], v) : 4;
      // dp_a^(d-1) dp_b^(d-1) / dp^(d-2)
      double const area =
          std::pow(bodies[a].spacing * bodies[b].spacing, dimension - 1) / std::pow(p.dp, dimension - 2);
      if (rule.law == ContactRule::Law::kernel)
        p.eps = rule.scale * reference_pressure(bodies[a], bodies[b], v) * area /
                contact_number(dimension, p.h, p.dp, p.exponent);
      if (rule.law == ContactRule::Law::linear)
        p.eps = rule.scale * std::min(bodies[a].bulk_modulus, bodies[b].bulk_modulus) * area;
    }
  return pairs;
}

void mark_surface_contact(Assembly const& assembly, std::vector<KernelContactPair>& pairs) {
  PIOLA_EXPECTS(pairs.size() == assembly.particles.bodies.size() * assembly.particles.bodies.size());
  auto const& bodies = assembly.particles.bodies;
  for (std::size_t a = 0; a < bodies.size(); ++a)
    for (std::size_t b = 0; b < bodies.size(); ++b)
      if (a != b && find_pair(assembly.contact_pairs, bodies[a].name, bodies[b].name) != nullptr)
        pairs[a * bodies.size() + b].surfaces = true;
}

void exclude_tied_pairs(std::vector<contact::TieRule> const& ties, std::size_t bodies,
                        std::vector<KernelContactPair>& pairs) {
  PIOLA_EXPECTS(pairs.size() == bodies * bodies);
  constexpr double out_of_sight = 1e-9;
  for (contact::TieRule const& tie : ties)
    for (std::size_t const pair : {tie.bodies[0] * bodies + tie.bodies[1], tie.bodies[1] * bodies + tie.bodies[0]}) {
      pairs[pair].eps = 0;
      pairs[pair].h *= out_of_sight;
      pairs[pair].dp = 0;
    }
}

}  // namespace piola::adaptle
