#!/usr/bin/env python3
"""A simulator of a falling block, which publishes its particles for the tracker."""
import numpy as np
import rospy
from sensor_msgs.msg import PointCloud2, PointField

LAYOUT = np.dtype([("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("id", "<u4")])
TYPES = {"<f4": PointField.FLOAT32, "<u4": PointField.UINT32}


def to_cloud(particles, stamp):
    cloud = PointCloud2(height=1, width=len(particles), point_step=LAYOUT.itemsize, row_step=particles.nbytes, is_dense=True)
    cloud.header.stamp, cloud.header.frame_id = stamp, "world"
    cloud.fields = [PointField(name, LAYOUT.fields[name][1], TYPES[LAYOUT[name].str], 1) for name in LAYOUT.names]
    cloud.data = particles.tobytes()
    return cloud


rospy.init_node("simulator")
publisher = rospy.Publisher("particles", PointCloud2, queue_size=100)
# What is published before somebody listens is lost, and the mesh belongs to the first frame.
while not rospy.is_shutdown() and publisher.get_num_connections() == 0:
    rospy.rostime.wallsleep(0.1)

particles = np.zeros(1000, LAYOUT)
particles["id"] = np.arange(1000)  # An id stays with its particle, wherever that is in the array.
particles["x"], particles["y"], particles["z"] = 0.05 * np.indices((10, 10, 10)).reshape(3, -1)
for frame in range(20):
    publisher.publish(to_cloud(particles, rospy.Time(1000) + rospy.Duration(frame / 60)))
    particles["z"] -= 9.81 * (2 * frame + 1) / 7200  # g t²/2, t = frame/60 s
    rospy.rostime.wallsleep(1 / 30)  # Not faster than the tracker; simulated time is that of the stamps.
rospy.rostime.wallsleep(1)  # The last frames are still on their way.
