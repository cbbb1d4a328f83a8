#!/usr/bin/env python3
"""Reads the JSON of stage_benchmarks and prints how the cost of the implicit surface grows with the particles."""
import json
import sys

LARGEST_RATIO = 6.0


def median_cpu_ms(results, particles):
    """CPU time of the implicit function and its triangulation, in milliseconds."""
    times = {entry["name"]: entry["cpu_time"] for entry in results["benchmarks"]}
    return sum(times[f"{stage}/{particles}/process_time_median"] for stage in ("implicit_function", "triangulation"))


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        results = json.load(file)
    few, many = median_cpu_ms(results, 28000), median_cpu_ms(results, 260000)
    verdict = "met" if many / few <= LARGEST_RATIO else "NOT MET"
    print(f"\nimplicit surface: {few:.1f} ms CPU for 28,000 particles, {many:.1f} ms for 260,000: "
          f"{many / few:.2f} times (at most {LARGEST_RATIO:.0f}): {verdict}\n")


if __name__ == "__main__":
    main()
