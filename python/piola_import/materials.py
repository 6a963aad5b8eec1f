# SPDX-License-Identifier: Apache-2.0
"""Conversions of constants that several programs share. All numbers are in SI."""
from .model import Material


def from_moduli(bulk, shear):
    """Young's modulus and Poisson's ratio of bulk and shear modulus."""
    return {"youngs_modulus": 9 * bulk * shear / (3 * bulk + shear),
            "poissons_ratio": (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear))}


def plastic(name, density, elastic, yield_stress, hardening):
    """Elastic with a yield stress that grows linearly with the plastic strain."""
    keys = {"law": "isotropic_hardening" if hardening > 0 else "perfectly_plastic", "density": density, **elastic,
            "yield_stress": yield_stress}
    if hardening > 0:
        keys["hardening_modulus"] = hardening
    return Material(name, keys)


def fracture_strain(material, strain):
    """Failure at a plastic strain whatever rate, temperature and pressure: Johnson and Cook's damage with D1 alone."""
    if strain > 0:
        material.keys |= {"damage": "johnson_cook", "d1": strain}


def tabulated(name, density, elastic, stresses, strains):
    """Yield stresses over plastic strains as linear hardening; tells how far the line is from the table."""
    first, last = stresses[0], stresses[-1]
    slope = 0.0 if len(strains) < 2 else (last - first) / (strains[-1] - strains[0])
    material = plastic(name, density, elastic, first, max(slope, 0.0))
    off = max(abs(first + slope * (strain - strains[0]) - stress) for stress, strain in zip(stresses, strains))
    if slope < 0:
        material.notes.append("its yield stress falls with strain: taken as constant")
    elif off > 0.01 * max(stresses):
        material.notes.append(f"its table of yield stresses is no line: linear hardening between its ends is up to "
                              f"{off / 1e6:.4g} MPa off")
    return material


def hyperelastic(name, density, c10, c01, bulk=None, nu=None):
    """C10 (I1 - 3) + C01 (I2 - 3) with a bulk modulus or Poisson's ratio; shear modulus 2 (C10 + C01)."""
    shear = 2 * (c10 + c01)
    elastic = from_moduli(bulk, shear) if nu is None else {"youngs_modulus": 2 * shear * (1 + nu), "poissons_ratio": nu}
    material = Material(name, {"law": "neo_hookean" if c01 == 0 else "mooney_rivlin", "density": density, **elastic})
    if c01 != 0:
        material.keys["c10_fraction"] = c10 / (c10 + c01)
        material.notes.append("Piola's Mooney-Rivlin law has (H:H)^(3/2) in place of the second invariant: the same "
                              "stiffness at small strain, another one beyond")
    return material


def johnson_cook(name, density, elastic, numbers):
    """numbers: keys of the law johnson_cook; the melting temperature must exceed the one of reference."""
    material = Material(name, {"law": "johnson_cook", "density": density, **elastic, **numbers})
    reference = numbers.get("reference_temperature", 293)
    if not numbers.get("melting_temperature", 0) > reference:
        material.keys["melting_temperature"] = reference + 1000
        material.keys.pop("specific_heat", None)
        material.notes.append("has no melting temperature above its reference: no heating is computed")
    elif reference < 150:
        material.notes.append(f"its temperatures are taken as kelvin, and {reference:g} K is cold: if they are in "
                              "degrees Celsius, add 273.15")
    return material


def problems_of(material):
    """What makes the numbers of a card unusable; an empty list if nothing does."""
    keys, found = material.keys, []
    for key in ("density", "youngs_modulus"):
        if not keys[key] > 0:
            found.append(f"its {key.replace('_', ' ').replace('youngs', 'Youngs')} is {keys[key]:g} (positive)")
    if not -1 < keys["poissons_ratio"] < 0.5:
        found.append(f"its Poisson's ratio is {keys['poissons_ratio']:g} (between -1 and 0.5)")
    if "yield_stress" in keys and not keys["yield_stress"] > 0:
        found.append(f"its yield stress is {keys['yield_stress']:g} (positive)")
    return found
