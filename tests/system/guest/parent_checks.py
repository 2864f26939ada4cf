# SPDX-License-Identifier: Apache-2.0
"""parent_checks.py GROUP: the parent's PC, its unit in the session of a person, its camera, its touchscreen."""
import os
import re
import shutil
import subprocess
import sys
import time

import packages
import parent
from check_table import Failed, Table, run, within

SEEN_WITHIN_S = 120
VIVID = "/sys/bus/platform/drivers/vivid"


def unit_is_up():
    """A person has logged in, whose manager starts telehug-active; the PC has no desktop."""
    run("useradd", "--create-home", "--groups", "video", "mum")
    run("loginctl", "enable-linger", "mum")
    within(60, "the manager of the person", lambda: os.path.exists("/run/user/1000/bus"))
    os.makedirs("/home/mum/.local/state/telehug")
    shutil.copy("/mnt/share/rig.toml", "/home/mum/.local/state/telehug/rig.toml")
    shutil.copy("/mnt/share/rig.background.png", "/home/mum/.local/state/telehug/rig.background.png")
    shutil.copy("/mnt/share/chat.jpg", "/home/mum/chat.jpg")
    run("chown", "-R", "mum:", "/home/mum/.local")
    parent.plug_camera()
    parent.set_keys()
    said = parent.manager_of_person("show", parent.UNIT, "--property=Type,ActiveState", "--value")
    if sorted(said.split()) != ["active", "notify"]:
        raise Failed("the unit is not up as a service that tells when it is ready")


def counter(name):
    return parent.status().get("counters", {}).get(name, 0)


def grows(name):
    before = counter(name)
    within(SEEN_WITHIN_S, f"{name} grows", lambda: counter(name) > before)


def touchscreen():
    """Touches of the camera's pictures, as another program reads them."""
    run("modprobe", "uinput")
    # As the rule says for whom it is; nobody sits at this PC.
    with open("/etc/udev/rules.d/70-telehug-uinput.rules", "w", encoding="ascii") as file:
        file.write('KERNEL=="uinput", SUBSYSTEM=="misc", OWNER="mum", OPTIONS+="static_node=uinput"\n')
    run("udevadm", "control", "--reload")
    run("udevadm", "trigger", "--settle", "--name-match=uinput")
    parent.set_keys(uinput=True)
    within(SEEN_WITHIN_S, "the touchscreen", lambda: "telehug touchscreen" in devices())
    event = re.search(r'Name="telehug touchscreen".*?(event\d+)', devices(), re.DOTALL)[1]
    with subprocess.Popen(["timeout", str(SEEN_WITHIN_S), "evtest", f"/dev/input/{event}"], text=True,
                          stdout=subprocess.PIPE) as reader:
        x_mm = y_mm = None
        for line in reader.stdout:
            found = re.search(r"\(ABS_MT_POSITION_([XY])\), value (\d+)", line)
            if found and found[1] == "X":
                x_mm = int(found[2]) / 100
            elif found:
                y_mm = int(found[2]) / 100
            if x_mm and y_mm:
                break
        reader.terminate()
    # Where the finger of the pictures slides.
    if x_mm is None or not (150 < x_mm < 275 and 160 < y_mm < 225):
        raise Failed(f"read {x_mm}, {y_mm} mm")
    return f"evtest reads {x_mm:.1f}, {y_mm:.1f} mm"


def devices():
    with open("/proc/bus/input/devices", encoding="utf-8") as file:
        return file.read()


def camera_lost_and_back():
    losses = counter("camera_losses")
    parent.unplug_camera()
    start = time.monotonic()
    within(SEEN_WITHIN_S, "the camera is told lost", lambda: counter("camera_losses") > losses)
    told_s = time.monotonic() - start
    parent.plug_camera()
    start = time.monotonic()
    grows("frames")
    return f"told after {told_s:.1f} s; pictures {time.monotonic() - start:.1f} s after it was back"


def vivid():
    run("modprobe", "vivid", "n_devs=1", "node_types=0x1", "num_inputs=1", "input_types=0")
    run("udevadm", "settle")
    device = "/dev/" + run("sh", "-c", "ls /sys/devices/platform/vivid.0/video4linux").split()[0]
    parent.set_keys(device=device, uinput=True)
    grows("frames")
    losses = counter("camera_losses")
    write(f"{VIVID}/unbind", "vivid.0")
    within(SEEN_WITHIN_S, "the camera is told lost", lambda: counter("camera_losses") > losses)
    write(f"{VIVID}/bind", "vivid.0")
    grows("frames")
    parent.set_keys()
    parent.unplug_camera()
    return f"{device}, lost and back"


def write(path, text):
    with open(path, "w", encoding="ascii") as file:
        file.write(text)


GROUPS = {"alone": {
    "apt installs telehug-active": lambda: packages.install("telehug-active"),
    "its unit is up in a person's session": unit_is_up,
    "a finger before a v4l2loopback camera moves a uinput touchscreen": touchscreen,
    "the camera is unplugged, and back": camera_lost_and_back,
    "vivid's camera, unbound and bound again": vivid,
}}


def main():
    table = Table()
    for name, function in GROUPS[sys.argv[1]].items():
        table.check(name, function)
    table.end()


if __name__ == "__main__":
    main()
