# SPDX-License-Identifier: Apache-2.0
"""Runs the commands of one page; commands_test.py says which and where."""
import os
import pathlib
import re
import subprocess
import time

import pages
from programs import PROGRAMS, Programs
from two_pcs import Failure, TwoPcs, eventually

BUILD = pathlib.Path(os.environ["TELEHUG_BIN"]).parent
PROGRAMS_SAY = Programs(BUILD / "bin")

# (what a command begins with, why it is not run here)
NOT_RUN = [
    ("sudo ", "changes this PC"),
    ("systemctl --user ", "needs a user's service manager: tests/system"),
    ("telehug-active camera ", "needs a webcam"),
    ("telehug jacket flash", "needs a board: test_jacket_flash has simulated ones"),
    ("avrdude ", "needs a board: test_jacket_flash has simulated ones"),
    ("deploy/demo", "installs packages: test_app_demo runs what it does then"),
    ("deploy/setup", "installs packages: tests/run begins with it"),
    ("deploy/packages/build", "takes a minute: test_packages does it and installs them"),
    ("tests/run", "runs this test"),
    ("cmake ", "has built this test"),
]
# Programs of Debian in commands that are not run.
OF_DEBIAN = {"apt", "avrdude", "cmake", "install", "nft", "systemctl", "systemd-sysusers", "systemd-tmpfiles", "usermod"}

# (what stands in a command, what stands for it here)
INSTEAD = [
    ("serial:/dev/serial/by-id/usb-...", "serial:{jacket}"),
    ("telehug pair accept CODE", "telehug pair accept {code}"),
    ("telehug pair invite", "telehug pair invite --address 127.0.0.1"),
    ("telehug jacket identify", "telehug jacket identify --seconds 0.1"),
]
# (what a command begins with, the codes that it may end with here, why)
ENDS = [
    ("telehug doctor", {0, 12}, "there is neither desktop nor webcam"),
    ("telehug face next", {0, 9}, "one person is in the picture, and it is refused"),
]


REFUSED = 9  # common/service/exit_code.hpp
REFUSED_AT_MOST_S = 15

# After this page a touch is felt: the rig's user touches the screen now and then.
LEADS_TO_A_TOUCH = "docs/getting-started.md"


def commands_of(text):
    """Lines that go on behind a backslash are one."""
    for line in re.sub(r"\\\n\s*", " ", text).splitlines():
        line = line.strip()
        if line and not line.startswith("#"):
            yield line


def reason_not_to_run(line):
    """(its row's first word, why) in NOT_RUN; None if it is to run."""
    return next((row for row in NOT_RUN if line.startswith(row[0])), None)


def without_sudo(line):
    """Pairs are a service's where people have installed packages; here each daemon's user has them."""
    return line.removeprefix("sudo ") if line.startswith("sudo telehug pair ") else line


def words_of(line):
    return re.sub(r"\s#\s.*$", "", line).split()


class Runner:
    """Runs one page's commands. `used` gets the rows of the tables that were needed."""

    def __init__(self, house, used):
        self.house, self.used = house, used
        self.invitation = self.inviting = None

    def pcs(self, where):
        pcs = {"parent": [self.house.parent], "wearer": [self.house.wearer], "source": [self.house.parent],
               "both": [self.house.parent, self.house.wearer]}
        if where not in pcs:
            raise Failure("where does it run? say so behind the fence: sh parent, wearer, both or source")
        return pcs[where]

    def prepare(self, commands):
        """Starts what runs already when somebody reads the page: the daemons of the PCs that it is about."""
        lines = [line for _, line in commands]
        used = [pc for where, _ in commands for pc in self.pcs(where)]
        for pc, program in ((self.house.wearer, "telehug-passive"), (self.house.parent, "telehug-active")):
            if pc not in used or any(line.startswith(f"{program} run") for line in lines):
                continue
            if pc is self.house.parent and not any(line.startswith("telehug-active calibrate") for line in lines):
                self.house.calibrate()
            pc.start_daemon(f"{program} run")
        self.house.wait_until_connected()
        self.house.wait_until_the_face_is_seen()

    def run(self, pc, line):
        command = line
        for what, instead in INSTEAD:
            if what in command:
                self.used.add(what)
                command = command.replace(what, self.filled(pc, instead))
        words = words_of(command)
        if words[0] in ("telehug-active", "telehug-passive") and words[1] == "run":
            pc.start_daemon(command)
            self.house.wait_until_connected()
        elif words[0] == "telehug-jacket-sim":
            port = pc.work / words[words.index("--link") + 1]
            pc.start(command).wait_for(port.is_symlink, "there is no port")
        elif words[:3] == ["telehug", "pair", "invite"]:
            self.drop_invitation()
            self.invitation, self.inviting = pc.start(command), pc
            self.house.code_of(self.invitation)
        elif words[:2] in (["telehug", "watch"], ["telehug-active", "look"]) and len(words) == 2:
            watching = pc.start(command)
            if words[1] == "look":
                watching.wait_for(watching.said, "it sees nothing")
        else:
            self.run_to_the_end(pc, command)
            if words[:2] == ["telehug", "send"]:
                self.house.wait_until_the_face_is_seen()

    def run_to_the_end(self, pc, command):
        may = {0}
        for begin, codes, _ in ENDS:
            if command.startswith(begin):
                self.used.add(begin)
                may = codes
        code, said = pc.run(command)
        # On a busy PC a peer or jacket is late now and then; a refusal because of that does not last.
        end = time.monotonic() + REFUSED_AT_MOST_S
        while code == REFUSED and code not in may and time.monotonic() < end:
            time.sleep(0.5)
            self.house.wait_until_connected()
            code, said = pc.run(command)
        if code not in may:
            raise Failure(f"{command}: ended with {code}:\n{said}\n{self.log_of(pc)}")
        if command.startswith("telehug open") and "/enter?link=" not in (pc.home / "opened").read_text():
            raise Failure("the browser was shown no link")
        if command.startswith("telehug pair accept"):
            eventually(lambda: not self.invitation.runs(), "the invitation goes on")
            if self.invitation.process.returncode != 0:
                raise Failure(f"{self.invitation.line}: {self.invitation.said()}")
            self.invitation = None
            eventually(lambda: all(p.daemon is None or "pair" in (p.status() or {}) for p in
                                   (self.house.parent, self.house.wearer)), "the daemons do not take up the pair")
            self.house.wait_until_connected()

    @staticmethod
    def log_of(pc):
        return pc.daemon.said() if pc.daemon else ""

    def filled(self, pc, text):
        if "{code}" in text:
            if not self.invitation:
                raise Failure("nobody has invited on this page")
            return text.format(code=self.house.code_of(self.invitation))
        return text.format(jacket=self.house.jacket)

    def drop_invitation(self):
        """Nobody accepts it on this page."""
        if self.invitation:
            self.invitation.end()
            self.inviting.started.remove(self.invitation)


