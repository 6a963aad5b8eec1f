#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tries every cell of docs/user/features.md: a tiny case runs a few steps where a cell says "yes", and shows an effect;
it is refused with exit status 2 and a message where the cell says "no".

Usage: features_test.py            compares with the page
       features_test.py --show     prints what happens, cell by cell
"""
import atexit
import concurrent.futures
import copy
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(os.environ["PIOLA_SOURCE_DIR"])
PROGRAM = os.environ.get("PIOLA_PROGRAM", "")
PAGE = ROOT / "docs/user/features.md"
FORMULATIONS = ("nodal", "jst_sph", "taylor_sph", "adaptle")
LAWS = {"nodal": "neo_hookean", "jst_sph": "neo_hookean", "taylor_sph": "linear_elastic", "adaptle": "elastic"}
STEEL = {"density": 7800, "youngs_modulus": 2e11, "poissons_ratio": 0.3}
BULK = {"density": 7800, "bulk_modulus": 1.6e11}
RELAXES = BULK | {"shear_modulus": 8e10, "g_1": 0.5}
YIELD = STEEL | {"yield_stress": 2e8}
HARDENS = YIELD | {"hardening_coefficient": 2e8, "hardening_exponent": 0.5, "melting_temperature": 1800}

CONCRETE = {"law": "holmquist_johnson_cook", "density": 2440, "shear_modulus": 14.86e9, "compressive_strength": 48e6,
            "tensile_strength": 4e6, "cohesive_strength": 0.79, "pressure_hardening": 1.6, "pressure_exponent": 0.61,
            "fracture_coefficient": 0.04, "crush_pressure": 16e6, "crush_compression": 0.001, "lock_pressure": 0.8e9,
            "lock_compression": 0.1, "k1": 85e9}
LAMINA = {"law": "orthotropic", "density": 1600, "youngs_modulus_2": 1e10, "youngs_modulus_3": 1e10,
          "poissons_ratio_12": 0.28, "poissons_ratio_13": 0.28, "poissons_ratio_23": 0.45, "shear_modulus_12": 7e9,
          "shear_modulus_13": 7e9, "shear_modulus_23": 3.5e9}

SPALL = {"spall_pressure": 1e8, "spall": "hydrostatic"}


# Small bodies. Sizes are in units of the spacing, 0.1 m.

def box(low, high):
    return {"box": {"min": [0.1 * x for x in low], "max": [0.1 * x for x in high]}, "spacing": 0.1}


def body(formulation, shape=None, name="block", **more):
    law = {"law": LAWS[formulation], "density": 1000, "youngs_modulus": 1e7, "poissons_ratio": 0.3}
    return {"name": name, "shape": shape or box([0, 0], [8, 5]), "material": law,
            "formulation": {"name": formulation}, "initial_velocity": ["Y", "0"]} | more


def case(*bodies, **more):
    """Steps are the same with and without an ability, so that a shorter step is not taken for an effect."""
    return {"title": "tiny", "run": {"end": 8e-3, "max_step": 1e-4, "threads": 1}, "body": list(bodies)} | more


def plain(formulation):
    return case(body(formulation))


def two(formulation, other=None, gap=0.1, speed=10):
    """Two blocks, the right one on its way to the left one."""
    cells = {"placement": "cell_centred"}
    left = body(formulation, box([0, 0], [4, 4]) | cells, "left", initial_velocity=["0", "0"])
    right = body(other or formulation, box([4 + gap, 0], [8 + gap, 4]) | cells, "right",
                 initial_velocity=[f"{-speed}", "0"])
    for one in (left, right):
        if one["formulation"]["name"] == "adaptle":
            one["formulation"]["description"] = "total_lagrangian"
    return case(left, right)


def falling(formulation):
    """A block that comes down on a floor at y = 0."""
    block = body(formulation, box([0, 0.5], [8, 5.5]), initial_velocity=["5", "-10"])
    if formulation == "adaptle":
        block["formulation"]["description"] = "total_lagrangian"
    return case(block)


# Each ability: from the name of a formulation to (the case with it, the case without it or None).

def with_body(**more):
    def make(formulation):
        made = plain(formulation)
        made["body"][0] |= more
        return made, plain(formulation)
    return make


def with_case(**more):
    return lambda formulation: (plain(formulation) | more, plain(formulation))


def with_run(**more):
    def make(formulation):
        made = plain(formulation)
        made["run"] |= more
        return made, plain(formulation)
    return make


def material(*, without=None, **given):
    """A metal or another law, whose waves are fast, as it is drawn out; the same material without some of it."""
    def metal(formulation, words):
        made = plain(formulation)
        made["body"][0] |= {"material": words, "initial_velocity": ["500*X", "0"]}
        made["run"] |= {"end": 1e-4, "max_step": 1e-6}
        return made
    return lambda formulation: (metal(formulation, given), without and metal(formulation, without))


def own_law():
    """A law of the user's: the library of an example, compiled here."""
    library = Path(tempfile.mkdtemp()) / "voce.so"
    atexit.register(shutil.rmtree, library.parent)
    subprocess.run(["cc", "-O2", "-shared", "-fPIC", "-I", ROOT / "src/piola/materials",
                    ROOT / "examples/user-materials/voce.c", "-o", library, "-lm"], check=True)
    return {"library": str(library), "density": 7800, "youngs_modulus": 2e11, "poissons_ratio": 0.3}


