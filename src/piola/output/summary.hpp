// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/identity.hpp"
#include "piola/domain/load_balancer.hpp"
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace piola {

struct MeasuredQuantity {
  std::string name;
  double value = 0;
  std::string unit;
};

/// How a dynamic relaxation ended.
struct RelaxationReport {
  bool at_rest = false;
  double residual = 0;  ///< unbalanced force / its maximum in the run
  long stops = 0;       ///< how often the bodies were brought to rest, or iterations
  double left = 0;      ///< estimate of the remaining displacement, relative to the present one
};

/// Values recorded by a guard.
struct GuardNumbers {
  std::string name;
  std::vector<std::pair<std::string, double>> values;
  std::string words;  ///< message to the user; empty: none
};

/// Communication of a rank, mean per step: messages to neighbouring ranks and collectives; and the wall time in both,
/// with waiting for slower ranks [s].
struct RankTraffic {
  double messages = 0, bytes = 0, collectives = 0;
  double message_seconds = 0, collective_seconds = 0;
  double replicated_bytes = 0;
};

/// Content of summary.json.
struct Summary {
  std::string status;  ///< "completed", "failed" or "stopped"
  std::string title, version, formulation;
  Identity identity;  ///< of the run
  std::int64_t particles = 0, steps = 0;
  std::string bits;              ///< hash of the last state, see StateHash
  double end_time = 0;           ///< s, time reached
  double wall_seconds = 0;       ///< over all parts of a resumed run
  double stages_per_second = 0;  ///< particle-stages per second of the steps alone
  int threads = 1;
  std::vector<RankTraffic> ranks;  ///< empty on one rank
  std::optional<RepartitionStatistics>
      repartition_statistics;                   ///< on several ranks, if the formulation supports repartitioning
  double energy_initial = 0, energy_final = 0;  ///< J
  /// Largest rise of (total energy - external work) above any earlier value, by the largest total energy.
  double energy_max_increase = 0;
  /// Largest fall of (total energy - external work) below any earlier value, by the largest total energy.
  double energy_max_decrease = 0;
  /// Largest change of momentum by a momentum scale of the run; nothing if supports, loads or mirrors change it.
  std::optional<double> linear_drift, angular_drift;
  /// Cracks of a run, if some have opened: area [m2, 2D: m], energy that softening took per area, and the largest
  /// fracture_energy of the materials [J/m2].
  struct Cracks {
    double area = 0, energy = 0, of_material = 0;
  };
  std::optional<Cracks> cracks;
  /// Reference magnitude per unit, to judge values: "kg m/s", "kg m^2/s", "Pa".
  std::vector<std::pair<std::string, double>> scales;
  std::vector<std::pair<std::string, double>> seconds;  ///< wall time by part of the work [s], if the formulation
                                                        ///< measures it
  /// Quality of the set-up, if the formulation measures it: residuals and errors of areas, ideally 0.
  std::vector<std::pair<std::string, double>> set_up;
  std::optional<RelaxationReport> relaxation;
  std::vector<MeasuredQuantity> quantities;
  std::vector<std::string> warnings;
  std::optional<std::vector<GuardNumbers>> guards;  ///< nothing: they were off
};

inline constexpr std::uint64_t most_summary_bytes = 100'000'000;  ///< of a file that is read

/// The JSON text; numbers that are not finite become null.
std::string to_json(Summary const& summary);
/// Throws FileError.
void write_summary(std::filesystem::path const& path, Summary const& summary);

}  // namespace piola
