#!/usr/bin/env python3
"""export_meshes: what other programs read of its files. VTK stands for them.

Usage: export_meshes_test.py EXPORT_MESHES
"""
import sys
import xml.etree.ElementTree as xml

import genpy
import numpy as np
import rosbag
from particle_surface_tracker.msg import InterpolatedField, TrackedMesh
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOGeometry import vtkGLTFReader, vtkOBJReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from script_support import ScriptTest, main

PROGRAM = sys.argv.pop()
CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], np.float32)
TRIANGLES = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], np.uint32)
COLORS = np.array([[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1], [0.4, 0.6, 0.8, 1]], np.float32)
TEXCOORDS = np.array([[0, 0], [1, 0], [0, 1], [0.25, 0.75]], np.float32)
NORMALS = np.array([[-3**-0.5] * 3, [1, 0, 0], [0, 1, 0], [0, 0, 1]], np.float32)
VELOCITIES = np.arange(12, dtype=np.float32).reshape(4, 3)


def tetrahedron(frame):
    message = TrackedMesh()
    message.header.stamp = genpy.Time(1000, 100000001 * frame)
    message.vertices = (CORNERS + np.float32(frame)).ravel().tolist()
    message.triangles = TRIANGLES.ravel().tolist()
    message.delta = [0.5, -0.25, 0.125, 0.0]
    message.ids = [7, 8, 9, 2**32 - 2]
    message.colors = COLORS.ravel().tolist()
    message.texcoords = TEXCOORDS.ravel().tolist()
    message.normals = NORMALS.ravel().tolist()
    message.velocities = VELOCITIES.ravel().tolist()
    message.interpolated = [
        InterpolatedField("velocity", 3, (-VELOCITIES).ravel().tolist()),
        InterpolatedField("temperature", 1, [300, 310, 320, np.nan]),
        InterpolatedField("rgb", 4, COLORS[::-1].ravel().tolist()),
        InterpolatedField("delta", 1, [1, 2, 3, 4]),  # The mesh has a delta of its own.
        InterpolatedField('a "b"\n<c>', 1, [5, 6, 7, 8]),
    ]
    return message


