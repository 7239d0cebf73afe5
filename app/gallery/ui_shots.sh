#!/bin/bash
# Makes the README's pictures of the window again, without a display: app/gallery/ui_shots.sh [FILE]
# [OPTIONS...], a data set of one's own as `isochron view` takes it, which becomes out/window.png.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../.ci/setup.sh"

installPackages base vtk tests
configure release -DBUILD_TESTING=ON
build release isochron ui_shot
shot=build/release/tests/ui/ui_shot
cd "$root"

if (($# > 0)); then
    mkdir -p out
    cd "$caller"
    exec "$root/$shot" "$root/out/window.png" "$@"
fi
"$shot" app/gallery/window.png datasets/pool_fire_T.nc --step 14 \
    --range 320:400 --color '#5b9bd5' --opacity 0.05 \
    --range 600:1000 --color '#e0562b' --opacity 0.12 \
    --range '(1000,max]' --color '#ffe08a' --opacity 0.5
"$shot" app/gallery/window_start.png
