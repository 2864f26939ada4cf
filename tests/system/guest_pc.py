# SPDX-License-Identifier: Apache-2.0
"""A PC in QEMU: booted or restored from a saved state, told what to do by ssh."""
import hashlib
import inspect
import json
import os
import re
import secrets
import shlex
import socket
import subprocess
import time

# KVM may be there and not work: always emulated, where AVX and FMA make the face finder ten times slower. With the HPET a
# restored guest would lose its timer.
MACHINE = ["qemu-system-x86_64", "-M", "q35,hpet=off", "-nodefaults", "-display", "none", "-accel", "tcg,thread=multi",
           "-cpu", "max,avx=off,avx2=off,fma=off", "-smp", "2", "-m", "1024", "-no-reboot", "-device", "virtio-rng-pci",
           "-append", "console=ttyS0 quiet panic=-1 mitigations=off audit=0"]
BOOT_LIMIT_S = 300
SCRIPTS = "/mnt/share/guest"
BROKEN_KERNEL = re.compile("kernel BUG|Oops")


class GuestFailed(Exception):
    """What the PC, not telehug, did wrong; with what its console says."""


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class GuestPc:
    """`image` is what build_guest made, `folder` this run's own, `share` what the guest sees in /mnt/share."""

    def __init__(self, image, folder, share, name, other="nobody"):
        self.image, self.folder, self.share, self.name, self.other = image, folder, share, name, other
        self.disk = f"{folder}/{name}.qcow2"
        self.console = f"{folder}/{name}.console"
        self.port = free_port()
        self.qemu = None

    def start(self, *more):
        devices = [
            "-kernel", f"{self.image}/vmlinux", "-initrd", f"{self.image}/initrd",
            "-drive", f"file={self.disk},if=virtio,format=qcow2,cache=unsafe",
            "-netdev", f"user,id=control,restrict=on,hostfwd=tcp:127.0.0.1:{self.port}-:22",
            "-device", "virtio-net-pci,netdev=control,mac=52:54:00:00:00:01,romfile=",
            # The network of the homes: two sockets, no bridge, nothing on this PC's own network.
            "-netdev", f"dgram,id=homes,local.type=unix,local.path={self.folder}/{self.name}.net,"
                       f"remote.type=unix,remote.path={self.folder}/{self.other}.net",
            "-device", "virtio-net-pci,netdev=homes,mac=52:54:00:77:00:01,romfile=",
            "-virtfs", f"local,path={self.share},mount_tag=share,security_model=none,readonly=on",
            "-chardev", f"file,id=console,path={self.console},append=on", "-serial", "chardev:console",
            "-qmp", f"unix:{self.folder}/{self.name}.qmp,server=on,wait=off"]
        with open(f"{self.folder}/{self.name}.log", "wb") as log:
            self.qemu = subprocess.Popen([*MACHINE, *devices, *more], stdin=subprocess.DEVNULL, stdout=log, stderr=log)
        end = time.monotonic() + BOOT_LIMIT_S
        while self.ssh("true", 5).returncode != 0:
            if time.monotonic() > end:
                raise GuestFailed(f"{self.name} does not answer after {BOOT_LIMIT_S} s\n{self.last_words()}")
            time.sleep(0.1)

    def boot(self):
        self.start()
        self.run("systemctl is-system-running --wait || systemctl --failed; mount -t 9p -o trans=virtio,ro share /mnt/share")

    def restore(self, saved, number):
        subprocess.run(["qemu-img", "create", "-q", "-f", "qcow2", "-b", f"{saved}/disk.qcow2", "-F", "qcow2", self.disk],
                       check=True)
        self.start("-incoming", f"exec:cat {shlex.quote(saved)}/state")
        self.run("mount -t 9p -o trans=virtio,ro share /mnt/share")
        self.run(f"echo {secrets.token_hex(32)} | python3 -B {SCRIPTS}/become.py {self.name} {number} {time.time()}")

    def save(self, saved):
        self.run("sync; umount /mnt/share")  # a mounted share can't be saved
        self.hang_up()
        self.ask("migrate", uri=f"exec:cat > {shlex.quote(saved)}/state")
        end = time.monotonic() + 120
        while self.ask("query-migrate")["status"] != "completed":
            if time.monotonic() > end:
                raise GuestFailed("the state is not saved after 120 s")
            time.sleep(0.2)
        self.end()
        os.rename(self.disk, f"{saved}/disk.qcow2")

    def ask(self, command, **arguments):
        with socket.socket(socket.AF_UNIX) as monitor:
            monitor.settimeout(20)
            monitor.connect(f"{self.folder}/{self.name}.qmp")
            with monitor.makefile("rw") as lines:
                lines.readline()  # the greeting
                for request in ({"execute": "qmp_capabilities"}, {"execute": command, "arguments": arguments}):
                    lines.write(json.dumps(request) + "\n")
                    lines.flush()
                    answer = {}
                    while not answer.keys() & {"return", "error"}:
                        answer = json.loads(lines.readline())
        if "error" in answer:
            raise GuestFailed(f"{command}: {answer['error']['desc']}")
        return answer["return"]

    def words(self, command):
        if self.qemu.poll() is not None:
            raise GuestFailed(f"{self.name} has ended\n{self.last_words()}")
        return ["ssh", "-q", "-i", f"{self.image}/id", "-p", str(self.port), "-o", "BatchMode=yes",
                "-o", "StrictHostKeyChecking=no", "-o", "UserKnownHostsFile=/dev/null", "-o", "ConnectTimeout=3",
                "-o", "ServerAliveInterval=10", "-o", "ServerAliveCountMax=9", "-o", "ControlMaster=auto",
                "-o", f"ControlPath={self.folder}/{self.name}.ssh", "-o", "ControlPersist=3000", "root@127.0.0.1", command]

    def ssh(self, command, limit_s, **how):
        try:
            return subprocess.run(self.words(command), timeout=limit_s, check=False, text=True,
                                  **{"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL, **how})
        except subprocess.TimeoutExpired:
            return subprocess.CompletedProcess(command, 124, f"not done after {limit_s} s")

    def run(self, command, limit_s=120):
        done = self.ssh(command, limit_s, stderr=subprocess.STDOUT)
        if done.returncode != 0:
            raise GuestFailed(f"{self.name}: {command}: exit code {done.returncode}: {done.stdout.strip()}")
        return done.stdout

    def begin(self, command, limit_s):
        """What it prints can be read while it runs."""
        return subprocess.Popen(self.words(f"timeout {limit_s} {command}"), stdin=subprocess.DEVNULL, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def reboot(self):
        """The guest's own reboot; QEMU ends then (-no-reboot: so does it after a panic) and is started on the same disk."""
        self.ssh("systemctl --no-block reboot", 20)
        self.hang_up()
        try:
            self.qemu.wait(120)
        except subprocess.TimeoutExpired:
            raise GuestFailed(f"{self.name} does not go down\n{self.last_words()}") from None
        self.boot()

    def hang_up(self):
        subprocess.run(["ssh", "-q", "-o", f"ControlPath={self.folder}/{self.name}.ssh", "-O", "exit", "127.0.0.1"],
                       check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def end(self):
        if self.qemu is not None and self.qemu.poll() is None:
            self.hang_up()
            self.qemu.terminate()
            self.qemu.wait(20)

    def console_text(self):
        if not os.path.exists(self.console):
            return ""
        with open(self.console, encoding="utf-8", errors="replace") as file:
            return file.read()

    def kernel_is_broken(self):
        return [line for line in self.console_text().splitlines() if BROKEN_KERNEL.search(line)]

    def last_words(self):
        with open(f"{self.folder}/{self.name}.log", encoding="utf-8", errors="replace") as log:
            return f"--- QEMU\n{log.read()}--- the console\n" + "\n".join(self.console_text().splitlines()[-20:])


def saved_state(image, folder, share):
    """Where the state of a booted PC is kept; made if this image, machine and QEMU have none yet."""
    version = subprocess.run([MACHINE[0], "--version"], check=True, capture_output=True, text=True).stdout
    devices = inspect.getsource(GuestPc.start)
    key = hashlib.sha256(f"{version}{MACHINE}{devices}".encode()).hexdigest()[:16]
    saved = f"{image}/saved-{key}"
    if not os.path.exists(f"{saved}/disk.qcow2"):
        os.makedirs(saved, exist_ok=True)
        pc = GuestPc(image, folder, share, "new")
        subprocess.run(["qemu-img", "create", "-q", "-f", "qcow2", "-b", f"{image}/disk.ext4", "-F", "raw", pc.disk],
                       check=True)
        try:
            pc.boot()
            pc.save(saved)
        finally:
            pc.end()
    return saved
