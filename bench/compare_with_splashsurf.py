#!/usr/bin/env python3
"""CPU time of the tracker, relative to what splashsurf needs to reconstruct the same frames: every stage on melting_bunny,
and whole frames of all sequences that splash or split.

Both work in one run and in turns: splashsurf on all frames of a sequence, then track_bag, and so on. CPU seconds are those
of the process, all threads, two threads each. track_bag must be in PATH.
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

# What the paper's Secs. 4 and 5 take; the rest is topology and upkeep (Secs. 6 to 8).
SURFACE_STAGES = ["implicit_function", "triangulation", "distance_field", "advection", "projection"]

# Rows of the table of stages: name, stages, largest ratio to splashsurf (medians). None: no limit of its own.
ROWS = [
    ("implicit surface", ["implicit_function", "triangulation"], 0.20),
    ("  implicit_function", ["implicit_function"], None),
    ("  triangulation", ["triangulation"], None),
    ("distance_field", ["distance_field"], 0.12),
    ("advection", ["advection"], 0.08),
    ("projection", ["projection"], 0.10),
    ("these together", SURFACE_STAGES, 0.50),
    ("topology_matching", ["voxelization", "topology_matching"], None),
    ("remeshing", ["remeshing"], None),
    ("upkeep", ["untangling", "upkeep", "stretched_detail"], None),
    ("measures", ["measures"], None),
]

# Whole frames: largest ratio to splashsurf (means), and largest ratio of the slowest frame to the median.
SEQUENCES = ["melting_bunny", "splitting_armadillo", "falling_objects"]
LARGEST_RATIO = 1.0
LARGEST_SPREAD = 4.0


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=pathlib.Path, required=True, help="folder with melting_bunny.bag, .ply and .json")
    parser.add_argument("--runs", type=int, default=3, help="turns of each program on melting_bunny (default 3), once on others")
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


def tracker_seconds(data, name, spacing, last):
    """CPU seconds of each stage, for each frame after the first."""
    lines = track(data / f"{name}.bag", data / f"{name}.ply", spacing, "--last", str(last))
    return [line["cpu_times"] for line in lines[1:]]


def measure(data, name, last, runs):
    """CPU seconds of splashsurf, and of the tracker by stage, for every frame and turn."""
    spacing = spacing_of(data, name)
    frames = read_frames(data / f"{name}.bag", last)
    reconstruct(frames[0], spacing)  # Starts the threads.
    splash, tracker = [], []
    for _ in range(runs):
        splash += splashsurf_seconds(frames, spacing)
        tracker += tracker_seconds(data, name, spacing, len(frames))
    return splash, tracker


def verdict(value, limit):
    return f"{limit:>9.2f}  {'met' if value <= limit else 'NOT MET'}"


def print_stages(splash, tracker):
    base = statistics.median(splash)
    print(f"melting_bunny; splashsurf: {1000 * base:.1f} ms CPU a frame (median of {len(splash)}; "
          f"{1000 * min(splash):.1f} to {1000 * max(splash):.1f})\n")
    print(f"{'stage':<22}{'CPU ms a frame':>15}{'ratio':>9}{'at most':>9}")
    for name, stages, limit in ROWS:
        cost = statistics.median(sum(times.get(stage, 0.0) for stage in stages) for times in tracker)
        ratio = cost / base
        print(f"{name:<22}{1000 * cost:>15.2f}{ratio:>9.3f}{'' if limit is None else verdict(ratio, limit)}")


def print_whole_frames(name, splash, tracker):
    base = statistics.mean(splash)
    frames = [sum(times.values()) for times in tracker]
    mean = statistics.mean(frames)
    spread = max(frames) / statistics.median(frames)
    print(f"{name:<22}{1000 * base:>15.1f}{1000 * mean:>13.1f}{mean / base:>9.3f}{verdict(mean / base, LARGEST_RATIO):<18}"
          f"{spread:>9.2f}{verdict(spread, LARGEST_SPREAD)}", flush=True)


def main():
    arguments = parse()
    measured = {"melting_bunny": measure(arguments.data, "melting_bunny", arguments.last, arguments.runs)}
    print_stages(*measured["melting_bunny"])
    print(f"\n{'whole frames, mean':<22}{'splashsurf ms':>15}{'tracker ms':>13}{'ratio':>9}{'at most':>9}"
          f"{'slowest / median':>18}{'at most':>9}")
    for name in SEQUENCES:
        if not (arguments.data / f"{name}.bag").exists():
            continue
        if name not in measured:
            measured[name] = measure(arguments.data, name, arguments.last, 1)
        print_whole_frames(name, *measured[name])


if __name__ == "__main__":
    main()
