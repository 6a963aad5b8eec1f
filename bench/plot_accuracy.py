#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws what `piola bench --only accuracy --json` has measured, error against processor time, as one SVG; prints it as
the two tables of bench/accuracy/README.md.

Usage: bench/plot_accuracy.py accuracy.json accuracy.svg [--finite-elements runs.csv]

runs.csv: lines "problem,poissons_ratio,across,value,seconds" of `piola_finite_elements`, drawn as a peer.
"""
import argparse
import csv
import json
import math
import sys

WIDTH, HEIGHT, MARGIN = 420, 300, 56
ERRORS = (1e-4, 0.5)
PRICES = ((0.03, "3 %"), (0.01, "1 %"), (0.003, "0.3 %"))
COLOURS = {"nodal": "#0072b2", "jst_sph": "#d55e00", "jst_sph paper": "#999999", "finite elements": "#009e73"}


def read(rows, finite_elements):
    """Points {(problem, nu): {scheme: [(cpu, |error|, across)]}} of measured rows, and of a file of finite elements."""
    panels = {}
    rows = list(rows)
    references = {(row["problem"], row["poissons_ratio"]): row["value"] / (1 + row["error"])
                  for row in rows if "error" in row}
    if finite_elements:
        with open(finite_elements, encoding="utf-8", newline="") as file:
            for row in csv.DictReader(file):
                key = (row["problem"], float(row["poissons_ratio"]))
                rows.append({"problem": key[0], "poissons_ratio": key[1], "formulation": "finite elements",
                             "across": int(row["across"]), "cpu_seconds": float(row["seconds"]),
                             "error": float(row["value"]) / references[key] - 1})
    for row in rows:
        if "error" not in row:
            continue
        panel = panels.setdefault((row["problem"], row["poissons_ratio"]), {})
        panel.setdefault(row["formulation"], []).append(
            (row["cpu_seconds"], max(abs(row["error"]), ERRORS[0]), row["across"]))
    return panels


def price(runs, error):
    """Processor time, and particles across, from which on all finer runs stay within an error."""
    found = "-"
    for row in runs:
        within = abs(row.get("error", math.inf)) <= error
        if not within:
            found = "-"
        elif found == "-":
            found = f"{row['cpu_seconds']:.2g} ({row['across']})"
    return found


def tables(rows):
    groups = {}
    for row in rows:
        groups.setdefault((row["problem"], row["poissons_ratio"], row["formulation"]), []).append(row)
    lines = ["| | nu | | " + " | ".join(name for _, name in PRICES) + " |", "|---" * (3 + len(PRICES)) + "|"]
    for key, runs in groups.items():
        lines.append("| " + " | ".join([*map(str, key), *(price(runs, error) for error, _ in PRICES)]) + " |")
    lines += ["", "| | nu | | across | particles | steps | value | error | set-up s | total s |", "|---" * 10 + "|"]
    for row in rows:
        result = [f"{row['value']:.4g}", f"{100 * row['error']:+.2f} %"] if "error" in row else [row["failure"], ""]
        lines.append("| " + " | ".join([row["problem"], str(row["poissons_ratio"]), row["formulation"],
                                        *(str(row[name]) for name in ("across", "particles", "steps")), *result,
                                        f"{row['set_up_cpu_seconds']:.3f}", f"{row['cpu_seconds']:.3f}"]) + " |")
    return "\n".join(lines)


class Panel:
    """One pair of logarithmic axes."""

    def __init__(self, left, top, times):
        self.left, self.top, self.times = left, top, times

    def x(self, seconds):
        low, high = map(math.log10, self.times)
        return self.left + MARGIN + (math.log10(seconds) - low) / (high - low) * (WIDTH - 1.4 * MARGIN)

    def y(self, error):
        low, high = map(math.log10, ERRORS)
        return self.top + HEIGHT - MARGIN - (math.log10(error) - low) / (high - low) * (HEIGHT - 1.7 * MARGIN)

    def axes(self, title):
        out = [text(self.left + WIDTH / 2, self.top + 20, title, 14, "middle", "bold")]
        for power in range(math.ceil(math.log10(self.times[0])), math.floor(math.log10(self.times[1])) + 1):
            x = self.x(10.0**power)
            out.append(line(x, self.y(ERRORS[0]), x, self.y(ERRORS[1]), "#ddd"))
            out.append(text(x, self.y(ERRORS[0]) + 16, f"{10.0**power:g}", 11))
        for error, name in ((1e-4, "0.01 %"), (1e-3, "0.1 %"), (1e-2, "1 %"), (1e-1, "10 %")):
            y = self.y(error)
            out.append(line(self.x(self.times[0]), y, self.x(self.times[1]), y, "#ddd"))
            out.append(text(self.left + MARGIN - 6, y + 4, name, 11, "end"))
        out.append(text(self.left + WIDTH / 2, self.top + HEIGHT - 18, "processor time [s]", 12))
        return out

    def curve(self, points, colour):
        points = sorted(points, key=lambda p: p[2])
        path = " ".join(f"{self.x(cpu):.1f},{self.y(error):.1f}" for cpu, error, _ in points)
        out = [f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="1.5"/>']
        for cpu, error, across in points:
            out.append(f'<circle cx="{self.x(cpu):.1f}" cy="{self.y(error):.1f}" r="3" fill="{colour}"/>')
            out.append(text(self.x(cpu) + 4, self.y(error) - 4, str(across), 8, "start"))
        return out


def text(x, y, what, size, anchor="middle", weight="normal"):
    return (f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}" font-weight="{weight}">'
            f"{what}</text>")


def line(x1, y1, x2, y2, colour):
    return f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}"/>'


def draw(panels):
    times = [cpu for panel in panels.values() for points in panel.values() for cpu, _, _ in points]
    span = (min(times) / 1.5, max(times) * 1.5)
    names = sorted({name for panel in panels.values() for name in panel}, key=list(COLOURS).index)
    rows = math.ceil(len(panels) / 2)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{2 * WIDTH}" height="{rows * HEIGHT + 30}" '
           'font-family="sans-serif">', '<rect width="100%" height="100%" fill="white"/>']
    for k, ((problem, ratio), curves) in enumerate(sorted(panels.items(), reverse=True)):
        panel = Panel(k % 2 * WIDTH, k // 2 * HEIGHT, span)
        out += panel.axes(f"{problem}, Poisson's ratio {ratio:g}")
        for name in names:
            if name in curves:
                out += panel.curve(curves[name], COLOURS[name])
    for k, name in enumerate(names):
        x = 60 + 180 * k
        out.append(f'<circle cx="{x}" cy="{rows * HEIGHT + 10}" r="5" fill="{COLOURS[name]}"/>')
        out.append(text(x + 10, rows * HEIGHT + 14, name, 12, "start"))
    return "\n".join(out + ["</svg>", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("measured", help="JSON of piola bench --only accuracy")
    parser.add_argument("picture", help="SVG to write")
    parser.add_argument("--finite-elements", help="CSV of piola_finite_elements")
    arguments = parser.parse_args()
    with open(arguments.measured, encoding="utf-8") as file:
        rows = json.load(file)["accuracy"]
    print(tables(rows))
    panels = read(rows, arguments.finite_elements)
    if not panels:
        sys.exit(f"{arguments.measured}: no errors in it - give the JSON of piola bench --only accuracy")
    with open(arguments.picture, "w", encoding="utf-8") as file:
        file.write(draw(panels))


if __name__ == "__main__":
    main()