class ExportMeshes(ScriptTest):
    def setUp(self):
        super().setUp()
        self.bag = self.folder / "tracked.bag"
        with rosbag.Bag(str(self.bag), "w") as bag:
            for frame in range(4):
                message = tetrahedron(frame)
                bag.write("/tracked_mesh", message, message.header.stamp)
        self.out = self.folder / "meshes"

    def export(self, *arguments, exit_code=0):
        return self.run_program(PROGRAM, "--bag", self.bag, "--out", self.out, *arguments, exit_code=exit_code)

    def read(self, reader, name):
        reader.SetFileName(str(self.out / name))
        reader.Update()
        return reader.GetOutput()

    def test_vtp_has_everything(self):
        self.export("--format", "vtp")
        for frame in range(4):
            data = self.read(vtkXMLPolyDataReader(), f"frame_{frame:06}.vtp")
            np.testing.assert_array_equal(vtk_to_numpy(data.GetPoints().GetData()), CORNERS + frame)
            np.testing.assert_array_equal(vtk_to_numpy(data.GetPolys().GetConnectivityArray()), TRIANGLES.ravel())
            np.testing.assert_array_equal(vtk_to_numpy(data.GetPolys().GetOffsetsArray()), [0, 3, 6, 9, 12])
            arrays = data.GetPointData()
            np.testing.assert_array_equal(vtk_to_numpy(arrays.GetArray("id")), [7, 8, 9, 2**32 - 2])
            np.testing.assert_array_equal(vtk_to_numpy(arrays.GetArray("delta")), [0.5, -0.25, 0.125, 0])
            np.testing.assert_array_equal(vtk_to_numpy(arrays.GetArray("color")), np.round(255 * COLORS).astype(np.uint8))
            np.testing.assert_array_equal(vtk_to_numpy(arrays.GetArray("texcoord")), TEXCOORDS)
            np.testing.assert_array_equal(vtk_to_numpy(arrays.GetNormals()), NORMALS)
            np.testing.assert_array_equal(vtk_to_numpy(arrays.GetArray("vertex_velocity")), VELOCITIES)
            np.testing.assert_array_equal(vtk_to_numpy(arrays.GetArray("velocity")), -VELOCITIES)
            np.testing.assert_array_equal(vtk_to_numpy(arrays.GetArray("temperature")), [300, 310, 320, np.nan])
            np.testing.assert_array_equal(vtk_to_numpy(arrays.GetArray("rgb")), COLORS[::-1])
            np.testing.assert_array_equal(vtk_to_numpy(arrays.GetArray("particle_delta")), [1, 2, 3, 4])
            np.testing.assert_array_equal(vtk_to_numpy(arrays.GetArray("a__b___c_")), [5, 6, 7, 8])
            self.assertEqual(arrays.GetNumberOfArrays(), 11)

    def test_vtp_is_xml_throughout(self):
        self.export("--format", "vtp")
        for path in self.out.glob("*.vtp"):
            elements = {element.tag for element in xml.parse(path).iter()}
            self.assertIn("DataArray", elements)
            self.assertNotIn("AppendedData", elements)

    def test_the_time_series_has_the_stamps(self):
        self.export("--format", "vtp", "--first", "1", "--last", "2")
        sets = list(xml.parse(self.out / "frames.pvd").getroot().iter("DataSet"))
        self.assertEqual([(part.get("timestep"), part.get("file")) for part in sets],
                         [("1000.100000001", "frame_000001.vtp"), ("1000.200000002", "frame_000002.vtp")])
        self.assertEqual({path.name for path in self.out.iterdir()}, {"frames.pvd"} | {part.get("file") for part in sets})

    def test_glb_is_gltf_with_colours_and_normals(self):
        self.export("--format", "glb", "--first", "3", "--last", "3")
        self.assertEqual([path.name for path in self.out.iterdir()], ["frame_000003.glb"])
        blocks = self.read(vtkGLTFReader(), "frame_000003.glb")
        while not blocks.IsA("vtkPolyData"):
            self.assertEqual(blocks.GetNumberOfBlocks(), 1)
            blocks = blocks.GetBlock(0)
        points = vtk_to_numpy(blocks.GetPoints().GetData())
        triangles = vtk_to_numpy(blocks.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        corners = CORNERS + np.float32(3)
        order = [int(np.flatnonzero((corners == point).all(axis=1))[0]) for point in points]
        self.assertEqual(sorted(order), [0, 1, 2, 3])
        np.testing.assert_array_equal(np.sort(np.take(order, triangles), axis=1), np.sort(TRIANGLES, axis=1))
        volume = np.linalg.det(points[triangles].astype(float) - 3).sum() / 6
        self.assertAlmostEqual(volume, 1 / 6)  # Seen from outside they are still counter-clockwise.
        arrays = blocks.GetPointData()
        names = [arrays.GetArrayName(index) for index in range(arrays.GetNumberOfArrays())]
        np.testing.assert_allclose(vtk_to_numpy(arrays.GetNormals())[order.index(0)], -np.full(3, 3**-0.5), atol=1e-6)
        np.testing.assert_allclose(vtk_to_numpy(arrays.GetArray("COLOR_0"))[order.index(3)], COLORS[3], atol=1e-6, err_msg=names)
        # The origin of glTF's textures is at the top.
        np.testing.assert_allclose(vtk_to_numpy(arrays.GetArray("TEXCOORD_0"))[order.index(3)], [0.25, 0.25], atol=1e-6)

    def test_ply_and_obj(self):
        for name, reader, options in (("ply", vtkPLYReader(), []), ("obj", vtkOBJReader(), ["--format", "obj"])):
            self.export(*options)
            data = self.read(reader, f"frame_000002.{name}")
            np.testing.assert_array_equal(vtk_to_numpy(data.GetPoints().GetData()), CORNERS + 2)
            self.assertEqual(data.GetNumberOfPolys(), 4)

    def test_ply_has_the_fields(self):
        self.export("--last", "0")
        header, _, data = (self.out / "frame_000000.ply").read_bytes().partition(b"end_header\n")
        words = [line.split() for line in header.decode().splitlines() if line.startswith("property") and "list" not in line]
        types = {"float": "<f4", "uint": "<u4", "uchar": "u1"}
        vertices = np.frombuffer(data, np.dtype([(name, types[kind]) for _, kind, name in words]), count=4)
        for name, values in (("nx ny nz", NORMALS), ("vertex_velocity_0 vertex_velocity_1 vertex_velocity_2", VELOCITIES),
                             ("velocity_0 velocity_1 velocity_2", -VELOCITIES), ("particle_delta", [[1], [2], [3], [4]])):
            np.testing.assert_array_equal(np.stack([vertices[part] for part in name.split()], axis=1), values)
        np.testing.assert_array_equal(vertices["delta"], [0.5, -0.25, 0.125, 0])

    def test_fields_that_do_not_fit_are_bad_input(self):
        for frame, change in enumerate([lambda message: message.velocities.pop(), lambda message: message.normals.pop(),
                                        lambda message: message.interpolated[1].values.pop(),
                                        lambda message: setattr(message.interpolated[1], "components", 0)]):
            message = tetrahedron(0)
            change(message)
            with rosbag.Bag(str(self.bag), "w") as bag:
                bag.write("/tracked_mesh", message, message.header.stamp)
            _, errors = self.export(exit_code=2)
            self.assert_one_line(errors, "message 0 of topic /tracked_mesh", "temperature" if frame > 1 else "")

    def test_vdb_is_gamma_on_the_lattice_of_the_spacing(self):
        self.export("--format", "vdb", "--spacing", "0.2", "--first", "1", "--last", "2")
        self.assertEqual({path.name for path in self.out.iterdir()}, {"gamma_000001.vdb", "gamma_000002.vdb"})
        fine = (self.out / "gamma_000001.vdb").stat().st_size
        self.export("--format", "vdb", "--spacing", "0.2", "--dx-gamma", "1", "--first", "1", "--last", "1")
        self.assertLess((self.out / "gamma_000001.vdb").stat().st_size, fine)
        _, errors = self.export("--format", "vdb", exit_code=1)
        self.assertIn("--spacing", errors)

    def test_a_mesh_file_is_frame_0(self):
        self.export("--last", "0")
        mesh, other = self.out / "frame_000000.ply", self.folder / "other"
        self.run_program(PROGRAM, "--mesh", mesh, "--out", other, "--format", "vdb", "--spacing", "0.2")
        self.export("--last", "0", "--format", "vdb", "--spacing", "0.2")
        self.assertEqual((other / "gamma_000000.vdb").read_bytes(), (self.out / "gamma_000000.vdb").read_bytes())
        self.run_program(PROGRAM, "--mesh", mesh, "--out", other, "--format", "obj")
        self.assertTrue((other / "frame_000000.obj").exists())
        _, errors = self.run_program(PROGRAM, "--mesh", self.bag, "--out", other, exit_code=2)
        self.assert_one_line(errors, str(self.bag))
        self.run_program(PROGRAM, "--mesh", mesh, "--bag", self.bag, "--out", other, exit_code=1)
        self.run_program(PROGRAM, "--out", other, exit_code=1)

    def test_bad_input(self):
        _, errors = self.export("--first", "4", exit_code=2)
        self.assert_one_line(errors, str(self.bag), "4 messages", "the first to export is 4")
        _, errors = self.export("--topic", "/none", exit_code=2)
        self.assert_one_line(errors, "0 messages", "/none")
        for arguments in (["--format", "stl"], ["--first", "2", "--last", "1"], ["--first", "-1"]):
            self.export(*arguments, exit_code=1)
        self.assertFalse(self.out.exists())
        self.out.touch()
        _, errors = self.export(exit_code=4)
        self.assert_one_line(errors, str(self.out))


if __name__ == "__main__":
    main()
