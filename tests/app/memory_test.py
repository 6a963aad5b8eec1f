# SPDX-License-Identifier: Apache-2.0
"""What `piola check` says of memory is what the process takes at most, within 25 %."""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM = os.environ["PIOLA_PROGRAM"]

CASE = """title = "Cube"
[run]
end = "1e-7 s"
[[body]]
name = "cube"
shape = {{ box = {{ min = ["0 m", "0 m", "0 m"], max = ["1 m", "1 m", "1 m"] }}, particles = [{n}, {n}, {n}]{more} }}
material = {{ law = "{law}", density = "7000 kg/m^3", youngs_modulus = "21 GPa", poissons_ratio = 0.3 }}
formulation = {{ name = "{formulation}"{words} }}
initial_velocity = ["0 m/s", "10 m/s", "0 m/s"]
[output.history]
every = "1 s"
"""
FLOWING = ', description = "eulerian"'
UNITS = {"kB": 1e3, "MB": 1e6, "GB": 1e9}


def largest_resident(command):
    """Bytes that a process of its own has resident at most."""
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    assert status == 0, command
    return 1024 * usage.ru_maxrss


def check(name, folder, law="neo_hookean", more="", words="", **keys):
    keys |= {"law": law, "more": more, "words": words}
    case = folder / f"{name}.toml"
    case.write_text(CASE.format(**keys))
    told = subprocess.run([PROGRAM, "check", case], check=True, capture_output=True, text=True).stdout
    number, unit = re.search(r"([\d.]+) ([kMG]B) of memory", told).groups()
    said = float(number) * UNITS[unit]
    taken = largest_resident([PROGRAM, "run", case, "-o", folder / name, "--threads", "2"])
    good = abs(said / taken - 1) <= 0.25
    print(f"{name}: said {said / 1e6:.0f} MB, taken {taken / 1e6:.0f} MB{'' if good else ' - more than 25 % apart'}")
    return good


def main():
    with tempfile.TemporaryDirectory() as folder:
        good = [
            check("lattice", Path(folder), n=48, formulation="jst_sph"),
            check("cloud", Path(folder), n=28, more=", jitter = 0.2", formulation="jst_sph"),
            check("nodal", Path(folder), n=32, formulation="nodal"),
            check("adaptle", Path(folder), n=28, law="elastic", formulation="adaptle"),
            check("flowing", Path(folder), n=28, law="elastic", formulation="adaptle", words=FLOWING),
            check("simplices", Path(folder), n=20, law="linear_elastic", formulation="taylor_sph"),
            check("parts", Path(folder), n=60, formulation="jst_sph"),
            check("flowing parts", Path(folder), n=60, law="elastic", formulation="adaptle", words=FLOWING),
        ]
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
