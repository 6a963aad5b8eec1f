# SPDX-License-Identifier: Apache-2.0
"""The line that shows how far a run is."""
import datetime
import sys
import time


class ProgressLine:
    """An observer of a run that renews one line of sys.stdout, at most twice a second, until close()."""
    _between = 0.5  # [s]

    def __init__(self, run):
        self._first, self._began = run.time, time.monotonic()
        self._last, self._open, self._width = -float("inf"), True, 0

    def __call__(self, run) -> None:
        now = time.monotonic()
        if not self._open or now - self._last < self._between:
            return
        self._last = now
        done, ahead = run.time - self._first, run.end - run.time
        left = f"{_duration((now - self._began) * ahead / done)} left" if done > 0 else "time left unknown yet"
        self._show(run, left)

    def close(self, run) -> None:
        """Writes where the run stands and ends the line."""
        self._open = False
        self._show(run, f"took {_duration(time.monotonic() - self._began)}", "\n")

    def _show(self, run, what: str, end: str = "") -> None:
        percent = int(100 * run.time / run.end)
        text = f"{percent:3d} %, t = {run.time:.4g} s of {run.end:.4g} s, step {run.steps}, {what}"
        sys.stdout.write("\r" + text.ljust(self._width) + end)
        sys.stdout.flush()
        self._width = len(text)


def _duration(seconds: float) -> str:
    """h:mm:ss"""
    try:
        return str(datetime.timedelta(seconds=round(seconds)))
    except OverflowError:
        return "more than a million years"
