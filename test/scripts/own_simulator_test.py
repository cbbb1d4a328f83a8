#!/usr/bin/env python3
"""The simulators of docs/own_simulator.md: every frame is tracked, and the mesh falls as the block does. Started by
own_simulator.test."""
import sys
import threading
import unittest

import numpy as np
import rospy
import rostest
from particle_surface_tracker.msg import TrackedMesh, TrackerStatus

FRAMES = 20


class OwnSimulator(unittest.TestCase):
    def test_the_mesh_falls_as_the_block_does(self):
        statuses, meshes, done = [], [], threading.Event()

        def note(status):
            statuses.append(status)
            if len(statuses) == FRAMES:
                done.set()

        rospy.Subscriber("/tracker/mesh", TrackedMesh, meshes.append)
        rospy.Subscriber("/tracker/status", TrackerStatus, note)
        rospy.set_param("/listening", True)
        self.assertTrue(done.wait(100), f"{len(statuses)} of {FRAMES} frames came")
        rospy.sleep(0.5)
        self.assertEqual([status.state for status in statuses],
                         [TrackerStatus.STARTED] + [TrackerStatus.TRACKED] * (FRAMES - 1))
        self.assertEqual(statuses[-1].frames_missing, 0)
        self.assertEqual(len(meshes), FRAMES)
        np.testing.assert_allclose([mesh.header.stamp.to_nsec() - 1000 * 10**9 for mesh in meshes],
                                   np.arange(FRAMES) * 10**9 / 60, atol=1)
        start = np.array(meshes[0].vertices).reshape(-1, 3)
        for frame, mesh in enumerate(meshes):
            moved = np.array(mesh.vertices).reshape(-1, 3) - start
            np.testing.assert_allclose(moved - [0, 0, -9.81 / 2 * (frame / 60)**2], 0, atol=0.001)


if __name__ == "__main__":
    rospy.init_node("own_simulator_test")
    rostest.rosrun("particle_surface_tracker", "own_simulator_test", OwnSimulator, sys.argv)
