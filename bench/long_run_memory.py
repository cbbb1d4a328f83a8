#!/usr/bin/env python3
"""Whether memory grows over 1,000 frames: two_drops forth and back, many times. track_bag must be in PATH.

Up to frame 3 the drops have not met, so the mesh stays the same and memory should. With --turn 39 they merge and come
apart every time; the mesh then grows, and memory with it.
"""
import argparse
import pathlib
import tempfile

from rosbags.rosbag1 import Reader, Writer
from rosbags.typesys import Stores, get_typestore
from tracking_report import spacing_of, track

LARGEST_GROWTH = 0.01  # Of the peak, from when everything has been used once to the last frame.


def write_loop(source, target, turn, frames):
    """A bag that plays the first frames of another one forth and back."""
    types = get_typestore(Stores.ROS1_NOETIC)
    with Reader(source) as reader:
        clouds = [types.deserialize_ros1(data, connection.msgtype) for connection, _, data in reader.messages()][:turn + 1]
    way = clouds + clouds[-2:0:-1]
    with Writer(target) as writer:
        connection = writer.add_connection("/particles", "sensor_msgs/msg/PointCloud2", typestore=types)
        for n in range(frames):
            cloud = way[n % len(way)]
            cloud.header.stamp.sec, cloud.header.stamp.nanosec = 1000 + n // 60, n % 60 * 16666667
            time = cloud.header.stamp.sec * 10**9 + cloud.header.stamp.nanosec
            writer.write(connection, time, types.serialize_ros1(cloud, "sensor_msgs/msg/PointCloud2"))


def first_with_operation(lines):
    """The first frame in which mesh upkeep did something: until then it has not used its working memory."""
    for number, line in enumerate(lines):
        if any(line["upkeep"][kind] for kind in ("splits", "collapses", "flips")):
            return number
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=pathlib.Path, required=True, help="folder with two_drops.bag, .ply and .json")
    parser.add_argument("--frames", type=int, default=1000, help="how many frames (default 1000)")
    parser.add_argument("--turn", type=int, default=3, help="frame at which it turns back (default 3)")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        loop = pathlib.Path(folder) / "loop.bag"
        write_loop(arguments.data / "two_drops.bag", loop, arguments.turn, arguments.frames)
        lines = track(loop, arguments.data / "two_drops.ply", spacing_of(arguments.data, "two_drops"))
    peaks = [line["peak_rss_bytes"] / 2**20 for line in lines]
    triangles = [line["triangles"] for line in lines]
    print(f"two_drops to frame {arguments.turn} and back, {len(lines)} frames:")
    for frame in sorted({len(lines) * k // 10 for k in range(1, 10)} | {len(lines) - 1}):
        print(f"  to frame {frame:>4}: peak memory {peaks[frame]:6.1f} MiB, most triangles {max(triangles[:frame + 1]):,}")
    begin = max(len(lines) // 4, first_with_operation(lines))
    growth = peaks[-1] / peaks[begin] - 1
    print(f"growth from frame {begin} on, by when mesh upkeep has worked: {100 * growth:.2f} % "
          f"(at most {100 * LARGEST_GROWTH:g} %): {'met' if growth <= LARGEST_GROWTH else 'NOT MET'}\n")


if __name__ == "__main__":
    main()
