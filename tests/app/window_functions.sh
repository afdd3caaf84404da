# For tests of the window under a real X server, with keys and a mouse: to be sourced. Ends the test with 'skipped' where
# Xvfb or xdotool is missing. Works in a folder of its own, $folder; sets $bad where something is wrong.
for tool in Xvfb xdotool; do
  command -v "$tool" >/dev/null || { echo "skipped: $tool is not installed"; exit 0; }
done
folder=$(mktemp -d)
cd "$folder" || exit 1
server=
program=
bad=0

finish() {
  [[ -n $program ]] && kill "$program" 2>/dev/null
  [[ -n $server ]] && kill "$server" 2>/dev/null
  rm -rf "$folder"
}
trap finish EXIT

wrong() { echo "$(basename "$0"): $*"; bad=1; }

# waits_for SECONDS COMMAND...: true as soon as the command is.
waits_for() {
  local end=$((SECONDS + $1))
  until "${@:2}"; do
    ((SECONDS > end)) && return 1
    sleep 0.1
  done
}

# start COMMAND...: the window, focused; its number in $window.
start() {
  "$@" >out.txt 2>err.txt &
  program=$!
  waits_for 30 found_window || { wrong "no window with: $* ($(cat err.txt))"; return 1; }
  xdotool windowfocus --sync "$window" 2>/dev/null
  sleep 0.3
}
found_window() { window=$(xdotool search --onlyvisible --name '^Otter: ' 2>/dev/null | tail -1) && [[ -n $window ]]; }

# Quits by Q, and the exit status is 0.
stop() {
  xdotool key q
  waits_for 20 is_gone || wrong "Q does not quit"
  wait "$program"
  local status=$?
  ((status == 0)) || wrong "exit status $status: $(cat err.txt)"
  [[ ! -s err.txt ]] || wrong "on stderr: $(cat err.txt)"
  program=
}
is_gone() { ! kill -0 "$program" 2>/dev/null; }
title_has() { [[ $(xdotool getwindowname "$window" 2>/dev/null) == *"$1"* ]]; }
title_lacks() { ! title_has "$1"; }
expect_title() { waits_for 10 title_has "$1" || wrong "$2: expected '$1' in the title, got '$(xdotool getwindowname "$window")'"; }
file_is_there() { compgen -G "$1" >/dev/null; }

exec 3<>display.txt
Xvfb -displayfd 3 -screen 0 1280x960x24 -nolisten tcp >/dev/null 2>&1 &
server=$!
has_display() { [[ -s display.txt ]]; }
waits_for 20 has_display || { echo "skipped: Xvfb does not start"; exit 0; }
DISPLAY=":$(tr -d '[:space:]' <display.txt)"
export DISPLAY
unset WAYLAND_DISPLAY
export SDL_VIDEODRIVER=x11
