#!/usr/bin/env python3
"""Loops a recorded sequence through the live nodelet, with resets, storms of dynamic_reconfigure and slow subscribers.
Fails where memory grows by more than 5 %, where a frame gets no answer, or where one fails. It needs a roscore.

Usage: soak.py BAG SPACING [FRAMES]
"""

import os
import signal
import subprocess
import sys
import threading
import time
import xmlrpc.client

import dynamic_reconfigure.client
import numpy
import rosbag
import rosgraph
import rospy
import sensor_msgs.msg
import std_srvs.srv
from particle_surface_tracker.msg import TrackedMesh, TrackerStatus

WARM_UP = 200  # Frames after which memory must be flat.
PATIENCE = 60.0  # Longest wait for the answer to a frame [s].
GROWTH = 1.05


def resident_megabytes(process):
    with open("/proc/%d/statm" % process) as statm:
        return int(statm.read().split()[1]) * os.sysconf("SC_PAGESIZE") / 1e6


class Soak:
    def __init__(self, bag, spacing):
        with rosbag.Bag(bag) as opened:
            # Bags give messages of classes of their own.
            self.clouds = [sensor_msgs.msg.PointCloud2(
                fields=[sensor_msgs.msg.PointField(f.name, f.offset, f.datatype, f.count) for f in cloud.fields],
                height=cloud.height, width=cloud.width, point_step=cloud.point_step, row_step=cloud.row_step,
                is_dense=cloud.is_dense, data=cloud.data) for _, cloud, _ in opened.read_messages("/particles")]
        self.answered = threading.Semaphore(0)
        self.latencies = []
        self.failed = []
        self.publisher = rospy.Publisher("particles", sensor_msgs.msg.PointCloud2, queue_size=10)
        rospy.Subscriber("/tracker/status", TrackerStatus, self.note)
        # Slower than what comes, so that queues are full.
        rospy.Subscriber("/tracker/mesh", TrackedMesh, lambda mesh: time.sleep(0.7), queue_size=1)
        while self.publisher.get_num_connections() == 0:
            time.sleep(0.05)
        self.reset = rospy.ServiceProxy("/tracker/reset", std_srvs.srv.Trigger)
        self.reset.wait_for_service(PATIENCE)
        self.reconfigure = dynamic_reconfigure.client.Client("/tracker", timeout=PATIENCE)

    def note(self, status):
        if status.state > TrackerStatus.TRACKED:
            self.failed.append("frame of %s: %s" % (status.header.stamp, status.reason))
        self.latencies.append(status.latency)
        self.answered.release()

    def disturb(self, n):
        """A reset with every loop of the sequence and at odd places, ten changes of parameters at a time."""
        if n % len(self.clouds) == 0 or n % 97 == 96:
            self.reset()
        if n % 25 == 24:
            for k in range(10):
                self.reconfigure.update_configuration({"tau": 0.3 + 0.02 * (k % 5)})

    def run(self, frames, process):
        memory = {}
        for n in range(frames):
            self.disturb(n)
            cloud = self.clouds[n % len(self.clouds)]
            # Time goes on through all loops.
            cloud.header.stamp = rospy.Time.from_sec(1000.0 + n / 60.0)
            cloud.header.frame_id = "world"
            self.publisher.publish(cloud)
            if not self.answered.acquire(timeout=PATIENCE):
                sys.exit("soak: no answer to frame %d within %g s: a deadlock?" % (n, PATIENCE))
            if (n + 1) % 100 == 0 or n + 1 == frames:
                memory[n + 1] = resident_megabytes(process)
                print("frame %5d: %.1f MB" % (n + 1, memory[n + 1]), flush=True)
        return memory

    def print_latencies(self):
        values = 1e3 * numpy.array(self.latencies)
        print("latency [ms]  " + "  ".join("%s %.1f" % (name, value) for name, value in zip(
            ("least", "median", "90 %", "99 %", "greatest"), numpy.percentile(values, [0, 50, 90, 99, 100]))))


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    bag, spacing = sys.argv[1:3]
    frames = int(sys.argv[3]) if len(sys.argv) == 4 else 2000
    if not rosgraph.is_master_online():
        sys.exit("soak: there is no roscore")
    manager = subprocess.Popen(["rosrun", "nodelet", "nodelet", "manager", "__name:=manager"], start_new_session=True)
    loader = subprocess.Popen(["rosrun", "nodelet", "nodelet", "load", "particle_surface_tracker/TrackerNodelet", "manager",
                               "__name:=tracker", "_spacing:=" + spacing], start_new_session=True)
    try:
        rospy.init_node("soak", disable_signals=True)
        soak = Soak(bag, spacing)
        process = xmlrpc.client.ServerProxy(rosgraph.Master("/soak").lookupNode("/manager")).getPid("/soak")[2]
        memory = soak.run(frames, process)
    finally:
        for started in (loader, manager):
            os.killpg(started.pid, signal.SIGINT)
            started.wait()
    soak.print_latencies()
    print("%d frames, %d not tracked" % (frames, len(soak.failed)))
    for failure in soak.failed[:10]:
        print("  " + failure)
    grown = memory[frames] / memory[min(memory, key=lambda n: abs(n - WARM_UP))]
    print("memory at the end: %.3f of that after %d frames" % (grown, min(memory, key=lambda n: abs(n - WARM_UP))))
    if soak.failed or grown > GROWTH:
        sys.exit("soak: failed")


if __name__ == "__main__":
    main()
