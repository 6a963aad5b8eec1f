#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Types what the manual says: every key, path, command, field, column and file of README.md and docs/ must exist."""
import importlib
import json
import os
import re
import shlex
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(os.environ["PIOLA_SOURCE_DIR"])
PROGRAM = os.environ.get("PIOLA_PROGRAM", "")
if not os.access(PROGRAM, os.X_OK):
    print("skipped: the program is not built")
    sys.exit(77)

PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
problems = []
counts = dict.fromkeys(("keys", "paths", "commands", "names", "files", "presets"), 0)


def said(*words):
    """What the program prints, and its exit status."""
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, timeout=60, check=False)
    return done.stdout + done.stderr, done.returncode


def complain(page, line, text):
    problems.append(f"{page.relative_to(ROOT)}:{line}: {text}")


# What there is, as the program tells it.

def key_tables():
    """Names of the keys of every section: {"run": {"end", ...}, ...}."""
    known = re.search(r"\(known: (.*?)\)", said("describe", "case", "no_such_section")[0], re.S).group(1)
    tables = {}
    for section in ["", *re.split(r",\s*", known)]:
        text = said("describe", "case", section)[0] if section else said("describe", "case")[0].split("\n\n")[0]
        rows = re.findall(r"^  (\S+)(?:  | {2,}|\n)", "\n".join(text.splitlines()[2:]) + "\n", re.M)
        tables[section] = set(rows)
    return tables


def names_after(kind):
    """Keys of all laws or formulations: the first words of rows indented by two."""
    return set(re.findall(r"^  ([a-z_0-9]+)  +\S", said("describe", kind)[0], re.M))


def listed(heading):
    text = said("describe", "case")[0]
    return set(re.search(re.escape(heading) + r"[^\n]*\n  (.*)", text).group(1).split(", "))


TABLES = key_tables()
TABLES["body.material"] = TABLES["body.material"] | names_after("material")
TABLES["body.formulation"] = TABLES["body.formulation"] | names_after("formulation")
FREE = {"constants", "body.define"}
LIBRARY = {"about", "range", "lacks", "shear_modulus", "bulk_modulus"}  # keys that materials of library files have, too
CHECKS = set(re.findall(r'"([a-z_]+)"', (ROOT / "src/piola/verification/checks.cpp").read_text()))
sys.path.insert(0, str(ROOT / "python"))
FIT = importlib.import_module("piola_identify.problem").KEYS
FIELDS = listed("Fields of frames and pictures")
COLUMNS = listed("Columns of history.csv") | set(re.findall(r'DiagnosticInfo\{"(\w+)"', "\n".join(
    path.read_text() for path in (ROOT / "src/piola/formulations").rglob("options.cpp"))))


# Blocks of TOML.

def blocks(text):
    """(line, language or None, text) of fenced and of indented blocks."""
    lines = text.splitlines()
    found, i = [], 0
    while i < len(lines):
        if lines[i].startswith("```"):
            end = next(k for k in range(i + 1, len(lines)) if lines[k].startswith("```"))
            found.append((i + 2, lines[i][3:].strip() or "text", "\n".join(lines[i + 1:end])))
            i = end + 1
        elif lines[i].startswith("    ") and (i == 0 or not lines[i - 1].strip()):
            end = i
            while end < len(lines) and (lines[end].startswith("    ") or not lines[end].strip()):
                end += 1
            found.append((i + 1, None, "\n".join(line[4:] for line in lines[i:end]).rstrip()))
            i = end
        else:
            i += 1
    return found


def check_table(page, line, table, section):
    for key, value in table.items():
        counts["keys"] += 1
        path = f"{section}.{key}" if section else key
        free = section in FREE or (section == "body.material" and "library" in table)  # a law of the user
        if not free and key not in TABLES[section]:
            complain(page, line, f'"{key}" is no key of {section or "a case"}')
            continue
        for item in value if isinstance(value, list) else [value]:
            if isinstance(item, dict) and path in TABLES | dict.fromkeys(FREE):
                check_table(page, line, item, path)
        if path == "output.frames.fields":
            for field in value:
                check_name(page, line, field, FIELDS, "field of frames")


