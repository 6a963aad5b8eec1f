# SPDX-License-Identifier: Apache-2.0
"""What an identification writes."""
import csv
import subprocess


def table_of(fit, found):
    """The found values as text for the terminal."""
    lines = []
    for n, p in enumerate(fit.parameters):
        unit = f" {p.unit}" if p.unit else ""
        lines.append(f"  {p.name} = {found.values[n]:.5g}{unit}   95 % interval {found.low[n]:.5g} to "
                     f"{found.high[n]:.5g}{unit}")
        if min(abs(found.values[n] - p.least), abs(p.most - found.values[n])) < 1e-3 * (p.most - p.least):
            lines.append(f"    it is at a bound ({p.least:g} to {p.most:g}): the interval says little")
    for i in range(len(fit.parameters)):
        for j in range(i):
            if abs(found.correlation[i, j]) > 0.95:
                lines.append(f"  {fit.parameters[j].name} and {fit.parameters[i].name} are correlated by "
                             f"{found.correlation[i, j]:.3f}: the curves hardly tell them apart")
    return "\n".join(lines)


def write_result(folder, fit, found, failed):
    text = ["# Parameters found by piola identify, with 95 % confidence intervals.",
            f"converged = {str(bool(found.converged)).lower()}", f'message = "{found.message}"',
            f"evaluations = {found.evaluations}", f"failed_runs = {failed}",
            f"residual = {found.residual:.6g}  # root mean square, in units of `error`, or of the largest y of a curve"]
    for n, p in enumerate(fit.parameters):
        text += ["", "[[parameter]]", f'name = "{p.name}"', f'key = "{p.key}"', f'unit = "{p.unit}"',
                 f"value = {float(found.values[n])!r}", f"low = {float(found.low[n])!r}",
                 f"high = {float(found.high[n])!r}",
                 "correlation = [" + ", ".join(f"{value:.4f}" for value in found.correlation[n]) + "]"]
    (folder / "result.toml").write_text("\n".join(text) + "\n", encoding="utf-8")


def write_curves(folder, runs, start, found):
    """The curves of each measurement at the start and as fitted, and the cases with the found values."""
    before, after = runs.evaluate([start, found.values])
    for n, measured in enumerate(runs.measured):
        with open(folder / f"{measured.curve.name}.csv", "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(["x", "measured", "start", "fitted"])
            for k in range(len(measured.x)):
                writer.writerow([f"{value:.8g}" for value in (measured.x[k], measured.y[k], before[n][k], after[n][k])])
        run = folder / f"{measured.curve.name}_fitted"
        subprocess.run(runs.command(measured.curve, found.values, run) + ["--force"], capture_output=True, check=False)
    return before, after


def draw(folder, runs, before, after):
    """A picture of all curves, if matplotlib is there. Returns its name."""
    try:
        import matplotlib
        matplotlib.use("Agg")
        from matplotlib import pyplot
    except ImportError:
        return None
    figure, axes = pyplot.subplots(figsize=(7, 5), constrained_layout=True)
    for n, measured in enumerate(runs.measured):
        colour = f"C{n}"
        axes.plot(measured.x, measured.y, ".", color=colour, label=f"{measured.curve.name}, measured")
        axes.plot(measured.x, before[n], ":", color=colour)
        axes.plot(measured.x, after[n], "-", color=colour, label="fitted")
    axes.set_xlabel(runs.measured[0].curve.x)
    axes.set_ylabel(runs.measured[0].curve.y)
    axes.legend()
    figure.savefig(folder / "fit.png", dpi=150)
    return "fit.png"
