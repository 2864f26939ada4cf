# SPDX-License-Identifier: Apache-2.0
"""Two PCs to run a page's commands on: each has a home and programs of its own, and they hear each other over loopback
in a DDS domain that nobody else uses. A virtual rig takes the webcam's place, a picture the screen's, the firmware in a
simulated microcontroller the jacket's."""
import contextlib
import fcntl
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import tempfile
import time

from pages import SOURCE

LONGEST_S = 40


class Failure(Exception):
    pass


def eventually(condition, what, longest_s=LONGEST_S):
    end = time.monotonic() + longest_s
    while True:
        result = condition()
        if result:
            return result
        if time.monotonic() > end:
            raise Failure(f"waited {longest_s} s in vain: {what}")
        time.sleep(0.02)


@contextlib.contextmanager
def unique_domain():
    """As tests/doubles/unique_domain.hpp, and by the same locks."""
    numbers = list(range(1, 101))
    random.shuffle(numbers)
    for number in numbers:
        file = pathlib.Path(tempfile.gettempdir()) / f"telehug-test-domain-{number}.lock"
        with open(file, "a", encoding="utf-8") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                continue
            yield number
            return
    raise Failure("every DDS domain is claimed by another test")


class Program:
    """One that runs beside the test until it is ended. What it says goes into a file."""

    def __init__(self, pc, line, number):
        self.line = line
        self.log = pc.home / f"{number}.log"
        with open(self.log, "wb") as log:
            self.process = subprocess.Popen(["bash", "-c", f"exec {line}"], cwd=pc.work, env=pc.environment,
                                            stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT)

    def said(self):
        return self.log.read_text(errors="replace")

    def runs(self):
        return self.process.poll() is None

    def wait_for(self, condition, what):
        def holds():
            result = condition()
            if not result and not self.runs():
                raise Failure(f"ended with {self.process.returncode}: {self.said()}")
            return result

        try:
            return eventually(holds, what)
        except Failure as failure:
            raise Failure(f"{self.line}: {failure}\n{self.said()}") from None

    def end(self):
        """How it ended; it is asked to first."""
        if self.runs():
            self.process.send_signal(signal.SIGINT)
        try:
            return self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            return self.process.wait()


class Pc:
    def __init__(self, house, name, side, programs, config):
        self.name, self.side = name, side
        self.home = house.folder / name
        self.work = self.home / "work"
        for folder in ("bin", "run", "state", "config/telehug", "work"):
            (self.home / folder).mkdir(parents=True)
        (self.home / "run").chmod(0o700)
        for program in ("telehug", f"telehug-{side}", *programs):
            self.install(house.build / "bin" / program, self.home / "bin" / program)
        (self.home / "share").symlink_to(house.build / "share")
        browser = self.home / "bin" / "xdg-open"
        browser.write_text(f'#!/bin/sh\necho "$1" >>{self.home}/opened\n')
        browser.chmod(0o755)
        for folder in ("deploy", "docs", "tests"):
            (self.work / folder).symlink_to(SOURCE / folder)
        (self.home / f"config/telehug/{side}.toml").write_text(config)
        self.environment = {"PATH": f"{self.home}/bin:/usr/bin:/bin", "HOME": str(self.home), "LANG": "C.UTF-8",
                            "XDG_RUNTIME_DIR": str(self.home / "run"), "XDG_STATE_HOME": str(self.home / "state"),
                            "XDG_CONFIG_HOME": str(self.home / "config"), "USER": name}
        for kept in ("ASAN_OPTIONS", "UBSAN_OPTIONS", "ASAN_SYMBOLIZER_PATH"):
            if kept in os.environ:
                self.environment[kept] = os.environ[kept]
        self.started = []
        self.daemon = None

    @staticmethod
    def install(program, place):
        """A program tells by its neighbours what this PC is: no symbolic link."""
        try:
            os.link(program, place)
        except OSError:
            shutil.copy2(program, place)

    def run(self, line):
        """How it ended, and what it said."""
        ended = subprocess.run(["bash", "-c", line], cwd=self.work, env=self.environment, stdin=subprocess.DEVNULL,
                               capture_output=True, text=True, timeout=LONGEST_S, check=False)
        return ended.returncode, ended.stdout + ended.stderr

    def start(self, line):
        program = Program(self, line, len(self.started))
        self.started.append(program)
        return program

    def start_daemon(self, line):
        if self.daemon and self.daemon.runs():
            self.end(self.daemon)
        self.daemon = self.start(line)
        self.daemon.wait_for(self.status, "it does not answer")

    def end(self, program):
        code = program.end()
        if code not in (0, -signal.SIGINT):
            raise Failure(f"{program.line}: ended with {code}: {program.said()}")

    def status(self):
        code, said = self.run(f"telehug status --side {self.side} --json")
        return json.loads(said)["daemons"][0] if code == 0 else None

    def hears_the_other(self):
        status = self.status()
        return status is not None and status.get("peer", {}).get("connected", False)

    def end_all(self):
        for program in reversed(self.started):
            self.end(program)


