# SPDX-License-Identifier: Apache-2.0
"""What an identification writes."""
import csv
import json
import subprocess


def table_of(fit, found):
    """The found values as text for the terminal."""
    lines = []
    for n, p in enumerate(fit.parameters):
        unit = f" {p.unit}" if p.unit else ""
        interval = "" if found.low is None else f"   95 % interval {found.low[n]:.5g} to {found.high[n]:.5g}{unit}"
        lines.append(f"  {p.name} = {found.values[n]:.5g}{unit}{interval}")
        if min(abs(found.values[n] - p.least), abs(p.most - found.values[n])) < 1e-3 * (p.most - p.least):
            lines.append(f"    it is at a bound ({p.least:g} to {p.most:g}): the interval says little")
    for i in range(len(fit.parameters) if found.correlation is not None else 0):
        for j in range(i):
            if abs(found.correlation[i, j]) > 0.95:
                lines.append(f"  {fit.parameters[j].name} and {fit.parameters[i].name} are correlated by "
                             f"{found.correlation[i, j]:.3f}: the curves hardly tell them apart")
    return "\n".join(lines)


def write_result(folder, fit, found, failed):
    text = ["# Parameters found by piola identify, with 95 % confidence intervals (low, high).",
            f"converged = {str(bool(found.converged)).lower()}", f"message = {_quoted(found.message)}",
            f"evaluations = {found.evaluations}", f"failed_runs = {failed}",
            f"residual = {float(found.residual):.6g}  # root mean square, in units of `error`, or of the largest y"]
    for n, p in enumerate(fit.parameters):
        text += ["", "[[parameter]]", f"name = {_quoted(p.name)}", f"key = {_quoted(p.key)}", f"unit = {_quoted(p.unit)}",
                 f"value = {float(found.values[n])!r}"]
        if found.low is not None:
            text += [f"low = {float(found.low[n])!r}", f"high = {float(found.high[n])!r}",
                     "correlation = [" + ", ".join(f"{value:.4f}" for value in found.correlation[n]) + "]"]
    (folder / "result.toml").write_text("\n".join(text) + "\n", encoding="utf-8")


def _quoted(text):
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def write_curves(folder, runs, start, found):
    """The measured curves, those at the start and the fitted ones in curves.csv, their picture, and a results folder of
    each with the found values, from which the case can be run again. Returns what failed, a line each."""
    before, after = runs.evaluate([start, found.values])
    with open(folder / "curves.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        first = runs.measured[0].curve
        writer.writerow(["curve", first.x, first.y, "start", "fitted"])
        for measured, *ys in zip(runs.measured, before, after):
            for values in zip(measured.x, measured.y, *ys):
                writer.writerow([measured.curve.name, *(f"{value:.8g}" for value in values)])
    commands = [[runs.program, "plot", str(folder)]]
    commands += [runs.command(measured.curve, found.values, folder / f"{measured.curve.name}_fitted") + ["--force"]
                 for measured in runs.measured]
    done = [subprocess.run(command, capture_output=True, text=True, check=False) for command in commands]
    return [line for one in done if one.returncode for line in one.stderr.strip().splitlines()[-1:]]
