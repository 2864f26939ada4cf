# SPDX-License-Identifier: Apache-2.0
"""passive_checks.py first: the wearer's daemon under systemd, with a jacket on a real serial port of USB."""
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time

from check_table import Failed, Table, run, within
from gpio_panel import GpioPanel
from usb_jacket import BY_ID, UsbJacket

UNIT = "telehug-passive.service"
SETTINGS = "/etc/telehug/passive.d/50-guest.toml"
ABSENT_WITHIN_S = 2  # of the emulated PC, whose times are ten times those of hardware
ARMED_WITHIN_S = 20
OFF_WITHIN_S = 2


def status():
    try:
        return json.loads(run("telehug", "status", "--json"))["daemons"][0]
    except (Failed, IndexError, KeyError):
        return {}


def jacket():
    return status().get("jacket", {})


def armed():
    found = jacket()
    return found if found.get("state") == "armed" else None


def property_of_unit(name):
    return run("systemctl", "show", UNIT, "--property", name, "--value").strip()


def set_keys(text):
    os.makedirs(os.path.dirname(SETTINGS), exist_ok=True)
    with open(SETTINGS, "w", encoding="ascii") as file:
        file.write(text)


def install():
    shutil.copytree("/mnt/share/install", "/", dirs_exist_ok=True, symlinks=True)
    shutil.copy("/mnt/share/guest/" + UNIT, "/etc/systemd/system/" + UNIT)
    with open("/etc/modules-load.d/telehug.conf", "w", encoding="ascii") as file:
        file.write("cdc_acm\n")
    run("modprobe", "cdc_acm")
    run("systemctl", "daemon-reload")
    return run("telehug-passive", "--version").strip()


def simulated_jacket():
    run("systemctl", "enable", "--quiet", "--now", UNIT)  # returns once the daemon has said that it is ready
    within(ARMED_WITHIN_S, "the simulated jacket is armed", armed)
    if property_of_unit("Type") != "notify" or property_of_unit("ActiveState") != "active":
        raise Failed("the unit is not up as a service that tells when it is ready")


def exposure():
    said = run("systemd-analyze", "security", "--no-pager", UNIT)
    return re.search(r"Overall exposure level.*: ([0-9.]+ \w+)", said)[1]


class Checks:
    def __init__(self):
        self.usb = None

    def felt(self):
        since = len(self.usb.lines())
        run("telehug", "jacket", "test", "1", "--seconds", "0.5")
        ran_s = within(OFF_WITHIN_S, "the motor's pin goes on and off again", lambda: self.usb.channel_ran(0, since))
        return f"the pin of motor 1 was on for {ran_s:.2f} s"

    def armed_and_felt(self):
        found = within(ARMED_WITHIN_S, "the jacket is armed", armed)
        if found["device"] not in (BY_ID, os.path.realpath(BY_ID)):
            raise Failed(f"armed on {found['device']}")
        return f"{found['device']} is {os.path.realpath(BY_ID)}; {self.felt()}"

    @staticmethod
    def use_usb(more=""):
        set_keys(f'[jacket]\nlink = "serial:{BY_ID}"\n{more}')
        run("systemctl", "restart", UNIT)

    def plug_in(self):
        self.usb = UsbJacket()
        self.use_usb()
        return self.armed_and_felt()

    def unplug(self):
        self.usb.unplug()
        start = time.monotonic()
        within(ABSENT_WITHIN_S, "the jacket is told absent", lambda: jacket().get("state") == "absent")
        return f"told {time.monotonic() - start:.2f} s after the port was gone"

    def replug_under_another_name(self):
        self.usb.plug()
        within(ARMED_WITHIN_S, "the jacket is armed", armed)
        before = os.path.realpath(BY_ID)
        # Whoever keeps the dead port open keeps its name.
        kept = os.open(before, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        try:
            self.usb.unplug()
            after = self.usb.plug()
            if after == before:
                raise Failed(f"it came back as {after}")
            return self.armed_and_felt()
        finally:
            os.close(kept)

    def watchdog(self):
        pid = int(property_of_unit("MainPID"))
        restarts = int(property_of_unit("NRestarts"))
        since = len(self.usb.lines())
        driving = subprocess.Popen(["telehug", "jacket", "test", "1", "--seconds", "5"], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        within(5, "the motor runs", lambda: any(line[3] == "on" for line in self.usb.lines()[since:]))
        os.kill(pid, signal.SIGSTOP)
        start = time.monotonic()
        within(OFF_WITHIN_S, "all motors are off when the daemon hangs", self.usb.all_off)
        off_s = time.monotonic() - start
        within(20, "systemd has restarted it", lambda: int(property_of_unit("NRestarts")) == restarts + 1)
        restarted_s = time.monotonic() - start
        driving.wait(10)
        within(ARMED_WITHIN_S, "another process runs", lambda: int(property_of_unit("MainPID")) not in (0, pid))
        self.armed_and_felt()
        return f"off after {off_s:.2f} s, restarted after {restarted_s:.1f} s, felt again"

    def stop_button(self):
        panel = GpioPanel()
        panel.press(False)
        self.use_usb(f'[gpio]\nchip = "{panel.label}"\nbutton_pull = "none"\n'
                     f'stop_button_line = "{panel.stop_line}"\nled_line = "{panel.light_line}"\n')
        within(ARMED_WITHIN_S, "the jacket is armed", armed)
        panel.press(True)
        within(OFF_WITHIN_S, "stopped", lambda: status().get("state") == "stopped")
        if subprocess.run(["telehug", "resume"], capture_output=True, check=False).returncode == 0:
            raise Failed("resumed while the button is pressed")
        within(10, "the light flashes fast", panel.light_has_changed)
        panel.press(False)
        within(OFF_WITHIN_S, "released", lambda: status().get("panel", {}).get("stop_button") == "released")
        if status().get("state") != "stopped":
            raise Failed("not stopped any more when the button is let go")
        run("telehug", "resume")
        told = self.felt()
        self.use_usb()
        return told

    def first(self, table):
        table.check("the programs are installed on a clean guest", install)
        table.check("the unit is up, its simulated jacket armed", simulated_jacket)
        table.check("systemd-analyze security", exposure)
        table.check("a jacket at a USB serial port is armed and felt", self.plug_in)
        table.check("unplugged: told absent", self.unplug)
        table.check("plugged in under another name: armed and felt", self.replug_under_another_name)
        table.check("the daemon hangs: motors off, restarted by the watchdog", self.watchdog)
        table.check("stop button and light on GPIO lines", self.stop_button)


def main():
    checks = Checks()
    table = Table()
    try:
        getattr(checks, sys.argv[1])(table)
    finally:
        if checks.usb is not None:
            checks.usb.end()
    table.end()


main()
