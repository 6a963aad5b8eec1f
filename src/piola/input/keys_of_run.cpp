// SPDX-License-Identifier: Apache-2.0
#include "piola/input/key_tables.hpp"
#include "piola/input/run_keys.hpp"
#include <array>
#include <vector>

namespace piola {
namespace {

using enum KeyInfo::Kind;

constexpr Interval open_unit{0, 1, true, true};
constexpr std::array<std::string_view, 1> auto_word{"auto"}, off_word{"off"};
constexpr std::array<std::string_view, 2> repartition_words{"auto", "never"};
constexpr std::array<std::string_view, 2> relax_method_words{"kinetic_damping", "conjugate_gradients"};
constexpr std::array<std::string_view, 4> instruction_set_words{"auto", "scalar", "v3", "v4"};

constexpr std::array run_rows{
    RunKey{{"run", "end", quantity, "s", positive, "", "time at which the run ends"}, fills<&RunSpec::end>},
    RunKey{{"run", "cfl", quantity, "1", above(0, 2),
            "nodal, jst_sph with scheme = \"filtered\": none, the step is measured; jst_sph else 0.3; taylor_sph: 0.9, "
            "exact lattices 1; adaptle: 0.3, up to 0.6 where shear has flattened total_lagrangian bodies",
            "step as a fraction of spacing / wave speed"},
           fills<&RunSpec::cfl>},
    RunKey{{"run", "damping", quantity, "1/s", not_negative, default_of_member,
            "mass-proportional damping: adds -damping v to the acceleration, except where a support prescribes v"},
           fills<&RunSpec::damping>},
    RunKey{{"run", "relax", flag, "", any_value, default_of_member,
            "dynamic relaxation: motion is taken out until the bodies are at rest, and the run ends there, at `end` at "
            "the latest"},
           fills<&RunSpec::relax>},
    RunKey{{"run", "relax_method", word, "", any_value, default_of_member,
            "relax: kinetic_damping stops all bodies at each peak of the kinetic energy; conjugate_gradients, for a "
            "body of nodal on its own, minimises the potential energy",
            relax_method_words},
           fills<&RunSpec::relax_method>},
    RunKey{{"run", "relax_tolerance", quantity, "1", open_unit, default_of_member,
            "relax: tolerance; converged when the norm of unbalanced forces is below this fraction of its maximum in "
            "the run"},
           fills<&RunSpec::relax_tolerance>},
    RunKey{{"run", "max_step", quantity, "s", positive, "no bound", "largest step"}, fills<&RunSpec::max_step>},
    RunKey{{"run", "min_step", quantity, "s", not_negative, "1e-6 of the first step",
            "a smaller stable step stops the run as failed"},
           fills<&RunSpec::min_step>},
    RunKey{{"run", "threads", whole, "", closed(1, 4096),
            "\"auto\" (OMP_NUM_THREADS, SLURM_CPUS_PER_TASK or all cores)", "number of threads, or \"auto\"",
            auto_word}},
    RunKey{{"run", "instruction_set", word, "", any_value, default_of_member, "instruction set of the processor",
            instruction_set_words},
           fills<&RunSpec::backend>},
    RunKey{{"run", "repartition", whole, "", count_range, "\"auto\" (when one of the ranks is busier than the others)",
            "adaptle with MPI: steps between repartitions, \"auto\" or \"never\"", repartition_words}},
    RunKey{{"run", "guards", table, "", any_value, "all on", "limits of the guards, or \"off\"", off_word}},
};

constexpr std::array guard_rows{
    GuardKey{{"run.guards", "energy_rise_warn", quantity, "1", positive, default_of_member,
              "rise of energy without a load, as a share of the energy at the start, of the work of loads, or of the "
              "largest kinetic energy: warns above"},
             Limits<&GuardLimits::energy_rise_warn>{GuardLimits::never}},
    GuardKey{
        {"run.guards", "energy_rise_stop", quantity, "1", positive, default_of_member, "the same: stops the run above"},
        Limits<&GuardLimits::energy_rise_stop>{GuardLimits::never}},
    GuardKey{{"run.guards", "dissipation", quantity, "1", positive, default_of_member,
              "share of that energy that stabilisation, viscosity, damping and the scheme itself take: warns above"},
             Limits<&GuardLimits::dissipation>{GuardLimits::never}},
    GuardKey{{"run.guards", "jacobian", list, "1", positive, "[0.3, 3]",
              "lowest and highest det F of materials that do not yield: warns outside", off_word}},
    GuardKey{{"run.guards", "overlap", quantity, "1", positive, default_of_member,
              "contact_overlap of adaptle: warns above"},
             Limits<&GuardLimits::overlap>{GuardLimits::never}},
    GuardKey{{"run.guards", "proximity", quantity, "1", positive, default_of_member,
              "distance, in spacings, of particles that were no neighbours at the start: warns below"},
             Limits<&GuardLimits::proximity>{0}},
    GuardKey{{"run.guards", "strain_drift_warn", quantity, "1", positive, default_of_member,
              "taylor_sph, updated configuration: strain of cells that their stress does not have: warns above"},
             Limits<&GuardLimits::strain_drift_warn>{GuardLimits::never}},
    GuardKey{{"run.guards", "strain_drift_stop", quantity, "1", positive, default_of_member,
              "the same: stops the run above"},
             Limits<&GuardLimits::strain_drift_stop>{GuardLimits::never}},
    GuardKey{{"run.guards", "step_warn", quantity, "1", positive, default_of_member,
              "step over the step that waves through the bodies at rest allow; steps bounded by max_step or cut to end "
              "do not count: warns below"},
             Limits<&GuardLimits::step_warn>{0}},
    GuardKey{{"run.guards", "step_stop", quantity, "1", positive, "\"off\" (min_step alone)",
              "the same: stops the run below", off_word},
             Limits<&GuardLimits::step_stop>{0}},
    GuardKey{{"run.guards", "small_strain_warn", quantity, "1", positive, default_of_member,
              "linear_elastic under jst_sph and nodal: largest principal Green strain: warns above"},
             Limits<&GuardLimits::small_strain_warn>{GuardLimits::never}},
    GuardKey{{"run.guards", "small_strain_stop", quantity, "1", positive, default_of_member,
              "the same: stops the run above", off_word},
             Limits<&GuardLimits::small_strain_stop>{GuardLimits::never}},
    GuardKey{{"run.guards", "small_rotation_warn", quantity, "rad", positive, default_of_member,
              "linear_elastic under jst_sph and nodal: largest angle of rotation of a particle: warns above"},
             Limits<&GuardLimits::small_rotation_warn>{GuardLimits::never}},
    GuardKey{{"run.guards", "small_rotation_stop", quantity, "rad", positive, default_of_member,
              "the same: stops the run above", off_word},
             Limits<&GuardLimits::small_rotation_stop>{GuardLimits::never}},
};

}  // namespace

std::span<RunKey const> run_keys() { return run_rows; }
std::span<GuardKey const> guard_keys() { return guard_rows; }

std::vector<KeyInfo> keys_of_run() { return joined_keys(run_keys(), guard_keys()); }

}  // namespace piola
