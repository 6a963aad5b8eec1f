# SPDX-License-Identifier: Apache-2.0
"""Start of `piola identify` and of `python3 -m piola_identify`."""
import sys
from pathlib import Path

if not __package__:  # started by its path, which puts this folder, not the one above, where modules are looked for
    sys.path[0] = str(Path(__file__).resolve().parent.parent)

try:
    import scipy.optimize  # noqa: F401
except ImportError:
    print(f"piola: identifying needs scipy for {sys.executable} - install the package python3-scipy (apt install "
          "python3-scipy), or name another Python in the variable PIOLA_PYTHON", file=sys.stderr)
    sys.exit(2)

from piola_identify.command import main

sys.exit(main(sys.argv[1:]))
