# SPDX-License-Identifier: Apache-2.0
"""What each rank of a run takes of memory at most, and its messages and collectives in a step: a cube of N^3 particles, a
step or a few, with frames, checkpoints and rows of the history. Or, of adaptle, two halves of it that collide: with `impact` as they are, total-Lagrangian; with `flow` the second
one is Eulerian.

Usage: bench/ranks_memory.py PROGRAM [N [RANKS,RANKS... [FORMULATION [jitter|impact|flow]]]]  (default: 80, 1,2,4, jst_sph)
PROGRAM must know MPI (PIOLA_MPI, or piola-mpi of PIOLA_MPI_BESIDE). Ranks have one thread each; there may be more of them
than cores.
"""
import json
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

CASE = """title = "Cube"
[run]
end = "{end} s"
[output.frames]
every = "{end} s"
fields = ["Displacement", "CauchyStress"]
[output.checkpoints]
every = "{end} s"
[output.history]
every = "{end} s"
[[body]]
name = "cube"
shape = {{ box = {{ min = ["0 m", "0 m", "0 m"], max = ["1 m", "1 m", "1 m"] }}, particles = [{n}, {n}, {n}]{more} }}
material = {{ law = "neo_hookean", density = "7000 kg/m^3", youngs_modulus = "21 GPa", poissons_ratio = 0.3 }}
formulation = {{ name = "{formulation}" }}
initial_velocity = ["0 m/s", "10 m/s", "0 m/s"]
[[support]]
body = "cube"
where = "Y < 1e-9"
fix = "xyz"
"""
HALF = """[[body]]
name = "{name}"
shape = {{ box = {{ min = ["0 m", "0 m", "{low} m"], max = ["1 m", "1 m", "{high} m"] }}, particles = [{n}, {n}, {half}] }}
material = {{ law = "elastic", density = "7000 kg/m^3", youngs_modulus = "21 GPa", poissons_ratio = 0.3 }}
formulation = {{ name = "adaptle", description = "{description}" }}
initial_velocity = ["0 m/s", "0 m/s", "{velocity} m/s"]
"""


def write_case(file, n, formulation, more):
    """more: jitter, impact, flow, or nothing."""
    n = int(n)
    jitter = ", jitter = 0.2" if more == "jitter" else ""
    case = CASE.format(n=n, formulation=formulation, end=1e-4 / n, more=jitter)
    if formulation == "adaptle":
        case = case.replace("neo_hookean", "elastic")
    if more in ("impact", "flow"):
        second = "eulerian" if more == "flow" else "total_lagrangian"
        halves = (("lower", 0, 0.5, 10, "total_lagrangian"), ("upper", 0.53, 1.03, -10, second))
        case = case[:case.index("[[body]]")] + "".join(
            HALF.format(name=name, low=low, high=high, velocity=velocity, description=description, n=n, half=n // 2)
            for name, low, high, velocity, description in halves)
        case += '[contact]\nlaw = "kernel"\n'  # they touch at the start
    file.write_text(case)


def run_as_rank(report, words):
    """What mpirun starts once per rank: the program, whose largest memory is noted."""
    status = subprocess.run(words, stdout=subprocess.DEVNULL).returncode
    with open(report, "a") as file:
        file.write(f"{resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss}\n")
    sys.exit(status)


def largest_of_ranks(program, ranks, case, folder):
    """Bytes of each rank, largest first."""
    report = folder / "memory"
    report.write_text("")
    words = [program, "run", case, "-o", folder / "run", "--force", "--threads", "1", "--no-pictures", "--quiet"]
    start = [sys.executable, __file__, "--rank", report]
    if ranks > 1:
        start = ["mpirun", "--oversubscribe", "--allow-run-as-root", "--mca", "plm", "isolated", "-n", str(ranks), *start]
    subprocess.run([*start, *words], check=True)
    return sorted((1024 * int(line) for line in report.read_text().split()), reverse=True)


def counts_of_step(run):
    """Of the rank with the most, from summary.json; nothing on one rank."""
    ranks = json.loads((run / "summary.json").read_text()).get("ranks", [])
    if not ranks:
        return ""
    most = {key: max(rank[key] for rank in ranks) for key in ("messages", "bytes", "collectives", "replicated_bytes")}
    return ("; in a step {messages:.1f} messages of {:.0f} kB in all, {collectives:.1f} collectives, {:.1f} kB "
            "replicated".format(most["bytes"] / 1e3, most["replicated_bytes"] / 1e3, **most))


def main():
    if sys.argv[1] == "--rank":
        run_as_rank(sys.argv[2], sys.argv[3:])
    words = sys.argv[1:] + ["80", "1,2,4", "jst_sph", ""][len(sys.argv) - 2:]
    program, n, counts, formulation, more = words
    with tempfile.TemporaryDirectory() as folder:
        case = Path(folder) / "case.toml"
        write_case(case, n, formulation, more)
        for ranks in map(int, counts.split(",")):
            found = largest_of_ranks(program, ranks, case, Path(folder))
            print(f"{n}^3 of {formulation} on {ranks}: " + ", ".join(f"{size / 1e6:.0f}" for size in found) + " MB"
                  + counts_of_step(Path(folder) / "run"), flush=True)


if __name__ == "__main__":
    main()
