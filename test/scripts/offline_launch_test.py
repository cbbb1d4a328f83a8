#!/usr/bin/env python3
"""offline.launch: track_bag by roslaunch does what it does by itself.

Usage: offline_launch_test.py MAKE_SIMULATION_BAG TRACK_BAG
"""
import socket
import sys

from script_support import PROJECT, ScriptTest, main

TRACK_BAG, MAKE_SIMULATION_BAG = sys.argv.pop(), sys.argv.pop()
SPACING = 0.06


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class OfflineLaunch(ScriptTest):
    def launch(self, **arguments):
        return self.run_program("roslaunch", "-p", free_port(), PROJECT / "launch/offline.launch",
                                *[f"{name}:={value}" for name, value in arguments.items()])

    def test_the_files_are_those_of_track_bag(self):
        bag, mesh, config = self.folder / "a bag.bag", self.folder / "first.ply", self.folder / "my parameters.yaml"
        config.write_text("tau: 0.4\n")
        self.run_program(MAKE_SIMULATION_BAG, "--bag", bag, "--mesh-out", mesh, "--frames", 3, "--spacing", SPACING, "--quiet")
        self.run_program(TRACK_BAG, "--bag", bag, "--mesh", mesh, "--spacing", SPACING, "--out", self.folder / "wanted", "--config",
                         config, "--first", 1, "--quiet")
        self.launch(bag=bag, mesh=mesh, spacing=SPACING, out=self.folder / "the meshes", config=config,
                    report=self.folder / "report.jsonl", out_bag=self.folder / "out.bag", options="--first 1")
        names = {path.name for path in (self.folder / "wanted").iterdir()}
        self.assertEqual(names, {"frame_000001.ply", "frame_000002.ply"})
        self.assertEqual({path.name for path in (self.folder / "the meshes").iterdir()}, names)
        for name in names:
            self.assertEqual((self.folder / "wanted" / name).read_bytes(), (self.folder / "the meshes" / name).read_bytes())
        self.assertEqual(len((self.folder / "report.jsonl").read_text().splitlines()), 2)
        self.assertTrue((self.folder / "out.bag").exists())

    def test_what_track_bag_complains_about_is_seen(self):
        _, errors = self.launch(bag=self.folder / "none.bag", out=self.folder / "meshes")
        self.assertIn("none.bag", errors)
        self.assertFalse((self.folder / "meshes").exists())


if __name__ == "__main__":
    main()
