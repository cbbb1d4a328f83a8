#!/usr/bin/env python3
"""live_splishsplash.launch: SPlisHSPlasH itself, tracked. Started by splishsplash_live.test."""
import sys
import threading
import unittest

import numpy as np
import rospy
import rostest
from particle_surface_tracker.msg import TrackedMesh, TrackerStatus
from sensor_msgs.msg import PointCloud2

from script_support import points_of

FRAMES = 8
SPACING = 0.04


class LiveSplishsplash(unittest.TestCase):
    def setUp(self):
        self.clouds, self.statuses, self.meshes = [], [], []
        self.done = threading.Event()
        rospy.Subscriber("/tracker/mesh", TrackedMesh, self.meshes.append)
        rospy.Subscriber("/particles", PointCloud2, self.clouds.append)
        rospy.Subscriber("/tracker/status", TrackerStatus, self.note)
        self.assertTrue(self.done.wait(200), f"{len(self.statuses)} of {FRAMES} frames came")
        rospy.sleep(0.5)

    def note(self, status):
        self.statuses.append(status)
        if len(self.statuses) >= FRAMES:
            self.done.set()

    def test_frames_are_tracked_with_true_ids_and_stamps(self):
        self.assertEqual([status.state for status in self.statuses],
                         [TrackerStatus.STARTED] + [TrackerStatus.TRACKED] * (FRAMES - 1))
        self.assertEqual([cloud.header.stamp.to_nsec() for cloud in self.clouds],
                         [1000 * 10**9 + round(frame * 10**9 / 60) for frame in range(FRAMES)])
        self.assertEqual(len(self.meshes), FRAMES)
        self.assertGreater(len(self.meshes[-1].triangles), 1000)

        frames = [np.sort(points_of(cloud), order="id") for cloud in self.clouds]
        for before, after in zip(frames, frames[1:]):
            np.testing.assert_array_equal(before["id"], after["id"])
            # Were ids mixed up, particles would seem to jump by their spacing at least.
            for axis in "xyz":
                moved = np.abs(after[axis] - before[axis] - after["v" + axis] / 60)
                self.assertLess(np.quantile(moved, 0.99), 0.2 * SPACING)


if __name__ == "__main__":
    rospy.init_node("splishsplash_live_test")
    rostest.rosrun("particle_surface_tracker", "splishsplash_live_test", LiveSplishsplash, sys.argv)
