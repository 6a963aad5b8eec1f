# SPDX-License-Identifier: Apache-2.0
"""Least squares over runs, and the confidence of what they find."""
from dataclasses import dataclass
from typing import Optional

import numpy as np
from scipy import optimize, stats

from .problem import Problem

DIFFERENCE = 0.01      # of the range of a linear parameter, or of the logarithm of a value
CONFIDENCE = 0.95
PENALTY = 10.0         # residuals of a trial whose run fails, over the largest one at the start


@dataclass
class Found:
    values: np.ndarray
    low: Optional[np.ndarray]          # ends of the confidence intervals; None: not known, as of the next two
    high: Optional[np.ndarray]
    correlation: Optional[np.ndarray]
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
        self.penalty = 1.0
        points = sum(len(measured.x) for measured in runs.measured)
        if points <= len(fit.parameters):
            raise Problem(f"{points} measured points cannot tell {len(fit.parameters)} parameters - measure more, or "
                          "leave parameters out")

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
            parts.append(np.full(points, self.penalty) if curves is None else (curves[n] - measured.y) / measured.scale)
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
        (curves,) = self.runs.evaluate([self.outer(start)])
        if curves is None:
            raise Problem("the runs fail with the values at the start, as told above - choose others, or correct the case")
        self.penalty = PENALTY * max(1.0, np.abs(self._of(curves)).max())
        done = optimize.least_squares(self.residuals, start, jac=self.jacobian, bounds=(self.low, self.high),
                                      x_scale=self.high - self.low, ftol=1e-6, xtol=1e-6, gtol=1e-8,
                                      max_nfev=self.fit.evaluations)
        return self.with_confidence(done)

    def unfinished(self, message):
        """The best values so far, without intervals; None if there are none."""
        cost, inner = self.best
        return None if inner is None else Found(np.array(self.outer(inner)), None, None, None, cost, self.count, False,
                                                message)

    def with_confidence(self, done):
        """Intervals from the variance of the residuals and the Jacobian at the solution, by Student's distribution."""
        points, number = done.jac.shape
        information = done.jac.T @ done.jac
        scale = np.sqrt(np.diag(information))  # so that units do not count
        if not np.all(scale > 0) or np.linalg.cond(information / np.outer(scale, scale)) > 1e12:
            raise Problem("the curves do not tell the parameters apart: two of them change the curves alike, or one "
                          "does not change them - leave one out, or add a curve that shows it")
        inverse = np.linalg.inv(information / np.outer(scale, scale))
        variance = float(np.sum(done.fun**2)) / (points - number)
        reach = stats.t.ppf(0.5 + CONFIDENCE / 2, points - number) * np.sqrt(variance * np.diag(inverse)) / scale
        correlation = inverse / np.sqrt(np.outer(np.diag(inverse), np.diag(inverse)))
        return Found(np.array(self.outer(done.x)), np.array(self.outer(done.x - reach)),
                     np.array(self.outer(done.x + reach)), correlation, float(np.sqrt(np.mean(done.fun**2))), self.count,
                     done.status > 0, done.message)
