#!/usr/bin/env python3
"""Table 1 of the paper on splitting_armadillo: what topology matching and meshing cost by Δx_Γ, the reach being the same
in r; and what matching costs in the whole domain, at r/2, in the same frames.

CPU seconds of all threads, mean over the frames after the first, two threads. track_bag must be in PATH.
"""
import argparse
import pathlib

from tracking_report import spacing_of, track

SIZES = [2.0, 1.0, 0.5, 0.25]
LARGEST_GROWTH = {"matching": 9.0, "meshing": 4.5}
LEAST_GAIN = 5.0
STAGES = {"matching": ["voxelization", "topology_matching"], "meshing": ["remeshing", "untangling", "upkeep"]}


def track_armadillo(data, last, **settings):
    """The report of every frame after the first."""
    options = ["--last", str(last)]
    for name, value in settings.items():
        options += ["--set", f"{name}={value}"]
    name = "splitting_armadillo"
    return track(data / f"{name}.bag", data / f"{name}.ply", spacing_of(data, name), *options)[1:]


def seconds(frame, column):
    return sum(frame["cpu_times"].get(stage, 0.0) for stage in STAGES[column])


def mean(frames, column):
    return sum(seconds(frame, column) for frame in frames) / len(frames)


def print_growth(data, last):
    print(f"Table 1: CPU seconds a frame, splitting_armadillo, frames 1 to {last}\n")
    print(f"{'Δx_Γ':<8}{'matching':>10}{'growth':>8}{'meshing':>10}{'growth':>8}{'unknowns':>11}{'cells anew':>12}")
    before, verdicts = None, []
    for size in SIZES:
        frames = track_armadillo(data, last, dx_gamma=size)
        row = {column: mean(frames, column) for column in STAGES}
        line = f"{size:<5g} r "
        for column, value in row.items():
            growth = value / before[column] if before else None
            line += f"{value:>11.4f}" + (f"{growth:>8.2f}" if growth else " " * 8)
            if growth:
                verdicts.append(growth <= LARGEST_GROWTH[column])
        unknowns = sum(frame["topology"]["unknowns"] for frame in frames) / len(frames)
        cells = sum(frame["topology"]["remeshed_cells"] for frame in frames) / len(frames)
        print(f"{line}{unknowns:>11,.0f}{cells:>12,.0f}", flush=True)
        before = row
    print(f"matching grows by at most {LARGEST_GROWTH['matching']:g}, meshing by at most {LARGEST_GROWTH['meshing']:g} "
          f"from row to row: {'met' if all(verdicts) else 'NOT MET'}\n")


def print_whole(data, last):
    restricted = track_armadillo(data, last, dx_gamma=0.5)
    whole = track_armadillo(data, last, dx_gamma=0.5, matching_reach=0)
    both = [(r, w) for r, w in zip(restricted, whole) if r["topology"]["unknowns"] and w["topology"]["unknowns"]]
    if not both:
        print(f"no frame up to {last} has anything to match")
        return
    near = sum(r["cpu_times"]["topology_matching"] for r, _ in both) / len(both)
    far = sum(w["cpu_times"]["topology_matching"] for _, w in both) / len(both)
    print(f"topology matching at r/2 in the {len(both)} frames up to {last} that have flags: {near:.4f} s CPU within "
          f"reach, {far:.3f} s in the whole domain ({far / near:.1f} times, at least {LEAST_GAIN:g}): "
          f"{'met' if far >= LEAST_GAIN * near else 'NOT MET'}\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=pathlib.Path, required=True, help="folder with splitting_armadillo.bag, .ply, .json")
    parser.add_argument("--last", type=int, default=99, help="last frame (default 99)")
    parser.add_argument("--whole-last", type=int, default=50, help="last frame of the whole domain (default 50)")
    arguments = parser.parse_args()
    print_growth(arguments.data, arguments.last)
    print_whole(arguments.data, min(arguments.last, arguments.whole_last))


if __name__ == "__main__":
    main()
