"""Who listens to the particles. Publishers in ROS drop what nobody has subscribed to yet."""
import threading
import time

import rospy
from particle_surface_tracker.msg import TrackerStatus


class WaitingError(Exception):
    """Another node has not come, or has not answered, in time."""


class Audience:
    def __init__(self, publisher, max_ahead, timeout):
        self._publisher = publisher
        self._timeout = timeout
        self._max_ahead = max_ahead
        self._answered = 0  # Frames
        self._changed = threading.Condition()
        self._subscriber = rospy.Subscriber("status", TrackerStatus, self._note) if max_ahead else None

    def wait_for_subscribers(self, count):
        self._wait(lambda: self._publisher.get_num_connections() >= count, f"fewer than {count} nodes have subscribed to the particles")
        if self._subscriber:
            self._wait(lambda: self._subscriber.get_num_connections() > 0, "no node answers on the topic 'status'")

    def wait_until_tracked(self, frame):
        """Returns when the tracker has answered to the frame and all before it; at once where it is not waited for."""
        if self._max_ahead:
            self._wait(lambda: self._answered > frame, f"the tracker has not answered to frame {frame}")

    def _note(self, _status):
        with self._changed:
            self._answered += 1
            self._changed.notify()

    def _wait(self, condition, complaint):
        end = time.monotonic() + self._timeout if self._timeout else float("inf")
        with self._changed:
            while not condition() and not rospy.is_shutdown():
                if time.monotonic() > end:
                    raise WaitingError(f"{complaint} within {self._timeout:g} s (~timeout)")
                self._changed.wait(0.05)
