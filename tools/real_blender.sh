#!/usr/bin/env bash
# A real Blender, with its window, in a Debian chroot: no display server, no effect on the host.
#
#   tools/real_blender.sh install [--version sid|trixie]   install (without --version: sid, else trixie)
#   tools/real_blender.sh run [--version V] [--gui] -- CMD  run CMD inside; --gui: under Xvfb, 1600x900
#   tools/real_blender.sh shell [--version V]              a shell inside
#   tools/real_blender.sh path [--version V]               the chroot's directory; exit 3 if not installed
#   tools/real_blender.sh remove [--version V]             delete the chroot
#
# Chroots are kept in ${TRG_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/trg}/real-blender. The checkout, a
# `shared` directory beside it and /tmp are visible inside at their own paths. Mounts and processes
# live in a namespace of their own and vanish with the command. TRG_DEBIAN_MIRROR names a Debian
# mirror; without it the mirror of the host's own apt sources is used.
# Exit status of `run` is that of CMD; 3 means that there is no real Blender, with the reason.
set -euo pipefail

ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
CACHE=${TRG_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/trg}/real-blender
PACKAGES=(blender python3-numpy python3-cattr python3-requests python3-zstandard
    xvfb xauth xdotool imagemagick libegl1 libgl1-mesa-dri mesa-vulkan-drivers)
RECIPE=1    # raise it when what is installed changes: older chroots are then made anew

fail() {
    echo "real_blender: $*" >&2
    exit 3
}

usage() {
    sed -n '2,/^set -/p' "${BASH_SOURCE[0]}" | sed -n 's/^# \{0,1\}//p' >&2
    exit 2
}

is_installed() { [ -f "$CACHE/$1/.finished-$RECIPE" ]; }

# The version asked for, or the first one that is installed.
choose_installed() {
    local version
    for version in ${1:-sid trixie}; do
        if is_installed "$version"; then
            echo "$version"
            return
        fi
    done
    fail "no real Blender${1:+ ($1)} is installed: run 'tools/real_blender.sh install'"
}

require_root() {
    [ "$(id -u)" = 0 ] || fail "a chroot needs root: run this as root or by sudo -E"
    unshare --mount true 2>/dev/null ||
        fail "this machine allows no mount namespace (unshare --mount failed): a container may need CAP_SYS_ADMIN"
}

# The Debian mirror of the host's own apt sources.
find_mirror() {
    if [ -n "${TRG_DEBIAN_MIRROR:-}" ]; then
        echo "$TRG_DEBIAN_MIRROR"
        return
    fi
    apt-get indextargets --format '$(ORIGIN)|$(SUITE)|$(REPO_URI)' 'Created-By: Packages' 2>/dev/null |
        awk -F'|' '$1 == "Debian" && $2 !~ /security/ { print $3; exit }'
}

