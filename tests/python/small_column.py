# SPDX-License-Identifier: Apache-2.0
"""What the tests of the module share: a small case, and a folder for each test."""
import os
import tempfile
import unittest
import warnings

import piola


def column(**settings):
    """A small column on a support."""
    return piola.Case({
        "title": "column",
        "run": {"end": "4 ms", "threads": 2},
        "body": [{
            "name": "column",
            "formulation": {"name": "nodal"},
            "shape": {"box": {"min": [0, 0, 0], "max": [1, 2, 1]}, "particles": [3, 6, 3]},
            "material": {"law": "neo_hookean", "density": 1000, "youngs_modulus": "10 GPa", "poissons_ratio": 0.3},
            "initial_velocity": ["3 * Y", 0, 0]}],
        "support": [{"name": "ground", "body": "column", "where": "Y < 0.1", "fix": "xyz"}],
        "output": {"frames": {"every": "1 ms"}, "history": {"every": "0.1 ms"}, "checkpoints": {"every": "1 ms"}},
    }, set=settings)


class InFolder(unittest.TestCase):
    def setUp(self):
        before = os.getcwd()
        folder = tempfile.TemporaryDirectory()
        os.chdir(folder.name)
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, before)
        # Doubts that a test does not look for fail it.
        caught = warnings.catch_warnings()
        caught.__enter__()
        warnings.simplefilter("error", piola.CaseWarning)
        self.addCleanup(caught.__exit__, None, None, None)
