# SPDX-License-Identifier: Apache-2.0
"""Chromium as a program window without decorations on an X display."""
import os
import shutil
import signal
import subprocess
import tempfile

PROGRAM = "chromium"
FLAGS = [
    "--no-first-run", "--no-default-browser-check", "--test-type", "--disable-gpu", "--disable-extensions",
    "--disable-sync", "--disable-background-networking", "--disable-component-update", "--disable-default-apps",
    "--disable-breakpad", "--password-store=basic", "--disable-background-timer-throttling",
    "--disable-renderer-backgrounding", "--disable-backgrounding-occluded-windows", "--disable-dev-shm-usage",
    "--disable-features=Translate,CalculateNativeWinOcclusion", "--no-sandbox",
]


class Browser:
    """Shows a page while it is entered. `window`: x, y, width, height in px of the monitor. `scale`: px of the monitor
    a CSS px, as on a scaled desktop."""

    def __init__(self, display, url, window, scale):
        self._profile = None
        self._process = None
        self._display = display
        x, y, width, height = (round(length / scale) for length in window)
        self._arguments = [f"--app={url}", f"--window-position={x},{y}", f"--window-size={width},{height}",
                           f"--force-device-scale-factor={scale}"]

    def __enter__(self):
        self._profile = tempfile.mkdtemp(prefix="telehug_browser.")
        environment = {"PATH": os.environ["PATH"], "HOME": self._profile, "XDG_RUNTIME_DIR": self._profile,
                       "DISPLAY": self._display, "LANG": "C.UTF-8"}
        self._process = subprocess.Popen(
            [PROGRAM, *FLAGS, f"--user-data-dir={self._profile}/profile", *self._arguments], env=environment,
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        return self

    def is_running(self):
        return self._process.poll() is None

    def __exit__(self, *_):
        # Asked alone it ends its helpers, too; what is left of the group that it leads is ended then.
        self._process.terminate()
        try:
            self._process.wait(10)
        except subprocess.TimeoutExpired:
            pass
        try:
            os.killpg(self._process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        self._process.wait()
        shutil.rmtree(self._profile, ignore_errors=True)
