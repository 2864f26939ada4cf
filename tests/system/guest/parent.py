# SPDX-License-Identifier: Apache-2.0
"""The parent's PC: a person's session without a desktop, whose camera sees the touch samples and whose screen is a file."""
import json
import os

from check_table import Failed, run, within
from usb_jacket import start_unit, stop_unit

UNIT = "telehug-active.service"
SETTINGS = "/home/mum/.config/telehug/active.d/50-guest.toml"
LOOPBACK = "/dev/video10"
RIG = "/mnt/share/rig"
PICTURES = [f"{RIG}/background.jpg"] * 5 + [f"{RIG}/sequence/{number:03}.jpg" for number in range(5, 19)]
PER_SECOND = 5
KEYS = """
[camera]
device = "{device}"
fps = 5
[body_map]
picture = "/home/mum/chat.jpg"
rate_hz = 2
max_age_ms = 30000
[sending]
at_start = "on"
[peer]
heartbeat_timeout_ms = 1000
[local_touch]
uinput = {uinput}
"""


def as_person(*command, fails=False):
    return run("runuser", "-u", "mum", "--", "env", "XDG_RUNTIME_DIR=/run/user/1000", *command, fails=fails)


def manager_of_person(*words):
    return run("systemctl", "--user", "--machine=mum@", *words)


def status():
    try:
        return json.loads(as_person("telehug", "status", "--json", "--side", "active"))["daemons"][0]
    except (Failed, IndexError, KeyError):
        return {}


def set_keys(device=LOOPBACK, uinput=False):
    os.makedirs(os.path.dirname(SETTINGS), exist_ok=True)
    with open(SETTINGS, "w", encoding="ascii") as file:
        file.write(KEYS.format(device=device, uinput="true" if uinput else "false"))
    run("chown", "-R", "mum:", "/home/mum/.config")
    manager_of_person("restart", UNIT)


def plug_camera():
    """Without a writer the device is none that captures."""
    run("modprobe", "v4l2loopback", "devices=1", f"video_nr={LOOPBACK[-2:]}", "card_label=Webcam", "exclusive_caps=1")
    within(10, LOOPBACK, lambda: os.path.exists(LOOPBACK))
    start_unit("camera", "python3", "/mnt/share/guest/camera.py", LOOPBACK, str(PER_SECOND), *PICTURES)
    run("udevadm", "settle")


def unplug_camera():
    """Its pictures end, and as soon as nobody waits for more the device is gone."""
    stop_unit("camera")
    within(60, "telehug-active lets go of the camera", lambda: not run("rmmod", "v4l2loopback", fails=True)
           and not os.path.exists(LOOPBACK))
