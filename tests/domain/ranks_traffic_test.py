# SPDX-License-Identifier: Apache-2.0
"""Ranks: the messages, bytes and collectives that ranks send in a step, counted (summary.json), are those that
`piola check --ranks` says, within a tenth: for each formulation and scheme, on lattices and clouds, with contact, on
2, 3 and 5 ranks.

Needs a program with MPI and mpirun; is skipped otherwise. PIOLA_RANKS_TESTS=quick takes a part of it.
"""
import json
import re
import sys
import tempfile
from pathlib import Path

from cases_on_ranks import RUBBING, TORN, of_taylor
from on_ranks import QUICK, SOURCE, expect, finish, piola, short_bar, skip_without_ranks

sys.path.insert(0, str(SOURCE / "bench"))
from ranks_memory import write_case  # noqa: E402

WITHIN = 0.1
UNITS = {"B": 1, "kB": 1e3, "MB": 1e6, "GB": 1e9}


def numbers(text):
    """Smallest and largest of "3 to 5" or "1.2 kB to 3 kB"."""
    found = []
    for part in text.split(" to "):
        value, unit = re.fullmatch(r"([\d,.]+) ?(\w*)", part.strip()).groups()
        found.append(float(value.replace(",", "")) * UNITS.get(unit, 1))
    return found[0], found[-1]


def said(case, ranks):
    told = piola(1, "check", case, "--ranks", ranks)
    expect(told.returncode == 0, f"check --ranks {ranks}: {told.stderr}")
    messages, size = re.search(r"it sends ([\d, to.]+) messages, ([\w, .]+?) in a step", told.stdout).groups()
    collectives = re.search(r"([\d,.]+) collectives", told.stdout).group(1)
    everybody = re.search(r"all ranks are told ([\d.]+ \w+) in", told.stdout)
    return {"messages": numbers(messages), "bytes": numbers(size), "collectives": numbers(collectives),
            "bytes_to_all": numbers(everybody.group(1)) if everybody else (0, 0)}


def ending(text, end):
    """The case with another end and the two rows of the history that there must be."""
    return re.sub(r'\nend = "[^"]+"', f'\nend = "{end}"', text) + f'\n[output.history]\nevery = "{end}"\n'


# Bodies that could meet and are too far from each other to tell ranks anything of it.
APART = """title = "Two blocks of AdapTLE that fly apart"
[run]
end = "0.4 us"
[contact]
friction = 0.3
""" + "".join(f"""[[body]]
name = "{name}"
shape.box = {{ min = ["0 mm", "{low} mm"], max = ["12 mm", "{low + 6} mm"] }}
shape.spacing = "0.25 mm"
shape.placement = "cell_centred"
material = {{ name = "copper_ofhc", damage = "none" }}
formulation = {{ name = "adaptle", description = "total_lagrangian" }}
initial_velocity = ["0 m/s", "{speed} m/s"]
""" for name, low, speed in (("low", 0, -5), ("high", 9, 5)))


def meeting(work):
    """What acts between bodies, and formulations that tell all ranks. What converts tells more than the model knows."""
    slow = TORN.replace("3100 m/s", "31 m/s").replace("200 m/s", "0 m/s").replace("500 m/s", "0 m/s")
    lagrangian = slow.replace("convert_strain = 0.05", 'description = "total_lagrangian"').replace(
        'convert_when = "plastic_strain > 0.05"', 'description = "total_lagrangian"')
    alone = RUBBING[:RUBBING.index('[[body]]\nname = "block"')].replace("[contact]\nfriction = 0.3\nself = true\n", "")
    flowing = alone.replace("total_lagrangian", "eulerian")
    rubbing = RUBBING.replace('{ name = "adaptle", description = "total_lagrangian" }', '{ name = "jst_sph" }')
    # More particles than are built for a look: other bodies decide what each of them tells. Coarser ones would meet.
    many = lagrangian.replace('"0.4 mm"', '"0.0235 mm"').replace('"0.6 mm"', '"0.3 mm"').replace("-5.5 mm", "-5.15 mm")
    write_case(work / "halves.toml", 60, "adaptle", "flow")
    halves = (work / "halves.toml").read_text()
    return {"rubbing": ending(RUBBING, "1.5 us"), "rubbing, jst_sph": ending(rubbing, "1.5 us"),
            "triangles": ending(of_taylor(""), "4 ms"),
            "boxes": ending(of_taylor(', virtual_particles = "lattice_cells"'), "4 ms"),
            "fixed triangles": ending(of_taylor(', configuration = "fixed"'), "4 ms"),
            "estimates, triangles": ending(
                of_taylor(', exchange = "kernel_sums", virtual_particles = "delaunay"', 0.15), "4 ms"),
            "estimates, boxes": ending(
                of_taylor(', exchange = "kernel_sums", virtual_particles = "lattice_cells"'), "4 ms"),
            "apart": APART + '[output.history]\nevery = "0.4 us"\n',
            "adaptle": ending(lagrangian, "0.4 us"),
            "many of adaptle": ending(many, "20 ns"), "many, flowing": halves,
            "adaptle, flowing": ending(flowing, "1.5 us"),
            "adaptle, corrected": ending(flowing.replace('"eulerian"', '"eulerian", correction = "mixed"'), "1.5 us")}