def metal(**given):
    """A metal that yields; without: only that."""
    return material(law="perfectly_plastic", **YIELD, **given, without={"law": "perfectly_plastic", **YIELD})


def warm_end(formulation):
    """A metal that is warm at one end, and softer there."""
    made, without = material(law="johnson_cook", **HARDENS, specific_heat=400,
                             without={"law": "johnson_cook", **HARDENS, "specific_heat": 400})(formulation)
    made["body"][0]["initial_temperature"] = "300 + 1000*X"
    return made, without


def setting(**given):
    def make(formulation):
        made = plain(formulation)
        made["body"][0]["formulation"] |= given
        return made, None
    return make


def description(names):
    """The setting that makes the description, where there is one: {formulation: settings}."""
    def make(formulation):
        return setting(**names.get(formulation, {"description": "none"}))(formulation)
    return make


def torn(names):
    """As description(), of a metal."""
    def make(formulation):
        made = metal()(formulation)[0] if formulation == "nodal" else plain(formulation)
        made["body"][0]["formulation"] |= names.get(formulation, {"description": "none"})
        return made, None
    return make


def shape(**given):
    return lambda formulation: (case(body(formulation, dict(given))), None)


def support(**given):
    def make(formulation):
        held = {"body": "block", "where": "X <= 0.01", "fix": "xy"} | given
        return plain(formulation) | {"support": [held]}, plain(formulation)
    return make


def relaxed(formulation):
    """A held block that comes to rest under a weight."""
    made = support()(formulation)[0] | {"load": [{"body": "block", "acceleration": ["0", "-9.81"]}]}
    made["run"] |= {"relax": True, "end": 0.5}
    return made, plain(formulation)


def descended(formulation):
    """As above, by conjugate gradients."""
    made, without = relaxed(formulation)
    made["run"] |= {"relax_method": "conjugate_gradients"}
    return made, without


def held_surface(formulation):
    """A packed block held on its face, and by the particles along it."""
    def held(what):
        block = body(formulation, box([0, 0], [8, 5]) | {"arrangement": "packed"})
        return case(block, support=[{"body": "block", "patch": "-x", "fix": "xy", "hold": what}])
    return held("surface"), held("particles")


def parts(formulation):
    """A block whose right half is stiffer."""
    made = plain(formulation)
    other = made["body"][0]["material"] | {"youngs_modulus": 4e7}
    made["region"] = [{"name": "right", "where": "X > 0.42"}]
    made["body"][0]["part"] = [{"where": "right", "material": other}]
    return made, plain(formulation)


def compared(make, **without):
    """The same with something else in the support instead of what it had."""
    def both(formulation):
        made, _ = make(formulation)
        other = copy.deepcopy(made)
        for key, value in without.items():
            other["support"][0].pop(key, None)
            if value is not None:
                other["support"][0][key] = value
        return made, other
    return both


def multipliers(formulation):
    made, _ = support()(formulation)
    other = copy.deepcopy(made)
    made["body"][0]["formulation"]["supports"] = "multipliers"
    return made, other


