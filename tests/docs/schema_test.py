#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The JSON Schema of case files: every shipped case is valid by it, slips are not. Also `piola check --json`."""
import json
import os
import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

ROOT = Path(os.environ["PIOLA_SOURCE_DIR"])
PROGRAM = os.environ.get("PIOLA_PROGRAM", "")
if not os.access(PROGRAM, os.X_OK):
    print("skipped: the program is not built")
    sys.exit(77)

TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "integer": int, "number": (int, float)}
KNOWN = {"$schema", "title", "description", "definitions", "type", "enum", "const", "properties", "required",
         "additionalProperties", "items", "minItems", "maxItems", "minimum", "maximum", "exclusiveMinimum",
         "exclusiveMaximum", "anyOf", "oneOf", "allOf", "not", "$ref"}
failures = 0


def check(good, text):
    global failures
    if not good:
        failures += 1
        print("FAILED:", text)


def said(*words, code=0):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=120, check=False)
    check(done.returncode == code, f"{words}: exit code {done.returncode}: {done.stderr}")
    return done.stdout


SCHEMA = json.loads(said("describe", "case", "--schema"))


# The words of JSON Schema, draft 7, that the schema uses.

def is_type(value, name):
    return isinstance(value, TYPES[name]) and (not isinstance(value, bool) or name == "boolean")


def in_range(value, schema):
    if not is_type(value, "number"):
        return True
    return (value >= schema.get("minimum", value) and value <= schema.get("maximum", value)
            and not value <= schema.get("exclusiveMinimum", float("-inf"))
            and not value >= schema.get("exclusiveMaximum", float("inf")))


def faults(value, schema, path):
    """What is wrong with a value, one line each."""
    unknown = schema.keys() - KNOWN
    check(not unknown, f"the schema has words that this test does not know: {unknown}")
    if "$ref" in schema:
        return faults(value, SCHEMA["definitions"][schema["$ref"].removeprefix("#/definitions/")], path)
    found = []
    types = schema.get("type", [])
    if types and not any(is_type(value, name) for name in ([types] if isinstance(types, str) else types)):
        found.append(f"{path} is {value!r} (allowed: {types})")
    if "enum" in schema and value not in schema["enum"]:
        found.append(f"{path} is {value!r} (allowed: {schema['enum']})")
    if "const" in schema and value != schema["const"]:
        found.append(f"{path} is {value!r} (allowed: {schema['const']})")
    if not in_range(value, schema):
        found.append(f"{path} is {value!r}, out of range")
    if isinstance(value, dict):
        found += faults_of_table(value, schema, path)
    if isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            found.append(f"{path} has {len(value)} items")
        for k, item in enumerate(value):
            found += faults(item, schema.get("items", {}), f"{path}[{k}]")
    for part in schema.get("allOf", []):
        found += faults(value, part, path)
    if "not" in schema and not faults(value, schema["not"], path):
        found.append(f"{path} is {value!r}, which is not allowed")
    for word in ("anyOf", "oneOf"):
        if word in schema:
            tried = [faults(value, part, path) for part in schema[word]]
            good = sum(not lines for lines in tried)
            if good == 0 or (word == "oneOf" and good > 1):
                found += min(tried, key=len) or [f"{path} fits {good} of {word}"]
    return found


def faults_of_table(value, schema, path):
    found = [f"{path}.{key} is missing" for key in schema.get("required", []) if key not in value]
    for key, item in value.items():
        own = schema.get("properties", {}).get(key, schema.get("additionalProperties", {}))
        if own is False:
            found.append(f"{path}.{key} is no key")
        elif own is not True:
            found += faults(item, own, f"{path}.{key}")
    return found


def faults_of(text):
    return faults(tomllib.loads(text), SCHEMA, "case")


# Shipped cases are valid.
cases = sorted((ROOT / "cases").glob("*/*/case.toml"))
check(len(cases) > 50, "too few cases")
for file in cases:
    for line in faults_of(file.read_text()):
        check(False, f"{file.relative_to(ROOT)}: {line}")

