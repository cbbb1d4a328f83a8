#!/bin/bash
# demo_launch_ends_test.sh DEVEL_FOLDER EXPORT_MESHES: demo.launch ends by itself, all frames have been tracked and
# recorded, and no process is left.
set -eu
devel=$1 export_meshes=$2
readonly frames=6

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export PATH=/usr/bin:/bin:$PATH
set +u
source "$devel/setup.bash"
set -u
port=$(python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
export ROS_IP=127.0.0.1 ROS_MASTER_URI=http://127.0.0.1:$port ROS_HOME=$folder ROS_LOG_DIR=$folder
unset ROS_HOSTNAME

fail() {
  echo "$*" >&2
  cat "$folder/roslaunch.txt" >&2
  exit 1
}

timeout --signal=INT 200 roslaunch --port="$port" particle_surface_tracker demo.launch rviz:=false frames:=$frames \
  spacing:=0.05 mesh:="$folder/ring with space.ply" record:="$folder/recorded.bag" timeout:=120 \
  >"$folder/roslaunch.txt" 2>&1 || fail "roslaunch ended with $?"
"$export_meshes" --bag "$folder/recorded.bag" --topic /tracker/mesh --out "$folder/meshes" || fail "no meshes"
count=$(find "$folder/meshes" -name 'frame_*.ply' | wc -l)
((count == frames)) || fail "$count of $frames meshes were recorded"
! pgrep -f "$folder" >/dev/null || fail "processes are left: $(pgrep -af "$folder")"
