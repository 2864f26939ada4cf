# SPDX-License-Identifier: Apache-2.0
"""A table of checks with their seconds, one line as soon as each is done."""
import subprocess
import sys
import time
import traceback


class Failed(Exception):
    """The sentence that says what was not as it must be."""


def run(*command, fails=False):
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    if done.returncode != 0 and not fails:
        raise Failed(f"{' '.join(command)}: exit code {done.returncode}: {(done.stdout + done.stderr).strip()}")
    return done.stdout


def within(seconds, what, condition):
    """Waits until the condition holds and returns its value; it is asked at least once after the time is over."""
    end = time.monotonic() + seconds
    while True:
        over = time.monotonic() > end
        value = condition()
        if value:
            return value
        if over:
            raise Failed(f"not within {seconds} s: {what}")
        time.sleep(0.02)


class Table:
    def __init__(self, tell=lambda line: print(line, flush=True)):
        self.tell = tell
        self.failed = 0

    def check(self, name, function):
        """A check returns what is to be told of it: a figure, or nothing."""
        start = time.monotonic()
        result, told = "ok", ""
        try:
            told = function() or ""
        except Failed as failure:
            result, told = "FAILED", str(failure)
        except Exception:  # the other checks are still worth their figures
            result, told = "FAILED", traceback.format_exc(limit=-2).strip().replace("\n", " | ")
        self.failed += result != "ok"
        self.tell(f"{result:6} {time.monotonic() - start:7.2f} s  {name}{': ' if told else ''}{told}")

    def end(self):
        sys.exit(1 if self.failed else 0)
