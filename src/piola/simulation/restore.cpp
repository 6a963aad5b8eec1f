// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/restore.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/base/version.hpp"
#include "piola/domain/error_agreement.hpp"
#include "piola/exec/backend_registry.hpp"
#include "piola/input/case_difference.hpp"
#include "piola/output/checkpoint.hpp"
#include "piola/particles/particle_record.hpp"
#include "piola/simulation/observers.hpp"
#include <fmt/format.h>

namespace piola {
namespace {

/// Differences that change the bits of a resumed run from those of an uninterrupted one. Such a run, and one resumed
/// with changed keys, has no identity.
void compare_origin(Checkpoint const& c, Simulation& s, bool changed, RunLog& journal) {
  std::string const here = exec_host::backend_text(s.spec.run.backend);
  std::string const before = c.version.substr(0, c.version.find(' '));
  char const* const what = "the numbers may differ in their last digits from those of a run without interruption";
  if (changed || c.version != s.spec.identity.program || c.backend != here) s.spec.identity.run.clear();
  if (before != version())
    journal.warn(fmt::format("the checkpoint was written by Piola {}, this is {}; {}", before, version(), what));
  if (c.backend != here)
    journal.warn(
        fmt::format("the checkpoint was written with the instruction set {}, this is {}; {}", c.backend, here, what));
}

/// Differences of the case from that of the checkpoint, as lines for the log. Throws InputError if any of them would
/// make it another run.
std::vector<std::string> accepted_changes(Checkpoint const& c, CaseSpec const& spec,
                                          std::filesystem::path const& folder) {
  std::string const file = (folder / "case.toml").string();
  std::vector<std::string> accepted;
  std::string refused;
  for (CaseDifference const& d : case_differences(c.source, spec.source)) {
    std::string const line = fmt::format("{}: {} -> {}", d.key, d.before, d.after);
    if (may_change_on_resume(d.key))
      accepted.push_back(line);
    else
      refused += "\n  " + line;
  }
  if (!refused.empty()) {
    throw InputError(
        fmt::format("{}: is not the case that this run was started with (allowed to change: {}) - restore "
                    "it, or run it again with 'piola run'; what differs:{}",
                    file, keys_that_may_change(), refused));
  }
  if (spec.run.end < c.time) {
    throw InputError(
        fmt::format("{}: run.end = {} s lies before the newest checkpoint (allowed: from {} s on) - give a "
                    "later one",
                    file, spec.run.end, c.time));
  }
  return accepted;
}

/// Throws InputError if the bodies are not those of the checkpoint.
void refuse_other_particles(Checkpoint const& c, ParticleSet const& particles, std::filesystem::path const& folder) {
  std::string const differs = particle_difference(c.particles, particle_record(particles));
  if (differs.empty()) return;
  throw InputError(
      fmt::format("{}: the particles are not those of its checkpoint (needed: the same bodies from the same "
                  "files) - bring back the files of the case, or run it again with 'piola run'; what differs: {}",
                  folder.string(), differs));
}

}  // namespace

std::optional<TimeState> restore(Simulation& s, std::filesystem::path const& folder, RunLog& journal,
                                 std::vector<Observer*> const& observers, bool cut_too) {
  PIOLA_EXPECTS(s.formulation != nullptr);
  std::vector<std::string> warnings, changes;
  std::vector<std::filesystem::path> abandoned;
  TimeState moment;
  bool const found = use_newest_checkpoint(folder, warnings, [&](Checkpoint& c) {
    comm::on_root([&] {
      changes = accepted_changes(c, s.spec, folder);
      refuse_other_particles(c, s.particles, folder);
    });
    if (c.cut_to_end && c.time < s.spec.run.end && !cut_too) {
      abandoned.push_back(checkpoint_path(folder, c.step));
      return false;
    }
    moment = {.time = c.time,
              .step = c.step,
              .dt = c.dt,
              .first_dt = c.first_dt,
              .cut_to_end = c.cut_to_end,
              .wall_seconds = c.wall_seconds,
              .stepping_seconds = c.stepping_seconds};
    s.formulation->load(*c.in_file);
    for (Observer* observer : observers) observer->load(c.observers, moment);
    if (comm::rank() == 0) compare_origin(c, s, !changes.empty(), journal);
    return true;
  });
  if (!found) return std::nullopt;
  std::error_code kept_all_the_same;
  if (comm::rank() == 0)
    for (auto const& path : abandoned) std::filesystem::remove(path, kept_all_the_same);
  for (std::string const& warning : warnings) journal.warn(warning);
  for (std::string const& change : changes) journal.note("changed: " + change);
  return moment;
}

}  // namespace piola
