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
import warnings
from typing import Any, Dict, List, Mapping, Optional, Sequence, Union

from .case import Case
from .errors import CaseWarning, InputError, PhysicsError

_STATUS = {0: "completed", 3: "failed"}  # of summary.json, by the exit code of the run's process


def study(case: Case, parameters: Mapping[str, Sequence[Any]], out: Union[str, os.PathLike] = "study",
          jobs: int = 2, threads: Optional[int] = None) -> List[Dict[str, Any]]:
    """Runs a case with every combination of the parameters' values, `jobs` at a time, each in a process of its own.

    parameters: values by key, as in case[key] = value. Each run has a folder of its own in `out`; study.csv there has a
    row for each: parameters, status, quantities. Runs that are completed there are not run again if nothing that they
    depend on has changed: case and parameters, the files that the case names, the program. A run that cannot be made
    has the status "failed", no quantities, and a CaseWarning that says why. threads: of each run; by default the cores
    divided by `jobs`. Returns the rows.
    Raises InputError for cases with Python functions (they cannot go to another process) and if any of the cases is
    wrong, before the first one runs.
    """
    if case._functions():
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
        tasks.append((one, values, os.path.join(out, f"run-{number + 1:0{digits}d}"), _identity(one, values)))
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        rows = list(pool.map(lambda task: _run(*task), tasks))
    _write(os.path.join(out, "study.csv"), rows)
    return rows


def _identity(case: Case, values: Mapping[str, Any]) -> str:
    """What a run of the case depends on, as a digest. Raises InputError if the case is wrong."""
    try:
        return case._case().identity
    except InputError as error:
        raise InputError(f"with {values}:\n{error}") from error
    finally:
        case._read = None  # its particles would stay in memory


def _run(case: Case, values: Dict[str, Any], folder: str, identity: str) -> Dict[str, Any]:
    summary = _summary(folder, identity) if identity else {}
    if summary.get("status") != "completed":
        summary = _made(case, values, folder, identity)
    quantities = {name: entry["value"] for name, entry in summary.get("quantities", {}).items()}
    return {"folder": folder, **values, "status": summary.get("status", "failed"), **quantities}


def _made(case: Case, values: Dict[str, Any], folder: str, identity: str) -> dict:
    """Makes a run in a process of its own. The summary that this run wrote; {} if it wrote none."""
    job = {"file": case._file and os.path.abspath(case._file), "text": case._text, "settings": case.overrides()}
    before = _text(folder)
    path = os.pathsep.join([os.path.dirname(os.path.dirname(os.path.abspath(__file__)))] + sys.path)
    done = subprocess.run([sys.executable, "-c", "from piola import studies; studies._work()", folder],
                          input=json.dumps(job), text=True, capture_output=True, env={**os.environ, "PYTHONPATH": path})
    summary = _summary(folder, identity) if _text(folder) != before else {}
    if summary.get("status") == _STATUS.get(done.returncode, ""):
        return summary
    why = done.stderr.strip().splitlines()[-1:] or [f"its process ended with {done.returncode}"]
    warnings.warn(f"{folder}: the run with {values} failed: {why[0]}", CaseWarning, stacklevel=2)
    return {}


def _text(folder: str) -> str:
    """The text of a summary.json; empty if there is none."""
    try:
        with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
            return file.read()
    except OSError:
        return ""


def _summary(folder: str, identity: str) -> dict:
    """What a summary.json says of a run with this identity; {} if it is of another run, or none."""
    try:
        summary = json.loads(_text(folder) or "{}")
        return summary if summary["identity"]["run"] == identity else {}
    except (ValueError, KeyError, TypeError):
        return {}


def _work() -> None:
    """What the process of one run does; its exit code is a key of _STATUS, or another one if it cannot run."""
    from . import _piola
    job, folder = json.load(sys.stdin), sys.argv[1]
    case = _piola.read(job["file"], job["text"], "case", job["settings"])
    session = _piola.Session(case, folder, False, False, {}, {}, {})
    try:
        session.advance(float("inf"), -1, False)
    except PhysicsError as error:
        print(error, file=sys.stderr)
        sys.exit(3)
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
