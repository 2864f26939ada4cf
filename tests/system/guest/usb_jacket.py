# SPDX-License-Identifier: Apache-2.0
"""The simulated jacket behind a USB serial port of the kernel: a CDC-ACM gadget on dummy_hcd, with hot plug."""
import os
import subprocess

from check_table import run, within

GADGET = "/sys/kernel/config/usb_gadget/jacket"
BY_ID = "/dev/serial/by-id/usb-Telehug_Test_jacket_TH0001-if00"
PINS = "/run/jacket-pins.csv"
TERMINAL = "/run/jacket-terminal"


def write(path, text):
    with open(path, "w", encoding="ascii") as file:
        file.write(text + "\n")


class UsbJacket:
    def __init__(self):
        run("modprobe", "-a", "libcomposite", "dummy_hcd", "usb_f_acm", "cdc_acm")
        for folder in ("", "/strings/0x409", "/configs/c.1/strings/0x409", "/functions/acm.0"):
            os.makedirs(GADGET + folder, exist_ok=True)
        write(GADGET + "/idVendor", "0x2341")
        write(GADGET + "/idProduct", "0x0043")
        write(GADGET + "/strings/0x409/manufacturer", "Telehug")
        write(GADGET + "/strings/0x409/product", "Test jacket")
        write(GADGET + "/strings/0x409/serialnumber", "TH0001")
        os.symlink(GADGET + "/functions/acm.0", GADGET + "/configs/c.1/acm.0")
        self.simulator = subprocess.Popen(["telehug-jacket-sim", "--link", TERMINAL, "--pins", PINS],
                                          stdout=subprocess.DEVNULL)
        within(10, "the simulator's terminal", lambda: os.path.exists(TERMINAL))
        self.bridge = None
        self.plug()

    def plug(self):
        write(GADGET + "/UDC", "dummy_udc.0")
        within(10, BY_ID, lambda: os.path.exists(BY_ID))
        # The device's end of the line is closed by each unplug.
        self.bridge = subprocess.Popen(["socat", "/dev/ttyGS0,raw,echo=0,clocal=1", TERMINAL + ",raw,echo=0"],
                                       stderr=subprocess.DEVNULL)
        return os.path.realpath(BY_ID)

    def unplug(self):
        write(GADGET + "/UDC", "")
        within(10, "the port is gone", lambda: not os.path.exists(BY_ID))
        self.bridge.terminate()
        self.bridge.wait()

    def end(self):
        for child in (self.bridge, self.simulator):
            if child is not None and child.poll() is None:
                child.terminate()
                child.wait()

    @staticmethod
    def lines():
        with open(PINS, encoding="ascii") as file:
            return [line.strip().split(",") for line in file if line.endswith("\n")]

    def channel_ran(self, channel, since):
        """Turned on and off again after so many lines of the log? None as long as not, else its seconds."""
        mine = [line for line in self.lines()[since:] if int(line[2]) == channel]
        if len(mine) < 2 or mine[0][3] != "on" or mine[-1][3] != "off":
            return None
        return (int(mine[-1][0]) - int(mine[0][0])) / 1e9

    def all_off(self):
        last = {}
        for line in self.lines():
            last[line[2]] = line[3]
        return "on" not in last.values()
