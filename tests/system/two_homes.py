# SPDX-License-Identifier: Apache-2.0
"""From two clean PCs to the first touch that is felt, by the commands that people type; with the times of each step."""
import json
import re
import time

from check_table import Failed, within
from guest_pc import SCRIPTS

PERSON = "runuser -u mum -- env XDG_RUNTIME_DIR=/run/user/1000"
CONNECTED_WITHIN_S = 180
FELT_WITHIN_S = 180


class Transcript:
    def __init__(self):
        self.start = time.monotonic()
        self.lines = []

    def tell(self, pc, what):
        self.lines.append(f"{time.monotonic() - self.start:7.1f} s  {pc:6}  {what}")


class TwoHomes:
    def __init__(self, parent, wearer, transcript):
        self.parent, self.wearer, self.transcript = parent, wearer, transcript

    def pair(self):
        command = f"{PERSON} telehug pair invite --name Mum --address 10.77.0.2"
        self.transcript.tell("parent", command)
        inviter = self.parent.begin(command, 300)
        code = inviter.stdout.readline().strip()
        if not re.fullmatch("[0-9A-Z-]+", code):
            raise Failed(f"pair invite says: {code} {inviter.stdout.read()}")
        self.transcript.tell("parent", code)
        command = f"telehug pair accept {code} --name Kim"
        self.transcript.tell("wearer", "sudo " + command)
        accepted = self.wearer.run(command)
        invited = inviter.stdout.read()
        inviter.wait(60)
        phrases = [re.search("^Phrase: (.*)$", said, re.MULTILINE)[1] for said in (accepted, invited)]
        self.transcript.tell("both", f"Phrase: {phrases[0]}")
        if phrases[0] != phrases[1]:
            raise Failed(f"two phrases: {phrases}")
        within(CONNECTED_WITHIN_S, "both are connected", lambda: all(self.peer_of(pc) for pc in (self.parent, self.wearer)))
        self.transcript.tell("both", "connected")
        return f"phrase: {phrases[0]}"

    def status(self, pc):
        said = pc.ssh(f"{PERSON if pc is self.parent else ''} telehug status --json", 60).stdout
        try:
            return json.loads(said)["daemons"][0]
        except (ValueError, KeyError, IndexError):
            return {}

    def peer_of(self, pc):
        return self.status(pc).get("peer", {}).get("connected")

    def pins(self):
        return len(self.wearer.run("cat /run/jacket-pins.csv").splitlines())

    def touch(self, jacket):
        """The camera sees a finger slide over the picture; the jacket's motors run, and the parent's PC is told so."""
        before = self.pins()
        self.parent.run(f"cd {SCRIPTS} && python3 -B -c 'import parent; parent.plug_camera()'")
        start = time.monotonic()
        self.transcript.tell("parent", "a finger on the picture")
        within(FELT_WITHIN_S, f"the {jacket} jacket's motors run", lambda: self.pins() > before)
        felt_s = time.monotonic() - start
        self.transcript.tell("wearer", f"felt by the {jacket} jacket")
        self.parent.run(f"cd {SCRIPTS} && python3 -B -c 'import parent; parent.unplug_camera()'")
        channel = self.wearer.run(f"sed -n {before + 1}p /run/jacket-pins.csv").split(",")[2]
        return f"motor {int(channel) + 1} after {felt_s:.1f} s of camera"
