# SPDX-License-Identifier: Apache-2.0
"""Conversions of constants that several programs share. All numbers are in SI."""
import numpy as np

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


MOST_ROWS = 32  # of hardening_curve


def tabulated(name, density, elastic, stresses, strains):
    """Yield stresses over plastic strains: linear hardening if they are on a line, else a table."""
    grown = np.maximum.accumulate(stresses)
    slope = 0.0 if len(strains) < 2 else (grown[-1] - grown[0]) / (strains[-1] - strains[0])
    off = max(abs(grown[0] + slope * (strain - strains[0]) - stress) for stress, strain in zip(grown, strains))
    if off > 0.001 * grown[-1]:
        material = _table(name, density, elastic, grown, strains)
    else:
        material = plastic(name, density, elastic, float(grown[0]), float(slope))
    if max(grown - stresses) > 0.001 * grown[-1]:
        material.notes.append("its yield stress falls with strain: from there on it is taken as constant")
    return material


def _table(name, density, elastic, stresses, strains):
    """The law tabulated_hardening, of the rows that the table needs most."""
    rows = [(float(strain), float(stress)) for strain, stress in zip(strains, stresses)]
    if rows[0][0] > 0:
        rows.insert(0, (0.0, rows[0][1]))
    kept, off = list(rows), 0.0
    while len(kept) > MOST_ROWS:
        heights = [abs(b[1] - np.interp(b[0], (a[0], c[0]), (a[1], c[1]))) for a, b, c in zip(kept, kept[1:], kept[2:])]
        del kept[1 + int(np.argmin(heights))]
    if len(kept) < len(rows):
        off = max(abs(stress - np.interp(strain, *zip(*kept))) for strain, stress in rows)
    material = Material(name, {"law": "tabulated_hardening", "density": density, **elastic,
                               "hardening_curve": [list(row) for row in kept]})
    if off > 0:
        material.notes.append(f"its table of yield stresses has {len(rows)} rows: {MOST_ROWS} of them are up to "
                              f"{off / 1e6:.4g} MPa off")
    return material


def cowper_symonds(material, rate, exponent):
    """The factor 1 + (rate/C)^(1/p) of the yield stress. rate: C in 1/s; 0: none."""
    if rate <= 0:
        return
    if exponent < 1:
        material.notes.append(f"its rate dependence (Cowper and Symonds) has p = {exponent:g}, below 1: it is left out")
        return
    if material.keys["law"] == "perfectly_plastic":
        material.keys |= {"law": "isotropic_hardening", "hardening_modulus": 0.0}
    material.keys |= {"rate_dependence": "cowper_symonds", "cowper_symonds_c": rate, "cowper_symonds_p": exponent}


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
    first = keys.get("yield_stress", keys.get("hardening_curve", [[0, 1]])[0][1])
    if not first > 0:
        found.append(f"its yield stress is {first:g} (positive)")
    return found
