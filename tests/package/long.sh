#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Long form of the tests of packages: tests/package/long.sh [BUILD_FOLDER], as root, some ten minutes, about 3 GB in TMPDIR. Makes the
# packages of a finished build, installs them in a bare Debian 12 (debootstrap), and there, as a user without rights: runs an example to its
# report and an export, builds the example of the libraries. Removing the packages must leave nothing behind.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=$(realpath "${1:-build/release}")
[ "$(id -u)" -eq 0 ] || { echo "tests/package/long.sh needs root, for debootstrap and chroot" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "debootstrap is missing: apt-get install debootstrap" >&2; exit 1; }
work=$(mktemp -d)
root=$work/root
clean_up() {
  for folder in proc sys; do
    ! mountpoint -q "$root/$folder" || umount "$root/$folder"
  done
  rm -rf --one-file-system "$work"
}
trap clean_up EXIT
inside() { chroot "$root" env -i PATH=/usr/bin:/bin:/usr/sbin:/sbin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive ${http_proxy:+http_proxy="$http_proxy"} "$@"; }
user() { chroot --userspec=nobody:nogroup "$root" env -i PATH=/usr/bin:/bin LC_ALL=C.UTF-8 HOME=/tmp "$@"; }
step() { echo "== $*"; }

step "packages"
(cd "$build" && cpack -G DEB -B "$work/packages" >/dev/null 2>&1)
step "a bare Debian 12"
debootstrap --variant=minbase bookworm "$root" "${FRETWORK_DEBIAN_MIRROR:-http://deb.debian.org/debian}" >"$work/log" || { tail "$work/log"; exit 1; }
mount --bind /proc "$root/proc" # the program finds its parts by /proc/self/exe, hwloc the processors by /sys
mount --bind /sys "$root/sys"
cp "$work"/packages/*.deb "$root/root/"
install_packages() { inside apt-get install -y -qq --no-install-recommends "$@" >"$work/log" 2>&1 || { tail "$work/log"; exit 1; }; }

step "the program with what it recommends"
recommended=$(dpkg-deb -f "$root"/root/fretwork_*.deb Recommends | tr -d ,)
# shellcheck disable=SC2086 # a word a package
install_packages "/root/$(basename "$root"/root/fretwork_*.deb)" $recommended
inside fretwork --version
for study in cantilever_stop straight_tube; do # a mesh; a geometry, by gmsh
  user cp -r "/usr/share/doc/fretwork/examples/$study" "/tmp/$study"
  user fretwork run "/tmp/$study/study.toml" | tail -n 2
  user test -s "/tmp/$study/study.results/report.html"
done
user fretwork export /tmp/straight_tube/study.results --format vtu

step "the libraries"
install_packages "/root/$(basename "$root"/root/libfretwork-dev_*.deb)" cmake g++ make
user cmake -S /usr/share/doc/fretwork/examples/library -B /tmp/library >"$work/log" || { cat "$work/log"; exit 1; }
user cmake --build /tmp/library
user /tmp/library/cantilever /tmp/cantilever_stop/beam.msh

step "removal"
inside apt-get purge -y -qq fretwork libfretwork-dev >"$work/log" 2>&1 || { tail "$work/log"; exit 1; }
left=$(find "$root/usr" -ipath '*fretwork*' | head)
[ -z "$left" ] || { echo "left behind: $left" >&2; exit 1; }
step "passed"