def load(**given):
    return with_case(load=[{"body": "block"} | given])


def contact(other=None, **table):
    def make(formulation):
        made = two(formulation, other)
        if table:
            made["contact"] = table
        return made, two(formulation, other) | {"contact": {"law": "none"}}
    return make


def friction(formulation):
    made = two(formulation)
    for one, speed in zip(made["body"], ("0", "-10")):
        one["initial_velocity"] = [speed, "5" if speed != "0" else "0"]
    return made | {"contact": {"law": "surface", "friction": 0.5}}, made | {"contact": {"law": "surface"}}


def own(formulation):
    """A block with a slit that closes; taylor_sph, which refuses the packed cloud: with a crack."""
    slit = [{"box": {"min": low, "max": high}} for low, high in (([0, 0], [1, 1]), ([0.2, 0.45], [1.1, 0.55]))]
    block = body(formulation, {"difference": slit, "spacing": 0.1}, initial_velocity=["0", "Y > 0.5 ? -20 : 20"])
    if formulation == "adaptle":
        block["formulation"]["description"] = "total_lagrangian"
    if formulation == "taylor_sph":
        made, _ = crack(formulation)
        return made | {"contact": {"law": "surface", "self": True}}, None
    return case(block) | {"contact": {"law": "surface", "self": True}}, case(block)


def rigid(**given):
    def make(formulation):
        floor = {"name": "floor", "box": {"min": [-1, -0.5], "max": [2, 0]}} | given
        return falling(formulation) | {"rigid": [floor]}, falling(formulation)
    return make


def on_free_shape(**more):
    """What acts on a free shape: keys of its section, or other sections as lists."""
    def make(formulation):
        free, _ = rigid(motion="free", mass=100)(formulation)
        acted = copy.deepcopy(free)
        for key, value in more.items():
            (acted if key == "spring" else acted["rigid"][0])[key] = value
        return acted, free
    return make


def rigid_friction(formulation):
    made, _ = rigid()(formulation)
    return made | {"contact": {"law": "surface", "friction": 0.5}}, made | {"contact": {"law": "surface"}}


def tie(**given):
    def make(formulation):
        made = two(formulation, gap=0.0, speed=-1)
        return made | {"tie": [{"between": ["left", "right"]} | given], "contact": {"law": "none"}}, \
            made | {"contact": {"law": "none"}}
    return make


def tie_to_rigid(formulation):
    """A block that would fly off a fixed shape."""
    block = body(formulation, box([0, 0], [8, 5]), initial_velocity=["0", "10"])
    if formulation == "adaptle":
        block["formulation"]["description"] = "total_lagrangian"
    floor = {"name": "floor", "box": {"min": [-1, -0.5], "max": [2, 0]}}
    made = case(block) | {"rigid": [floor], "contact": {"law": "surface"}}
    return made | {"tie": [{"between": ["block", "floor"]}]}, made


def crack(formulation):
    made = plain(formulation) | {"load": [{"body": "block", "face": "+y", "traction": ["0", "1e5"]}]}
    made["body"][0] |= {"shape": box([0, 0], [8, 6])}
    return made | {"crack": [{"body": "block", "from": [0, 0.3], "to": [0.4, 0.3]}]}, made


def follows(formulation):
    made = plain(formulation) | {"load": [{"body": "block", "face": "+x", "pressure": "1e6", "follower": True}]}
    made["body"][0]["initial_velocity"] = ["-30*Y", "30*X"]
    other = copy.deepcopy(made)
    other["load"][0]["follower"] = False
    return made, other


def radiates(formulation):
    made = plain(formulation)
    return made | {"load": [{"body": "block", "face": "+x", "non_reflecting": True}]}, made


def bar(**settings):
    def make(formulation):
        made = case(body(formulation, box([0], [8]), initial_velocity=["X"]))
        made["body"][0]["formulation"] |= settings
        return made, None
    return make


def ring(formulation):
    made = case(body(formulation, box([10, 0], [18, 5])))
    return made | {"geometry": "axisymmetric"}, made


def spinning_column(formulation):
    return case(body(formulation, box([0, 0, 0], [4, 3, 3]), initial_velocity=["0", "-Z", "Y"])), None


