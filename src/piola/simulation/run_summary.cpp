// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/run_summary.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/version.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include "piola/measures/quantities.hpp"
#include "piola/model/body_properties.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace piola {
namespace {

double largest(std::vector<double> const& values) {
  double most = 0;
  for (double v : values) most = std::max(most, std::isfinite(v) ? std::abs(v) : 0.0);
  return most;
}

/// Largest rise (sign 1) or fall (sign -1) of the energy that no support or load brought and that did not leave through
/// a non-reflecting patch, by the largest energy.
double largest_rise(HistoryTable const& history, double sign) {
  auto const energy = history.values("total_energy"), work = history.values("external_work");
  std::vector<double> radiated(energy.size(), 0);
  if (history.find("radiated_energy")) radiated = history.values("radiated_energy");
  double rise = 0, lowest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < energy.size(); ++k) {
    double const own = sign * (energy[k] - work[k] + radiated[k]);
    if (!std::isfinite(own)) continue;
    lowest = std::min(lowest, own);
    rise = std::max(rise, own - lowest);
  }
  double const scale = largest(energy);
  return scale > 0 ? rise / scale : rise;
}

/// Largest change of a vector column triple since the first row.
double drift(HistoryTable const& history, std::string const& name) {
  double most = 0;
  auto const x = history.values(name + "_x"), y = history.values(name + "_y"), z = history.values(name + "_z");
  for (std::size_t k = 0; k < x.size(); ++k) {
    double const d = std::hypot(x[k] - x[0], y[k] - y[0], z[k] - z[0]);
    if (std::isfinite(d)) most = std::max(most, d);
  }
  return most;
}

/// Half the diagonal of the box around the particles [m]: the arm of the angular momentum scale.
double half_diagonal(ParticleSet const& particles) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    auto const [low, high] = std::minmax_element(particles.X.begin(), particles.X.end(),
                                                 [c](auto const& a, auto const& b) { return a[c] < b[c]; });
    if (low != particles.X.end()) sum += ((*high)[c] - (*low)[c]) * ((*high)[c] - (*low)[c]);
  }
  return std::sqrt(sum) / 2;
}

/// Whether nothing but bodies and other shapes act on a rigid shape.
bool is_left_alone(RigidSpec const& rigid) {
  auto const is_none = [](std::array<Expression, 3> const& formulas) {
    return std::all_of(formulas.begin(), formulas.end(), [](Expression const& e) { return e.text() == "0"; });
  };
  return rigid.free && is_none(rigid.gravity) && is_none(rigid.force) && is_none(rigid.torque) && rigid.can_turn &&
         rigid.held == std::array<bool, 3>{};
}

/// The largest rho c^2 of the bodies, with the speed c of pressure waves at rest [Pa].
double wave_modulus(Simulation const& s) {
  double modulus = 0;
  auto const facts = body_properties(s.spec, s.particles);
  for (std::size_t b = 0; b < facts.size(); ++b) {
    Body const& body = s.particles.bodies[b];
    double const volume =
        std::accumulate(s.particles.volume.begin() + body.first, s.particles.volume.begin() + body.last, 0.0);
    if (volume > 0) modulus = std::max(modulus, facts[b].mass / volume * facts[b].p_wave * facts[b].p_wave);
  }
  return modulus;
}

void add_conservation(Summary& summary, HistoryTable const& history, Simulation const& s) {
  if (history.rows.empty()) return;
  auto const energy = history.values("total_energy");
  summary.energy_initial = energy.front();
  summary.energy_final = energy.back();
  summary.energy_max_increase = energy_increase(history);
  summary.energy_max_decrease = energy_decrease(history);
  // sqrt(2 M E_kin) is the momentum of the whole mass at the root mean square speed.
  double const momentum = std::sqrt(2 * s.mass * largest(history.values("kinetic_energy")));
  double const arm = half_diagonal(s.particles);
  summary.scales = {{"kg m/s", momentum}, {"kg m^2/s", momentum * arm}, {"Pa", wave_modulus(s)}};
  bool const free = s.spec.supports.empty() && s.spec.loads.empty() && s.spec.mirrors.empty() &&
                    s.spec.springs.empty() && std::all_of(s.spec.rigids.begin(), s.spec.rigids.end(), is_left_alone);
  if (!free) return;
  summary.linear_drift = momentum > 0 ? drift(history, "linear_momentum") / momentum : 0;
  summary.angular_drift = momentum > 0 && arm > 0 ? drift(history, "angular_momentum") / (momentum * arm) : 0;
}

void add_cracks(Summary& summary, HistoryTable const& history, Simulation const& s) {
  auto const area = history.find("crack_area"), energy = history.find("fracture_energy");
  if (!area || !energy || history.rows.empty() || !(history.rows.back()[*area] > 0)) return;
  Summary::Cracks cracks{history.rows.back()[*area], 0, 0};
  cracks.energy = history.rows.back()[*energy] / cracks.area;
  auto const count = [&](MaterialParameters const& material) {
    with_solid(material,
               [&](auto const& law) { cracks.of_material = std::max(cracks.of_material, law.fracture.energy); });
  };
  for (BodySpec const& body : s.spec.bodies) {
    count(body.material);
    for (auto const& part : body.parts) count(part.material);
  }
  summary.cracks = cracks;
}

std::string status_word(RunStatus ending) {
  switch (ending) {
    case RunStatus::completed: return "completed";
    case RunStatus::failed: return "failed";
    default: return "stopped";
  }
}

}  // namespace

double energy_increase(HistoryTable const& history) { return largest_rise(history, 1); }
double energy_decrease(HistoryTable const& history) { return largest_rise(history, -1); }

Summary summarise(Simulation const& s, TimeState const& moment, RunStatus ending, HistoryTable const& history,
                  RunLog& journal) {
  PIOLA_EXPECTS(s.formulation != nullptr);
  Summary summary;
  summary.status = status_word(ending);
  summary.title = s.spec.title;
  summary.version = version();
  summary.identity = s.spec.identity;
  summary.formulation = s.formulation_name;
  summary.particles = s.particles.size();
  summary.steps = moment.step;
  summary.end_time = moment.time;
  summary.wall_seconds = moment.wall_seconds;
  summary.threads = s.threads;
  RunStatistics statistics = s.formulation->statistics();
  double const stages =
      static_cast<double>(moment.step) * statistics.stages_per_step * static_cast<double>(summary.particles);
  summary.stages_per_second = moment.stepping_seconds > 0 ? stages / moment.stepping_seconds : 0;
  summary.seconds = std::move(statistics.seconds);
  for (SetUpCheck const& check : statistics.set_up_checks) summary.set_up.emplace_back(check.name, check.value);
  add_conservation(summary, history, s);
  add_cracks(summary, history, s);
  for (QuantitySpec const& spec : s.spec.quantities) {
    std::string why;
    if (auto const value = measure(spec, history, why)) summary.quantities.push_back(*value);
    if (!why.empty() && ending == RunStatus::completed) journal.warn(why);
  }
  summary.warnings = journal.warnings();
  return summary;
}

}  // namespace piola
