# Jobs in the background, ports and displays, for scripts that run live nodes. To be sourced; needs fail().

# in_background COMMAND…: starts a job in a process group of its own: Ctrl-C does not reach it, the script ends all in
# order. Its process is $!.
in_background() {
  set -m
  "$@" &
  set +m
}

# end_job PROCESS: ends a job and all that it started; roslaunch needs a while for that.
end_job() {
  local pid=$1 tenths
  [[ -n $pid ]] || return 0
  kill -INT "$pid" 2>/dev/null || true
  for ((tenths = 0; tenths < 250; ++tenths)); do
    kill -0 "$pid" 2>/dev/null || break
    sleep 0.1
  done
  kill -KILL -- "-$pid" 2>/dev/null || true
  wait "$pid" 2>/dev/null || true
}

free_port() {
  python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'
}

require_localhost() {
  getent hosts localhost >/dev/null ||
    fail "roslaunch needs the name localhost, which /etc/hosts does not have. As root: echo '127.0.0.1 localhost' >>/etc/hosts"
}

# open_virtual_screen LOG_FOLDER: sets DISPLAY, and screen_pid to the job to end.
open_virtual_screen() {
  local number_file=$1/display tenths
  in_background Xvfb -displayfd 3 -screen 0 1400x900x24 +extension GLX +render -noreset -nolisten tcp \
    3>"$number_file" >"$1/xvfb.log" 2>&1
  screen_pid=$!
  for ((tenths = 0; tenths < 200; ++tenths)); do
    [[ ! -s $number_file ]] || break
    kill -0 "$screen_pid" 2>/dev/null || break
    sleep 0.1
  done
  [[ -s $number_file ]] || fail "Xvfb gives no display; see $1/xvfb.log"
  DISPLAY=:$(<"$number_file")
  export DISPLAY LIBGL_ALWAYS_SOFTWARE=1 QT_X11_NO_MITSHM=1
}
