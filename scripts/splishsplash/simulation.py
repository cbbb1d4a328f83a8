"""SPlisHSPlasH, stepped so that it meets the time of every frame."""
import ctypes
import math
import time

import numpy as np

from particle_files.fields import Particles

INSTALLATION = ("pySPlisHSPlasH is not in this Python. Make one that has it, and name it with python:=DIR/bin/python\n"
                "  python3 -m venv --copies --system-site-packages DIR && DIR/bin/pip install pySPlisHSPlasH")
GRACE = 1e-3  # [s] While SPlisHSPlasH computes, no other thread of Python runs; rospy has some.
SAME_TIME = 1e-6  # [s] SPlisHSPlasH counts time in single precision.


class EndOfRun(Exception):
    """Ends the simulation from within."""


class MissingSimulator(Exception):
    """pySPlisHSPlasH is not installed."""


def imported():
    # The wheel brings libGLdispatch, and the libGL of the system needs its own: with both in one process the import crashes.
    # What is loaded first, for all to see, is what both then use.
    try:
        ctypes.CDLL("libGLdispatch.so.0", mode=ctypes.RTLD_GLOBAL)
    except OSError:
        pass  # Then there is no libGL either, and no clash.
    try:
        import pysplishsplash
    except ImportError as error:
        raise MissingSimulator(f"{INSTALLATION}\n  ({error})") from error
    return pysplishsplash


class Simulation:
    """One run of a scene."""

    def __init__(self, scene, folder, frame_rate):
        self._library = library = imported()
        self._frame_rate = frame_rate
        self._base = library.Exec.SimulatorBase()
        # Without a window it wants to know when to stop; run() stops earlier.
        self._base.init(sceneFile=str(scene), useGui=False, useCache=False, outputDir=str(folder), initialPause=False, stopAt=1e9)
        self._base.initSimulation()
        self._simulation = library.Simulation.getCurrent()
        self._clock = library.TimeManager.getCurrent()
        self._adaptive = self._simulation.getValueInt(library.Simulation.CFL_METHOD) != library.Simulation.ENUM_CFL_NONE
        self._fixed_step = self._clock.getTimeStepSize()
        self._models = [self._simulation.getFluidModel(index) for index in range(self._simulation.numberOfFluidModels())]

    def time(self):
        """Simulated time [s]; of a frame, exactly its number over the frame rate."""
        now = self._clock.getTime()
        frame = round(now * self._frame_rate) / self._frame_rate
        return frame if abs(frame - now) <= SAME_TIME * max(1.0, now) else now

    def spacing(self):
        """r [m]: the distance of neighbouring particles at rest."""
        return 2 * self._simulation.getParticleRadius()

    def particle_count(self):
        return sum(model.numActiveParticles() for model in self._models)

    def particles(self):
        """Those of all fluids. Ids count from 0 in each; emitters have room for theirs."""
        positions, velocities, ids, first_id = [], [], [], 0
        for model in self._models:
            count = model.numActiveParticles()
            fields = [np.array(model.getFieldBuffer(name), copy=False)[:count] for name in ("position", "velocity", "id")]
            positions.append(fields[0].reshape(-1, 3))
            velocities.append(fields[1].reshape(-1, 3))
            ids.append(fields[2].ravel() + np.uint32(first_id))
            first_id += model.numParticles()
        return Particles(np.concatenate(positions), np.concatenate(velocities), np.concatenate(ids), {}, [])

    def run(self, on_frame):
        """Calls on_frame(number) for the state at the beginning and at the time of every frame, until that raises EndOfRun."""
        frame = 0

        def after_step():
            nonlocal frame
            time.sleep(GRACE)
            if self._clock.getTime() >= (frame + 1) / self._frame_rate - SAME_TIME:
                frame += 1
                on_frame(frame)
            self._shorten_step((frame + 1) / self._frame_rate)

        try:
            on_frame(frame)
            self._shorten_step(1 / self._frame_rate)
            self._base.setTimeStepCB(after_step)
            self._base.runSimulation()
        except EndOfRun:
            pass
        finally:
            self._base.cleanup()

    def _shorten_step(self, until):
        """Makes the next step shorter than the scene wants it, so that a whole number of such steps leads there."""
        wanted = self._clock.getTimeStepSize() if self._adaptive else self._fixed_step
        left = max(until - self._clock.getTime(), SAME_TIME)
        self._clock.setTimeStepSize(left / math.ceil(left / wanted - 1e-3))
