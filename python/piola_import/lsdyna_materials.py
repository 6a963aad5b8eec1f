# SPDX-License-Identifier: Apache-2.0
"""Material cards and equations of state of LS-DYNA as keys of Piola (LS-DYNA Keyword Manual, Volumes I and II)."""
from .materials import (cowper_symonds, fracture_strain, from_moduli, hyperelastic, johnson_cook, plastic,
                        tabulated)
from .model import Material

# Card numbers and names; both stand for the function of the same entry.
KINDS = {}


def card_of(*names):
    def keep(function):
        KINDS.update({name: function for name in names})
        return function
    return keep


def kind_of(keyword):
    """The function for a keyword such as MAT_003_TITLE, or None."""
    return KINDS.get(keyword.removeprefix("MAT_").removesuffix("_TITLE"))


class Card:
    """A material card: rows of numbers from the line after the title, with units; `eos` has keys, c0 and c1, `curve`
    gives the points of a curve by its number, or None."""

    def __init__(self, block, first, units, problems, eos, curve):
        self.block, self.first, self.units, self.problems = block, first, units, problems
        self.eos, self.curve = eos or {}, curve
        self.name = f"material {block.fields(first)[0]}"

    def row(self, k, count=8):
        return self.block.card(self.first + k, self.problems, count)

    @property
    def stress(self):
        return self.units.stress

    def elastic(self, E, nu, G=0.0):
        """Young's modulus and Poisson's ratio; of a shear modulus with the bulk modulus of the equation of state."""
        if E > 0:
            return {"youngs_modulus": E * self.stress, "poissons_ratio": nu}
        density = self.row(0)[1] * self.units.density
        bulk = self.eos.get("c1") or density * self.eos.get("bulk_sound_speed", 0.0)**2
        if bulk > 0 and G > 0:
            return from_moduli(bulk, G * self.stress)
        return {"youngs_modulus": 2 * G * (1 + nu) * self.stress, "poissons_ratio": nu}


@card_of("001", "1", "ELASTIC")
def elastic(card):
    _, density, E, nu = card.row(0)[:4]
    return Material(card.name, {"law": "elastic", "density": density * card.units.density, **card.elastic(E, nu)})


@card_of("003", "3", "PLASTIC_KINEMATIC")
def plastic_kinematic(card):
    _, density, E, nu, yield_stress, tangent, beta, _ = card.row(0)
    rate_c, rate_p, strain = card.row(1)[:3]
    material = plastic(card.name, density * card.units.density, card.elastic(E, nu), yield_stress * card.stress,
                       _hardening(E, tangent) * card.stress)
    fracture_strain(material, strain)
    if tangent > 0 and beta < 1:
        material.notes.append(f"BETA = {beta:g}: its kinematic hardening is taken as isotropic (the same until the "
                              "load reverses)")
    cowper_symonds(material, rate_c / card.units.time, rate_p)
    return material


def _hardening(E, tangent):
    """Slope over the plastic strain of a tangent modulus, which is a slope over the whole strain."""
    return E * tangent / (E - tangent) if 0 < tangent < E else 0.0


@card_of("012", "12", "ISOTROPIC_ELASTIC_PLASTIC")
def isotropic_elastic_plastic(card):
    _, density, shear, yield_stress, hardening, bulk = card.row(0)[:6]
    return plastic(card.name, density * card.units.density, from_moduli(bulk * card.stress, shear * card.stress),
                   yield_stress * card.stress, hardening * card.stress)


@card_of("010", "10", "ELASTIC_PLASTIC_HYDRO")
def elastic_plastic_hydro(card):
    _, density, shear, yield_stress, hardening, cutoff, strain, _ = card.row(0)
    elastic_keys, density = card.elastic(0, 0, shear), density * card.units.density
    strains, stresses = card.row(1) + card.row(2), card.row(3) + card.row(4)
    count = sum(value > 0 for value in stresses)
    if count > 1:
        material = tabulated(card.name, density, elastic_keys, [s * card.stress for s in stresses[:count]],
                             strains[:count])
    else:
        material = plastic(card.name, density, elastic_keys, yield_stress * card.stress, hardening * card.stress)
    if cutoff < 0:
        material.keys["spall_pressure"] = -cutoff * card.stress
    fracture_strain(material, strain)
    return material


@card_of("024", "24", "PIECEWISE_LINEAR_PLASTICITY")
def piecewise_linear(card):
    _, density, E, nu, yield_stress, tangent, strain, _ = card.row(0)
    rate_c, rate_p, curve, curve_of_rate = card.row(1)[:4]
    points = card.curve(int(curve)) if curve else None
    if points is None:
        count = sum(value > 0 for value in card.row(3))
        points = list(zip(card.row(2), card.row(3)))[:count]
    elastic_keys, density = card.elastic(E, nu), density * card.units.density
    if len(points) > 1:
        strains, stresses = zip(*points)
        material = tabulated(card.name, density, elastic_keys, [s * card.stress for s in stresses], strains)
    else:
        material = plastic(card.name, density, elastic_keys, yield_stress * card.stress,
                           _hardening(E, tangent) * card.stress)
    fracture_strain(material, strain if strain < 1e10 else 0)
    if curve and card.curve(int(curve)) is None:
        material.notes.append(f"its curves of yield stresses (LCSS = {curve:g}) are no *DEFINE_CURVE of growing strains "
                              "and are left out: SIGY and ETAN count")
    cowper_symonds(material, rate_c / card.units.time, rate_p)
    if curve_of_rate:
        material.notes.append("its rate dependence (LCSR) is left out")
    return material


