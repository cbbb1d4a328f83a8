#!/usr/bin/env python3
"""Prints a report of track_bag (--report FILE) in short: what was tracked, how well, how fast."""
import argparse
import json
import sys


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("report", help="file of one JSON object per frame")
    with open(parser.parse_args().report, encoding="utf-8") as file:
        lines = [json.loads(line) for line in file if line.strip()]
    frames = [line for line in lines if "error" not in line]
    if not frames:
        sys.exit("summarize_report: the report has no tracked frames")
    for name, value in summary(frames):
        print(f"  {name:<32}{value}")


def summary(frames):
    """Pairs of a name and a text."""
    first, last = frames[0], frames[-1]
    tracked = frames[1:] or frames
    seconds = sum(frame["times"]["total"] for frame in tracked)
    start_ratio = first["volume"] / first["implicit_volume"]
    drift = max(abs(frame["volume"] / frame["implicit_volume"] / start_ratio - 1) for frame in frames)
    flagged = [frame["flagged_vertices"] for frame in frames]
    return [
        ("frames", f"{len(frames)} ({first['frame']} to {last['frame']})"),
        ("particles", f"{last['particles']:,}"),
        ("mesh", f"{last['vertices']:,} vertices, {last['triangles']:,} triangles, "
                 f"{last['components']} component(s), genus {last['genus']}"),
        ("first vertices still alive", f"{100 * last['original_vertices_alive'] / first['vertices']:.1f} %"),
        ("vertices flagged, worst frame", f"{max(flagged):,} ({100 * max(flagged) / last['vertices']:.2f} %)"),
        ("volume against particles", f"within {100 * drift:.2f} % of the first frame's"),
        ("time per frame", f"{1000 * seconds / len(tracked):.0f} ms ({len(tracked) / seconds:.1f} frames/s)"),
        ("peak memory", f"{max(frame['peak_rss_bytes'] for frame in frames) / 2**20:.0f} MiB"),
    ]


if __name__ == "__main__":
    main()
