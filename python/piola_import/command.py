# SPDX-License-Identifier: Apache-2.0
"""The command line: reads one file, writes one folder, and prints what was not understood."""
import argparse
import os
import re
import sys
import tempfile
from pathlib import Path

from . import points
from .files import printable
from .model import ImportProblems, Problems
from .units import names_all, read_units
from .write_case import CaseWriter, Options

BAD_INPUT = 2
KEYWORDS_OF_DYNA = (".k", ".key", ".dyn", ".kw")
LENGTH = re.compile(r"^([-+0-9.eE]+)\s*([a-z]*)$")


def main(arguments):
    """Exit code 0: something was converted; 2: nothing was, or the input is broken."""
    options = _parser().parse_args(arguments)
    try:
        code = _import(options)
        sys.stdout.flush()
        return code
    except ImportProblems as error:
        for line in str(error).splitlines():
            print(f"piola: {printable(line)}", file=sys.stderr)
    except ValueError as error:
        print(f"piola: {error}", file=sys.stderr)
    except BrokenPipeError:  # the reader of the report has gone, and the folder is written
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except OSError as error:
        folder = options.out or Path(options.file).stem
        print(f"piola: {folder} cannot be written, or {options.file} not read ({error.strerror}) - choose another "
              "folder by --out", file=sys.stderr)
    except MemoryError:
        print(f"piola: {options.file}: too large for the memory of this computer", file=sys.stderr)
    return BAD_INPUT


def _parser():
    parser = argparse.ArgumentParser(prog="piola import", description="Turns a mesh, cards or a cloud of points of "
                                     "another program into a case: LS-DYNA (.k), Abaqus (.inp), Gmsh (.msh), VTK "
                                     "(.vtu), all that meshio reads, CAD (.step, by gmsh), tables (.csv, .xyz).")
    parser.add_argument("file", help="the file of the other program")
    parser.add_argument("--units", default="", help="its units: SI, or length, time and mass as in mm,ms,kg (meshes: a "
                        "length is enough)")
    parser.add_argument("--out", "-o", default="", help="the folder to write (default: the name of the file)")
    parser.add_argument("--particles", choices=["packed", "elements"], default="packed",
                        help="packed: the surface is filled with even particles; elements: one particle per element, "
                        "at its centroid with its volume")
    parser.add_argument("--spacing", default="",
                        help="distance of particles, such as 2mm (default: as fine as the mesh)")
    parser.add_argument("--formulation", choices=["nodal", "jst_sph", "adaptle"], default="",
                        help="default: nodal; for one particle per element and clouds the one that takes them")
    parser.add_argument("--material", default="", help="material of the library for parts without one")
    parser.add_argument("--force", action="store_true", help="replace a case.toml that is there")
    return parser


def _import(given):
    source = Path(given.file)
    if not source.is_file():
        what = "is a folder" if source.is_dir() else "does not exist"
        raise ValueError(f"{source}: {what} - name the file to import")
    folder = Path(given.out or source.stem)
    if (folder / "case.toml").exists() and not given.force:
        raise ValueError(f"{folder}/case.toml is there already - name another folder by --out, or add --force")
    if folder.exists() and not folder.is_dir():
        raise ValueError(f"{folder} is a file - name a folder by --out")
    options = Options(source.name, given.particles == "elements", given.formulation, _length(given.spacing),
                      given.material)
    if options.particles and options.formulation == "nodal":
        raise ValueError("--formulation nodal takes no particles from files (allowed: jst_sph, adaptle) - leave out "
                         "--particles elements: the surface is then packed")
    problems, left = Problems(), []
    # Files appear in the folder only when all of them are written.
    folder.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".import-", dir=folder.parent) as work:
        about, left = _convert(source, given, options, Path(work), problems)
        folder.mkdir(exist_ok=True)
        for file in Path(work).iterdir():
            os.replace(file, folder / file.name)
    _report(source, folder, about, left)
    return 0


def _length(text):
    """A length such as 2mm in m; None for an empty text."""
    if not text:
        return None
    found = LENGTH.match(text.strip())
    try:
        value = float(found[1]) * (read_units(found[2]).length if found[2] else 1.0)
    except (TypeError, ValueError):
        value = 0
    if not 0 < value < 1e15:
        raise ValueError(f"--spacing {text} is no length - write for example 2mm or 0.002")
    return value


def _convert(source, given, options, work, problems):
    """Reads and writes; returns lines about the bodies and about what was not understood."""
    ending = source.suffix.lower()
    if kind := points.kind_of(source):
        return _convert_points(kind, source, given, options, work, problems), []
    keywords = ending in (*KEYWORDS_OF_DYNA, ".inp")
    units = _units(given.units, source, keywords)
    if ending in KEYWORDS_OF_DYNA:
        from .lsdyna import read_lsdyna
        model = read_lsdyna(source, units, problems)
    elif ending == ".inp":
        from .abaqus import read_abaqus
        model = read_abaqus(source, units, problems)
    else:
        from .meshes import read_mesh
        model = read_mesh(source, units, problems, options.spacing)
    problems.stop_if_any()
    if model.faces is not None:
        from .write_points import write_hulls
        return write_hulls(model, work, options, problems), model.left.lines()
    if model.elements is None or not len(model.elements):
        raise ImportProblems("\n".join([f"{source}: has no solid elements that can be converted", *model.left.lines()]))
    writer = CaseWriter(model, work, options, problems)
    about = writer.write()
    notes = [f"  {material.name}: {note}" for material in model.materials if material for note in material.notes]
    return about, list(dict.fromkeys(model.left.lines() + notes + [f"  {n}" for n in writer.notes + model.notes]))


def _units(text, source, keywords):
    if not text:
        raise ValueError(f"{source}: does not say its units - add --units mm,ms,kg (length, time and mass; SI)"
                         if keywords else f"{source}: does not say its unit of length - add --units mm, or SI")
    units = read_units(text)
    if keywords and not names_all(text):
        raise ValueError(f"--units {text}: names too few units - name a length, a time and a mass, as mm,ms,kg")
    return units


def _convert_points(kind, source, given, options, work, problems):
    from .write_points import write_cloud
    if kind == "xyz":
        cloud = points.read_xyz(source, _units(given.units, source, False), options.spacing, problems)
    else:
        if given.units:
            read_units(given.units)
        unit = next((u for u in re.split(r"[-,/ ]", given.units) if u), "")
        cloud = points.read_csv(source, "m" if unit.lower() == "si" else unit, problems)
    problems.stop_if_any()
    return write_cloud(cloud, work, options)


def _report(source, folder, about, left):
    print(f"{source} -> {folder}/case.toml")
    print("\n".join(about))
    if left:
        print("Not taken over, or not in full:")
        print("\n".join(map(printable, left)))
    else:
        print("Everything in the file was understood.")
    print(f"Next: piola check {folder}/case.toml; add loads, probes and output; piola run {folder}/case.toml")
