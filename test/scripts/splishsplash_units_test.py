#!/usr/bin/env python3
"""What splishsplash_node does around the simulator, with a stand-in for it: it is on PyPI only, and may not be there."""
import pathlib
import sys
import tempfile
import types
import unittest
import unittest.mock

import numpy as np

from script_support import PROJECT, main

sys.path.insert(0, str(PROJECT / "scripts"))

from particle_files.errors import UsageError
from splishsplash import settings, simulation

FRAME_RATE = 60


class Fluid:
    """Particles that fall freely."""

    def __init__(self, count, room):
        self._room, self._count = room, count
        self.fields = {"position": np.zeros((room, 3), np.float32), "velocity": np.zeros((room, 3), np.float32),
                       "id": np.arange(room, dtype=np.uint32)}

    def numActiveParticles(self):
        return self._count

    def numParticles(self):
        return self._room

    def getFieldBuffer(self, name):
        return self.fields[name]


class StandIn:
    """As much of SPlisHSPlasH as the node uses. After a step it says how long it wants the next one, if it adapts them."""

    def __init__(self, adaptive, step, fluids):
        self.adaptive, self.longest, self.next, self.fluids = adaptive, step, step, fluids
        self.random = np.random.default_rng(1)
        self.now, self.steps, self.cleaned = np.float32(0), [], False
        self.Exec = types.SimpleNamespace(SimulatorBase=lambda: self)
        self.Simulation = types.SimpleNamespace(getCurrent=lambda: self, CFL_METHOD="method", ENUM_CFL_NONE=0)
        self.TimeManager = types.SimpleNamespace(getCurrent=lambda: self)

    def init(self, **options):
        assert options["useGui"] is False

    def initSimulation(self):
        pass

    def getValueInt(self, _name):
        return 1 if self.adaptive else 0

    def getTimeStepSize(self):
        return self.next

    def setTimeStepSize(self, value):
        self.next = value

    def numberOfFluidModels(self):
        return len(self.fluids)

    def getFluidModel(self, index):
        return self.fluids[index]

    def getTime(self):
        return float(self.now)

    def getParticleRadius(self):
        return 0.01

    def setTimeStepCB(self, callback):
        self.callback = callback

    def runSimulation(self):
        while True:
            self.steps.append(self.next)
            self.now = np.float32(self.now + self.next)
            if self.adaptive:
                self.next = self.longest * (0.5 + 0.5 * self.random.random())
            self.callback()

    def cleanup(self):
        self.cleaned = True


def run(stand_in, frames):
    """The times of the frames."""
    times = []

    def on_frame(frame):
        times.append(run.simulation.time())
        if frame + 1 == frames:
            raise simulation.EndOfRun

    with unittest.mock.patch.object(simulation, "imported", lambda: stand_in):
        run.simulation = simulation.Simulation(pathlib.Path("scene.json"), "folder", FRAME_RATE)
    run.simulation.run(on_frame)
    return times


class Frames(unittest.TestCase):
    def test_every_frame_is_met_whatever_the_step(self):
        for adaptive in (True, False):
            for step in (0.001, 0.005, 1 / 180, 0.1):
                with self.subTest(adaptive=adaptive, step=step):
                    stand_in = StandIn(adaptive, step, [Fluid(3, 3)])
                    self.assertEqual(run(stand_in, 30), [frame / FRAME_RATE for frame in range(30)])
                    self.assertLessEqual(max(stand_in.steps), step * 1.001)
                    self.assertGreater(min(stand_in.steps), 0.2 * min(step, 1 / FRAME_RATE))
                    self.assertTrue(stand_in.cleaned)

    def test_one_frame_is_the_state_at_the_beginning(self):
        stand_in = StandIn(True, 0.005, [Fluid(3, 3)])
        self.assertEqual(run(stand_in, 1), [0])
        self.assertEqual(stand_in.steps, [])

    def test_ids_of_several_fluids_differ_also_when_emitters_fill_their_room(self):
        fluids = [Fluid(4, 10), Fluid(5, 5)]
        run(StandIn(True, 0.005, fluids), 1)
        self.assertEqual(run.simulation.particles().ids.tolist(), [0, 1, 2, 3, 10, 11, 12, 13, 14])
        fluids[0]._count = 10
        particles = run.simulation.particles()
        self.assertEqual(particles.ids.tolist(), list(range(15)))
        self.assertEqual(particles.positions.shape, (15, 3))
        self.assertEqual(run.simulation.particle_count(), 15)
        self.assertEqual(run.simulation.spacing(), 0.02)


class Errors(unittest.TestCase):
    def test_a_python_without_the_simulator_is_said(self):
        with unittest.mock.patch.dict(sys.modules, {"pysplishsplash": None}):
            with self.assertRaisesRegex(simulation.MissingSimulator, "pip install pySPlisHSPlasH"):
                simulation.imported()

    def read(self, **parameters):
        with unittest.mock.patch("rospy.get_param", return_value=parameters):
            return settings.read_settings()

    def test_parameters(self):
        scene = str(PROJECT / "examples/splishsplash/two_blocks.json")
        read = self.read(scene=scene, frames=7, frame_rate=24, frame_id="tank", timeout=1)
        self.assertEqual((read.frames, read.frame_rate, read.frame_id, read.max_ahead), (7, 24.0, "tank", 0))
        for parameters, part in (({}, "~scene"), ({"scene": scene, "frames": 0}, "~frames is 0"),
                                 ({"scene": scene, "frames": 1.5}, "~frames is '1.5'"),
                                 ({"scene": scene, "frame_rate": -1.0}, "~frame_rate is -1"),
                                 ({"scene": scene, "speed": 1}, "~speed"), ({"scene": "/none.json"}, "/none.json")):
            with self.subTest(parameters), self.assertRaisesRegex(UsageError, part):
                self.read(**parameters)

    def test_a_scene_that_is_no_json(self):
        with tempfile.NamedTemporaryFile(suffix=".json", mode="w") as file:
            file.write('{"Configuration": ')
            file.flush()
            with self.assertRaisesRegex(UsageError, "no JSON"):
                self.read(scene=file.name)


if __name__ == "__main__":
    main()
