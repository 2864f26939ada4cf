#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What pages name by name is there: keys of the configuration, exit codes, commands with their options."""
import json
import os
import re
import shlex
import subprocess
import unittest

import pages
from programs import Programs, PROGRAMS

BIN = os.environ["TELEHUG_BIN"]
# What looks like a key but is a file, or a part of the status.
STATUS = {"camera.problems", "jacket.heaters"}
FILES = (".toml", ".png", ".jpg", ".json", ".csv", ".cpp", ".hpp", ".net", ".sh")

EXIT_CODE = re.compile(r"(?:exit codes?|ends? with(?: exit code)?|exits(?: with)?)\s+(\d+)\b")


def keys():
    shown = subprocess.run([f"{BIN}/telehug", "config", "show", "--json"], capture_output=True, text=True, check=True,
                           env={**os.environ, "XDG_CONFIG_HOME": "/dev/null"})
    return {key for side in json.loads(shown.stdout)["sides"] for key in side["keys"]}


def named_keys(span, sections):
    """Of a word of code: "camera.fps", "[camera] fps", "[camera] fps = 30"; a section alone is "[camera]"."""
    for match in re.finditer(r"(?<![\w./-])([a-z_]+)\.([a-z_]+)\b(?![./-]\w|\.\.\.)", span):
        if match.group(1) in sections and not match.group(0).endswith(FILES) and match.group(0) not in STATUS:
            yield match.group(0)
    match = re.fullmatch(r"\[([a-z_]+)\](?: ([a-z_]+)( = .*)?)?", span)
    if match and match.group(1) not in ("defaults", "actuator"):  # of jackets' profiles
        yield f"{match.group(1)}.{match.group(2)}" if match.group(2) else match.group(1)


class Pages(unittest.TestCase):
    def test_name_only_keys_that_the_configuration_has(self):
        known = keys()
        sections = {key.split(".")[0] for key in known}
        seen = 0
        for page in pages.all_pages():
            for line, span in page.code_spans():
                for key in named_keys(span, sections):
                    seen += 1
                    with self.subTest(f"{page.name}:{line}: {key}"):
                        self.assertTrue(key in known | sections, "there is no such key")
        self.assertGreater(seen, 50)

    def test_name_only_exit_codes_that_a_program_has(self):
        programs = Programs(BIN)
        known = set().union(*(programs.exit_codes(program) for program in PROGRAMS))
        self.assertTrue({0, 3, 12, 15} <= known)
        seen = 0
        for page in pages.all_pages():
            for line, match in page.find(EXIT_CODE):
                seen += 1
                with self.subTest(f"{page.name}:{line}: {match.group(0)}"):
                    self.assertIn(int(match.group(1)), known)
        self.assertGreater(seen, 3)

    def test_name_only_commands_and_options_that_a_program_has(self):
        programs = Programs(BIN)
        seen = 0
        for page in pages.all_pages():
            for line, span in page.code_spans():
                for command in re.split(r" \| |; ", span):
                    if command.split(" ")[0] not in PROGRAMS:
                        continue
                    seen += 1
                    with self.subTest(f"{page.name}:{line}: {command}"):
                        self.assertIsNone(programs.fault_of(command.split()))
        self.assertGreater(seen, 100)

    def test_show_only_commands_and_options_that_a_program_has_in_their_blocks_of_code(self):
        programs = Programs(BIN)
        seen = 0
        for page in pages.all_pages():
            for block in page.blocks:
                for command in block.text.splitlines():
                    # In two columns the second one says what the first one does.
                    words = shlex.split(re.split(r" {2,}| #", command.strip())[0].rstrip("\\")) if (
                        command.strip().startswith("telehug")) else []
                    if not words or words[0] not in PROGRAMS:
                        continue
                    seen += 1
                    with self.subTest(f"{page.name}:{block.line}: {command}"):
                        self.assertIsNone(programs.fault_of(words))
        self.assertGreater(seen, 30)


class TheMaths(unittest.TestCase):
    def test_tells_the_times_that_stand_in_the_files_that_it_names(self):
        page = pages.parse(pages.SOURCE / "docs" / "maths.md")
        text = page.path.read_text()
        table = text[text.index("## Dead man's timings"):]
        table = table[:table.index("\n## ", 1)]
        rows = re.findall(r"^\| (.+) \| (\d+)[^|]* \| .*\]\(([^)]+)\) \|$", table, re.MULTILINE)
        self.assertGreater(len(rows), 7)
        for what, milliseconds, file in rows:
            with self.subTest(what):
                source = (page.path.parent / file).resolve().read_text()
                self.assertRegex(source, rf"(= {milliseconds}ms;|_ms = {milliseconds};|WDTO_{milliseconds}MS)")


class TheReader(unittest.TestCase):
    """Of these tests themselves."""

    def test_finds_keys_in_all_forms_and_no_files(self):
        sections = {"camera", "rig"}
        for span, found in (("camera.fps", ["camera.fps"]), ("[rig] size = 3", ["rig.size"]), ("[camera]", ["camera"]),
                            ("camera.toml", []), ("--set camera.fps=30", ["camera.fps"]), ("camera.cpp", []),
                            ("setup/camera.hpp", []), ("rig.background.png", []), ("[[actuator]]", [])):
            self.assertEqual(list(named_keys(span, sections)), found, span)


if __name__ == "__main__":
    unittest.main()
