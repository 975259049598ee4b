#!/bin/bash
# Runs the real window under a virtual display and drives it with mouse and keys.
#
#   tests/smoke/run.sh [PATH OF THE PROGRAM]      default: target/debug/spline-lab
#
# Set SPLINE_LAB_SMOKE_KEEP to a folder to keep the screenshots and the program's log.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"
program="${1:-${CARGO_TARGET_DIR:-$here/../../target}/debug/spline-lab}"
if [ ! -x "$program" ]; then
    echo "smoke: there is no program $program; build it with cargo build" >&2
    exit 1
fi
program="$(realpath "$program")"
for tool in Xvfb xdotool import identify python3; do
    if ! command -v "$tool" >/dev/null; then
        echo "smoke: $tool is missing; on Debian: apt-get install xvfb xdotool imagemagick python3" >&2
        exit 1
    fi
done

folder="$(mktemp -d)"
display_server=""
clean_up() {
    if [ -n "$display_server" ]; then
        kill "$display_server" 2>/dev/null || true
        wait "$display_server" 2>/dev/null || true
    fi
    rm -rf "$folder"
}
trap clean_up EXIT

# Xvfb picks a free display number and writes it down once it takes clients.
Xvfb -displayfd 3 -screen 0 1280x900x24 -nolisten tcp -noreset 3>"$folder/display" 2>"$folder/xvfb.log" &
display_server=$!
for _ in $(seq 100); do
    [ -s "$folder/display" ] && break
    if ! kill -0 "$display_server" 2>/dev/null; then
        cat "$folder/xvfb.log" >&2
        echo "smoke: Xvfb did not start" >&2
        exit 1
    fi
    sleep 0.1
done
if [ ! -s "$folder/display" ]; then
    echo "smoke: Xvfb named no display within 10 s" >&2
    exit 1
fi
DISPLAY=":$(cat "$folder/display")"
export DISPLAY
unset WAYLAND_DISPLAY WAYLAND_SOCKET DBUS_SESSION_BUS_ADDRESS

python3 "$here/drive.py" "$program" "$here/start.spline" "$folder"
