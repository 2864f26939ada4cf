#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Every block of code of the README and of docs/ is tried, and those of other pages that say what they are: commands
run in the order of their page, on two PCs without hardware (two_pcs.py), and settings are read by the program that they
are for. What stands behind the fence says what a block is:

  sh parent | sh wearer | sh both   commands for that PC, or for each of them, whose daemon runs already unless the page
                                    starts it itself
  sh source                         commands for the folder of the sources
  toml active | toml passive        settings of that side
  toml jacket | toml limits         a jacket's profile; the wearer's own limits
  text, ini                         to be read only; no command stands there

What can't run here is in NOT_RUN (page_trial.py), with its reason; its words are checked all the same. A command that
neither runs nor stands there fails the test, and so does a line of these tables that no page needs any more."""
import concurrent.futures
import re
import subprocess
import sys
import unittest

import pages
from page_trial import BUILD, ENDS, INSTEAD, NOT_RUN, OF_DEBIAN, PageTrial, Runner, commands_of, commands_on
from programs import PROGRAMS
from two_pcs import TwoPcs, eventually


class Commands(unittest.TestCase):
    def test_do_what_their_page_says(self):
        trials = [PageTrial(page.name, list(commands_on(page))) for page in pages.all_pages()]
        with concurrent.futures.ThreadPoolExecutor(max_workers=2) as two_at_a_time:
            for trial in two_at_a_time.map(PageTrial.__call__, [trial for trial in trials if trial.commands]):
                print(trial.name, *trial.told, sep="\n    ")
                with self.subTest(trial.name):
                    self.assertIsNone(trial.fault)
        self.assertGreater(sum(len(trial.commands) for trial in trials), 40)
        tables = {entry[0] for entry in (*NOT_RUN, *INSTEAD, *ENDS)}
        used = set().union(*(trial.used for trial in trials))
        self.assertEqual(tables - used, set(), "no page needs these lines of the tables any more")


class Status(unittest.TestCase):
    def test_shows_the_lines_that_troubleshooting_looks_for(self):
        text = (pages.SOURCE / "docs" / "troubleshooting.md").read_text()
        table = re.search(r"^\| it shows .*\n((?:\|.*\n)+)", text, re.MULTILINE).group(1)
        wanted = re.findall(r"^\| `([a-z_]+(?: touch)?)", table, re.MULTILINE)
        self.assertGreater(len(wanted), 7)
        with TwoPcs(BUILD) as house:
            Runner(house, set()).prepare([("both", "telehug status")])
            eventually(lambda: house.wearer.status().get("last_touch"), "the wearer's side hears of no touch")
            house.parent.run("telehug stop")
            eventually(lambda: house.wearer.status()["problems"], "the other side does not say who stopped")
            said = house.parent.run("telehug status")[1] + house.wearer.run("telehug status")[1]
        for line in wanted:
            with self.subTest(line):
                self.assertRegex(said, rf"(?m)^ +{line} ")


class Settings(unittest.TestCase):
    def test_are_taken_by_their_program(self):
        checks = {"active": ["telehug", "config", "check", "active", "--config"],
                  "passive": ["telehug", "config", "check", "passive", "--config"],
                  "jacket": ["telehug-passive", "check-jacket"],
                  "limits": ["telehug-passive", "check-jacket", f"{pages.SOURCE}/deploy/jackets/duemilanove-16.toml",
                             "--overrides"]}
        seen = 0
        with TwoPcs(BUILD) as house:
            file = house.folder / "settings.toml"
            for page in pages.all_pages():
                for block in page.blocks:
                    if block.words[:1] != ("toml",):
                        continue
                    with self.subTest(f"{page.name}:{block.line}"):
                        seen += 1
                        self.assertIn(block.words[1:], [(name,) for name in checks])
                        file.write_text(block.text + "\n")
                        check = checks[block.words[1]]
                        ended = subprocess.run([BUILD / "bin" / check[0], *check[1:], file], capture_output=True,
                                               text=True, timeout=20, check=False)
                        self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)
        self.assertGreater(seen, 1)


class Blocks(unittest.TestCase):
    def test_of_the_book_say_what_they_are(self):
        for page in pages.book():
            for block in page.blocks:
                with self.subTest(f"{page.name}:{block.line}"):
                    self.assertIn(block.words[:1], [("sh",), ("toml",), ("text",), ("ini",)],
                                  "what is it? say so behind a fence of ```")

    def test_that_are_only_read_hold_no_commands(self):
        for page in pages.book():
            for block in page.blocks:
                if block.words[:1] != ("text",):
                    continue
                for line in commands_of(block.text):
                    with self.subTest(f"{page.name}:{block.line}: {line}"):
                        self.assertNotIn(line.split()[0], {*PROGRAMS, *OF_DEBIAN, "sudo"})


if __name__ == "__main__":
    sys.stdout.reconfigure(line_buffering=True)
    unittest.main()
