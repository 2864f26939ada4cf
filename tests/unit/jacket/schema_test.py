#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
#
# deploy/jackets/jacket.schema.json and the loader (`telehug-passive check-jacket`) agree on what a profile is: on the
# shipped ones, and on each of them with one thing changed.
import copy
import json
import pathlib
import subprocess
import sys
import tempfile
import tomllib

import jsonschema


def toml_value(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, list):
        return "[" + ", ".join(toml_value(entry) for entry in value) + "]"
    return repr(value)


def toml_text(profile):
    plain = {key: value for key, value in profile.items() if key not in ("defaults", "actuator")}
    lines = [f"{key} = {toml_value(value)}" for key, value in plain.items()]
    for header, table in [("[defaults]", profile.get("defaults"))] + [("[[actuator]]", a) for a in profile["actuator"]]:
        if table is not None:
            lines += [header] + [f"{key} = {toml_value(value)}" for key, value in table.items()]
    return "\n".join(lines) + "\n"


def tables_of(profile):
    yield "", profile
    if "defaults" in profile:
        yield "defaults.", profile["defaults"]
    kinds = set()
    for place, actuator in enumerate(profile["actuator"]):
        if actuator["kind"] not in kinds:  # one of each kind tells enough
            kinds.add(actuator["kind"])
            yield f"actuator[{place}].", actuator


def changed(profile):
    """(what, profile) with one key of one table left out, of another type, out of range or unknown."""
    wrong = ["", "other", -1, -6.5, 0, 0.5, 1, 3, 17, 18.0, 39, 41, 101, 256, 10001, True, [0], [101], [1.5], ["a"], []]
    places = [(name, key) for name, table in tables_of(profile) for key in list(table) + ["unknown"]]
    for name, key in places:
        for value in [None] + wrong:
            other = copy.deepcopy(profile)
            table = dict(tables_of(other))[name]
            if key == "actuator" or key == "defaults":
                continue
            if value is None:
                table.pop(key, None)
            else:
                table[key] = value
            yield f"{name}{key} = {'(left out)' if value is None else toml_value(value)}", other


# What the schema's description says that it can't say.
def beyond_schema(faults):
    known = ("already taken", "already drives", "leaves nothing", "for the heater", "a legacy jacket knows no strength",
             "must be a whole number")  # JSON takes 18.0 for one
    return bool(faults) and all(any(word in fault for word in known) for fault in faults)


# (is it right, faults) of each of these texts.
def loaded(program, texts):
    with tempfile.TemporaryDirectory() as folder:
        files = [f"{folder}/{number}.toml" for number in range(len(texts))]
        for file, text in zip(files, texts):
            pathlib.Path(file).write_text(text)
        run = subprocess.run([program, "check-jacket", *files], capture_output=True, text=True, timeout=60)
        right = [any(line.startswith(f"{file}: ") for line in run.stdout.splitlines()) for file in files]
        faults = [[line for line in run.stderr.splitlines() if f"{file}:" in line] for file in files]
        assert all(is_right != bool(found) for is_right, found in zip(right, faults)), run.stderr
        assert (run.returncode == 0) == all(right)
        return list(zip(right, faults))


def main(program, folder):
    folder = pathlib.Path(folder)
    schema = json.loads((folder / "jacket.schema.json").read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    compared = refused = 0
    for shipped in sorted(folder.glob("*.toml")):
        profile = tomllib.loads(shipped.read_text())
        others = [("as shipped", profile), *changed(profile)]
        for (what, other), (by_loader, faults) in zip(others, loaded(program, [toml_text(other) for _, other in others])):
            by_schema = validator.is_valid(tomllib.loads(toml_text(other)))
            agree = by_schema == by_loader or (by_schema and beyond_schema(faults))
            if not agree or (what == "as shipped" and not by_loader):
                sys.exit(f"{shipped.name}, {what}: schema says {by_schema}, loader {by_loader}: {faults}")
            compared += 1
            refused += not by_loader
    assert compared > 500 and refused > 300, (compared, refused)
    print(f"{compared} profiles compared, {refused} refused by both")


main(*sys.argv[1:])
