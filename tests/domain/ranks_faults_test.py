# SPDX-License-Identifier: Apache-2.0
"""Ranks in trouble: one that is killed at any moment, cannot read a file, has no memory or no disk left ends all of
them, with one message and the exit code of one rank; a killed run goes on from its last checkpoint with the same bits.

Needs a program with MPI and mpirun; is skipped otherwise. Arguments: kills conversions faults (default: all);
PIOLA_KILLS: how many of each (default 50, or 4 if PIOLA_RANKS_TESTS=quick); PIOLA_SEED chooses who and when.
"""
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from cases_on_ranks import TORN
from on_ranks import (ENVIRONMENT, QUICK, checkpoint, command, contents, differences, differently, expect, finish,
                      piola, short_bar, skip_without_ranks, start)

KILLS = int(os.environ.get("PIOLA_KILLS", "4" if QUICK else "50"))
SEED = int(os.environ.get("PIOLA_SEED", "17"))


def ranks_of(run):
    return [int(line) for line in
            subprocess.run(["pgrep", "-P", str(run.pid)], capture_output=True, text=True).stdout.split()]


def kill_one(line, delay, chance):
    """Runs it and kills a rank after so many seconds, if it still runs; says whether that happened."""
    run = subprocess.Popen(line, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=ENVIRONMENT)
    time.sleep(delay)
    children = ranks_of(run)
    killed = False
    if run.poll() is None and children:
        try:
            os.kill(chance.choice(children), signal.SIGKILL)
            killed = True
        except ProcessLookupError:
            pass
    code = run.wait(60)
    left = [child for child in children if Path(f"/proc/{child}").exists()]
    for _ in range(50):
        if not left:
            break
        time.sleep(0.1)
        left = [child for child in left if Path(f"/proc/{child}").exists()]
    expect(not left, f"{len(left)} ranks go on without the one that was killed")
    return killed and code != 0


def final_state(folder):
    files = sorted((folder / "checkpoints").glob("*.h5")) if (folder / "checkpoints").is_dir() else []
    return (files[-1].name, checkpoint(files[-1])) if files else ("none", {})


def torn_plate(folder):
    """Particles of AdapTLE convert between its checkpoints."""
    case = folder / "torn.toml"
    text = TORN.replace('end = "1 ms"', 'end = "2 us"')
    case.write_text(text + '[output.checkpoints]\nevery = "0.1 us"\n[output.pictures]\nevery = "10 us"\n')
    return case


def check_kills(bar, work):
    chance = random.Random(SEED)
    whole = work / "whole"
    shutil.rmtree(whole, ignore_errors=True)
    piola(1, "run", bar, "--out", whole)
    begun = time.monotonic()
    piola(2, "run", bar, "--out", work / "timed", "--force")
    takes = time.monotonic() - begun
    killed = resumed = 0
    for number in range(KILLS):
        folder = work / f"killed{number}"
        ranks = chance.choice((2, 3))
        if not kill_one(command(ranks, "run", bar, "--out", folder, "--quiet"), chance.uniform(0, 0.8 * takes), chance):
            print(f"kill {number}: the run was over before")
        else:
            killed += 1
        had = final_state(folder)[0] != "none"
        again = piola(chance.choice((1, 2, 3)), "resume", folder)
        if had:
            resumed += 1
            # 2: it was at its end, which one rank says, too
            expect(again.returncode in (0, 2), f"kill {number}: not resumed: {again.stderr}")
        else:
            expect(again.returncode == 2, f"kill {number}: resumed from nothing, exit code {again.returncode}")
            anew = piola(ranks, "run", bar, "--out", folder)
            expect(anew.returncode == 0, f"kill {number}: not run anew: {anew.stderr}")
        name, state = final_state(folder)
        name_of_whole, state_of_whole = final_state(whole)
        expect(name == name_of_whole and len(state) > 5 and not differences(state, state_of_whole),
               f"kill {number}: ends in another state ({name}), {differences(state, state_of_whole)[:4]}")
        expect((folder / "history.csv").read_bytes() == (whole / "history.csv").read_bytes(),
               f"kill {number}: has another history")
        shutil.rmtree(folder)
    expect(3 * killed >= KILLS, f"only {killed} of {KILLS} runs were killed before their end")
    print(f"{bar.name}: {killed} of {KILLS} runs killed (seed {SEED}), {resumed} resumed from a checkpoint", flush=True)


def said(run):
    return [line for line in run.stderr.splitlines() if line.startswith("piola: ")]


def check_one_voice(what, run, codes, text):
    lines = said(run)
    expect(run.returncode in codes, f"{what}: exit code {run.returncode}, not of {codes}: {run.stderr}")
    if run.returncode != 0:
        expect(len(lines) == 1 and text in lines[0], f"{what}: not one message with '{text}' but {lines} {run.stderr}")


def limited(bounds):
    """What sets bounds for one rank before it starts."""
    return ["bash", "-c", f"ulimit {bounds} && exec \"$@\"", "bounded"]


