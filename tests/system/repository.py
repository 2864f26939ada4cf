# SPDX-License-Identifier: Apache-2.0
"""The flat repository that guests without a network install from."""
import glob
import os
import re
import shutil
import subprocess
import tempfile

SOURCE = os.path.realpath(os.path.dirname(__file__) + "/../..")


def repack_as_next(package, folder):
    """The same files as the next version, to be upgraded to."""
    with tempfile.TemporaryDirectory() as work:
        subprocess.run(["dpkg-deb", "-R", package, work + "/tree"], check=True)
        with open(work + "/tree/DEBIAN/control", encoding="utf-8") as file:
            control = file.read()
        version = re.search("^Version: (.*)$", control, re.MULTILINE)[1]
        with open(work + "/tree/DEBIAN/control", "w", encoding="utf-8") as file:
            file.write(control.replace(f"Version: {version}\n", f"Version: {version}+next\n")
                       .replace(f"(= {version})", f"(= {version}+next)"))
        subprocess.run(["dpkg-deb", "--root-owner-group", "-Zgzip", "-z1", "-b", work + "/tree", folder], check=True,
                       stdout=subprocess.DEVNULL)


def apt_for_guest(image, *words):
    """This PC's apt, as if what is on the guest's disk were here, and nothing else."""
    return subprocess.run(
        ["apt-get", "-q", "-y", "-o", f"Dir::State::status={image}/status", "-o", f"Dir::Cache::archives={image}/archives",
         "-o", "Debug::NoLocking=true", "-o", "APT::Install-Recommends=false", "-o", "APT::Sandbox::User=root", *words],
        check=False, capture_output=True, text=True)


def make_repository(image, build, folder):
    """Telehug's packages, and all that they need and a clean guest has not; this is kept in the image's folder."""
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([SOURCE + "/deploy/packages/build", folder], check=True, stdout=subprocess.DEVNULL,
                   env={**os.environ, "TELEHUG_BUILD": build})
    packages = sorted(glob.glob(folder + "/telehug-*.deb"))
    os.makedirs(image + "/archives/partial", exist_ok=True)
    wanted = ["install", "--download-only", *packages]
    if apt_for_guest(image, *wanted).returncode != 0:  # the lists of packages may be older than the mirror
        subprocess.run(["apt-get", "-q", "update"], check=False, capture_output=True)
        done = apt_for_guest(image, *wanted)
        if done.returncode != 0:
            raise SystemExit(f"what the packages need can't be downloaded:\n{done.stdout}{done.stderr}")
    for package in packages:
        repack_as_next(package, folder)
    for archive in glob.glob(image + "/archives/*.deb"):
        shutil.copy(archive, folder)
    with open(folder + "/Packages", "wb") as index:
        subprocess.run(["dpkg-scanpackages", "--multiversion", "."], cwd=folder, check=True, stdout=index,
                       stderr=subprocess.DEVNULL)
