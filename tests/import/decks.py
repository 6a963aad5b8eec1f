# SPDX-License-Identifier: Apache-2.0
"""Meshes and files of other programs for the tests of piola import."""
import os
import subprocess
import tempfile
import tomllib
import unittest
from pathlib import Path

import numpy as np

PROGRAM = os.environ["PIOLA_PROGRAM"]
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]


def block(counts, lengths):
    """Nodes (n, 3), hexahedra (m, 8) as rows of nodes, and the grid of node numbers of a box."""
    axes = [np.linspace(0, length, count + 1) for count, length in zip(counts, lengths)]
    X = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    grid = np.arange(X[..., 0].size).reshape(X.shape[:3])
    n = np.array(counts)
    corners = [grid[a:a + n[0], b:b + n[1], c:c + n[2]] for a, b, c in CORNERS]
    return X.reshape(-1, 3), np.stack(corners, axis=-1).reshape(-1, 8), grid


def dyna_mesh(X, solids, part=None):
    """*NODE and *ELEMENT_SOLID in fixed columns; numbers count from 1."""
    part = np.ones(len(solids), dtype=int) if part is None else part
    lines = ["*NODE"] + ["%8d%16.9g%16.9g%16.9g" % (k + 1, *x) for k, x in enumerate(X)] + ["*ELEMENT_SOLID"]
    for k, nodes in enumerate(solids):
        lines += ["%8d%8d" % (k + 1, part[k]), "".join("%8d" % (n + 1) for n in nodes)]
    return "\n".join(lines) + "\n"


def dyna_set(keyword, number, ids):
    rows = ["".join("%10d" % n for n in ids[k:k + 8]) for k in range(0, len(ids), 8)]
    return "\n".join([f"*{keyword}", "%10d" % number, *rows]) + "\n"


def part_card(number, title, material, eos=0):
    return "*PART\n%s\n%10d%10d%10d%10d\n" % (title, number, 1, material, eos)


STEEL = "*MAT_ELASTIC\n" + "%10d%10s%10s%10s\n" % (1, "7.85E-6", "200.0", "0.3")  # mm, ms, kg: GPa


def abaqus_mesh(X, elements, kind, elset="all"):
    """*NODE and *ELEMENT; numbers count from 1."""
    lines = ["*NODE"] + [f"{k + 1}, " + ", ".join("%.9g" % v for v in x) for k, x in enumerate(X)]
    lines += [f"*ELEMENT, TYPE={kind}, ELSET={elset}"]
    lines += [f"{k + 1}, " + ", ".join(str(n + 1) for n in nodes) for k, nodes in enumerate(elements)]
    return "\n".join(lines) + "\n"


class InFolder(unittest.TestCase):
    """Each test has an empty folder as its working folder."""

    def setUp(self):
        before, folder = os.getcwd(), tempfile.TemporaryDirectory()
        os.chdir(folder.name)
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, before)

    def run_import(self, *arguments, code=0, **environment):
        """Output of piola import; the exit code must be `code`, and no traceback may appear."""
        done = subprocess.run([PROGRAM, "import", *map(str, arguments)], capture_output=True, text=True, check=False,
                              env=os.environ | environment)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        return done.stdout + done.stderr

    def check_material(self, case, wanted):
        """The first body's material has these keys alone, with these values."""
        found = case["body"][0]["material"]
        self.assertEqual(set(found), set(wanted))
        for key, value in wanted.items():
            if isinstance(value, str):
                self.assertEqual(found[key], value)
            else:
                np.testing.assert_allclose(found[key], value, rtol=1e-9, err_msg=key)

    def imported(self, name, text, *arguments):
        """Writes a file, imports it into "out", checks the case with piola check; returns case, output, its check."""
        Path(name).write_text(text, encoding="utf-8")
        output = self.run_import(name, "--out", "out", "--force", *arguments)
        case = tomllib.loads(Path("out/case.toml").read_text(encoding="utf-8"))
        early = ("--set", "run.end=1e-9")  # few trial steps
        done = subprocess.run([PROGRAM, "check", "out/case.toml", *early], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return case, output, done.stdout

    def refused(self, name, text, *words, arguments=("--units", "mm,ms,kg")):
        """A file that is refused by a message with these words, in this order."""
        Path(name).write_bytes(text if isinstance(text, bytes) else text.encode())
        output = self.run_import(name, "--out", "none", *arguments, code=2)
        at = 0
        for word in words:
            self.assertIn(word, output[at:], output)
            at = output.index(word, at)
        self.assertFalse(Path("none").exists())
        return output