def most_memory(line):
    """The largest virtual memory that any rank of a run takes [kB]."""
    run = subprocess.Popen(line, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=ENVIRONMENT)
    most = 0
    while run.poll() is None:
        for rank in ranks_of(run):
            try:
                status = Path(f"/proc/{rank}/status").read_text()
            except (FileNotFoundError, ProcessLookupError):
                continue
            most = max([most, *(int(line.split()[1]) for line in status.splitlines() if line.startswith("VmPeak"))])
        time.sleep(0.02)
    return most


def check_memory(work):
    """A rank that has less memory than it needs stops wherever that is: while it reads, builds or steps."""
    small, large = short_bar(work), work / "block.toml"
    large.write_text(small.read_text().replace("[5, 5, 9]", "[31, 31, 61]").replace('"20 ms"', '"0.2 ms"'))
    words = ["--out", work / "memory", "--force", "--no-pictures", "--quiet"]
    # A thread's own heap reserves addresses that a process without them does well without: there is one heap for all.
    ENVIRONMENT["MALLOC_ARENA_MAX"] = "1"
    # MPI itself has what it needs: how it fails without is its own business.
    least, most = (most_memory(command(3, "run", case, *words)) for case in (small, large))
    expect(most > 1.05 * least, f"the large run takes {most} kB, the small one {least}: nothing to test between")
    stopped, shares = 0, (0.1, 0.5, 0.8) if QUICK else [k / 20 for k in range(1, 20)]
    for k, share in enumerate(shares):
        poor = (k + 1) % 3
        bounds = limited(f"-v {int(least + share * (most - least))}")
        run = start(differently(*(((bounds if r == poor else []), ["run", large, *words]) for r in range(3))),
                    timeout=120)
        check_one_voice(f"rank {poor} with {share:.0%} of the memory", run, (0, 1), "not enough memory")
        stopped += run.returncode == 1
    expect(stopped >= 2, f"memory was short in {stopped} runs only")
    print(f"memory, {least} to {most} kB: {stopped} of {len(shares)} runs stopped", flush=True)


def check_blind_rank(work, case):
    """A rank whose machine does not see the folder of results: rank 0 writes all."""
    apart, seen = work / "apart", work / "seen"
    apart.mkdir()
    blind = ["unshare", "--mount", "bash", "-c", f"mount -t tmpfs none {apart} && exec \"$@\"", "blind"]
    if subprocess.run([*blind, "true"], capture_output=True).returncode != 0:
        print("a rank that does not see the results: skipped, file systems cannot be mounted here")
        return
    words = ["run", case, "--quiet", "--no-pictures", "--out"]
    run = start(differently(([], [*words, apart / "out"]), (blind, [*words, apart / "out"])))
    expect(run.returncode == 0, f"a rank that does not see the results: {run.stderr}")
    piola(2, *words, seen)
    different = differences(contents(apart / "out"), contents(seen))
    expect(not different, f"where a rank does not see the results they differ in {different[:6]}")


def check_faults(bar, work):
    words = ["run", bar, "--out", work / "out", "--quiet"]
    missing = ["run", work / "missing.toml", *words[2:]]
    for line, who in (((([], words), ([], missing)), 1), ((([], missing), ([], words)), 0)):
        run = start(differently(*line))
        check_one_voice(f"a case that rank {who} does not see", run, (2,), "there is no such case file")
    other = ["run", bar, *words[2:], "--set", "body.0.initial_velocity=[\"6*Z\",\"0\",\"0\"]"]
    check_one_voice("different cases", start(differently(([], words), ([], other))), (2,), "different cases")
    check_one_voice("a folder that is a file", piola(2, "run", bar, "--out", bar / "results"), (1, 2), str(bar))
    full = start(differently((limited("-f 40"), words), ([], words)))
    check_one_voice("a disk without room", full, (1,), "cannot be written")
    large = work / "large.toml"
    large.write_text(bar.read_text().replace("[5, 5, 9]", "[25, 25, 33]").replace('"20 ms"', '"0.1 ms"'))
    words = ["run", large, "--out", work / "large", "--quiet", "--no-pictures"]
    full = start(differently(([], words), (limited("-f 400"), words)))
    check_one_voice("a disk without room for the part of rank 1", full, (1,), "(on rank 1)")
    left = [file.name for file in (work / "large").rglob("*.part")]
    expect(not left, f"parts of files are left: {left}")
    check_blind_rank(work, large)
    check_memory(work)


skip_without_ranks()
with tempfile.TemporaryDirectory() as name:
    place = Path(name)
    chosen = sys.argv[1:] or ["kills", "conversions", "faults"]
    if "faults" in chosen:
        check_faults(short_bar(place), place)
    if "kills" in chosen:
        check_kills(short_bar(place), place)
    if "conversions" in chosen:
        check_kills(torn_plate(place), place)
finish()
