#!/usr/bin/env python3
"""CPU time of every stage of the tracker, relative to what splashsurf needs to reconstruct the same frames.

Both work on melting_bunny in one run and in turns: splashsurf on all frames, then track_bag, and so on. CPU seconds are
those of the process, all threads, two threads each; medians over frames and turns. track_bag must be in PATH.
"""
import argparse
import os
import pathlib
import statistics
import time

os.environ.setdefault("RAYON_NUM_THREADS", "2")

import numpy as np  # noqa: E402
import pysplashsurf  # noqa: E402
from rosbags.rosbag1 import Reader  # noqa: E402
from rosbags.typesys import Stores, get_typestore  # noqa: E402
from tracking_report import spacing_of, track  # noqa: E402

# Rows of the table: name, stages, largest ratio to splashsurf. None: no limit of its own, or all stages.
ROWS = [
    ("implicit surface", ["implicit_function", "triangulation"], 0.20),
    ("  implicit_function", ["implicit_function"], None),
    ("  triangulation", ["triangulation"], None),
    ("distance_field", ["distance_field"], 0.12),
    ("advection", ["advection"], 0.08),
    ("projection", ["projection"], 0.10),
    ("measures", ["measures"], None),
    ("all stages", None, 0.50),
]


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=pathlib.Path, required=True, help="folder with melting_bunny.bag, .ply and .json")
    parser.add_argument("--runs", type=int, default=3, help="turns of each program (default 3)")
    parser.add_argument("--last", type=int, default=99, help="last frame (default 99)")
    return parser.parse_args()


def read_frames(path, last):
    """Positions of frames 1 to last; frame 0 only starts the tracker."""
    types = get_typestore(Stores.ROS1_NOETIC)
    frames = []
    with Reader(path) as reader:
        for index, (connection, _, data) in enumerate(reader.messages()):
            if index > last:
                break
            cloud = types.deserialize_ros1(data, connection.msgtype)
            offsets = {field.name: field.offset for field in cloud.fields}
            layout = np.dtype({"names": list("xyz"), "formats": ["<f4"] * 3, "offsets": [offsets[c] for c in "xyz"],
                               "itemsize": cloud.point_step})
            points = np.frombuffer(cloud.data.tobytes(), layout)
            frames.append(np.ascontiguousarray(np.stack([points[c] for c in "xyz"], axis=1)))
    return frames[1:]


def reconstruct(positions, spacing):
    # Smoothing length and cube size are in multiples of the particle radius.
    pysplashsurf.reconstruct_surface(positions, particle_radius=0.5 * spacing, smoothing_length=2.0, cube_size=1.0)


def splashsurf_seconds(frames, spacing):
    """CPU seconds of each frame."""
    seconds = []
    for positions in frames:
        start = time.process_time()
        reconstruct(positions, spacing)
        seconds.append(time.process_time() - start)
    return seconds


def tracker_seconds(data, spacing, last):
    """CPU seconds of each stage, for each frame after the first."""
    lines = track(data / "melting_bunny.bag", data / "melting_bunny.ply", spacing, "--last", str(last))
    return [line["cpu_times"] for line in lines[1:]]


def print_table(tracker, splash):
    base = statistics.median(splash)
    print(f"splashsurf: {1000 * base:.1f} ms CPU a frame (median of {len(splash)}; "
          f"{1000 * min(splash):.1f} to {1000 * max(splash):.1f})\n")
    print(f"{'stage':<22}{'CPU ms a frame':>15}{'ratio':>9}{'at most':>9}")
    for name, stages, limit in ROWS:
        cost = statistics.median(
            sum(seconds for stage, seconds in times.items() if stages is None or stage in stages) for times in tracker)
        ratio = cost / base
        verdict = "" if limit is None else f"{limit:>9.2f}  {'met' if ratio <= limit else 'NOT MET'}"
        print(f"{name:<22}{1000 * cost:>15.2f}{ratio:>9.3f}{verdict}")


def main():
    arguments = parse()
    spacing = spacing_of(arguments.data, "melting_bunny")
    frames = read_frames(arguments.data / "melting_bunny.bag", arguments.last)
    reconstruct(frames[0], spacing)  # Starts the threads.
    splash, tracker = [], []
    for _ in range(arguments.runs):
        splash += splashsurf_seconds(frames, spacing)
        tracker += tracker_seconds(arguments.data, spacing, arguments.last)
    print_table(tracker, splash)


if __name__ == "__main__":
    main()