FEATURES = {
    "one dimension": bar(),
    "one dimension, uniaxial stress": bar(assumption="uniaxial_stress"),
    "two dimensions, plane strain": lambda f: (plain(f), None),
    "two dimensions, plane stress": setting(assumption="plane_stress"),
    "axisymmetric": ring,
    "three dimensions": spinning_column,
    "total Lagrangian": description({"nodal": {}, "jst_sph": {}, "adaptle": {"description": "total_lagrangian"}}),
    "updated Lagrangian or Eulerian": description({"taylor_sph": {"configuration": "updated"},
                                                   "adaptle": {"description": "eulerian"}}),
    "from one to the other where material is torn": torn({"nodal": {"conversion": "eulerian", "convert_strain": 0.1},
                                                          "adaptle": {"description": "adaptive",
                                                                      "convert_strain": 0.1}}),
    "`linear_elastic`": material(law="linear_elastic", **STEEL),
    "`neo_hookean`": material(law="neo_hookean", **STEEL),
    "`mooney_rivlin`": material(law="mooney_rivlin", **STEEL),
    "`saint_venant_kirchhoff`": material(law="saint_venant_kirchhoff", **STEEL),
    "`compressible_neo_hookean`": material(law="compressible_neo_hookean", **STEEL),
    "`arruda_boyce`": material(law="arruda_boyce", **STEEL, limiting_stretch=2),
    "`ogden`": material(law="ogden", **BULK, mu_1=8e10, alpha_1=1.5, mu_2=-1e10, alpha_2=-2),
    "`viscoelastic`": material(law="viscoelastic", **RELAXES, tau_1=1e-5,
                               without={"law": "viscoelastic", **RELAXES, "tau_1": 1}),
    "`elastic`": material(law="elastic", **STEEL),
    "`perfectly_plastic`": material(law="perfectly_plastic", **YIELD),
    "`isotropic_hardening`": material(name="copper_linear_hardening"),
    "`voce`, hardening that saturates": material(law="voce", **YIELD, voce_q=2e9, voce_b=100,
                                                 without={"law": "voce", **YIELD, "voce_q": 0, "voce_b": 1}),
    "`tabulated_hardening`, a table of yield stresses": material(
        law="tabulated_hardening", **STEEL, hardening_curve=[[0, 2e8], [0.01, 1e9]],
        without={"law": "tabulated_hardening", **STEEL, "hardening_curve": [[0, 2e8], [0.01, 2e8]]}),
    "rate dependence of Cowper and Symonds": material(
        law="isotropic_hardening", **YIELD, hardening_modulus=0, rate_dependence="cowper_symonds", cowper_symonds_c=40,
        cowper_symonds_p=5, without={"law": "isotropic_hardening", **YIELD, "hardening_modulus": 0}),
    "`johnson_cook`": material(name="copper_ofhc"),
    "`zerilli_armstrong`": material(law="zerilli_armstrong", **STEEL, athermal_stress=2e8, thermal_softening=0.002,
                                    thermal_rate=1e-4),
    "`steinberg_guinan`": material(law="steinberg_guinan", **YIELD, strain_factor=36, hardening_exponent=0.45,
                                   pressure_coefficient=2.8e-11),
    "`johnson_holmquist`, glass and ceramics": material(name="soda_lime_glass"),
    "`drucker_prager`, soil and rock": material(law="drucker_prager", **STEEL, friction_angle=0.5, cohesion=1e8),
    "`holmquist_johnson_cook`, concrete": material(**CONCRETE),
    "`p_alpha`, porous solids": material(law="p_alpha", density=2160, distension=1.25, bulk_sound_speed=5300,
                                         elastic_pressure=1e8, compaction_pressure=1e9, shear_modulus=15e9,
                                         yield_stress=1e8),
    "`orthotropic`, composites and wood": material(**LAMINA, youngs_modulus_1=181e9,
                                                   without=LAMINA | {"youngs_modulus_1": 20e9}),
    "a law of your own in a library": material(**own_law(), yield_stress=2e8,
                                             without={**own_law(), "yield_stress": 1e8}),
    "equations of state: `stiffened_gas`": metal(eos="stiffened_gas", adiabatic_exponent=4),
    "equations of state: `mie_grueneisen`": metal(eos="mie_grueneisen", grueneisen_gamma=2, hugoniot_s1=1.5),
    "equations of state: `polynomial`": metal(eos="polynomial", c2=1e12),
    "equations of state: `tillotson`": metal(eos="tillotson", tillotson_a=0.5, tillotson_b=1.5, tillotson_bulk_b=1e11,
                                             tillotson_e0=9e6, tillotson_eiv=2e6, tillotson_ecv=9e6, tillotson_alpha=5,
                                             tillotson_beta=5),
    "explosives (`jwl`)": material(name="composition_b"),
    "heating by plastic work": material(law="johnson_cook", **HARDENS, specific_heat=1,
                                        without={"law": "johnson_cook", **HARDENS}),
    "conduction of heat": material(law="johnson_cook", **HARDENS, specific_heat=1, conductivity=1e6,
                                   without={"law": "johnson_cook", **HARDENS, "specific_heat": 1}),
    "damage": metal(damage="johnson_cook", d1=0.001, melting_temperature=1800),
    "cracks with a toughness": material(law="elastic", **STEEL, tensile_strength=1e3, fracture_energy=1e-6,
                                        without={"law": "elastic", **STEEL}),
    "tension cut off at a limit": metal(spall_pressure=1e8),
    "spall that opens a gap": material(law="perfectly_plastic", **YIELD, **SPALL,
                                       without={"law": "perfectly_plastic", **YIELD, "spall_pressure": 1e8}),
    "scatter of strength between particles": material(law="perfectly_plastic", **YIELD, **SPALL, weibull_modulus=10,
                                                      without={"law": "perfectly_plastic", **YIELD, **SPALL}),
    "box": lambda f: (plain(f), None),
    "disc or ball": shape(sphere={"centre": [0, 0], "radius": 0.4}, spacing=0.1),
    "hole": shape(sphere={"centre": [0, 0], "radius": 0.6, "inner_radius": 0.2}, spacing=0.1),
    "disc of circles of particles": shape(sphere={"centre": [0, 0], "radius": 0.4, "arrangement": "rings"},
                                          spacing=0.1),
    "combined shapes, packed": shape(difference=[{"box": {"min": [0, 0], "max": [1, 0.6]}},
                                                 {"sphere": {"centre": [0.5, 0.3], "radius": 0.15}}], spacing=0.1),
    "irregular particles (`jitter`)": shape(**box([0, 0], [8, 5]), jitter=0.2),
    "particles at random places": shape(**box([0, 0], [8, 5]), placement="random"),
    "several materials in one body": parts,
    "initial velocity": with_body(initial_velocity=["3*Y", "0"]),
    "initial displacement": with_body(initial_displacement=["0.01*X", "0"]),
    "initial deformation gradient": with_body(initial_deformation_gradient=[["1.01", "0"], ["0", "1"]]),
    "initial temperature that differs within a body": warm_end,
    "supports that hold": support(),
    "supports that drive": compared(support(velocity=["5", "0"]), velocity=None),
    "supports that let go": compared(support(until=1e-3), until=None),
    "rollers along the axes": compared(support(fix="y"), fix="xy"),
    "rollers on oblique planes": support(normal=[1, 1], fix="normal"),
    "supports on patches hold the surface itself": held_surface,
    "exact boundary values by multipliers": multipliers,
    "mirror planes": with_case(mirror=[{"body": "block", "face": "-x"}]),
    "tractions": load(face="+x", traction=["1e5", "0"]),
    "pressure": load(face="+x", pressure="1e5"),
    "pressure that follows the deformed face": follows,
    "patches that let waves leave": radiates,
    "body forces, gravity": load(acceleration=["0", "-9.81"]),
    "loads, velocities and initial values from tables and CSV files":
        load(acceleration=["0", {"table": [[0, 0], ["8 ms", -9.81]]}]),
    "damping": with_run(damping=100),
    "relaxation to rest": relaxed,
    "relaxation by conjugate gradients": descended,
    "contact between bodies": contact(),
    "contact with a body of another formulation": lambda f: contact(other="jst_sph" if f == "nodal" else "nodal")(f),
    "friction between bodies": friction,
    "a body that touches itself": own,
    "rigid shapes": rigid(),
    "friction on rigid shapes": rigid_friction,
    "rigid shapes that are driven": rigid(velocity=["0", "10"]),
    "free rigid bodies": rigid(motion="free", mass=100),
    "forces and torques on free rigid bodies": on_free_shape(force=[100, "1 kN/m"], torque=["t*1e4"]),
    "springs and dashpots of free rigid bodies":
        on_free_shape(spring=[{"between": ["floor"], "points": [[0, 0], [0, -1]], "stiffness": 1e4, "damping": 100,
                               "rest_length": 0.5}]),
    "ties": tie(),
    "ties to rigid shapes": tie_to_rigid,
    "cohesive zones": tie(strength=1e5, toughness=1000),
    "cracks": crack,
}


