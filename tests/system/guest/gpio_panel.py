# SPDX-License-Identifier: Apache-2.0
"""The jacket's stop button and light on lines of the kernel's gpio-sim."""
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

    def __init__(self):
        run("modprobe", "gpio-sim")
        with open("/etc/udev/rules.d/70-telehug-guest.rules", "w", encoding="ascii") as file:
            file.write('SUBSYSTEM=="gpio", KERNEL=="gpiochip*", GROUP="dialout", MODE="0660"\n')
        run("udevadm", "control", "--reload")
        os.makedirs(CHIP + "/bank0")
        write(CHIP + "/bank0/num_lines", "8")
        write(CHIP + "/bank0/label", self.label)
        write(CHIP + "/live", "1")
        run("udevadm", "settle")
        self.folder = f"/sys/devices/platform/{read(CHIP + '/dev_name')}/{read(CHIP + '/bank0/chip_name')}"

    def press(self, pressed):
        """A normally closed button to ground: open, and so high, when it is pressed."""
        write(f"{self.folder}/sim_gpio{self.stop_line}/pull", "pull-up" if pressed else "pull-down")

    def light_has_changed(self):
        level = f"{self.folder}/sim_gpio{self.light_line}/value"
        first = read(level)
        end = time.monotonic() + 1
        while time.monotonic() < end:
            if read(level) != first:
                return True
            time.sleep(0.01)
        return False