def compare(name, case, ranks, work):
    model = said(case, ranks)
    run = piola(ranks, "run", case, "--out", work / "run", "--force", "--no-pictures", "--quiet")
    if not expect(run.returncode == 0, f"{name} on {ranks} ranks: {run.stderr}"):
        return
    counted = json.loads((work / "run/summary.json").read_text())["ranks"]
    expect(len(counted) == ranks, f"{name}: {len(counted)} ranks counted of {ranks}")
    for what, (least, most) in model.items():
        values = [rank[what] for rank in counted]
        for expected, value in ((least, min(values)), (most, max(values))):
            # Where steps tell all ranks nothing, measurements of the step limit and rows do: little beside
            # the messages.
            of = value if expected > 0 else min(rank["bytes"] for rank in counted)
            expect(abs(value - expected) <= WITHIN * of,
                   f"{name} on {ranks} ranks: {what} {value:.4g} in a step, not {expected:.4g}")
    print(f"{name} on {ranks} ranks: " + ", ".join(
        f"{what} {min(r[what] for r in counted):.4g} to {max(r[what] for r in counted):.4g} (model {a:.4g} to {b:.4g})"
        for what, (a, b) in model.items()), flush=True)


skip_without_ranks()
with tempfile.TemporaryDirectory() as folder:
    work = Path(folder)
    bar = short_bar(work).read_text().replace("[5, 5, 9]", "[9, 9, 17]").replace('"20 ms"', '"12 ms"')
    # Rows gather, which the model leaves out of the counts.
    bar = bar.replace('every = "0.5 ms"', 'every = "12 ms"')
    jitter = bar.replace("particles = [9, 9, 17]", "particles = [9, 9, 17], jitter = 0.1")
    loaded = bar + '[[load]]\nbody = "bar"\nface = "+z"\ntraction = ["1 kPa", "0", "0"]\nname = "wind"\n'
    cases = {"default": bar, "jittered": jitter, "loaded": loaded}
    for scheme in ("paper", "robust"):
        cases[scheme] = bar.replace('{ name = "jst_sph" }', f'{{ name = "jst_sph", scheme = "{scheme}" }}')
    nodal = bar.replace('{ name = "jst_sph" }', '{ name = "nodal" }')
    cases["nodal"] = nodal
    cases["nodal, jittered"] = nodal.replace("particles = [9, 9, 17]", "particles = [9, 9, 17], jitter = 0.1")
    cases["nodal, given steps"] = nodal.replace("[run]", "[run]\ncfl = 0.2")
    cases["displacement"] = cases["robust"].replace('scheme =', 'variables = "displacement", scheme =')
    cases.update(meeting(work))
    for name, text in cases.items():
        if len(sys.argv) > 1 and not any(word in name for word in sys.argv[1:]):
            continue
        if QUICK and name not in ("default", "nodal", "rubbing", "rubbing, jst_sph", "adaptle"):
            continue
        (work / "case.toml").write_text(text)
        for ranks in (3,) if QUICK or name.startswith("many") else (2, 3, 5):
            compare(name, work / "case.toml", ranks, work)
finish()