def check_words(line):
    """Of a command that is not run: is there such a command, with such options?"""
    words = words_of(line)
    if words[0] == "sudo":
        words.pop(0)
    if words[0] in PROGRAMS:
        fault = PROGRAMS_SAY.fault_of(words)
        if fault:
            raise Failure(fault)
        return
    options = [word.split("=")[0] for word in words[1:] if word.startswith("--")]
    if words[0].split("/")[0] in ("deploy", "tests"):
        if not os.access(pages.SOURCE / words[0], os.X_OK):
            raise Failure(f"there is no program {words[0]}")
        known = (pages.SOURCE / words[0]).read_text() + PROGRAMS_SAY.help(("telehug-demo",))
        for option in options:
            if not re.search(rf"(^|[\s|]){option}\b", known):
                raise Failure(f"{words[0]} has no option {option}")
        return
    if words[0] not in OF_DEBIAN:
        raise Failure(f"what is {words[0]}?")
    if words[0] == "cmake" and "--preset" in words:
        if f'"name": "{words[words.index("--preset") + 1]}"' not in (pages.SOURCE / "CMakePresets.json").read_text():
            raise Failure("there is no such preset")
    if words[0] == "systemctl":
        units = {file.name.split(".")[0] for file in (pages.SOURCE / "deploy" / "systemd").glob("*.service.in")}
        for unit in re.findall(r"(?<!@)\btelehug-[\w-]+", line):
            if unit not in units:
                raise Failure(f"there is no unit {unit}")


def commands_on(page):
    """(line of its block, where it runs, command), in the page's order."""
    for block in page.blocks:
        if block.words[:1] == ("sh",):
            for line in commands_of(block.text):
                yield block.line, block.words[1] if len(block.words) > 1 else "", line


class PageTrial:
    """Of one page: what of it was run or not, as lines, and what went wrong."""

    def __init__(self, name, commands):
        self.name, self.commands = name, commands
        self.used, self.told = set(), []
        self.fault = None

    def __call__(self):
        try:
            self.try_all()
        except (Failure, subprocess.TimeoutExpired) as failure:
            self.fault = str(failure)
        return self

    def try_all(self):
        run = []
        for number, where, line in self.commands:
            line = without_sudo(line)
            row = reason_not_to_run(line)
            if row:
                self.used.add(row[0])
                self.attempt(number, line, check_words, line)
                self.told.append(f"not run ({row[1]}): {line}")
            else:
                run.append((number, where, line))
        if not run:
            return
        with TwoPcs(BUILD) as house:
            runner = Runner(house, self.used)
            runner.prepare([(where, line) for _, where, line in run])
            for number, where, line in run:
                for pc in runner.pcs(where):
                    seconds = self.attempt(number, f"on the {pc.name}'s PC: {line}", runner.run, pc, line)
                    self.told.append(f"run on the {pc.name}'s, {seconds:.1f} s: {line}")
            runner.drop_invitation()
            if self.name == LEADS_TO_A_TOUCH:
                house.wait_until_a_touch_is_felt()
                self.told.append("and a touch is felt")

    def attempt(self, number, what, action, *arguments):
        """How many seconds it took."""
        began = time.monotonic()
        try:
            action(*arguments)
        except (Failure, subprocess.TimeoutExpired) as failure:
            raise Failure(f"{self.name}:{number}: {what}\n{failure}") from None
        return time.monotonic() - began
