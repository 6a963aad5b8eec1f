# SPDX-License-Identifier: Apache-2.0
"""*MATERIAL of Abaqus as keys of Piola."""
from .materials import cowper_symonds, from_moduli, hyperelastic, johnson_cook, plastic, tabulated
from .model import Material

READ = {"DENSITY", "ELASTIC", "PLASTIC", "RATE DEPENDENT", "HYPERELASTIC", "EOS", "SPECIFIC HEAT",
        "INELASTIC HEAT FRACTION", "DAMAGE INITIATION", "TENSILE FAILURE"}
# Keywords that may stand below *MATERIAL; others end it.
OPTIONS = READ | {"DAMAGE EVOLUTION", "DAMPING", "EXPANSION", "CONDUCTIVITY", "VISCOELASTIC", "SHEAR FAILURE",
                  "USER MATERIAL", "DEPVAR", "CONCRETE DAMAGED PLASTICITY", "DRUCKER PRAGER", "CREEP", "HYPERFOAM",
                  "MULLINS EFFECT",
                  "CYCLIC HARDENING", "POTENTIAL", "CRUSHABLE FOAM", "VISCOSITY", "GAS SPECIFIC HEAT", "LATENT HEAT",
                  "DETONATION POINT", "ANNEAL TEMPERATURE", "HYSTERESIS", "CAP PLASTICITY", "NO COMPRESSION",
                  "NO TENSION"}


class Card:
    """A material with its options by name."""

    def __init__(self, name, options, units, problems):
        self.name, self.options, self.units, self.problems = f"material {name}", options, units, problems

    def row(self, option, k=0, count=8):
        return self.options[option].values(k, self.problems, count) if option in self.options else [0.0] * count

    def kind(self, option, parameter):
        return self.options[option].get(parameter) if option in self.options else ""


def material_of(name, options, units, problems):
    """The material, or None if no law of Piola has its options."""
    card = Card(name, options, units, problems)
    density = card.row("DENSITY")[0] * units.density
    if "HYPERELASTIC" in options:
        material = _hyperelastic(card, density)
    elif "ELASTIC" in options and card.kind("ELASTIC", "TYPE") in ("", "ISOTROPIC", "ISO", "SHEAR"):
        elastic, notes = _elastic(card, density)
        material = _plastic(card, density, elastic) if "PLASTIC" in options else Material(
            card.name, {"law": "elastic", "density": density, **elastic})
        if material:
            material.notes += notes
            _heat_and_shock(card, material)
    else:
        return None
    if material and len(options.get("ELASTIC").lines if "ELASTIC" in options else []) > 1:
        material.notes.append("its elastic constants depend on temperature or fields: the first line counts")
    return material


def _elastic(card, density):
    first, second = card.row("ELASTIC")[:2]
    if card.kind("ELASTIC", "TYPE") != "SHEAR":
        return {"youngs_modulus": first * card.units.stress, "poissons_ratio": second}, []
    bulk = density * (card.row("EOS")[0] * card.units.velocity)**2
    if bulk > 0:
        return from_moduli(bulk, first * card.units.stress), []
    return {"youngs_modulus": 2.6 * first * card.units.stress, "poissons_ratio": 0.3}, [
        "has a shear modulus alone: Poisson's ratio is taken as 0.3"]


def _plastic(card, density, elastic):
    keyword = card.options["PLASTIC"]
    if card.kind("PLASTIC", "HARDENING") == "JOHNSON COOK":
        return _johnson_cook(card, density, elastic)
    rows = [keyword.values(k, card.problems) for k in range(len(keyword.lines))]
    if not rows:
        return None
    rows = [row for row in rows if row[2] == rows[0][2]]
    stresses, strains = [row[0] * card.units.stress for row in rows], [row[1] for row in rows]
    growing = all(b > a for a, b in zip(strains, strains[1:]))
    if not growing:
        card.problems.add(keyword.place, "the plastic strains do not grow from line to line - correct the table")
        return None
    material = (plastic(card.name, density, elastic, stresses[0], 0.0) if len(rows) == 1 else
                tabulated(card.name, density, elastic, stresses, strains))
    if card.kind("PLASTIC", "HARDENING") in ("KINEMATIC", "COMBINED"):
        material.notes.append("its kinematic hardening is taken as isotropic (the same until the load reverses)")
    if len(rows) < len(keyword.lines):
        material.notes.append("its yield stress depends on temperature or rate: the first of its curves counts")
    if card.kind("RATE DEPENDENT", "TYPE") not in ("", "POWER LAW"):
        material.notes.append("its rate dependence is left out")
    elif "RATE DEPENDENT" in card.options:
        rate, exponent = card.row("RATE DEPENDENT")[:2]
        cowper_symonds(material, rate / card.units.time, exponent)
    return material


