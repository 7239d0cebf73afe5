# Sourced by run, test and .ci/run: installs Debian packages, configures and builds, quietly.

caller=$PWD
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root" || exit 1

say() { printf '%s\n' "$*" >&2; }
die() { say "$*"; exit 1; }

# quietly WHAT COMMAND...: says WHAT when the command takes longer than a moment; its output is shown
# only when it fails, which ends the script.
quietly() {
    local what=$1 log timer code=0; shift
    log=$(mktemp)
    { sleep 0.7 </dev/null >/dev/null 2>&1 && say "$what ..."; } &
    timer=$!
    "$@" >"$log" 2>&1 || code=$?
    kill "$timer" 2>/dev/null || true
    wait "$timer" 2>/dev/null || true
    if ((code != 0)); then
        cat "$log" >&2
        rm -f "$log"
        die "$what failed: $*"
    fi
    rm -f "$log"
}

# packagesOf SECTION...: the packages of these sections of debian-packages.
packagesOf() {
    local section='' wanted=" $* " line
    while read -r line _ || [[ -n $line ]]; do
        case $line in
            '' | '#'*) ;;
            '['*']') section=${line#[}; section=${section%]} ;;
            *) if [[ $wanted == *" $section "* ]]; then printf '%s\n' "$line"; fi ;;
        esac
    done <debian-packages
}

# missingPackages PACKAGE...: those that are not installed. Asking dpkg takes hundredths of a
# second, so it is asked every time: no note of an earlier answer can be out of date.
missingPackages() {
    comm -13 <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null |
               sed -n 's/^installed //p' | sort -u) <(printf '%s\n' "$@" | sort -u)
}

asRoot() {
    if [[ $(id -u) == 0 ]]; then
        env DEBIAN_FRONTEND=noninteractive "$@"
    else
        sudo env DEBIAN_FRONTEND=noninteractive "$@"
    fi
}

# installPackages SECTION...: installs what is missing; does nothing when nothing is.
installPackages() {
    local -a wanted missing install
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        say "Not a Debian system, so nothing is installed here: debian-packages lists what is needed."
        return
    fi
    mapfile -t wanted < <(packagesOf "$@")
    mapfile -t missing < <(missingPackages "${wanted[@]}")
    if ((${#missing[@]} == 0)); then return; fi
    if [[ $(id -u) != 0 ]] && ! command -v sudo >/dev/null; then
        die "Missing packages can be installed by root only, and there is no sudo: ${missing[*]}"
    fi
    say "Installing Debian packages: ${missing[*]}"
    install=(asRoot apt-get install -y -qq --no-install-recommends "${missing[@]}")
    # Package lists that are absent or old make the first attempt fail; then they are renewed.
    if apt-cache show "${missing[@]}" >/dev/null 2>&1 && "${install[@]}" >/dev/null 2>&1; then
        return
    fi
    quietly "Updating the package lists" asRoot apt-get update -qq
    quietly "Downloading and installing" "${install[@]}"
}

# skipsIn PRESET: why tests that share a process were skipped by the last run of ctest, and how many; others ctest names.
skipsIn() {
    local log=build/$1/Testing/Temporary/LastTest.log
    if [[ ! -f $log ]]; then return; fi
    awk '/ Testing: / { shared = /_tests\.[0-9]+$/ }
         shared && /: Skipped$/ { getline; why[$0]++ }
         END { for (each in why) printf "%d skipped: %s\n", why[each], each }' "$log" | sort
}

# configure PRESET -DNAME=VALUE...: nothing when build/PRESET is configured with these values.
configure() {
    local preset=$1 flag configured=1; shift
    local cache=build/$preset/CMakeCache.txt
    if [[ ! -f build/$preset/build.ninja ]]; then configured=0; fi
    for flag in "$@"; do
        flag=${flag#-D}
        grep -q "^${flag%%=*}:[A-Z]*=${flag#*=}\$" "$cache" 2>/dev/null || configured=0
    done
    if ((configured)); then return; fi
    quietly "Configuring build/$preset" cmake --preset "$preset" "$@"
}

# build PRESET TARGET...
build() {
    local preset=$1; shift
    quietly "Building build/$preset (the first time takes minutes)" \
        cmake --build "build/$preset" --target "$@"
}
