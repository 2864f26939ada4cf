# SPDX-License-Identifier: Apache-2.0
"""The simulated jacket, and a USB serial port of the kernel for it: a CDC-ACM gadget on dummy_hcd, with hot plug.
Both are units, so that they outlive the script that starts them."""
import os

from check_table import run, within

GADGET = "/sys/kernel/config/usb_gadget/jacket"
BY_ID = "/dev/serial/by-id/usb-Telehug_Test_jacket_TH0001-if00"
PINS = "/run/jacket-pins.csv"
TERMINAL = "/run/jacket-terminal"


def write(path, text):
    with open(path, "w", encoding="ascii") as file:
        file.write(text + "\n")


def start_unit(name, *command):
    run("systemd-run", "--quiet", "--collect", f"--unit={name}", *command)


def stop_unit(name):
    """It may have ended by itself."""
    run("systemctl", "stop", name, fails=True)


def start_simulator():
    start_unit("jacket-simulator", "telehug-jacket-sim", "--link", TERMINAL, "--pins", PINS)
    within(10, "the simulator's terminal", lambda: os.path.exists(TERMINAL))


def make_port():
    run("modprobe", "-a", "libcomposite", "dummy_hcd", "usb_f_acm", "cdc_acm")
    for folder in ("", "/strings/0x409", "/configs/c.1/strings/0x409", "/functions/acm.0"):
        os.makedirs(GADGET + folder, exist_ok=True)
    write(GADGET + "/idVendor", "0x2341")
    write(GADGET + "/idProduct", "0x0043")
    write(GADGET + "/strings/0x409/manufacturer", "Telehug")
    write(GADGET + "/strings/0x409/product", "Test jacket")
    write(GADGET + "/strings/0x409/serialnumber", "TH0001")
    os.symlink(GADGET + "/functions/acm.0", GADGET + "/configs/c.1/acm.0")


def plug():
    write(GADGET + "/UDC", "dummy_udc.0")
    within(10, BY_ID, lambda: os.path.exists(BY_ID))
    # The device's end of the line is closed by each unplug.
    start_unit("jacket-usb", "socat", "/dev/ttyGS0,noctty,raw,echo=0,clocal=1", TERMINAL + ",noctty,raw,echo=0")
    return os.path.realpath(BY_ID)


def unplug():
    write(GADGET + "/UDC", "")
    within(10, "the port is gone", lambda: not os.path.exists(BY_ID))
    stop_unit("jacket-usb")


def pins():
    """Each turning on or off of a motor: nanoseconds, cycle, channel, on or off."""
    with open(PINS, encoding="ascii") as file:
        return [line.strip().split(",") for line in file if line.endswith("\n")]


def channel_ran(channel, since):
    """Turned on and off again after so many lines of the log? None as long as not, else its seconds."""
    mine = [line for line in pins()[since:] if int(line[2]) == channel]
    if len(mine) < 2 or mine[0][3] != "on" or mine[-1][3] != "off":
        return None
    return (int(mine[-1][0]) - int(mine[0][0])) / 1e9


def all_off():
    last = {}
    for line in pins():
        last[line[2]] = line[3]
    return "on" not in last.values()
