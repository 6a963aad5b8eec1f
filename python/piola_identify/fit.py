# SPDX-License-Identifier: Apache-2.0
"""Least squares over runs, and the confidence of what they find."""
from dataclasses import dataclass

import numpy as np
from scipy import optimize, stats

from .problem import Problem

DIFFERENCE = 0.01      # of the range of a linear parameter, or of the logarithm of a value
CONFIDENCE = 0.95
PENALTY = 1e3          # residual of a trial whose run fails, in units of the scale of a curve


@dataclass
class Found:
    values: np.ndarray
    low: np.ndarray          # ends of the confidence intervals
    high: np.ndarray
    correlation: np.ndarray
    residual: float          # root mean square, in units of the scales of the curves
    evaluations: int
    converged: bool
    message: str


class LeastSquares:
    """Varies the parameters within their bounds, by inner values (logarithms where wanted)."""

    def __init__(self, fit, runs, progress):
        self.fit, self.runs, self.progress = fit, runs, progress
        self.count = 0
        bounds = [(p.inner(p.least), p.inner(p.most)) for p in fit.parameters]
        self.low, self.high = (np.array(side) for side in zip(*bounds))
        self.best = (np.inf, None)

    def outer(self, inner):
        return [p.outer(value) for p, value in zip(self.fit.parameters, inner)]

    def residuals(self, inner):
        self.count += 1
        (curves,) = self.runs.evaluate([self.outer(inner)])
        residuals = self._of(curves)
        cost = float(np.sqrt(np.mean(residuals**2)))
        if cost < self.best[0]:
            self.best = (cost, np.array(inner))
        self.progress(self.count, cost, self.best[0], self.outer(inner))
        return residuals

    def _of(self, curves):
        parts = []
        for n, measured in enumerate(self.runs.measured):
            points = len(measured.x)
            parts.append(np.full(points, PENALTY) if curves is None else (curves[n] - measured.y) / measured.scale)
        return np.concatenate(parts)

    def steps(self, inner):
        """A step of each parameter that stays within the bounds."""
        steps = []
        for parameter, value, low, high in zip(self.fit.parameters, inner, self.low, self.high):
            size = DIFFERENCE if parameter.log else DIFFERENCE * (high - low)
            size = min(size, 0.25 * (high - low))
            steps.append(size if value + size <= high else -size)
        return np.array(steps)

    def jacobian(self, inner):
        """One-sided differences, from the other side where a run fails; all runs at a time."""
        steps = self.steps(inner)
        trials = [np.array(inner) + np.eye(len(steps))[k] * steps[k] for k in range(len(steps))]
        all_curves = self.runs.evaluate([self.outer(inner)] + [self.outer(trial) for trial in trials])
        base = self._of(all_curves[0])
        columns = []
        for k, curves in enumerate(all_curves[1:]):
            step = steps[k]
            if curves is None:
                step = -step
                (curves,) = self.runs.evaluate([self.outer(np.array(inner) + np.eye(len(steps))[k] * step)])
            if curves is None:
                raise Problem(f"runs fail on both sides of {self.fit.parameters[k].name} = {self.outer(inner)[k]:g} - "
                              "choose other bounds")
            columns.append((self._of(curves) - base) / step)
        return np.stack(columns, axis=1)

    def solve(self):
        start = np.array([p.inner(p.start) for p in self.fit.parameters])
        inside = 1e-6 * (self.high - self.low)
        start = np.clip(start, self.low + inside, self.high - inside)
        if not np.all(np.abs(self.residuals(start)) < PENALTY):
            raise Problem("the runs fail with the values at the start - choose others")
        done = optimize.least_squares(self.residuals, start, jac=self.jacobian, bounds=(self.low, self.high),
                                      x_scale=self.high - self.low, ftol=1e-6, xtol=1e-6, gtol=1e-8,
                                      max_nfev=self.fit.evaluations)
        return self.with_confidence(done)

    def with_confidence(self, done):
        """Intervals from the variance of the residuals and the Jacobian at the solution, by Student's distribution."""
        points, number = done.jac.shape
        free = points - number
        if free < 1:
            raise Problem(f"{points} measured points cannot tell {number} parameters")
        variance = float(np.sum(done.fun**2)) / free
        information = done.jac.T @ done.jac
        if np.linalg.cond(information) > 1e14:
            raise Problem("the curves do not tell the parameters apart: two of them change the curves alike, or one "
                          "does not change them - leave one out, or add a curve that shows it")
        covariance = variance * np.linalg.inv(information)
        deviation = np.sqrt(np.diag(covariance))
        reach = stats.t.ppf(0.5 + CONFIDENCE / 2, free) * deviation
        return Found(np.array(self.outer(done.x)), np.array(self.outer(done.x - reach)),
                     np.array(self.outer(done.x + reach)), covariance / np.outer(deviation, deviation),
                     float(np.sqrt(np.mean(done.fun**2))), self.count, done.status > 0, done.message)
