#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# units_test.sh UNIT PROGRAM  would systemd accept the unit, and how exposed would it be?
set -eu
command -v systemd-analyze >/dev/null || { echo "skipped: there is no systemd-analyze here"; exit 0; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
unit=$folder/$(basename "$1")
sed "s|^ExecStart=[^ ]*|ExecStart=$2|" "$1" >"$unit"
said=$(systemd-analyze verify --man=no "$unit" 2>&1 | grep -F "$(basename "$1")" || true)
[ -z "$said" ] || { echo "$said"; exit 1; }
systemd-analyze security --no-pager --offline=true --threshold=20 "$unit" | tail -1
systemd-analyze security --no-pager --offline=true --threshold=20 "$unit" >/dev/null
