# SPDX-License-Identifier: Apache-2.0
"""Studies: one case with many values of its parameters."""
from __future__ import annotations

import concurrent.futures
import csv
import itertools
import json
import os
import subprocess
import sys
from typing import Any, Dict, List, Mapping, Optional, Sequence, Union

from .case import Case
from .errors import FileError, InputError

_JOB = "study.json"  # in the folder of each run: its parameters


def study(case: Case, parameters: Mapping[str, Sequence[Any]], out: Union[str, os.PathLike] = "study",
          jobs: int = 2, threads: Optional[int] = None) -> List[Dict[str, Any]]:
    """Runs a case with every combination of the parameters' values, `jobs` at a time, each in a process of its own.

    parameters: values by key, as in case[key] = value. Each run has a folder of its own in `out`; study.csv there has a
    row for each: parameters, status, quantities. Runs that are completed there with the same case and parameters are
    not run again. threads: of each run; by default the cores divided by `jobs`. Returns the rows.
    Raises InputError for cases with Python functions (they cannot go to another process) and if any of the cases is
    wrong, before the first one runs.
    """
    if case._has_functions():
        raise InputError("a case with Python functions cannot be studied - run it in a loop of your own")
    if jobs < 1:
        raise ValueError("jobs: a number from 1 on is needed")
    out = os.fspath(out)
    os.makedirs(out, exist_ok=True)
    share = threads or max(1, (os.cpu_count() or 1) // jobs)
    combinations = [dict(zip(parameters, values)) for values in itertools.product(*parameters.values())]
    digits = len(str(len(combinations)))
    tasks = []
    for number, values in enumerate(combinations):
        one = case.copy({"run.threads": share, **values} if "run.threads" not in case._settings else values)
        _check(one, values)
        tasks.append((one, values, os.path.join(out, f"run-{number + 1:0{digits}d}")))
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        rows = list(pool.map(lambda task: _run(*task), tasks))
    _write(os.path.join(out, "study.csv"), rows)
    return rows


def _check(case: Case, values: Mapping[str, Any]) -> None:
    try:
        case._case()
    except InputError as error:
        raise InputError(f"with {values}:\n{error}") from error
    case._read = None  # its particles would stay in memory


def _run(case: Case, values: Dict[str, Any], folder: str) -> Dict[str, Any]:
    from .results import Results
    job = {"file": case._file and os.path.abspath(case._file), "text": case._text, "settings": case.overrides(),
           "values": {key: str(value) for key, value in values.items()}}
    if not _is_done(folder, job):
        worker = [sys.executable, "-c", "from piola import studies; studies._work()", folder]
        path = os.pathsep.join([os.path.dirname(os.path.dirname(os.path.abspath(__file__)))] + sys.path)
        done = subprocess.run(worker, input=json.dumps(job), text=True, capture_output=True,
                              env={**os.environ, "PYTHONPATH": path})
        if done.returncode != 0 and not os.path.exists(os.path.join(folder, "summary.json")):
            raise FileError(f"{folder}: the run with {values} could not be made: {done.stderr.strip()}")
    results = Results(folder)
    return {"folder": folder, **values, "status": results.summary.get("status", "failed"), **results.quantities}


def _is_done(folder: str, job: dict) -> bool:
    try:
        with open(os.path.join(folder, _JOB), encoding="utf-8") as file:
            same = json.load(file) == job
        with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
            return same and json.load(file)["status"] == "completed"
    except (OSError, ValueError, KeyError):
        return False


def _work() -> None:
    """What the process of one run does."""
    from . import _piola
    job, folder = json.load(sys.stdin), sys.argv[1]
    case = _piola.read(job["file"], job["text"], "case", job["settings"])
    session = _piola.Session(case, folder, False, False, {}, {}, {})
    with _new_file(os.path.join(folder, _JOB)) as file:
        json.dump(job, file)
    session.advance(float("inf"), -1, False)
    session.finish()


def _new_file(path: str):
    """Opens a file to write in place of the one of its name; a link there is replaced, never followed."""
    if os.path.lexists(path):
        os.unlink(path)
    return open(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666), "w", newline="", encoding="utf-8")


def _write(path: str, rows: List[Dict[str, Any]]) -> None:
    columns = list(dict.fromkeys(key for row in rows for key in row))
    part = path + ".part"
    with _new_file(part) as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        writer.writerows(rows)
    os.replace(part, path)
