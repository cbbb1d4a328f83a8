#!/usr/bin/env python3
"""A package of one's own, in a catkin workspace over this package, as docs/building.md describes it: it is built against
messages, headers and libraries, and its program runs.

Usage: own_package_test.py PREFIX

PREFIX is the devel space, or the folder of an installation that is still to be moved to its place.
"""
import os
import pathlib
import re
import subprocess
import sys

from script_support import PROJECT, ScriptTest, main

PREFIX = pathlib.Path(sys.argv.pop())

MANIFEST = """<package format="2">
  <name>follower</name> <version>1.0.0</version> <description>Follows a mesh.</description>
  <maintainer email="nobody@example.org">nobody</maintainer> <license>BSD</license>
  <buildtool_depend>catkin</buildtool_depend>
  <depend>particle_surface_tracker</depend> <depend>roscpp</depend>
</package>
"""
PROGRAM = """
#include <cstdio>
#include <particle_surface_tracker/TrackedMesh.h>
#include <particle_surface_tracker/core/mesh_measures.h>
#include <particle_surface_tracker/ros/mesh_conversion.h>
#include <ros/ros.h>

int main() {
  ros::Time::init();
  particle_surface_tracker::TrackedMesh message;  // A corner of the unit cube.
  message.vertices = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  message.triangles = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  message.ids = {0, 1, 2, 3};
  message.delta = {0, 0, 0, 0};
  const auto mesh = particle_surface_tracker::to_triangle_mesh(message);
  std::printf("volume %.4f\\n", particle_surface_tracker::measure_mesh(mesh.positions(), mesh.triangles()).volume);
}
"""


def quoted_cmake():
    page = (PROJECT / "docs/building.md").read_text(encoding="utf-8")
    section = page[page.index("### From a package of your own"):]
    return re.search(r"```cmake\n(.*?)```", section, re.DOTALL).group(1)


def move_to_its_place(prefix):
    """An installation in a staging folder names in its CMake package the folder that it is made for."""
    for path in prefix.glob("share/particle_surface_tracker/cmake/particle_surface_trackerConfig.cmake"):
        text = path.read_text(encoding="utf-8")
        place = re.search(r"set\(particle_surface_tracker_INSTALL_PREFIX (\S+)\)", text)
        if place:
            path.write_text(text.replace(place.group(0), place.group(0).replace(place.group(1), str(prefix)))
                            .replace(f"foreach(path {place.group(1)}/", f"foreach(path {prefix}/"), encoding="utf-8")


class OwnPackage(ScriptTest):
    def test_it_builds_and_runs(self):
        move_to_its_place(PREFIX)
        package = self.folder / "src/follower"
        package.mkdir(parents=True)
        (package / "package.xml").write_text(MANIFEST)
        (package / "follower.cpp").write_text(PROGRAM)
        (package / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.16)\nproject(follower)\n" + quoted_cmake())
        # ROS's own variables come from the workspaces.
        environment = {name: value for name, value in os.environ.items() if not name.startswith("ROS_")}
        environment["CMAKE_PREFIX_PATH"] = f"{PREFIX}:/usr"
        built = subprocess.run(["catkin_make", "--use-ninja", "-C", str(self.folder), "--cmake-args",
                                "-DPYTHON_EXECUTABLE=" + sys.executable, "-DCMAKE_BUILD_TYPE=None"],
                               env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        self.assertEqual(built.returncode, 0, built.stdout)
        output, _ = self.run_program(self.folder / "devel/lib/follower/follower")
        self.assertEqual(output, "volume 0.1667\n")
        # Of this installation, not of another one.
        linked, _ = self.run_program("ldd", self.folder / "devel/lib/follower/follower")
        for library in re.findall(r"libparticle_surface_tracker\S*\.so => (\S+)", linked):
            self.assertTrue(library.startswith(str(PREFIX)), linked)
        self.assertIn("libparticle_surface_tracker_ros.so", linked)


if __name__ == "__main__":
    main()
