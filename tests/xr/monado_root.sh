#!/bin/bash
# The tests labelled xr need Monado, an OpenXR runtime. Debian 12 packages none, so they are built and
# run inside a Debian 13: a folder outside the source tree, entered by chroot. So are those labelled
# imgui, of panels and of what opens before the window: its Dear ImGui is a newer one.
#   tests/xr/monado_root.sh make                 makes it, when it is not there: a few minutes, 1.3 GB
#   tests/xr/monado_root.sh test [CTEST ARGS]    builds the tests in it and runs them
#   tests/xr/monado_root.sh bench                builds and runs what measures against Monado, some minutes
#   tests/xr/monado_root.sh picture              makes the README's picture of it again
#   tests/xr/monado_root.sh run COMMAND...       any command, in its copy of the source tree
#   tests/xr/monado_root.sh there                succeeds when it is there
#   tests/xr/monado_root.sh --remove             removes it
# The folder: $ISOCHRON_MONADO_ROOT, else isochron/debian13 in the user's cache. Needs root, or sudo.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../.ci/setup.sh"

folder=${ISOCHRON_MONADO_ROOT:-${XDG_CACHE_HOME:-$HOME/.cache}/isochron/debian13}
ours=$folder/.isochron-root  # written first, and what may be removed by its being there
complete=$folder/.isochron-complete
# In it, of this checkout alone: files of another would be older than what is built of these.
inside=/isochron/$(basename "$root")-$(cksum <<<"$root" | cut -d ' ' -f 1)

# privately COMMAND...: what it mounts is seen by nobody else, and goes with it; so nothing of this
# machine can ever be reached by removing the folder. A system entered by chroot has no mount of its own
# whose propagation could be changed; should its mounts be shared, `remove` refuses what is left.
privately() {
    local propagation=private
    asRoot unshare --mount --propagation private true 2>/dev/null || propagation=unchanged
    asRoot unshare --mount --propagation "$propagation" "$@"
}

# enter COMMAND...: in the folder's system.
enter() {
    privately bash -c '
        mount -t proc proc "$0/proc" && mount --rbind /dev "$0/dev" && mount -t sysfs sysfs "$0/sys" &&
        exec chroot "$0" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 \
            DEBIAN_FRONTEND=noninteractive "$@"' "$folder" "$@"
}

mirror() { apt-get indextargets --format '$(REPO_URI)' | grep -v security | head -n 1; }

# The network as this machine reaches it.
useNetwork() {
    asRoot cp /etc/resolv.conf "$folder/etc/resolv.conf"
    if [[ -f /etc/apt/apt.conf ]]; then asRoot cp /etc/apt/apt.conf "$folder/etc/apt/apt.conf"; fi
    asRoot cp -r /etc/apt/apt.conf.d/. "$folder/etc/apt/apt.conf.d/"
}

# What it holds beyond Debian's smallest system.
packages() { packagesOf base tests xr; }

# A folder that an earlier checkout made may lack what this one's list has since gained: it is told by
# the list that the folder was completed with, and completed again.
isComplete() { [[ -f $complete ]] && packages | cmp -s - "$complete"; }

make() {
    if isComplete; then return; fi
    if [[ ! -f $complete ]]; then
        remove  # what an interrupted run has left
        command -v debootstrap >/dev/null || quietly "Installing debootstrap" \
            asRoot apt-get install -y -qq --no-install-recommends debootstrap
        asRoot mkdir -p "$folder"
        asRoot touch "$ours"
        quietly "Making a Debian 13 in $folder" privately \
            debootstrap --variant=minbase trixie "$folder" "$(mirror)"
    fi
    addPackages
}

addPackages() {
    local -a wanted
    mapfile -t wanted < <(packages)
    useNetwork
    quietly "Reading the package lists of $folder" enter apt-get update -qq
    quietly "Installing its packages" enter apt-get install -y -qq --no-install-recommends "${wanted[@]}"
    quietly "Cleaning up" enter apt-get clean
    packages | asRoot tee "$complete" >/dev/null
}

# The files that git knows or would take, as they are now, their times kept for the build.
copySource() {
    asRoot rm -rf --one-file-system "$folder$inside/source"
    asRoot mkdir -p "$folder$inside/source"
    git ls-files -co --exclude-standard -z |
        tar --create --null --files-from=- --ignore-failed-read 2>/dev/null |
        asRoot tar --extract --no-same-owner --directory "$folder$inside/source"
}

run() {
    isComplete || die "There is no Debian 13, or not all of it, in $folder: tests/xr/monado_root.sh make"
    copySource
    enter bash -c 'cd "$0/source" && "$@"' "$inside" "$@"
}

# built BUILD FLAGS TARGETS COMMAND...: builds the targets in it, then runs the command in the build's
# folder.
built() {
    run bash -c 'build=../$1
        source .ci/setup.sh
        quietly "Configuring in Debian 13" cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
            -DCMAKE_CXX_FLAGS_RELEASE="$2" -DISOCHRON_VTK=OFF -DISOCHRON_OPENVDB=OFF -DISOCHRON_WERROR=ON \
            -DCMAKE_UNITY_BUILD=ON
        quietly "Building in Debian 13" cmake --build "$build" --target $3
        cd "$build" && exec "${@:4}"' built "$@"
}

tests() {
    # Sooner compiled than as fast as can be.
    built build-tests "-O1 -DNDEBUG" "xr_tests panels_tests ui_over_tests" \
        ctest --no-tests=error --output-on-failure -j3 -L 'xr|imgui' "$@"
}
fast="-O3 -DNDEBUG"
bench() { built build "$fast" headset_frames tests/headset_frames; }
picture() {
    built build "$fast" headset_picture tests/headset_picture headset.png
    cp "$folder$inside/build/headset.png" app/gallery/headset.png
}

remove() {
    if [[ ! -e $folder ]]; then return; fi
    [[ -f $ours ]] || die "$folder was not made by this script: it is left alone"
    if grep -qF " $folder/" /proc/self/mountinfo; then die "Something is mounted in $folder: it is left alone"; fi
    asRoot rm -rf --one-file-system "$folder"
}

command=${1:-}
if (($# > 0)); then shift; fi
case $command in
    make) make ;;
    test) tests "$@" ;;
    bench) bench ;;
    picture) picture ;;
    run) run "$@" ;;
    there) isComplete ;;
    --remove) remove ;;
    *) die "$(sed -n '2,/^set/{s/^# \{0,1\}//;/^set/d;p}' "${BASH_SOURCE[0]}")" ;;
esac