# Cases as text, and running them.

def toml(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(one)}" for key, one in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(toml(one) for one in value) + "]"
    return f'"{value}"' if isinstance(value, str) else repr(value)


def text_of(tables):
    return "".join(f"{key} = {toml(value)}\n" for key, value in tables.items())


def run(folder, text):
    """(exit status, message, history) of a case."""
    place = Path(folder) / hashlib.sha1(text.encode()).hexdigest()
    file = place.with_suffix(".toml")
    file.write_text(text)
    done = subprocess.run([PROGRAM, "run", file, "--quiet", "--force", "--out", place], capture_output=True,
                          text=True, timeout=120, check=False)
    history = place / "history.csv"
    return done.returncode, done.stderr.strip(), history.read_text() if history.exists() else ""


def energies(history):
    """Rows of the columns that every run has."""
    lines = [line.split(",") for line in history.splitlines()]
    columns = [k for k, name in enumerate(lines[0]) if re.match(r"(kinetic|strain)_energy|linear_momentum", name)]
    return [[line[k] for k in columns] for line in lines]


class Happened:
    """What a formulation makes of an ability: yes, no, ignored (it runs, without an effect) or fails."""

    def __init__(self, made, without):
        self.status, self.message, history = made
        self.word = {0: "yes", 2: "no"}.get(self.status, "fails")
        if self.word == "yes" and without is not None:
            status, message, plainly = without
            if status != 0:
                self.word, self.message = "fails", f"without it: {message}"
            elif energies(plainly) == energies(history):
                self.word = "ignored"


