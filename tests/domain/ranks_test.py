# SPDX-License-Identifier: Apache-2.0
"""Ranks: every case that can, on 1, 2, 3 and 5 ranks, has the same bytes: history, frames, checkpoints, pictures, the
log and the summary but for what times and counts of ranks they name. So it has if particles are shared out anew every
three steps, by measured work or at random. A run goes on with another number of ranks; what is refused is said once.

Needs a program with MPI and mpirun; is skipped otherwise. Words choose: cases, own, variants, recuts, mixed, restarts,
words; a part of the name of a case, cases/contact for example, chooses among the cases of the first four.
PIOLA_RANKS_TESTS=quick takes a part of them, on 2 and 3 ranks.
"""
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from cases_on_ranks import DESCENDING, ESCAPED, FAILING, OWN_CASES, TAYLOR, VARIANTS, WHIRLED
from on_ranks import (ENVIRONMENT, QUICK, SOURCE, checkpoint, contents, differences, expect, finish, piola, short_bar,
                      skip_without_ranks)

STEPS = 20
QUICK_PART = ["cases/jst_sph/bending_column", "touching bodies", "probed", "torn plate",
              "that flow", "damped patch", "deleted", "columns", "large files", "restarts", "words"]
OFTEN = "run.repartition=3"  # steps
SHOWN = {"crushed cells": "repeated_steps", "torn plate": "converted_particles",
         "torn plate with probes": "converted_particles",  # columns above zero at the end
         "disc and plate that flow": "eulerian_particles",
         "deleted disc": "deleted_particles", "rubbing bar of AdapTLE": "friction_heat"}
SHARED = re.compile(r'name = "(jst_sph|nodal|adaptle)"')  # the formulations of bodies that ranks share
# What no case of one rank has together: two bodies, jitter, a mirror plane, loads, a release.
MIXED = """title = "Two bodies"
contact = "none"
[run]
end = "1 ms"
[[body]]
name = "rubber"
shape = { box = { min = ["0 mm", "0 mm", "0 mm"], max = ["40 mm", "20 mm", "10 mm"] }, spacing = "2 mm", jitter = 0.1 }
material = { law = "neo_hookean", density = 1100, youngs_modulus = "5 MPa", poissons_ratio = 0.45 }
formulation = { name = "jst_sph" }
initial_velocity = ["50*X", "0", "3 m/s"]
[[body]]
name = "copper"
shape = { box = { min = ["60 mm", "0 mm", "0 mm"], max = ["90 mm", "16 mm", "10 mm"] }, spacing = "2 mm" }
material = { law = "neo_hookean", density = 8960, youngs_modulus = "124 GPa", poissons_ratio = 0.34 }
formulation = { name = "jst_sph" }
initial_velocity = ["-3000*(X - 0.06)", "0", "0"]
[[mirror]]
body = "rubber"
face = "-x"
[[load]]
body = "rubber"
face = "+x"
traction = ["1 kPa", "0", "0"]
[[load]]
body = "copper"
face = "+z"
pressure = "2 MPa"
[[load]]
body = "copper"
acceleration = ["0 m/s^2", "-9.81 m/s^2", "0 m/s^2"]
[[support]]
body = "rubber"
where = "Y < 1e-6"
fix = "y"
until = "20 us"
[[support]]
body = "copper"
where = "X < 0.0601"
fix = "xyz"
[[probe]]
name = "top"
body = "rubber"
kind = "average"
where = "Z > 9e-3"
quantities = ["velocity_x", "pressure"]
[output.frames]
every = "10 ms"
[output.checkpoints]
every = "10 ms"
"""


def able_cases():
    """Axisymmetric bodies of adaptle, and those of taylor_sph, are refused on several ranks."""
    def able(text):
        return (SHARED.search(text) and 'name = "taylor_sph"' not in text
                and not ("axisymmetric" in text and 'name = "adaptle"' in text))

    return [file for file in sorted((SOURCE / "cases").rglob("case.toml")) if able(file.read_text())]


def first_step(file, work, settings=()):
    """[s], as the run says it; the run itself is as short as can be."""
    words = ["run", file, "--no-pictures", "--out", work / "first", "--set", 'run.end="1e-12 s"']
    told = piola(1, *words, *settings).stdout
    value, unit = re.search(r"first step ([\d.e+-]+) (\w+)", told).groups()
    return float(value) * {"s": 1, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "ps": 1e-12}[unit]


def last_of(folder, column):
    """The last value of a column of history.csv."""
    lines = [line for line in (folder / "history.csv").read_text().strip().splitlines()]
    names = [line for line in lines if column in line][-1]
    return float(lines[-1].split(",")[names.split(",").index(column)])