def check_fragment(page, line, table):
    """A whole case, or the keys of one section without its heading."""
    loose = {k: v for k, v in table.items() if k not in TABLES[""]}
    check_table(page, line, {k: v for k, v in table.items() if k not in loose}, "")
    if not loose:
        return
    fitting = [section for section, keys in TABLES.items() if set(loose) <= keys]
    if fitting:
        check_table(page, line, loose, fitting[0])
    else:
        complain(page, line, f"no section has all the keys {', '.join(loose)}")


def parsed(text):
    text = text.replace("...", "0")
    try:
        return [tomllib.loads(text)]
    except tomllib.TOMLDecodeError:
        return [tomllib.loads(line) for line in text.splitlines() if line.strip()]


def check_blocks(page, text):
    for line, language, block in blocks(text):
        first = block.splitlines()[0] if block else ""
        looks = "theory" not in page.parts and re.match(r"\[?\[?[a-z_.]+\]\]?\s*$|[a-z_]+ = ", first)
        if language != "toml" and not (language is None and looks):
            continue
        try:
            tables = parsed(block)
        except tomllib.TOMLDecodeError as error:
            complain(page, line, f"this block is not TOML: {error}")
            continue
        for table in tables:
            if table.keys() & {"variant", "check"}:
                for row in table.get("variant", []) + table.get("check", []):
                    for key in set(row) - CHECKS:
                        complain(page, line, f'"{key}" is no key of checks.toml')
                    for setting in row.get("set", []):
                        check_path(page, line, setting.split("=")[0])
            elif "parameters" in table:  # of a study
                for key in table["parameters"]:
                    check_path(page, line, key)
            elif "parameter" in table:  # of an identification
                for kind in ("parameter", "curve"):
                    for key in {key for row in table[kind] for key in row} - FIT[kind]:
                        complain(page, line, f'"{key}" is no key of {kind} of piola identify')
                for row in table["parameter"]:
                    check_path(page, line, row["key"])
            elif table.keys() & {"sources", "material"} == {"sources", "material"}:  # a library file
                for material in table["material"]:
                    check_table(page, line, {k: v for k, v in material.items() if k not in LIBRARY}, "body.material")
            else:
                check_fragment(page, line, table)


# Paths, commands, names and files in the running text.

def check_path(page, line, path):
    """run.cfl, output.frames.every, body.0.shape.particles, body.column.material.density."""
    counts["paths"] += 1
    steps = path.split(".")
    section = steps.pop(0)
    if page.name == "python.md" and section == "run":  # a piola.Run: tests/python looks at its page
        return
    if steps and section in ("body", "support", "load", "mirror", "crack", "rigid", "probe", "quantity"):
        if steps[0].isdigit() or (steps[0] not in TABLES[section]):
            steps.pop(0)
    for step in steps:
        if section in FREE:
            return
        if section not in TABLES or step not in TABLES[section]:
            complain(page, line, f"{path}: {section} has no key {step}")
            return
        section = f"{section}.{step}"


def check_name(page, line, name, known, what):
    counts["names"] += 1
    if name not in known:
        complain(page, line, f"{name} is no {what} that a case may ask for")


def help_of(command, cache={}):  # noqa: B006, kept on purpose
    if command not in cache:
        cache[command] = said(command, "--help")
    return cache[command]


def check_command(page, line, text):
    counts["commands"] += 1
    words = shlex.split(re.split(r" {2,}| > ", text.strip())[0].replace("\\|", "|"), comments=True)[1:]
    if not words or words[0].startswith("-"):
        return
    usage, status = help_of(words[0])
    if status != 0:
        complain(page, line, f"{text}: there is no command {words[0]}")
        return
    for word in words[1:]:
        option = word.split("=")[0]
        if option.startswith("-") and not re.search(rf"(?<![\w-]){re.escape(option)}(?![\w-])", usage):
            complain(page, line, f"{text}: {words[0]} has no option {option}")
    for k, word in enumerate(words):
        if words[k - 1] == "--set" and "=" in word:
            check_path(page, line, word.split("=")[0])
    placeholder = any(re.search(r"[A-Z|\[\]]|my_law", word) for word in words[1:])
    if words[0] == "describe" and not placeholder and said(*words)[1] != 0:
        complain(page, line, f"{text}: {said(*words)[0].strip()}")
    if words[0] == "verify" and not placeholder:
        for name in (word for word in words[1:] if not word.startswith("-")):
            if not any(ROOT.glob(f"cases/*/{name}")) and not (ROOT / "cases" / name).exists():
                complain(page, line, f"{text}: there is no case {name}")


