"""Ids for particles that have none: each is taken for the one that was expected nearest to it in the frame before."""
import dataclasses

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

REACH = 1.0  # [r] One that is farther from where it was expected is another particle.
NEIGHBORS = 12  # Their errors correct what is expected of a particle.
LINK = 1.5  # [r] Particles nearer than this are of one body.
SMALLEST_BODY = 8
AMBIGUOUS = 0.5  # The particle that was taken is more than this part as far as the next one.


@dataclasses.dataclass
class MatchReport:
    """How sure the ids of one frame are."""

    particles: int
    gone: int  # Of the frame before, not found
    born: int  # Of this frame, new
    ambiguous: int
    distance: float  # From where they were expected, median [r]
    spacing: float  # r that was taken

    @property
    def unmatched(self):
        """Share of the particles of both frames that have no partner."""
        both = 2 * self.particles - self.born + self.gone
        return (self.gone + self.born) / both if both else 0.0


def estimated_spacing(positions):
    """The median distance to the nearest neighbour."""
    if len(positions) < 2:
        return None
    return float(np.median(cKDTree(positions).query(positions, k=2)[0][:, 1])) or None


class NearestMatcher:
    """Gives ids frame by frame. The first frame has 0, 1, …; what is born gets numbers that were never used."""

    def __init__(self, spacing):
        self._spacing = spacing
        self._positions = np.empty((0, 3))
        self._motion = None  # Displacements expected until the next frame; None: nothing is known of them
        self._ids = np.empty(0, np.uint32)
        self._unused = 0

    def ids(self, positions, velocities, interval):
        """Ids of the next frame, and how sure they are. `interval` is the time between frames [s]."""
        if self._motion is None:
            self._motion = bodies_motion(self._positions, positions, LINK * self._spacing)
        expected = self._positions + self._motion
        old, new, _ = mutual_nearest(expected, positions, REACH * self._spacing)
        # Where liquid falls or is stopped, neighbours are in error together.
        expected += neighbors_error(self._positions, old, positions[new] - expected[old])
        old, new, distances = mutual_nearest(expected, positions, REACH * self._spacing)

        ids = np.zeros(len(positions), np.uint32)
        ids[new] = self._ids[old]
        born = np.ones(len(positions), bool)
        born[new] = False
        ids[born] = np.arange(self._unused, self._unused + np.count_nonzero(born))
        self._unused += np.count_nonzero(born)

        report = MatchReport(len(positions), len(self._positions) - len(old), int(np.count_nonzero(born)),
                             ambiguous_matches(expected[old], positions, distances),
                             float(np.median(distances)) / self._spacing if len(distances) else 0.0, self._spacing)
        if velocities is not None:
            self._motion = velocities * interval
        else:
            self._motion = last_motion(positions, new, positions[new] - self._positions[old])
        self._positions, self._ids = positions, ids
        return ids, report


def mutual_nearest(expected, found, reach):
    """Pairs of rows of which each is nearest to the other, again and again among those that are left."""
    old, new = np.arange(len(expected)), np.arange(len(found))
    pairs = []
    while len(old) and len(new):
        distances, there = cKDTree(found[new]).query(expected[old], distance_upper_bound=reach)
        back = cKDTree(expected[old]).query(found[new])[1]
        near = np.flatnonzero(np.isfinite(distances))
        near = near[back[there[near]] == near]
        if not len(near):
            break
        pairs.append((old[near], new[there[near]], distances[near]))
        old, new = np.delete(old, near), np.delete(new, there[near])
    if not pairs:
        return np.empty(0, int), np.empty(0, int), np.empty(0)
    return tuple(np.concatenate(part) for part in zip(*pairs))


def neighbors_error(positions, matched, errors):
    """For every particle the median error of the matched ones around it."""
    if not len(matched):
        return np.zeros_like(positions)
    count = min(NEIGHBORS, len(matched))
    around = cKDTree(positions[matched]).query(positions, k=count)[1].reshape(len(positions), count)
    return np.median(errors[around], axis=1)


def ambiguous_matches(expected, found, distances):
    if len(found) < 2 or not len(expected):
        return 0
    second = cKDTree(found).query(expected, k=2)[0][:, 1]
    return int(np.count_nonzero(distances > AMBIGUOUS * second))


def last_motion(positions, matched, displacements):
    """The last displacement of every particle; of what is born, that of the nearest matched one."""
    if not len(matched):
        return None
    motion = displacements[cKDTree(positions[matched]).query(positions)[1]]
    motion[matched] = displacements
    return motion


def bodies_motion(before, after, link):
    """Displacements by bodies: one of as many particles that is nearest. A lattice that moves by its own spacing looks
    as if it had not moved at all, particle by particle."""
    motion = np.zeros_like(before)
    labels, counts, centers = bodies(before, link)
    _, counts_after, centers_after = bodies(after, link)
    for body in np.flatnonzero(counts >= SMALLEST_BODY):
        alike = np.flatnonzero(np.abs(counts_after - counts[body]) <= counts[body] // 100)
        if len(alike):
            shifts = centers_after[alike] - centers[body]
            motion[labels == body] = shifts[np.argmin(np.linalg.norm(shifts, axis=1))]
    return motion


def bodies(positions, link):
    """The body of every particle, and number of particles and centre of every body."""
    count = len(positions)
    if not count:
        return np.empty(0, int), np.empty(0, int), np.empty((0, 3))
    pairs = cKDTree(positions).query_pairs(link, output_type="ndarray")
    number, labels = connected_components(coo_matrix((np.ones(len(pairs), bool), pairs.T), (count, count)), directed=False)
    counts = np.bincount(labels, minlength=number)
    sums = np.column_stack([np.bincount(labels, positions[:, axis], number) for axis in range(3)])
    return labels, counts, sums / counts[:, None]