mirror_from_sources() {
    cat /etc/apt/sources.list /etc/apt/sources.list.d/*.list /etc/apt/sources.list.d/*.sources 2>/dev/null |
        grep -v '^ *#' | grep -oE '(https?|file)://[^ ]+' | grep -v security | grep -m1 debian || true
}

ensure_debootstrap() {
    command -v debootstrap >/dev/null && return
    command -v apt-get >/dev/null || fail "debootstrap is not installed and there is no apt-get to get it"
    apt-get install -y --no-install-recommends debootstrap >/dev/null ||
        { apt-get update && apt-get install -y --no-install-recommends debootstrap; } >/dev/null ||
        fail "apt-get could not install debootstrap"
}

# The host's way to the mirror (proxy, time checks, name server) is the chroot's as well; files with
# hooks are left out because they call programs of the host.
copy_network_settings() {
    local target=$1 file
    mkdir -p "$target/etc/apt/apt.conf.d" "$target/etc/dpkg/dpkg.cfg.d"
    for file in /etc/apt/apt.conf /etc/apt/apt.conf.d/*; do
        [ -f "$file" ] && ! grep -q 'Invoke' "$file" && cp "$file" "$target/etc/apt/apt.conf.d/"
    done
    [ -e /etc/resolv.conf ] && cp -L /etc/resolv.conf "$target/etc/resolv.conf"
    [ -e /etc/hosts ] && cp -L /etc/hosts "$target/etc/hosts"
    ln -sf /proc/self/mounts "$target/etc/mtab"
    printf 'force-unsafe-io\n' >"$target/etc/dpkg/dpkg.cfg.d/trg"
    printf 'path-exclude /usr/share/%s/*\n' doc man locale >>"$target/etc/dpkg/dpkg.cfg.d/trg"
    printf '#!/bin/sh\nexit 101\n' >"$target/usr/sbin/policy-rc.d"
    chmod +x "$target/usr/sbin/policy-rc.d"
}

install_version() {
    local version=$1 target=$CACHE/$1 log=$CACHE/$1.log mirror
    is_installed "$version" && return
    ensure_debootstrap
    mirror=$(find_mirror)
    mirror=${mirror:-$(mirror_from_sources)}
    [ -n "$mirror" ] || fail "no Debian mirror in the apt sources: set TRG_DEBIAN_MIRROR"
    echo "real_blender: installing Blender of Debian $version (log: $log)" >&2
    rm -rf --one-file-system "$target"
    debootstrap --variant=minbase --include=ca-certificates "$version" "$target" "$mirror" >"$log" 2>&1 &&
        copy_network_settings "$target" &&
        enter "$target" apt-get update >>"$log" 2>&1 &&
        enter "$target" env DEBIAN_FRONTEND=noninteractive \
            apt-get install -y --no-install-recommends "${PACKAGES[@]}" >>"$log" 2>&1 &&
        enter "$target" apt-get clean >>"$log" 2>&1 &&
        enter "$target" blender --version >>"$log" 2>&1 || return 1
    touch "$target/.finished-$RECIPE"
}

# One installer at a time; a half-made chroot has no marker and is made anew.
install() {
    local wanted=$1 version
    require_root
    mkdir -p "$CACHE"
    exec 9>"$CACHE/.lock"
    flock 9
    for version in ${wanted:-sid trixie}; do
        if install_version "$version"; then
            echo "$CACHE/$version"
            return
        fi
        echo "real_blender: Debian $version failed:" >&2
        tail -n 5 "$CACHE/$version.log" >&2
    done
    fail "no version could be installed"
}

# Run a command inside a chroot, in a namespace: the host never sees a mount.
enter() {
    local target=$1
    shift
    unshare --mount --pid --fork --kill-child bash -c "$INSIDE" enter "$target" "$ROOT" "$PWD" "$@"
}

# The same in place of this shell: whoever kills it kills all that runs inside.
enter_for_good() {
    local target=$1
    shift
    exec unshare --mount --pid --fork --kill-child bash -c "$INSIDE" enter "$target" "$ROOT" "$PWD" "$@"
}

# The part that runs in the namespace, before the command.
INSIDE='
set -euo pipefail
target=$1 root=$2 directory=$3
shift 3
bind() { mkdir -p "$target$1"; mount --rbind "$1" "$target$1"; }
mount -t proc proc "$target/proc"
bind /dev
bind /sys
bind /tmp
bind "$root"
[ ! -d "$root/../shared" ] || bind "$(cd "$root/../shared" && pwd -P)"
[ -d "$target$directory" ] || directory=$root
exec chroot "$target" /usr/bin/env -u LD_LIBRARY_PATH -u PYTHONPATH -u PYTHONHOME -u VIRTUAL_ENV \
    HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 LIBGL_ALWAYS_SOFTWARE=1 \
    sh -c '\''cd "$1" && shift && exec "$@"'\'' sh "$directory" "$@"
'

# Runs inside: a command under an X server of its own, whose number the server picks itself.
GUI='
display=$(mktemp)
Xvfb -displayfd 3 -screen 0 1600x900x24 -nolisten tcp 3>"$display" 2>/dev/null &
server=$!
for _ in $(seq 100); do [ -s "$display" ] && break; sleep 0.1; done
[ -s "$display" ] || { echo "real_blender: Xvfb did not start" >&2; exit 3; }
export DISPLAY=:$(cat "$display")
rm -f "$display"
"$@"
status=$?
kill "$server" 2>/dev/null
exit "$status"
'

main() {
    local verb=${1:-} version='' gui=0
    [ $# -gt 0 ] && shift
    while [ $# -gt 0 ]; do
        case $1 in
            --version) version=${2:?--version needs sid or trixie}; shift 2 ;;
            --gui) gui=1; shift ;;
            --) shift; break ;;
            *) usage ;;
        esac
    done
    case $version in '' | sid | trixie) ;; *) usage ;; esac

    case $verb in
        install) install "$version" ;;
        path)
            version=$(choose_installed "$version")
            echo "$CACHE/$version"
            ;;
        run)
            [ $# -gt 0 ] || usage
            version=$(choose_installed "$version")
            require_root
            if [ "$gui" = 1 ]; then
                set -- bash -c "$GUI" gui "$@"
            fi
            enter_for_good "$CACHE/$version" "$@"
            ;;
        shell)
            version=$(choose_installed "$version")
            require_root
            enter_for_good "$CACHE/$version" bash -i
            ;;
        remove) rm -rf --one-file-system "${CACHE:?}/${version:?remove needs --version}" ;;
        *) usage ;;
    esac
}

# Read whole before it runs, so that the file may change meanwhile.
main "$@"
exit
