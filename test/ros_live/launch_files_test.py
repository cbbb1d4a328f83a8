#!/usr/bin/env python3
"""Loads every launch file as roslaunch does, without starting anything: what it names is there, every argument is
described, and what a user types reaches the nodes.

Usage: launch_files_test.py PROJECT

PROJECT is the folder of the sources, or share/particle_surface_tracker where the package is installed.
"""

import os
import pathlib
import shutil
import sys
import unittest
import xml.etree.ElementTree as xml

import roslaunch.config
import roslaunch.node_args
import roslaunch.xmlloader
import rospkg
import yaml

PROJECT = pathlib.Path(sys.argv.pop())
FILES = sorted(PROJECT.glob("launch/*.launch")) + sorted(PROJECT.glob("launch/*.launch.xml"))
# Programs that are for looking only; a machine without a screen need not have them.
VIEWERS = {"rviz", "tf2_ros"}


def load(path, *arguments):
    loader = roslaunch.xmlloader.XmlLoader(resolve_anon=False)
    config = roslaunch.config.ROSLaunchConfig()
    loader.load(str(path), config, argv=list(arguments), verbose=False)
    return config


def required_arguments(path):
    return ["%s:=%s" % (arg.get("name"), PROJECT / "package.xml") for arg in xml.parse(path).getroot().iter("arg")
            if arg.get("doc") and arg.get("default") is None and arg.get("value") is None]


def parameters(config):
    return {name: parameter.value for name, parameter in config.params.items()}


