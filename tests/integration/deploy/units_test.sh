#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# units_test.sh UNITS PROGRAMS  would systemd accept the units in the folder UNITS, and how exposed would they be? They are
# to start the programs in the folder PROGRAMS.
set -eu
command -v systemd-analyze >/dev/null || { echo "skipped: there is no systemd-analyze here"; exit 0; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/system" "$folder/user" "$folder/run"
for unit in telehug-passive telehug-active-rig telehug-active; do
  kind=system
  [ $unit != telehug-active ] || kind=user
  sed "s|^ExecStart=[^ ]*/|ExecStart=$2/|" "$1/$unit.service" >"$folder/$kind/$unit.service"
done

fail() {
  echo "$1"
  exit 1
}

verify() {
  # It also speaks of units of this PC.
  said=$(XDG_RUNTIME_DIR=$folder/run systemd-analyze "$@" 2>&1 | grep -F "telehug" || true)
  [ -z "$said" ] || fail "$said"
}
verify --man=no verify "$folder/system/telehug-passive.service" "$folder/system/telehug-active-rig.service"
verify --man=no --user verify "$folder/user/telehug-active.service"

# exposure UNIT LIMIT  in tenths
exposure() {
  systemd-analyze security --no-pager --offline=true --threshold="$2" "$1" >"$folder/exposure" || result=$?
  tail -1 "$folder/exposure"
  [ "${result:-0}" -eq 0 ] || fail "that is more than $2 tenths"
}
exposure "$folder/system/telehug-passive.service" 20
exposure "$folder/system/telehug-active-rig.service" 20
exposure "$folder/user/telehug-active.service" 70

# What systemd would take for nothing, and so does not tell.
for unit in "$folder"/*/*.service; do
  for line in Type=notify Restart=always 'ExecReload=/bin/kill -HUP $MAINPID' NoNewPrivileges=yes UMask=0077; do
    grep -qxF "$line" "$unit" || fail "$unit: $line is missing"
  done
  for key in MemoryMax WatchdogSec; do grep -q "^$key=" "$unit" || fail "$unit: $key is missing"; done
  # What is missing may come back: that many starts never happen within the interval.
  number() { sed -n "s/^$1=//p" "$unit"; }
  [ $(($(number RestartSec) * $(number StartLimitBurst))) -gt "$(number StartLimitIntervalSec)" ] ||
    fail "$unit gives up after some starts"
done

# A group that is not there keeps a unit from starting: those that it needs come with the account, which makes them.
if grep -E '^(Supplementary)?Group=' "$folder"/system/* | grep -vE '=telehug$'; then fail "groups belong into sysusers.conf"; fi
