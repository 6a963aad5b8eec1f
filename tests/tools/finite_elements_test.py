# SPDX-License-Identifier: Apache-2.0
"""The finite elements that references come from: an exact solution, energy, threads, words for what is wrong."""
import os
import re
import subprocess
import sys
from pathlib import Path

PROGRAM = Path(os.environ.get("PIOLA_PROGRAM", "")).parent / "piola_finite_elements"
EXACT = 0.70750  # cos(sqrt(3)/2 pi sqrt((lambda + 2 mu)/rho) 2 ms), 17 MPa, 0.3, 1100 kg/m^3
failures = 0


def expect(holds, text):
    global failures
    if not holds:
        print(text)
        failures += 1


def run(*words):
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True,
                          env={**os.environ, "OMP_WAIT_POLICY": "passive"})


def rows(text):
    """Lines of the table: bricks across, bricks, steps, readings, energy error."""
    return [[float(word) for word in line.split()] for line in text.splitlines() if re.match(r"\s+\d", line)]


if not os.environ.get("PIOLA_PROGRAM") or not PROGRAM.is_file():
    print("skipped: piola_finite_elements is not built (PIOLA_FINITE_ELEMENTS)")
    sys.exit(77)

# A mode of linear elasticity: second order, towards the exact solution.
text = run("swing", "--across", "4,8,16", "--safety", "0.5").stdout
found = re.search(r"order ([\d.]+), limit ([\d.]+)", text)
expect(found, "no order and limit of the swinging cube:\n" + text)
if found:
    expect(abs(float(found[1]) - 2) < 0.1, "order of the swinging cube " + found[1])
    expect(abs(float(found[2]) - EXACT) < 2e-4, "limit of the swinging cube " + found[2])

# A free body at large strain keeps its energy to the order of the step, and turns with its angular momentum.
error = [rows(run("spin", "--across", "4", "--safety", safety).stdout)[0][-1] for safety in ("0.8", "0.4")]
expect(error[1] < 2e-3 and error[1] < 0.4 * error[0], f"energy errors of the spinning cube {error}")

# Energy and twist near incompressibility, far from locking: published peak near 340 degrees on a coarse mesh.
stiff = rows(run("twist", "--nu", "0.499", "--across", "4", "--time").stdout)
expect(len(stiff) == 1 and 335 < stiff[0][3] < 360, f"twist at 0.499: {stiff}")
expect(len(stiff) == 1 and stiff[0][-1] > 0, f"--time gives no rate: {stiff}")

# The same digits with any number of threads: even and odd layers, whoever adds them.
one, three = (run("twist", "--across", "5", "--threads", n).stdout for n in ("1", "3"))
same = [r[:-1] for r in rows(one)] == [r[:-1] for r in rows(three)]
expect(one and same, f"threads change the answer:\n{one}\n{three}")

WRONG = [(["twist", "--acros", "4"], "--acros: is not known"), (["twist", "--across", "4,2"], "rising"),
         (["punch", "--across", "1"], "leaves a side without a brick"), (["twist", "--nu"], "wants a value")]
for words, part in WRONG:
    wrong = run(*words)
    expect(wrong.returncode == 1 and part in wrong.stderr, f"{words}: {wrong.returncode} {wrong.stderr}")
expect(run("knead").returncode == 2, "an unknown problem is accepted")
sys.exit(1 if failures else 0)