@card_of("015", "15", "JOHNSON_COOK")
def mat_johnson_cook(card):
    _, density, G, E, nu = card.row(0)[:5]
    A, B, n, C, m, melting, reference, rate = card.row(1)
    heat, cutoff, spall, _, *damage = card.row(2)
    damage.append(card.row(3)[0])
    numbers = {"yield_stress": A * card.stress, "hardening_coefficient": B * card.stress, "hardening_exponent": n,
               "rate_coefficient": C, "thermal_exponent": m or 1.0, "melting_temperature": melting}
    if reference > 0:
        numbers["reference_temperature"] = reference
    if rate > 0:
        numbers["reference_rate"] = rate / card.units.time
    if heat > 0:
        numbers["specific_heat"] = heat * card.units.specific_heat
    if any(damage):
        numbers |= {"damage": "johnson_cook", **dict(zip(("d1", "d2", "d3", "d4", "d5"), damage))}
    if cutoff != 0:
        numbers |= {"spall_pressure": abs(cutoff) * card.stress,
                    "spall": {1: "limit", 3: "hydrostatic"}.get(int(spall), "principal")}
    elastic_keys = card.elastic(0, nu, G) if G > 0 else card.elastic(E, nu)
    material = johnson_cook(card.name, density * card.units.density, elastic_keys, numbers)
    if damage[2] > 0:
        material.notes.append("D3 is positive: tougher in tension than in compression; is the sign right?")
    return material


@card_of("098", "98", "SIMPLIFIED_JOHNSON_COOK")
def simplified_johnson_cook(card):
    _, density, E, nu = card.row(0)[:4]
    A, B, n, C, strain, largest, saturation, rate = card.row(1)
    numbers = {"yield_stress": A * card.stress, "hardening_coefficient": B * card.stress, "hardening_exponent": n,
               "rate_coefficient": C, "melting_temperature": 2000.0, "reference_rate": (rate or 1.0) / card.units.time}
    material = johnson_cook(card.name, density * card.units.density, card.elastic(E, nu), numbers)
    fracture_strain(material, strain if strain < 1e10 else 0)
    if 0 < min(largest or 1e30, saturation or 1e30) < 1e27:
        material.notes.append("its limits of stress (SIGMAX, SIGSAT) are left out")
    return material


@card_of("027", "27", "MOONEY-RIVLIN_RUBBER", "MOONEY_RIVLIN_RUBBER")
def mooney_rivlin(card):
    _, density, nu, A, B = card.row(0)[:5]
    if A == 0 and B == 0:
        return None  # constants from a test curve
    return hyperelastic(card.name, density * card.units.density, A * card.stress, B * card.stress, nu=nu)


@card_of("077_H", "77_H", "HYPERELASTIC_RUBBER")
def hyperelastic_rubber(card):
    _, density, nu, order, viscous = card.row(0)[:5]
    C10, C01, *others = card.row(1)[:6]
    if order != 0 or any(others) or C10 + C01 <= 0:
        return None
    material = hyperelastic(card.name, density * card.units.density, C10 * card.stress, C01 * card.stress, nu=nu)
    if viscous:
        material.notes.append("its viscous terms (NV) are left out")
    return material


def grueneisen(row, units):
    """*EOS_GRUNEISEN: keys of Piola. row: EOSID C S1 S2 S3 GAMAO A E0."""
    _, C, s1, s2, s3, gamma, a, energy = row
    keys = {"eos": "mie_grueneisen", "bulk_sound_speed": C * units.velocity, "hugoniot_s1": s1,
            "grueneisen_gamma": gamma}
    keys |= {key: value for key, value in (("hugoniot_s2", s2), ("hugoniot_s3", s3), ("grueneisen_slope", a)) if value}
    return keys, ["its initial energy E0 is left out"] if energy else []


def linear_polynomial(row, energy, units):
    """*EOS_LINEAR_POLYNOMIAL: keys of Piola. row: EOSID C0 C1 C2 C3 C4 C5 C6."""
    keys = {"eos": "polynomial"} | {f"c{k}": row[k + 1] * units.stress for k in (1, 2, 3) if row[k + 1]}
    keys |= {f"c{k}": row[k + 1] for k in (4, 5, 6) if row[k + 1]}
    notes = ["C0 is left out: a solid is free of stress at rest"] if row[1] else []
    return keys, notes + (["its initial energy E0 is left out"] if energy else [])