def _johnson_cook(card, density, elastic):
    A, B, n, m, melting, reference = card.row("PLASTIC")[:6]
    stress = card.units.stress
    numbers = {"yield_stress": A * stress, "hardening_coefficient": B * stress, "hardening_exponent": n,
               "thermal_exponent": m or 1.0, "melting_temperature": melting}
    if reference > 0:
        numbers["reference_temperature"] = reference
    if card.kind("RATE DEPENDENT", "TYPE") == "JOHNSON COOK":
        C, rate = card.row("RATE DEPENDENT")[:2]
        numbers |= {"rate_coefficient": C, "reference_rate": (rate or 1.0) / card.units.time}
    notes = []
    if card.kind("DAMAGE INITIATION", "CRITERION") == "JOHNSON COOK":
        # Abaqus has exp(-d3 eta), with the pressure over the Mises stress as -eta: the sign of D3 turns.
        d1, d2, d3, d4, d5 = card.row("DAMAGE INITIATION")[:5]
        numbers |= {"damage": "johnson_cook", "d1": d1, "d2": d2, "d3": -d3, "d4": d4, "d5": d5}
        notes.append("damage begins where Abaqus starts *DAMAGE EVOLUTION; fracture_displacement may say how it ends")
    material = johnson_cook(card.name, density, elastic, numbers)
    material.notes += notes
    return material


def _heat_and_shock(card, material):
    """Heating by plastic work and the equation of state."""
    plastic_law = material.keys["law"] != "elastic"
    heat, fraction = card.row("SPECIFIC HEAT")[0], card.row("INELASTIC HEAT FRACTION")[0]
    if heat > 0 and plastic_law and material.keys.get("melting_temperature", 1e30) > 0:
        material.keys["specific_heat"] = heat * card.units.specific_heat
        material.keys["heat_fraction"] = fraction if 0 < fraction <= 1 else 0.9
    if card.kind("EOS", "TYPE") == "USUP":
        c0, s, gamma = card.row("EOS")[:3]
        material.keys |= {"eos": "mie_grueneisen", "bulk_sound_speed": c0 * card.units.velocity, "hugoniot_s1": s,
                          "grueneisen_gamma": gamma}
    elif "EOS" in card.options:
        material.notes.append("its equation of state is left out: the pressure is that of the elastic constants")


def _hyperelastic(card, density):
    """Neo-Hooke and Mooney-Rivlin by constants; D1 gives the bulk modulus 2 / D1."""
    keyword = card.options["HYPERELASTIC"]
    kinds = set(keyword.parameters)
    if "TEST DATA INPUT" in kinds or not kinds & {"NEO HOOKE", "MOONEY-RIVLIN", "POLYNOMIAL"}:
        return None
    neo = "NEO HOOKE" in kinds
    if "POLYNOMIAL" in kinds and keyword.parameters.get("N", "1") not in ("1", ""):
        return None
    row = card.row("HYPERELASTIC")
    c10, c01, d1 = (row[0], 0.0, row[1]) if neo else row[:3]
    stress = card.units.stress
    if c10 + c01 <= 0:
        return None
    bulk = 2 / d1 if d1 > 0 else 2 * (c10 + c01) * 20
    material = hyperelastic(card.name, density, c10 * stress, c01 * stress, bulk=bulk * stress)
    if d1 <= 0:
        material.notes.append("D1 = 0: a bulk modulus of 20 shear moduli is taken (nu = 0.475), as in Abaqus/Explicit")
    return material
