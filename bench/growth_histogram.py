#!/usr/bin/env python3
"""How many cells of Γ are re-meshed only so that the cut is simple, for each region that is re-meshed.

Reads the files cells_*.vtp that track_bag --debug-cells all wrote into some folders. A region is a set of marked cells
of one frame that touch each other, in a corner at least; what grew in it are the cells that were not flagged, tangled,
deep or at a node that changed sides.
"""
import argparse
import pathlib
import re

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

GROWN = 5  # CellKind::kGrown
EDGES = [0, 1, 2, 5, 10, 20, 50, 100, np.inf]


def read_array(content, name, dtype):
    """An array of a file of write_cells_vtp()."""
    offset = int(re.search(rb'Name="' + name.encode() + rb'"[^>]*offset="(\d+)"', content).group(1))
    start = content.index(b'encoding="raw">\n_') + 17 + offset
    size = int(np.frombuffer(content, "<u8", 1, start)[0])
    return np.frombuffer(content, dtype, size // np.dtype(dtype).itemsize, start + 8)


def regions_of(path):
    """Numbers of marked cells, and of grown ones among them, of every region."""
    content = path.read_bytes()
    marked = read_array(content, "marked", "u1") == 1
    if not marked.any():
        return np.empty((0, 2), int)
    middles = read_array(content, "Points", "<f4").reshape(-1, 3)[marked].astype(float)
    grown = read_array(content, "kind", "u1")[marked] == GROWN
    tree = cKDTree(middles)
    if len(middles) == 1:
        return np.array([[1, int(grown[0])]])
    cell = tree.query(middles, k=2)[0][:, 1].min()  # Neighbours share a face, an edge or a corner.
    pairs = tree.query_pairs(1.8 * cell, output_type="ndarray")
    graph = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(middles), len(middles)))
    count, label = connected_components(graph, directed=False)
    return np.stack([np.bincount(label, minlength=count), np.bincount(label, grown, count).astype(int)], axis=1)


def bin_name(low, high):
    if not np.isfinite(high):
        return f"{low:.0f} or more"
    return f"{low:.0f}" if high == low + 1 else f"{low:.0f} to {high - 1:.0f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=pathlib.Path, help="output folders of track_bag")
    columns = []
    for folder in parser.parse_args().folders:
        files = sorted(folder.glob("cells_*.vtp"))
        if not files:
            parser.error(f"{folder} has no cells_*.vtp; track_bag --debug-cells all writes them")
        columns.append((folder.name, np.concatenate([regions_of(path) for path in files])))
    print("| cells marked by growth | " + " | ".join(name for name, _ in columns) + " |")
    print("|---|" + "---|" * len(columns))
    for low, high in zip(EDGES, EDGES[1:]):
        counts = [np.count_nonzero((regions[:, 1] >= low) & (regions[:, 1] < high)) for _, regions in columns]
        print(f"| {bin_name(low, high)} | " + " | ".join(f"{count:,}" for count in counts) + " |")
    print("| regions | " + " | ".join(f"{len(regions):,}" for _, regions in columns) + " |")
    print("| most in one | " + " | ".join(f"{regions[:, 1].max():,}" for _, regions in columns) + " |")
    print("| share of all marked cells | "
          + " | ".join(f"{100 * regions[:, 1].sum() / regions[:, 0].sum():.1f} %" for _, regions in columns) + " |")


if __name__ == "__main__":
    main()