def try_all():
    """{(ability, formulation): Happened}; each case runs once."""
    pairs = {(ability, one): [made and text_of(made) for made in FEATURES[ability](one)]
             for ability in FEATURES for one in FORMULATIONS}
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        runs = {text: pool.submit(run, folder, text) for pair in pairs.values() for text in pair if text}
        return {key: Happened(*(text and runs[text].result() for text in pair)) for key, pair in pairs.items()}


def told():
    """{ability: {formulation: the cell's text}} of the page."""
    cells = {}
    for line in PAGE.read_text().splitlines():
        row = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if line.startswith("|") and len(row) == 5 and row[0] and not row[0].startswith("--"):
            cells[row[0]] = dict(zip(FORMULATIONS, row[1:]))
    return cells


def main(arguments):
    if not os.access(PROGRAM, os.X_OK):
        print("skipped: the program is not built")
        return 77
    happened = try_all()
    if arguments == ["--show"]:
        for (ability, one), what in happened.items():
            print(f"{ability} | {one} | {what.word} | {' '.join(what.message.split())[:300]}")
        return 0
    cells, wrong = told(), 0
    for ability in dict.fromkeys([*cells, *FEATURES]):
        if ability not in cells or ability not in FEATURES:
            print(f"{ability}: {'no row of the page' if ability not in cells else 'no case tries it'}")
            wrong += 1
            continue
        for one in FORMULATIONS:
            what, word = happened[ability, one], re.match(r"\**(\w+)", cells[ability][one])[1]
            if what.word != word:
                print(f"{ability}, {one}: the page says {word}, it is {what.word}: {what.message[:300]}")
                wrong += 1
    print(f"features_test: {len(happened)} cells tried, {wrong} wrong")
    return 1 if wrong or not cells else 0


sys.exit(main(sys.argv[1:]))
