#!/usr/bin/env bash
# Installs a .deb into a new Debian 12 and runs it there: clean_machine.sh PACKAGE.deb. Takes root,
# debootstrap and a network.
set -euo pipefail
package=$(realpath "$1")
root=$(mktemp -d)
cleanup() {
    for place in proc dev; do mountpoint -q "$root/$place" && umount "$root/$place"; done
    rm -rf --one-file-system "$root"
}
trap cleanup EXIT
debootstrap --variant=minbase bookworm "$root" > /dev/null
cp /etc/resolv.conf "$root/etc/"
for file in /etc/apt/apt.conf.d/99*; do [ ! -e "$file" ] || cp "$file" "$root/etc/apt/apt.conf.d/"; done
mount --bind /dev "$root/dev"
mount -t proc none "$root/proc"
cp "$package" "$root/tmp/abrdf.deb"
chroot "$root" bash -euc '
    export DEBIAN_FRONTEND=noninteractive HOME=/root
    apt-get update -qq
    apt-get install -y -qq --no-install-recommends /tmp/abrdf.deb > /dev/null
    cd /root
    abrdf --version
    abrdf demo cloth.zip --size 8 -q
    abrdf convert cloth.zip -o cloth.exr --method published --output-space ACEScg
    OCIO=/usr/share/abrdf/config.ocio abrdf convert cloth.zip -o same.exr --method published --output-space ACEScg -q
    cmp cloth.exr same.exr
    abrdf inspect cloth.exr > /dev/null
    abrdf preview cloth.exr -o cloth.png --size 64x64 -q
    dpkg -r abrdf > /dev/null
    [ ! -e /usr/bin/abrdf ] && [ ! -e /usr/share/abrdf ]'
echo "the package installs, runs and goes"
