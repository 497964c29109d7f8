#!/usr/bin/env bash
# The GLFW window under Xvfb with real events: it opens, takes clicks, keys, text and the wheel, resizes and closes.
#   xvfb_test.sh WINDOW_PROGRAM [FOLDER]    FOLDER keeps the log and the picture
# Leaves with 77 where xvfb-run or xdotool is missing.
set -euo pipefail

if [ "${CELLCUT_IN_XVFB:-}" != yes ]; then
  for tool in xvfb-run xdotool; do
    command -v "$tool" >/dev/null || { echo "skipped: no $tool"; exit 77; }
  done
  unset WAYLAND_DISPLAY
  CELLCUT_IN_XVFB=yes exec xvfb-run -a -s "-screen 0 1280x1024x24" "$0" "$@"
fi

program=$1
folder=${2:-$(mktemp -d)}
[ $# -gt 1 ] || trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder"
log=$folder/log
"$program" "$folder/window.png" >"$log" 2>&1 &
pid=$!

fail() {
  echo "failed: $1; the program said:" >&2
  cat "$log" >&2
  kill "$pid" 2>/dev/null || true
  exit 1
}

# Waits until the program has said the line; generous, for the machine may be busy.
expect() {
  local i
  for ((i = 0; i < 600; ++i)); do
    if grep -qxE "$1" "$log"; then return 0; fi
    sleep 0.1
  done
  fail "never said '$1'"
}
at() { sed -n "s/^$1 //p" "$log" | head -n 1; }

expect "ready"
grep -qx "window glfw" "$log" || fail "it is no window on the display"
window=$(xdotool search --sync --name "^cellcut test$" | head -n 1)
[ "$(xdotool getwindowgeometry --shell "$window" | sed -n 's/WIDTH=//p')" = 640 ] || fail "the window is not 640 wide"
xdotool windowfocus "$window"

# shellcheck disable=SC2046  # two numbers are meant
xdotool mousemove --window "$window" $(at button) click 1
expect "clicked 1"
xdotool click 1
expect "clicked 2"
xdotool key F2
expect "F2 1"
# shellcheck disable=SC2046
xdotool mousemove --window "$window" $(at field) click 1
xdotool type --delay 5 "cut 42"
expect "text cut 42"
xdotool click 4
expect "wheel 1"

xdotool windowsize "$window" 800 500
expect "size 800 500"
xdotool windowsize "$window" 333 222
expect "size 333 222"
xdotool windowsize "$window" 900 600
expect "size 900 600"

# Without a window manager nobody turns a close button into the message that it sends.
if command -v python3 >/dev/null; then
  python3 "$(dirname "$0")/close_window.py" "$window"
else
  xdotool key Escape
fi
expect "closed"
wait "$pid" || fail "it left with $?"
[ "$(grep -c '^clicked' "$log")" = 2 ] || fail "clicks were counted twice"
echo "the window took all of it"
