# SPDX-License-Identifier: Apache-2.0
"""The wearer's PC: its daemon, its settings, its jacket."""
import json
import os

import usb_jacket
from check_table import Failed, run, within

UNIT = "telehug-passive.service"
SETTINGS = "/etc/telehug/passive.d/50-guest.toml"
# Of an emulated PC, whose times are ten times those of hardware and more where others use it, too.
ABSENT_WITHIN_S = 5
ARMED_WITHIN_S = 60
OFF_WITHIN_S = 5


def status():
    try:
        return json.loads(run("telehug", "status", "--json", "--side", "passive"))["daemons"][0]
    except (Failed, IndexError, KeyError):
        return {}


def jacket():
    return status().get("jacket", {})


def armed():
    found = jacket()
    return found if found.get("state") == "armed" else None


def absent():
    return jacket().get("state") == "absent"


def property_of_unit(name):
    return run("systemctl", "show", UNIT, "--property", name, "--value").strip()


def set_keys(text):
    os.makedirs(os.path.dirname(SETTINGS), exist_ok=True)
    with open(SETTINGS, "w", encoding="ascii") as file:
        file.write(text)
    run("systemctl", "restart", UNIT)


def use_usb(more=""):
    set_keys(f'[jacket]\nlink = "serial:{usb_jacket.BY_ID}"\n{more}')


def felt():
    """A trial of a motor, seen at its pin."""
    since = len(usb_jacket.pins())
    run("telehug", "jacket", "test", "1", "--seconds", "0.5")
    ran_s = within(OFF_WITHIN_S, "the motor's pin goes on and off again", lambda: usb_jacket.channel_ran(0, since))
    return f"the pin of motor 1 was on for {ran_s:.2f} s"


def armed_and_felt(device):
    found = within(ARMED_WITHIN_S, "the jacket is armed", armed)
    if found["device"] not in (device, os.path.realpath(device)):
        raise Failed(f"armed on {found['device']}")
    return felt()