# Slips are not.
SAMPLE = """title = "T"
run = { end = "1 s" }
[[body]]
name = "b"
shape = { box = { min = [0, 0], max = [1, 1] }, particles = [5, 5] }
material = { law = "neo_hookean", density = 1, youngs_modulus = 1, poissons_ratio = 0.3 }
formulation = { name = "nodal" }
"""
check(faults_of(SAMPLE) == [], f"the sample is not valid: {faults_of(SAMPLE)}")
for old, new, told in [
        ('end = "1 s"', "ende = 1", "ende is no key"),
        ('end = "1 s"', "end = -1", "out of range"),
        ('end = "1 s"', "end = true", "run.end is True"),
        ('end = "1 s"', 'end = 1, instruction_set = "v5"', "v5"),
        ('end = "1 s"', 'end = 1, threads = "all"', "all"),
        ("[0, 0]", "[0, 0, 0, 0]", "4 items"),
        ("density = 1, ", "", "density is missing"),
        ("density = 1, ", "density = 1, shear = 3, ", "shear is no key"),
        ('"neo_hookean"', '"neo_hooke"', "neo_hooke"),
        ('name = "nodal"', 'name = "nodal", blend = 7', ""),
        ('[[body]]\nname = "b"', "[[body]]", "name is missing"),
        ('title = "T"', 'title = 3', "case.title is 3")]:
    lines = faults_of(SAMPLE.replace(old, new, 1))
    check(any(told in line for line in lines), f"{new}: {lines}")
for good in ['end = 1, threads = "auto"', 'end = 1, guards = "off"', 'end = 1, repartition = "never"']:
    check(faults_of(SAMPLE.replace('end = "1 s"', good)) == [], good)
check(faults_of(SAMPLE.replace("law = \"neo_hookean\", density = 1, youngs_modulus = 1, poissons_ratio = 0.3",
                               'name = "steel_4340"')) == [], "a material of the library")
own = SAMPLE.replace("law = \"neo_hookean\", density = 1, youngs_modulus = 1, poissons_ratio = 0.3",
                     'name = "my_alloy", density = 1')
check(faults_of(own) != [], "a material of no library")
check(faults_of('library = ["my-alloys.toml"]\n' + own) == [], "a material of a library of the case")

# Every key of the reference is in the schema, with what it means.
keys = re.findall(r"^\| `(\w+)` \|", (ROOT / "docs/user/case-reference.md").read_text(), re.M)
written = json.dumps(SCHEMA)
for key in set(keys):
    check(f'"{key}"' in written, f"the schema lacks {key}")
check(said("describe", "body", "--schema", code=2) == "", "--schema of a part")

# The plan: what check says, for scripts. Nothing is written beside it.
with tempfile.TemporaryDirectory() as folder:
    file = Path(folder) / "case.toml"
    slow = SAMPLE.replace("poissons_ratio = 0.3", "poissons_ratio = 0.4999")
    file.write_text(slow + "[output.frames]\nevery = 0.1\n")
    plan = json.loads(said("check", file, "--json"))
    text = said("check", file)
    check(sorted(os.listdir(folder)) == ["case.toml"], "check writes files")
    check(plan["particles"] == 25 and plan["dimension"] == 2, "particles")
    check(plan["bodies"][0]["name"] == "b" and plan["bodies"][0]["formulation"] == "nodal", "bodies")
    check(0 < plan["steps"]["least"] <= plan["steps"]["most"], "steps")
    check(0 < plan["step"]["first_s"] <= plan["step"]["settled_s"], "step")
    check(plan["run_s"]["least"] <= plan["run_s"]["most"] and plan["memory_bytes"] > 1e6, "needs")
    check(f"{plan['steps']['least']:,}" in text, "check and check --json differ in steps")
    check(text.count("\nwarning: ") == len(plan["warnings"]), "check and check --json differ in warnings")
    for warning in plan["warnings"]:
        check(warning["text"] in text and warning.get("line", 1) >= 1, f"a warning: {warning}")
    check(said("check", file, "--json", "--ranks", "2", code=2) == "", "--ranks beside --json")

print(f"{len(cases)} cases, {failures} failures")
sys.exit(1 if failures else 0)
