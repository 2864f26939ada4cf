# SPDX-License-Identifier: Apache-2.0
"""The simulated jacket behind Bluetooth: two virtual controllers of the kernel, hci0 the PC's, hci1 the jacket's.
As a program: the jacket's end, which joins whoever connects with the simulator's terminal."""
import os
import select
import socket
import subprocess
import tty

from check_table import run, within
from usb_jacket import TERMINAL, start_unit, stop_unit

ADDRESS = "00:AA:01:01:00:01"
CHANNEL = 1
MODULES = ["hci_vhci", "rfcomm", "bnep", "af_alg", "algif_hash", "algif_skcipher", "cmac", "ecb", "ecdh_generic"]


def switch_on():
    """The radios of both; without bluetoothd, which would make them appear late and deaf."""
    run("modprobe", "-a", *MODULES)
    run("systemctl", "mask", "--runtime", "--now", "bluetooth")
    start_unit("radios", "btvirt", "-B", "-l2")
    within(20, "two controllers", lambda: run("hciconfig").count("\tBD Address") == 2)
    for adapter in ("hci0", "hci1"):
        run("hciconfig", adapter, "up")
    in_range(True)
    start_unit("jacket-bluetooth", "python3", os.path.realpath(__file__))


def switch_off():
    stop_unit("jacket-bluetooth")
    stop_unit("radios")


def in_range(can_be_reached):
    run("hciconfig", "hci1", "piscan" if can_be_reached else "noscan")


def cut():
    run("hcitool", "-i", "hci1", "dc", "00:AA:01:00:00:00")


def pull_adapter():
    subprocess.run(["systemctl", "kill", "--signal=KILL", "radios"], check=True)
    within(10, "the controllers are gone", lambda: "hci" not in run("hciconfig"))
    stop_unit("jacket-bluetooth")


def join(link, terminal):
    while True:
        ready, _, _ = select.select([link, terminal], [], [])
        if link in ready:
            received = link.recv(4096)
            if not received:
                return
            os.write(terminal, received)
        if terminal in ready:
            link.sendall(os.read(terminal, 512))


def serve():
    terminal = os.open(TERMINAL, os.O_RDWR | os.O_NOCTTY)
    tty.setraw(terminal)
    with socket.socket(socket.AF_BLUETOOTH, socket.SOCK_STREAM, socket.BTPROTO_RFCOMM) as listener:
        listener.bind((ADDRESS, CHANNEL))
        listener.listen(1)
        while True:
            link, _ = listener.accept()
            with link:
                try:
                    join(link, terminal)
                except OSError as error:
                    print("the link has ended:", error, flush=True)


if __name__ == "__main__":
    serve()