class TwoPcs:
    """Use as a context: they are gone at its end, with all that runs on them."""

    def __init__(self, build):
        self.build = pathlib.Path(build)

    def __enter__(self):
        with contextlib.ExitStack() as stack:
            self.set_up(stack)
            self.stack = stack.pop_all()
        return self

    def set_up(self, stack):
        self.folder = pathlib.Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="telehug-docs-")))
        peer = f"[peer]\ndomain = {stack.enter_context(unique_domain())}\nloopback_only = true\n"
        self.jacket = self.folder / "jacket"
        fixtures = SOURCE / "tests" / "fixtures"
        self.parent = Pc(self, "parent", "active", [],
                         '[camera]\nsource = "virtual"\nfps = 10\n'
                         f'[body_map]\npicture = "{fixtures}/chat/01_full.jpg"\n{peer}')
        self.wearer = Pc(self, "wearer", "passive", ["telehug-jacket-sim"],
                         f'[jacket]\nlink = "serial:{self.jacket}"\n{peer}')
        stack.callback(self.kill_all)
        self.pins = self.folder / "pins.csv"
        self.simulator = self.wearer.start(f"telehug-jacket-sim --link {self.jacket} --pins {self.pins}")
        self.simulator.wait_for(self.jacket.is_symlink, "there is no simulated jacket")

    def __exit__(self, kind, *_):
        with self.stack:
            if kind is None:
                for pc in (self.parent, self.wearer):
                    pc.end_all()

    def kill_all(self):
        for pc in (self.parent, self.wearer):
            for program in pc.started:
                program.process.kill()
                program.process.wait()

    def wait_until_connected(self):
        if self.parent.daemon and self.wearer.daemon:
            eventually(lambda: self.parent.hears_the_other() and self.wearer.hears_the_other(),
                       "the two do not hear each other")

    def wait_until_the_face_is_seen(self):
        """Unless it is not looked for, as long as touches may not go out."""
        def seen():
            status = self.parent.status()
            return status and (not status["sending"]["on"] or status["face"]["found"])

        if self.parent.daemon and self.wearer.daemon:
            eventually(seen, "the face in the picture is not found")

    def wait_until_a_touch_is_felt(self):
        def ran():
            return re.search(r",on$", self.pins.read_text(), re.MULTILINE)

        eventually(ran, "no motor has run")

    def calibrate(self):
        code, said = self.parent.run("telehug-active calibrate")
        if code:
            raise Failure(said)

    def code_of(self, invitation):
        """That an invitation prints."""
        code = re.compile(r"^[0-9A-Z]{5}(-[0-9A-Z]{5})+$", re.MULTILINE)
        return invitation.wait_for(lambda: code.search(invitation.said()), "no code is printed").group(0)
