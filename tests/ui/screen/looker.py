# SPDX-License-Identifier: Apache-2.0
"""What telehug says about the screen, look by look."""
import collections
import json
import os
import subprocess
import threading
import time

from true_grid import Grid

# `looked_ns`: when the screen was looked at; `told_ns`: when this was heard of it. `grid` is None while there is none;
# `seen_ns`: when the face was last there, 0 while there is no grid.
Look = collections.namedtuple("Look", "looked_ns told_ns seen_ns version grid problem")


class Looker:
    """Runs `telehug-active look` while it is entered. `settings`: what its `--set` takes. `home`: a folder without
    anybody's configuration and calibration."""

    def __init__(self, program, display, home, settings, seconds):
        options = [word for setting in settings for word in ("--set", setting)]
        self._command = [program, "look", "--seconds", str(seconds), *options]
        self._environment = {"PATH": os.environ["PATH"], "HOME": home, "DISPLAY": display}
        self._looks = []
        self._news = threading.Condition()
        self._ended = ""  # why no more looks come

    def __enter__(self):
        self._process = subprocess.Popen(self._command, env=self._environment, stdin=subprocess.DEVNULL,
                                         stdout=subprocess.PIPE, text=True)
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._process.terminate()
        try:
            self._process.wait(10)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._thread.join()
        self._process.stdout.close()

    def _read(self):
        fault = ""
        for line in self._process.stdout:
            try:
                look = _parse(line)
            except (KeyError, TypeError, ValueError) as error:
                fault = f"said what no look is ({error!r}): {line.strip()}"
                break
            with self._news:
                self._looks.append(look)
                self._news.notify_all()
        with self._news:
            self._ended = fault or f"ended early with {self._process.wait()}"
            self._news.notify_all()

    def looks(self, from_ns, to_ns=None):
        """Those at the screen from one time on, until another or now."""
        with self._news:
            return [look for look in self._looks if from_ns <= look.looked_ns and (not to_ns or look.looked_ns < to_ns)]

    def wait(self, reached, timeout_s):
        """Until `reached(looks)` is true of all looks so far; False if it is not within the time."""
        give_up = time.monotonic() + timeout_s
        with self._news:
            while not reached(self._looks):
                if self._ended:
                    raise RuntimeError(f"'{' '.join(self._command)}' {self._ended}")
                left_s = give_up - time.monotonic()
                if left_s <= 0:
                    return False
                self._news.wait(left_s)
            return True

    def wait_until_still(self, since_ns, still_s, timeout_s):
        """Until the remote face was seen after `since_ns` and the grid has stood for a time; the last look."""
        def still(looks):
            if not looks or not looks[-1].grid or looks[-1].seen_ns < since_ns:
                return False
            begin = next((look for look in looks if look.version == looks[-1].version))
            return looks[-1].looked_ns - max(begin.looked_ns, since_ns) >= still_s * 1e9

        reached = self.wait(still, timeout_s)
        with self._news:
            return (self._looks[-1] if self._looks else None), reached


def _parse(line):
    told_ns = time.monotonic_ns()
    said = json.loads(line)
    grid = None
    if said["version"] != 0:
        box, side = said["grid"], said["box_px"]
        grid = Grid(middle_px=box["x"] + box["w"] / 2, chin_px=box["y"], side_px=side, bottom_px=box["y"] + box["h"])
        if said["columns"] != 5 or abs(box["w"] - 5 * side) >= 2:
            raise ValueError("not a grid of five columns of squares")
    return Look(said["time_ns"], told_ns, said.get("seen_ns", 0), said["version"], grid, said["problem"])