PRESETS = {preset["name"]: preset
           for preset in json.loads((ROOT / "CMakePresets.json").read_text())["configurePresets"]}


def variables_of(preset):
    """The cache variables of a preset, with those that it inherits."""
    own = PRESETS[preset]
    inherited = variables_of(own["inherits"]) if "inherits" in own else {}
    return inherited | own.get("cacheVariables", {})


def check_presets(page, number, line):
    """Presets that pages name exist; those for users need none of the packages that only tests need."""
    for name in re.findall(r"cmake --preset ([\w-]+)", line):
        counts["presets"] += 1
        if name not in PRESETS:
            complain(page, number, f"there is no preset {name}")
        elif page.name != "CONTRIBUTING.md" and "developer" not in page.parts:
            if variables_of(name).get("PIOLA_TESTS") != "OFF":
                complain(page, number, f"the preset {name} builds the tests, whose packages users do not have")


def check_line(page, number, line):
    check_presets(page, number, line)
    for code in re.findall(r"`([^`]+)`", line):
        if re.fullmatch(r"(run|output|body|contact)\.[a-z0-9_.]*[a-z0-9_](=.*)?", code):
            check_path(page, number, code.split("=")[0])
        if re.match(r"(\S*/)?piola [a-z]", code):
            check_command(page, number, code)
        if re.fullmatch(r"(src|tests|cases|docs|tools|app|bench|cmake|data)/[\w./-]+", code):
            counts["files"] += 1
            place = ROOT / code
            if not (place.parent if "my_" in code else place).exists():
                complain(page, number, f"there is no {'folder for ' if 'my_' in code else ''}{code}")
    if re.match(r"(    |)(\S*/)?piola [a-z]", line) and "|" not in line:
        check_command(page, number, line)


def check_tables(page, text):
    """Rows of tables whose first heading is `field` or `column`."""
    known, what = None, ""
    for number, line in enumerate(text.splitlines(), 1):
        heading = re.match(r"\| (field|column) \|", line)
        if heading:
            known, what = (FIELDS, "field of frames") if heading[1] == "field" else (COLUMNS, "column of history.csv")
        elif not line.startswith("|"):
            known = None
        elif known is not None:
            for name in re.findall(r"`(\w+)`", line.split("|")[1]):
                if not name.startswith("_"):
                    check_name(page, number, name, known, what)


def check_messages():
    """Paths of keys that messages of the program name."""
    for path in [*(ROOT / "src").rglob("*.cpp"), *(ROOT / "app").glob("*.cpp")]:
        for number, line in enumerate(path.read_text().splitlines(), 1):
            for literal in re.findall(r'"((?:\\.|[^"\\])*)"', line):
                if " " not in literal:  # a name, not a sentence
                    continue
                for found in re.findall(r"(?<![\w./])(?:run|output)\.[a-z_]+(?:\.[a-z_]+)*(?!\.?[\w/])", literal):
                    if not found.endswith((".cpp", ".hpp", ".md")):
                        check_path(path, number, found)


for page in PAGES:
    content = page.read_text()
    if page.name == "case-reference.md":
        if "set by the other words" in content:
            complain(page, 1, "a default is not told")
        continue
    if page.name == "materials.md":  # written by the program, too
        continue
    check_blocks(page, content)
    check_tables(page, content)
    for number, line in enumerate(content.splitlines(), 1):
        check_line(page, number, line)
check_messages()

print("\n".join(problems))
print(", ".join(f"{count} {what}" for what, count in counts.items()), f"looked at, {len(problems)} wrong")
empty = [what for what, count in counts.items() if count == 0]
if empty:
    print(f"nothing found to look at: {', '.join(empty)}")
sys.exit(1 if problems or empty else 0)
