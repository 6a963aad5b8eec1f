# SPDX-License-Identifier: Apache-2.0
"""Shows that the tests of ranks find errors in what ranks send each other: makes one error after the other in a copy of
the sources, builds piola-mpi there, and runs a comparison that must fail.

Usage: tests/domain/mutants.py FOLDER [NUMBER...]     FOLDER: for the copy and its build, kept for the next time
About one minute for each mutant. Needs git, CMake, Ninja and MPI, as the preset audit.
"""
import io
import os
import shutil
import subprocess
import sys
import tarfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
# What is wrong, file below src/piola, text, text in its place, and a part of the name of a case of ranks_test.py.
MUTANTS = [
    ("half of the ghosts are not requested", "domain/halo_plan.cpp",
     "  read.erase(std::unique(read.begin(), read.end()), read.end());\n",
     "  read.erase(std::unique(read.begin(), read.end()), read.end());\n  read.resize(read.size() / 2);\n",
     "cases/jst_sph/bending_column"),
    ("stress of neighbours of jst_sph stays old", "formulations/jst_sph/step.hpp",
     "    halo_.refresh(b_.second);\n", "", "multipliers of the paper"),
    ("stress of neighbours of nodal stays old", "formulations/nodal/step.hpp",
     "    halo_.refresh(b_.stress_for_neighbours);\n", "", "mirrored copper"),
    ("stress of neighbours of adaptle stays old", "formulations/adaptle/step_halo_exchanges.cpp",
     "    halo.plan.exchange(fields);\n", "", "torn plate"),
    ("records of spatial ghosts are not sent", "formulations/adaptle/step_halo_exchanges.cpp",
     "{spatial_records(s), 0, s.settings.corrected ? corrected : all}", "{spatial_records(s), 0, 1}", "fluxes"),
    ("velocities of ghosts in contact stay old", "formulations/adaptle/step_halo_exchanges.cpp",
     "{{s.field.v_half, 0, 3}, {s.field.volume_half, 0, 1}}", "{{s.field.volume_half, 0, 1}}", "meeting"),
    ("the step of a rank is that of its own particles", "formulations/adaptle/step.hpp",
     "      to.m.dt = from.m.dt < to.m.dt ? from.m.dt : to.m.dt;\n", "", "on a wall"),
    ("ranks do not tell who converts", "formulations/adaptle/conversion.cpp",
     "*static_cast<std::uint64_t*>(mine) |= *static_cast<std::uint64_t const*>(other);", "(void)other, (void)mine;",
     "torn plate"),
    ("a field of particles that move to another rank is lost", "formulations/adaptle/distribution.cpp",
     "    if (!particles.is_replicated(field)) fields.emplace_back(field, components);\n",
     "    if (!particles.is_replicated(field) && components != 6) fields.emplace_back(field, components);\n",
     "cut anew: torn plate"),
    ("equations of supports have old positions", "formulations/jst_sph/multipliers.cpp",
     "  merge(body.x);\n", "", "multipliers"),
    ("held surfaces have old positions", "mechanics/surface_constraint.cpp",
     "  if (own_) allgather_selected_slots(field, *own_, slots_, D_);\n", "", "held packing"),
    ("sums over particles are those of one rank", "domain/communicator_mpi.cpp",
     "    world.combine(static_cast<char const*>(others) + at, static_cast<char*>(mine) + at);\n", "    (void)at;\n",
     "cases/jst_sph/bending_column"),
    ("surfaces in contact have old positions of other ranks", "formulations/common/bodies_solver.hpp",
     "  if (!both.empty()) comm::allreduce_or({both.front().data(), 3 * both.size()});\n", "", "touching bodies"),
]


def copy_to(folder):
    """The sources of the last commit, configured; a copy of another commit is replaced."""
    head = ["git", "-C", SOURCE, "rev-parse", "HEAD"]
    commit = subprocess.run(head, check=True, capture_output=True, text=True).stdout
    mark = folder / "commit-of-mutants"
    if mark.exists() and mark.read_text() == commit:
        return
    if mark.exists():
        shutil.rmtree(folder)
    elif folder.exists() and any(folder.iterdir()):
        sys.exit(f"{folder}: holds other things (an empty folder is needed) - give another one")
    folder.mkdir(parents=True, exist_ok=True)
    mark.write_text(commit)
    archive = subprocess.run(["git", "-C", SOURCE, "archive", "HEAD"], check=True, capture_output=True).stdout
    tarfile.open(fileobj=io.BytesIO(archive)).extractall(folder)
    subprocess.run(["cmake", "--preset", "audit", "-DPIOLA_TOGETHER=ON", "-DPIOLA_INSTRUCTION_SETS=two"], cwd=folder,
                   check=True, stdout=subprocess.DEVNULL)


def build(folder):
    return subprocess.run(["ninja", "-C", "build/audit", "piola-mpi"], cwd=folder, capture_output=True).returncode == 0


def test(folder, case):
    """Whether the comparison of this case fails."""
    environment = {**os.environ, "PIOLA_RANKS_TESTS": "quick", "PIOLA_SOURCE_DIR": str(folder),
                   "PIOLA_RANKS_PROGRAM": str(folder / "build/audit/piola-mpi")}
    run = subprocess.run([sys.executable, folder / "tests/domain/ranks_test.py", case], env=environment,
                         capture_output=True, text=True)
    return run.returncode != 0


def is_found(folder, mutant):
    what, name, text, other, case = mutant
    file = folder / "src/piola" / name
    whole = file.read_text()
    if whole.count(text) != 1:
        sys.exit(f"{name}: holds {whole.count(text)} times {text.strip()!r} - give the mutant '{what}' other words")
    file.write_text(whole.replace(text, other))
    try:
        if not build(folder):
            sys.exit(f"the mutant '{what}' cannot be built")
        return test(folder, case)
    finally:
        file.write_text(whole)


def main(folder, *numbers):
    folder = Path(folder).resolve()
    copy_to(folder)
    missed = 0
    for number in map(int, numbers or range(len(MUTANTS))):
        what, *_, case = MUTANTS[number]
        found = is_found(folder, MUTANTS[number])
        missed += not found
        print(f"{number}: {what}: {'found' if found else 'NOT FOUND'} by '{case}'", flush=True)
    build(folder)
    intact = {MUTANTS[number][4] for number in map(int, numbers or range(len(MUTANTS)))}
    broken = [case for case in sorted(intact) if test(folder, case)]
    print(f"{missed} not found; without an error {len(intact) - len(broken)} of {len(intact)} comparisons pass")
    sys.exit(1 if missed or broken else 0)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
