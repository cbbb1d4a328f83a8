#!/usr/bin/env python3
"""Loops a recorded sequence through the live nodelet, with resets, storms of dynamic_reconfigure and slow subscribers of
mesh and markers; for 500 frames without any reset. Fails where memory ever grows by more than 5 %, where a frame gets no
answer, or where one fails. It needs a roscore.

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
from particle_surface_tracker.msg import TrackerStatus

SLOWLY_READ = ("mesh", "marker", "surface_marker", "topology_marker")
WARM_UP = 200  # Frames after which memory must not grow.
CALM = 500  # Frames in a row without a reset; fewer in a short run.
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
        self.slept = dict.fromkeys(SLOWLY_READ, 0)
        for topic in SLOWLY_READ:
            rospy.Subscriber("/tracker/" + topic, rospy.AnyMsg, self.sleep_over, topic, queue_size=1)
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

    def sleep_over(self, _, topic):
        self.slept[topic] += 1
        time.sleep(0.7)

    def disturb(self, n, is_calm):
        """A reset with every loop of the sequence and at odd places, ten changes of parameters at a time. Every fourth time
        one of them waits for a reset, and is put back the next time; in calm frames it never takes effect."""
        if not is_calm and (n % len(self.clouds) == 0 or n % 97 == 96):
            self.reset()
        if n % 25 == 24:
            for k in range(10):
                self.reconfigure.update_configuration({"tau": 0.3 + 0.02 * (k % 5),
                                                       "dx_gamma": 1.0 if n // 25 % 4 == 0 else 0.5})

    def cloud(self, n, is_calm):
        """The sequence from its beginning; without a reset forth and back, because particles do not jump."""
        count = len(self.clouds)
        place = n % (2 * count - 2) if is_calm else n % count
        return self.clouds[place if place < count else 2 * count - 2 - place]

    def run(self, frames, process):
        """Memory after every frame [MB]."""
        memory = []
        calm_begin = frames // 3 // len(self.clouds) * len(self.clouds)
        calm_length = min(CALM, frames // 4)
        for n in range(frames):
            calm = n - calm_begin
            is_calm = 0 < calm < calm_length
            self.disturb(n, is_calm)
            cloud = self.cloud(calm if is_calm else n, is_calm)
            # Time goes on through all loops.
            cloud.header.stamp = rospy.Time.from_sec(1000.0 + n / 60.0)
            cloud.header.frame_id = "world"
            if calm == calm_length:
                self.reset()
            self.publisher.publish(cloud)
            if not self.answered.acquire(timeout=PATIENCE):
                sys.exit("soak: no answer to frame %d within %g s: a deadlock?" % (n, PATIENCE))
            memory.append(resident_megabytes(process))
            if (n + 1) % 100 == 0 or n + 1 == frames:
                print("frame %5d: %.1f MB" % (n + 1, memory[n]), flush=True)
        print("%d frames in a row without a reset" % calm_length)
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
    if frames <= WARM_UP:
        sys.exit("soak: FRAMES has to be above %d" % WARM_UP)
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
    # What a single frame needs goes up and down by some per cent with its place in the sequence.
    before = max(memory[:WARM_UP])
    after = max(memory[WARM_UP:])
    print("most memory in %d frames %.1f MB, in all that follow %.1f MB, %.3f of it" % (
        WARM_UP, before, after, after / before))
    print("read slowly: " + ", ".join("%d of %s" % (count, topic) for topic, count in soak.slept.items()))
    if soak.failed or after / before > GROWTH or not all(soak.slept.values()):
        sys.exit("soak: failed")


if __name__ == "__main__":
    main()
