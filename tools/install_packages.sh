#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing of the packages named in tools/packages.txt and on the command line (as root, or through sudo).
set -euo pipefail
cd "$(dirname "$0")/.."
wanted=$(grep -v '^#' tools/packages.txt; printf '%s\n' "$@")
missing=()
for package in $wanted; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0
as_root=
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "these packages are missing and need root: ${missing[*]}" >&2; exit 1; }
  as_root=sudo
fi
# A line every tenth of the download and of the installation, of the lines "dlstatus:...:PERCENT:TEXT" and "pmstatus:..." of apt.
tell_tenths() {
  local stage='' told=0 kind percent text
  while IFS=: read -r kind _ percent text; do
    case $kind in dlstatus | pmstatus) ;; *) continue ;; esac
    [ "$kind" = "$stage" ] || told=-10
    stage=$kind
    [ $((${percent%.*} - told)) -ge 10 ] || continue
    told=${percent%.*}
    echo "  $told % $text"
  done
}
echo "installing: ${missing[*]}"
$as_root apt-get update -qq
install=(env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends)
if [ -t 1 ]; then # with apt's progress bar
  $as_root "${install[@]}" -q -o Dpkg::Progress-Fancy=1 "${missing[@]}"
else
  $as_root "${install[@]}" -qq -o APT::Status-Fd=1 "${missing[@]}" | tell_tenths
fi
