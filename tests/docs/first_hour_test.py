#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Types docs/user/first-hour.md and axisymmetric-impact.md from top to bottom: writes their files, runs their commands
and scripts in an empty folder, and looks for what the pages show of the answers. Programs other than piola and touch
are left out."""
import csv
import os
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(os.environ["PIOLA_SOURCE_DIR"])
PROGRAM = os.environ.get("PIOLA_PROGRAM", "")
PAGE = ROOT / "docs/user/first-hour.md"
IMPACT = ROOT / "docs/user/axisymmetric-impact.md"
# Commands that are meant to fail, and how.
STATUS = {"piola check beam.toml, empty": 2}
# What the machine decides: seconds, memory, threads.
MACHINE = re.compile(r"^needs, estimated")


def steps(text):
    """("file", name, text), ("python", None, text) or ("line", None, text), as they come."""
    lines, k, name = text.splitlines(), 0, None
    while k < len(lines):
        named = re.search(r"Write `([\w.]+)`", lines[k])
        name = named[1] if named else name
        if lines[k].startswith("```"):
            end = lines.index("```", k + 1)
            kind = "file" if lines[k] == "```toml" else lines[k][3:]
            yield kind, name, "\n".join(lines[k + 1:end]) + "\n"
            k = end
        elif lines[k].startswith("    "):
            yield "line", None, lines[k].strip()
        k += 1


NUMBER = r"(?<![\w.])-?\d[\d,]*(?:\.\d+)?(?!\w)"


def shown_in(line, said):
    """Whether a line of the page is in an answer: the same words, and numbers that are what is shown once rounded."""
    pattern = "".join(f"({NUMBER})" if k % 2 else re.sub(r"(\\ )+", r"\\s+", re.escape(part))
                      for k, part in enumerate(re.split(f"({NUMBER})", line)))
    wanted = [number.replace(",", "") for number in re.findall(NUMBER, line)]
    return any(all(abs(float(a) - float(b.replace(",", ""))) <= 0.51 * 10.0 ** -len(a.partition(".")[2])
                   for a, b in zip(wanted, found.groups())) for found in re.finditer(pattern, said))


class Reader:
    """Somebody who types what the page says."""

    def __init__(self, folder):
        self.folder, self.said, self.wrong, self.done = folder, "", [], 0

    def run(self, words, command):
        done = subprocess.run(words, cwd=self.folder, capture_output=True, text=True, timeout=280, check=False)
        self.said, self.done = done.stdout + done.stderr, self.done + 1
        empty = command.endswith("check beam.toml") and (self.folder / "beam.toml").stat().st_size == 0
        wanted = STATUS.get(command + ", empty" * empty, 0)
        if done.returncode != wanted:
            self.wrong.append(f"{command}: exit status {done.returncode} instead of {wanted}: {self.said[-600:]}")

    def line(self, line):
        """A command, or a line of an answer."""
        word = line.split()[0]
        if word in ("piola", "touch"):
            self.run([PROGRAM if word == "piola" else word, *shlex.split(line)[1:]], line)
        elif word in ("tools/quickstart", "alias", "ffmpeg"):
            return  # the quick start builds the program; the others are not Piola's
        elif not MACHINE.match(line) and not shown_in(line.removeprefix("piola: "), self.said):
            self.wrong.append(f"the page shows '{line}', the program said: {self.said[-900:]}")

    def follow(self, text):
        for kind, name, block in steps(text):
            if kind == "file":
                (self.folder / name).write_text(block)
            elif kind == "python":
                self.run([sys.executable, "-c", block], "the script")
            elif kind == "line":
                self.line(block)


def expected():
    """What a reader should find in the end."""
    return ["beam-results/energies.svg", "tip.svg", "compared.pdf", "stiffness.svg", "bounce-results/summary.json",
            *(f"{name}-results/pictures" for name in ("beam", "bounce", "rod")), "stiffness-study/study.csv",
            "rod-converge/convergence.csv"]


def main():
    if not os.access(PROGRAM, os.X_OK):
        print("skipped: the program is not built")
        return 77
    with tempfile.TemporaryDirectory() as name:
        reader = Reader(Path(name))
        reader.follow(PAGE.read_text())
        reader.follow(IMPACT.read_text())
        reader.wrong += [f"{file} is missing" for file in expected() if not (reader.folder / file).exists()]
        told = float(re.search(r"the tip ([\d.]+) cm down", PAGE.read_text())[1])
        with open(reader.folder / "beam-rest/history.csv", encoding="utf-8") as table:
            fell = -100 * float(list(csv.DictReader(table))[-1]["tip.displacement_z"])
        if abs(fell - told) > 0.051:
            reader.wrong.append(f"the beam rests {fell:.3f} cm down, the page says {told} cm")
        with open(reader.folder / "stiffness-study/study.csv", encoding="utf-8") as table:
            rows = list(csv.DictReader(table))
        if len(rows) != 3 or {row["status"] for row in rows} != {"completed"}:
            reader.wrong.append(f"the study has the rows {rows}")
    print("".join(f"first_hour_test: {line}\n" for line in reader.wrong), end="")
    print(f"first_hour_test: {reader.done} commands typed, {len(reader.wrong)} wrong")
    return 1 if reader.wrong or reader.done < 15 else 0


sys.exit(main())