def draw_cuts(seed):
    """Of runs from now on; None: cuts follow measured work."""
    ENVIRONMENT.pop("PIOLA_DRAWN_CUTS", None)
    if seed is not None:
        ENVIRONMENT["PIOLA_DRAWN_CUTS"] = str(seed)


def compare_case(file, name, work, overrides=(), column=None):
    """column: what is above zero at the end, so that it is compared."""
    settings = [word for override in overrides for word in ("--set", override)]
    end = f'run.end="{STEPS * first_step(file, work, settings):.9e} s"'
    settings = ["--set", end, *settings]
    reference = work / "one"
    one = piola(1, "run", file, "--out", reference, *settings)
    # Dynamic relaxation that is not at rest at the end fails.
    codes = (0, 3) if re.search(r"^relax = true", file.read_text(), re.MULTILINE) else (0,)
    expect(one.returncode in codes, f"{name} on one rank: {one.stderr}")
    expected = contents(reference)
    expect(any(key.startswith("checkpoints") for key in expected), f"{name}: no checkpoint to compare")
    if column:
        expect(last_of(reference, column) > 0, f"{name}: nothing of what is to be compared, {column}")
    for ranks, threads in ((2, 1), (3, 1)) if QUICK else ((2, 2), (3, 1), (5, 1)):
        several = work / str(ranks)
        drawn = OFTEN in overrides and ranks > 2
        draw_cuts(ranks if drawn else None)
        run = piola(ranks, "run", file, "--out", several, *settings, threads=threads)
        expect(run.returncode == one.returncode, f"{name} on {ranks} ranks: {run.stdout}{run.stderr}")
        ends = run.stdout.count("completed at") + run.stdout.count("failed at")
        expect(ends == 1, f"{name} on {ranks} ranks prints {ends} reports")
        different = differences(expected, contents(several)) if several.is_dir() else ["everything"]
        expect(not different, f"{name} on {ranks} ranks with {threads} threads differs in {different[:8]}")
        if drawn and expect((several / "summary.json").is_file(), f"{name}: no summary"):
            cuts = json.loads((several / "summary.json").read_text())["repartition"]["count"]
            expect(cuts >= STEPS // 3 - 2, f"{name} on {ranks} ranks was cut {cuts} times")
        shutil.rmtree(several, ignore_errors=True)
    print(f"{name}: {len(expected)} files and datasets compared", flush=True)


def compare_restarts(bar, work):
    """2 to 3 to 1 rank against a run without interruption."""
    whole, parts = work / "whole", work / "parts"
    piola(1, "run", bar, "--out", whole)
    expect(piola(2, "run", bar, "--out", parts, "--set", 'run.end="7.3 ms"').returncode == 0, "the first part")
    for ranks, end in ((3, "13.1 ms"), (1, "20 ms")):
        resumed = piola(ranks, "resume", parts, "--set", f'run.end="{end}"')
        expect(resumed.returncode == 0, f"resumed on {ranks} ranks: {resumed.stderr}")
    final = sorted((whole / "checkpoints").glob("*.h5"))[-1].name
    expect((parts / "checkpoints" / final).is_file(), f"the resumed run does not end with {final}")
    # The case says another end, and pictures note those of the ends before: on one rank, too.
    state = [{name: value for name, value in checkpoint(folder / "checkpoints" / final).items()
              if name != "case" and not name.startswith("observers/picture")} for folder in (whole, parts)]
    expect(len(state[0]) > 5 and not differences(*state),
           "the run resumed on 2, 3 and 1 ranks ends in another state")
    expect((whole / "history.csv").read_bytes() == (parts / "history.csv").read_bytes(),
           "the run resumed on 2, 3 and 1 ranks has another history")


def compare_own_restart(name, text, work):
    """2 to 3 to 1 rank against one rank. The default interval of the history would follow the end of the run."""
    work.mkdir()
    file = work / "case.toml"
    file.write_text(text)
    step = first_step(file, work)
    file.write_text(f'{text}\n[output.history]\nevery = "{step:.9e} s"\n')
    piola(1, "run", file, "--no-pictures", "--out", work / "whole", "--set", f'run.end="{30 * step:.9e} s"')
    for ranks, steps in ((2, 11), (3, 19), (1, 30)):
        words = ["run", file, "--no-pictures", "--out", work / "parts"] if steps == 11 else ["resume", work / "parts"]
        told = piola(ranks, *words, "--set", f'run.end="{steps * step:.9e} s"')
        expect(told.returncode == 0, f"{name} to step {steps} on {ranks} ranks: {told.stderr}")
    last = [sorted((work / folder / "checkpoints").glob("*.h5"))[-1] for folder in ("whole", "parts")]
    state = [{key: value for key, value in checkpoint(file).items()
              if key != "case" and not key.startswith("observers/picture")} for file in last]
    expect(len(state[0]) > 5 and not differences(*state), f"{name} on 2, 3, 1 ranks ends in {differences(*state)[:8]}")


def check_words(bar, work):
    """One message, whoever finds what is wrong, and the exit code of one rank."""
    (work / "taylor.toml").write_text(TAYLOR)
    for words, code, text in (
            (["run", work / "taylor.toml", "--out", work / "no"], 2, 'the formulation "taylor_sph" runs on one rank'),
            (["run", bar, "--set", "run.ende=1"], 2, "is not a key of run"),
            (["run", "nothing.toml"], 2, "no such case file"),
            (["check", bar], 2, "start this command without mpirun"),
            (["fly"], 2, "fly")):
        told = piola(2, *words)
        expect(told.returncode == code, f"{words}: exit code {told.returncode} instead of {code}: {told.stderr}")
        expect(told.stderr.count(text) == 1, f"{words}: '{text}' is said {told.stderr.count(text)} times")
    wrong = bar.read_text().replace('youngs_modulus = "17 MPa"', 'youngs_modulus = "17 Pa"')
    (work / "soft.toml").write_text(wrong)
    alone, shared = (piola(n, "run", work / "soft.toml", "--out", work / f"soft{n}", "--no-pictures", "--set",
                           'run.end="10 s"') for n in (1, 3))
    expect(alone.returncode == 3, f"the soft bar does not fail: {alone.stdout}{alone.stderr}")
    expect(shared.returncode == 3, f"the soft bar on 3 ranks: exit code {shared.returncode}")
    said = [line for line in alone.stderr.splitlines() if "particle" in line][:1]
    expect(said and said[0] in shared.stderr, f"the failure on 3 ranks is another one: {shared.stderr}")
    for name, text in (("crushed", FAILING), ("escaped", ESCAPED), ("whirled", WHIRLED), ("descending", DESCENDING)):
        (work / f"{name}.toml").write_text(text)
        alone, shared = (piola(n, "run", work / f"{name}.toml", "--out", work / f"{name}{n}") for n in (1, 3))
        expect(alone.returncode == 3 and shared.returncode == 3,
               f"{name} ends with {alone.returncode}, on 3 ranks with {shared.returncode}: {shared.stderr}")
        different = differences(*(contents(work / f"{name}{n}") for n in (1, 3)))
        expect(not different, f"what the failure of {name} leaves differs on 3 ranks in {different[:8]}")


skip_without_ranks()
with tempfile.TemporaryDirectory() as folder:
    work = Path(folder)
    bar = short_bar(work)
    everything = ["cases", "own", "variants", "recuts", "mixed", "restarts", "words"]
    chosen = sys.argv[1:] or (QUICK_PART if QUICK else everything)
    cases = [(file, f"cases/{file.parent.relative_to(SOURCE / 'cases')}", "cases", (), None) for file in able_cases()]
    expect(len(cases) >= 65, f"only {len(cases)} cases run on ranks")
    for name, text in OWN_CASES.items():
        file = work / f"{re.sub('[^a-z]+', '_', name.lower())}.toml"
        file.write_text(text)
        cases.append((file, name, "own", (), SHOWN.get(name)))
    for name, (folder, column, overrides) in VARIANTS.items():
        cases.append((SOURCE / "cases/adaptle" / folder / "case.toml", name, "variants", overrides, column))
        cases.append((SOURCE / "cases/adaptle" / folder / "case.toml", f"cut anew: {name}", "recuts",
                      [*overrides, OFTEN], column))
    for name in ("torn plate", "torn plate with probes", "deleted disc", "rubbing bar of AdapTLE"):
        cases.append((work / f"{name.lower().replace(' ', '_')}.toml", f"cut anew: {name}", "recuts", [OFTEN],
                      SHOWN[name]))
    for file, name, kind, overrides, column in cases:
        if kind in chosen or any(word in name for word in chosen):
            own = work / file.stem / name.replace(" ", "_").replace("/", "_")
            own.mkdir(parents=True)
            compare_case(file, name, own, overrides, column)
            shutil.rmtree(own)
    if "mixed" in chosen:
        (work / "mixed.toml").write_text(MIXED)
        compare_case(work / "mixed.toml", "two bodies", work)
    if "restarts" in chosen:
        compare_restarts(bar, work)
        for name in ("touching bodies", "mirrored copper", "crushed cells", "torn plate",
                     "deleted disc", "large files"):
            compare_own_restart(name, OWN_CASES[name], work / f"restart_{name.replace(chr(32), chr(95))}")
        draw_cuts(1)
        for name in ("torn plate", "deleted disc"):
            compare_own_restart(f"{name}, cut anew", OWN_CASES[name].replace("[run]", "[run]\nrepartition = 2"),
                                work / f"recut_{name.replace(chr(32), chr(95))}")
        draw_cuts(None)
    if "words" in chosen:
        check_words(bar, work)
finish()
