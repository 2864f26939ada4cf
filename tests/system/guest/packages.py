# SPDX-License-Identifier: Apache-2.0
"""apt in a guest, which knows the repository of the share and nothing else."""
import os
import re
import subprocess

from check_table import Failed, run


def version_of(package):
    return run("dpkg-query", "-W", "-f", "${Version}", package).strip()


def apt(*words, limit_s=900):
    done = subprocess.run(["apt-get", "-q", "-y", "--no-install-recommends", *words], capture_output=True, text=True, check=False,
                          timeout=limit_s, stdin=subprocess.DEVNULL, env={**os.environ, "DEBIAN_FRONTEND": "noninteractive"})
    if done.returncode != 0:
        raise Failed(f"apt-get {' '.join(words)}: {done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


def no_unit_failed():
    failed = run("systemctl", "--failed", "--no-legend", "--plain").strip()
    if failed:
        raise Failed(f"units have failed: {failed}")


def install(package):
    """On a clean guest, not yet the next version; and whether anything about the system has failed since."""
    with open("/etc/apt/sources.list", "w", encoding="ascii") as file:
        file.write("deb [trusted=yes] file:/mnt/share/repository ./\n")
    apt("update")
    version = run("apt-cache", "policy", package).split("Candidate: ")[1].split()[0].removesuffix("+next")
    said = apt("install", f"{package}={version}", f"telehug-common={version}")
    no_unit_failed()
    return f"{version_of(package)}, {re.search('([0-9]+) newly installed', said)[1]} packages"


def upgrade(package):
    before = version_of(package)
    apt("install", package, "telehug-common")
    after = version_of(package)
    if after == before:
        raise Failed(f"{package} is still {after}")
    return f"{before} to {after}"
