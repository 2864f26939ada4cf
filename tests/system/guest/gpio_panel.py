# SPDX-License-Identifier: Apache-2.0
"""The jacket's stop button, light and power line on lines of the kernel's gpio-sim."""
import os
import time

from check_table import run
from usb_jacket import write

CHIP = "/sys/kernel/config/gpio-sim/panel"


def read(path):
    with open(path, encoding="ascii") as file:
        return file.read().strip()


class GpioPanel:
    label = "panel"
    stop_line = 2
    light_line = 3
    power_line = 4

    def __init__(self):
        run("modprobe", "gpio-sim")
        os.makedirs(CHIP + "/bank0")
        write(CHIP + "/bank0/num_lines", "8")
        write(CHIP + "/bank0/label", self.label)
        write(CHIP + "/live", "1")
        run("udevadm", "settle")
        self.folder = f"/sys/devices/platform/{read(CHIP + '/dev_name')}/{read(CHIP + '/bank0/chip_name')}"

    def press(self, pressed):
        """A normally closed button to ground: open, and so high, when it is pressed."""
        write(f"{self.folder}/sim_gpio{self.stop_line}/pull", "pull-up" if pressed else "pull-down")

    def level(self, line):
        return read(f"{self.folder}/sim_gpio{line}/value")

    def power_is_on(self):
        return self.level(self.power_line) == "1"

    def light_has_changed(self):
        first = self.level(self.light_line)
        end = time.monotonic() + 1
        while time.monotonic() < end:
            if self.level(self.light_line) != first:
                return True
            time.sleep(0.01)
        return False