class LaunchFiles(unittest.TestCase):
    def test_there_are_some(self):
        names = {path.name for path in FILES}
        self.assertTrue({"live.launch", "replay.launch", "offline.launch", "live_splishsplash.launch",
                         "distributed.launch", "surface_maker.launch"} <= names, names)

    def test_every_argument_is_described(self):
        for path in FILES:
            for arg in xml.parse(path).getroot().findall("arg"):
                self.assertTrue(arg.get("doc") or arg.get("value"), "%s: %s" % (path.name, arg.get("name")))

    def test_every_file_loads_and_its_programs_are_there(self):
        pack = rospkg.RosPack()
        for path in FILES:
            config = load(path, *required_arguments(path))
            self.assertFalse(config.config_errors, path.name)
            for node in config.nodes:
                if node.package in VIEWERS and node.package not in pack.list():
                    continue
                command = roslaunch.node_args.create_local_process_args(node, config.machines[""])
                # With a launch-prefix that is not the first word.
                program = next(word for word in command if os.path.basename(word) == node.type)
                for word in (command[0], program):
                    self.assertTrue(shutil.which(word), "%s: %s" % (path.name, word))

    def test_files_that_are_named_are_there(self):
        for path in FILES:
            for node in load(path, *required_arguments(path)).nodes:
                words = node.args.split()
                for word in words:
                    if word.startswith(str(PROJECT)):
                        self.assertTrue(os.path.exists(word), "%s: %s" % (path.name, word))

    def test_arguments_reach_the_nodelet(self):
        config = load(PROJECT / "launch/live.launch", "mesh:=/data/a.ply", "spacing:=0.03", "config:=/data/p.yaml",
                      "queue_size:=7", "queue_policy:=latest", "refine_initial:=true", "particles:=/flow/particles",
                      "initial_mesh:=/flow/mesh", "interpolate:=velocity heat", "save_folder:=/data/out",
                      "marker_color_by:=id")
        values = parameters(config)
        self.assertEqual(values["/tracker/mesh"], "/data/a.ply")
        self.assertEqual(values["/tracker/spacing"], "0.03")
        self.assertEqual(values["/tracker/config"], "/data/p.yaml")
        self.assertEqual(values["/tracker/queue_size"], 7)
        self.assertEqual(values["/tracker/queue_policy"], "latest")
        self.assertEqual(values["/tracker/refine_initial"], True)
        self.assertEqual(values["/tracker/interpolate"], "velocity heat")
        self.assertEqual(values["/tracker/save_folder"], "/data/out")
        self.assertEqual(values["/tracker/marker_color_by"], "id")
        nodelet = next(node for node in config.nodes if node.name == "tracker")
        self.assertEqual(nodelet.args.split(), ["load", "particle_surface_tracker/TrackerNodelet", "tracker_manager"])
        remappings = [list(pair) for pair in nodelet.remap_args]
        self.assertIn(["particles", "/flow/particles"], remappings)
        self.assertIn(["initial_mesh", "/flow/mesh"], remappings)

    def test_nothing_of_an_earlier_start_reaches_a_node(self):
        types = {"tracker_node", "implicit_surface_node"}
        for path in FILES:
            config = load(path, *required_arguments(path))
            for node in config.nodes:
                if node.type in types or "Nodelet" in node.args:
                    self.assertIn(node.namespace + node.name + "/", config.clear_params, path.name)

    def test_a_manager_can_be_shared(self):
        config = load(PROJECT / "launch/live.launch", "manager:=simulation_manager", "rviz:=false")
        self.assertEqual([node.name for node in config.nodes], ["tracker"])
        self.assertEqual(config.nodes[0].args.split()[-1], "simulation_manager")

    def test_checkpoints_and_respawn_reach_the_nodelet(self):
        config = load(PROJECT / "launch/live.launch", "checkpoint:=/data/run.checkpoint", "checkpoint_every:=20",
                      "respawn:=true")
        values = parameters(config)
        self.assertEqual(values["/tracker/checkpoint"], "/data/run.checkpoint")
        self.assertEqual(values["/tracker/checkpoint_every"], 20)
        self.assertTrue(all(node.respawn for node in config.nodes if node.package == "nodelet"))

    def test_makers_share_the_frames(self):
        config = load(PROJECT / "launch/distributed.launch", "spacing:=0.03", "makers:=3", "local:=2", "rviz:=false")
        self.assertEqual({node.name for node in config.nodes},
                         {"tracker_manager", "tracker", "surface_maker_0", "surface_maker_1"})
        values = parameters(config)
        self.assertEqual(values["/tracker/surfaces"], "/surfaces")
        self.assertEqual([values["/surface_maker_1/" + name] for name in ("every", "offset", "spacing")], [3, 1, 0.03])
        makers = [node for node in config.nodes if node.type == "implicit_surface_node"]
        self.assertIn(["surfaces", "/surfaces"], [list(pair) for pair in makers[0].remap_args])

    def test_replay_is_paced_and_waits(self):
        config = load(PROJECT / "launch/replay.launch", "bag:=/data/a.bag", "rviz:=false")
        player = next(node for node in config.nodes if node.name == "player")
        for word in ("--queue 0", "--wait-for-subscribers", "--rate-control-topic /tracker/status", "/data/a.bag"):
            self.assertIn(word, player.args)
        self.assertNotIn("--loop", player.args)
        self.assertEqual(parameters(config)["/tracker/queue_size"], 1000000)
        self.assertEqual(parameters(config)["/tracker/queue_policy"], "all")
        self.assertEqual({node.name for node in config.nodes}, {"tracker_manager", "tracker", "player"})

    def test_offline_options_reach_track_bag(self):
        config = load(PROJECT / "launch/offline.launch", "bag:=/data/a b.bag", "out:=/data/out", "options:=--first 3")
        self.assertEqual([node.name for node in config.nodes], ["track_bag"])
        words = roslaunch.node_args.create_local_process_args(config.nodes[0], config.machines[""])
        for option in (["--bag", "/data/a b.bag"], ["--out", "/data/out"], ["--mesh", "implicit"], ["--first", "3"]):
            self.assertEqual(words[words.index(option[0]):][:2], option)
        for option in ("--config", "--report", "--out-bag"):
            self.assertNotIn(option, words)

    def test_splishsplash_runs_in_its_python(self):
        config = load(PROJECT / "launch/live_splishsplash.launch", "python:=/opt/splish/bin/python", "scene:=/data/a.json",
                      "frame:=tank", "frame_rate:=24")
        values = parameters(config)
        self.assertEqual((values["/simulator/scene"], values["/simulator/frame_rate"], values["/simulator/frame_id"]),
                         ("/data/a.json", 24.0, "tank"))
        self.assertEqual(values["/simulator/subscribers"], 2)  # Tracker and rviz
        simulator = next(node for node in config.nodes if node.name == "simulator")
        self.assertEqual(simulator.launch_prefix, "/opt/splish/bin/python")
        self.assertIn(["status", "tracker/status"], [list(pair) for pair in simulator.remap_args])

    def test_scenes_with_y_up_are_turned(self):
        config = load(PROJECT / "launch/live.launch", "y_up:=true", "frame:=tank")
        transform = next(node for node in config.nodes if node.name == "y_up_to_z_up")
        self.assertEqual(transform.args.split()[-2:], ["z_up", "tank"])
        viewer = next(node for node in config.nodes if node.name == "rviz")
        self.assertEqual(viewer.args.split()[-2:], ["-f", "z_up"])


class RvizFiles(unittest.TestCase):
    def test_all_that_the_tracker_shows_is_in_them(self):
        for path in sorted(PROJECT.glob("rviz/*.rviz")):
            displays = yaml.safe_load(path.read_text())["Visualization Manager"]["Displays"]
            topics = {display["Marker Topic"]: display["Class"] for display in displays if "Marker Topic" in display}
            self.assertEqual(topics.get("/tracker/marker"), "rviz/Marker", path.name)
            self.assertEqual(topics.get("/tracker/surface_marker"), "rviz/Marker", path.name)
            self.assertEqual(topics.get("/tracker/topology_marker"), "rviz/MarkerArray", path.name)


if __name__ == "__main__":
    unittest.main()
