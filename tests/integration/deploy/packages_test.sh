#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# packages_test.sh SOURCE BUILD  are the Debian packages of a build right, and do they install, upgrade and purge?
set -euo pipefail
source=$1
build=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() {
  echo "FAILED: $*"
  exit 1
}

echo "--- built"
TELEHUG_BUILD=$build SOURCE_DATE_EPOCH=1700000000 "$source/deploy/packages/build" "$folder/repository"
cd "$folder/repository"
sed -n 's/^Filename: //p' Packages | sort | diff - <(ls -d ./*.deb) || fail "the index is not of these packages"

echo "--- their files"
list() {
  local part
  for part in common active passive; do
    # The book grows; everything else is listed.
    dpkg-deb -c telehug-${part}_*.deb | awk -v part=$part '$6 !~ /\/$/ && $6 !~ /doc\/telehug-common\/docs\// {print part, $1, $2, $6}'
  done
}
list | diff "$source/tests/integration/deploy/packages.golden" - || fail "other files than in packages.golden"
for package in *.deb; do
  dpkg-deb --fsys-tarfile "$package" | TZ=UTC tar -tv --full-time | grep -v ' 2023-11-14 22:13:20 ' &&
    fail "$package has files that are not of SOURCE_DATE_EPOCH"
done

echo "--- what they say of themselves"
says() {
  dpkg-deb -f telehug-"$1"_*.deb "$2" | grep -qE -- "$3" || fail "$1: $2 is '$(dpkg-deb -f telehug-"$1"_*.deb "$2")'"
}
version=$(sed -n 's/^project(telehug VERSION \([0-9.]*\) .*/\1/p' "$source/CMakeLists.txt")
for part in common active passive; do
  says $part Version "^$version-1$"
  says $part Architecture "^$(dpkg --print-architecture)$"
  says $part Source '^telehug$'
  says $part Depends 'libc6 \(>= '
done
says active Depends "^telehug-common \(= $version-1\), libpipewire-0.3-modules, "
says passive Depends "^telehug-common \(= $version-1\), "
says passive Depends 'libfastrtps'
# The wearer's PC may be a small one.
dpkg-deb -f telehug-passive_*.deb Depends | grep -E 'opencv|xcb|pipewire' && fail "passive: needs a desktop's libraries"
[ "$(dpkg-deb -I telehug-active_*.deb conffiles)" = /etc/telehug/active.toml ] || fail "active: conffiles"
[ "$(dpkg-deb -I telehug-passive_*.deb conffiles)" = /etc/telehug/passive.toml ] || fail "passive: conffiles"

echo "--- lintian"
said=$(lintian --tag-display-limit 0 --fail-on error,warning --allow-root ./*.deb 2>&1) || fail "$said"
desktop-file-validate "$source/deploy/desktop/telehug.desktop"

echo "--- programs find what comes with them"
# finds ROOT  in ROOT/bin and ROOT/share
finds() {
  [ "$("$1/bin/telehug" --version)" = "$version" ] || fail "telehug tells another version"
  "$1/bin/telehug-passive" check-jacket duemilanove-16.toml >/dev/null || fail "no jackets are found in $1"
  "$1/bin/telehug-active" show-boxes "$source/tests/fixtures/chat/01_full.jpg" --out "$folder/boxes.png" | grep -q '^face ' ||
    fail "no model is found in $1"
  # It names the file before it fails at the port.
  { "$1/bin/telehug" jacket flash --yes --port /dev/null 2>/dev/null || true; } |
    grep -qF "$1/share/telehug/firmware/telehug-jacket.hex" || fail "no firmware is found in $1"
  [ -f "$1/share/telehug/firmware/telehug-jacket.elf" ] || fail "no firmware for the simulated jacket in $1"
  local code=0
  timeout 1 "$1/bin/telehug-jacket-sim" >/dev/null 2>"$folder/errors" || code=$?
  [ $code -eq 124 ] || [ $code -eq 0 ] || fail "the simulated jacket does not run: $(cat "$folder/errors")"
}
mkdir "$folder/unpacked"
for package in *.deb; do dpkg-deb -x "$package" "$folder/unpacked"; done
finds "$folder/unpacked/usr"
if strings -a "$folder"/unpacked/usr/bin/* | grep -F "$source"; then fail "the source's folder is in a program"; fi
for unit in "$folder"/unpacked/lib/systemd/system/*.service "$folder"/unpacked/usr/lib/systemd/user/*.service; do
  grep -qE '^ExecStart=/usr/bin/telehug-(active|passive) run$' "$unit" || fail "$unit starts something else"
done

echo "--- cmake --install, with other prefixes"
DESTDIR=$folder/staged cmake --install "$build" --prefix /opt/hug >/dev/null
[ "$(cd "$folder/staged" && find . -mindepth 1 -maxdepth 2 | sort | xargs)" = './opt ./opt/hug' ] || fail "DESTDIR or prefix is not honoured"
grep -qx 'ExecStart=/opt/hug/bin/telehug-passive run' "$folder/staged/opt/hug/lib/systemd/system/telehug-passive.service" ||
  fail "the unit does not know the prefix"
mv "$folder/staged/opt/hug" "$folder/moved"
finds "$folder/moved"

if [ "$(id -u)" -ne 0 ]; then
  echo "skipped: installing into a folder needs root"
  exit 0
fi

echo "--- installed, upgraded, removed and purged in a folder"
root=$folder/root
mkdir -p "$root"/var/lib/dpkg/{info,updates} "$root"/etc "$root"/run
touch "$root/var/lib/dpkg/status"
printf 'root:x:0:0:root:/root:/bin/sh\n' >"$root/etc/passwd"
printf 'root:x:0:\n' >"$root/etc/group"
in_root() {
  dpkg --root="$root" --log="$folder/log" --force-script-chrootless --force-depends "$@" >"$folder/said" 2>&1 ||
    fail "dpkg $*: $(cat "$folder/said")"
}
in_root -i ./*.deb
grep -q '^telehug:x:.*:/var/lib/telehug:/usr/sbin/nologin$' "$root/etc/passwd" || fail "no account"
for group in dialout bluetooth gpio video; do
  grep -qE "^$group:.*:telehug$" "$root/etc/group" || fail "the account is not in the group $group"
done
[ "$(stat -c %a "$root/var/lib/telehug")" = 700 ] || fail "the state folder is open to others"
[ -L "$root/etc/systemd/system/multi-user.target.wants/telehug-passive.service" ] || fail "the passive side is not enabled"
[ -L "$root/etc/systemd/user/graphical-session.target.wants/telehug-active.service" ] || fail "the active side is not enabled"
[ ! -e "$root/etc/systemd/system/multi-user.target.wants/telehug-active-rig.service" ] || fail "the rig's unit is enabled"

# What people make and change.
sed -i 's/^#level = .*/level = "debug"/' "$root/etc/telehug/passive.toml"
printf '[log]\n' >"$root/etc/telehug/passive.d/10-mine.toml"
mkdir -p "$root/var/lib/telehug/pairs/passive/0123456789abcdef"
rm "$root/etc/systemd/system/multi-user.target.wants/telehug-passive.service"
# The same packages as another release.
mkdir "$folder/newer"
for package in *.deb; do
  dpkg-deb -R "$package" "$folder/newer/tree"
  sed -i "s/$version-1/$version-2/" "$folder/newer/tree/DEBIAN/control"
  dpkg-deb -Znone --root-owner-group -b "$folder/newer/tree" "$folder/newer" >/dev/null
  rm -r "$folder/newer/tree"
done
cd "$folder/newer"
in_root -i ./*.deb
[ "$(dpkg --root="$root" -l | awk '/^ii/ {print $3}' | sort -u)" = "$version-2" ] || fail "not upgraded"
grep -qx 'level = "debug"' "$root/etc/telehug/passive.toml" || fail "a changed configuration was overwritten"
[ ! -e "$root/etc/systemd/system/multi-user.target.wants/telehug-passive.service" ] || fail "a disabled unit was enabled"

in_root -r telehug-active telehug-passive telehug-common
grep -qx 'level = "debug"' "$root/etc/telehug/passive.toml" || fail "removing took the configuration away"
in_root -P telehug-active telehug-passive telehug-common
# Beside what other packages' tools keep: accounts, dpkg's and systemd's own folders.
left=$(cd "$root" && find etc var run \( -path var/lib/dpkg -o -path 'etc/*passwd*' -o -path 'etc/*group*' -o -path 'etc/*shadow*' \
  -o -path etc/.pwd.lock \) -prune -o \( ! -type d -o -name '*telehug*' -o -path '*/telehug/*' \) -print | sort | xargs)
expected='etc/telehug etc/telehug/passive.d etc/telehug/passive.d/10-mine.toml var/lib/telehug var/lib/telehug/pairs'
expected="$expected var/lib/telehug/pairs/passive var/lib/telehug/pairs/passive/0123456789abcdef"
[ "$left" = "$expected" ] || fail "purging leaves: $left"
echo "all is right"
