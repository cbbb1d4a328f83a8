#!/usr/bin/env python3
"""One picture of a tracked sequence: a column per frame; in the rows the surface that the particles alone give, the
tracked mesh, and both from near, at a point of the mesh that is followed. Insides are red: red is a hole or a tear.

Needs python3-vtk9 (Debian) and a screen; without one: xvfb-run -a python3 contact_sheet.py …
"""
import argparse
import pathlib
import re
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (vtkActor, vtkLight, vtkPolyDataMapper, vtkProperty, vtkRenderer, vtkRenderWindow,
                                         vtkTextActor, vtkWindowToImageFilter)
import vtkmodules.vtkRenderingFreeType  # noqa: F401  registers the text renderer
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  registers the renderer

PALE = (0.70, 0.79, 0.88)
INSIDE = (0.85, 0.10, 0.05)
BALL = (0.45, 0.45, 0.47)
MARGIN_LEFT, MARGIN_TOP = 34, 34  # Pixels for the labels.
PLY_TYPES = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4",
             "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4",
             "float32": "f4", "float64": "f8"}


def main():
    arguments = parse_arguments()
    implicit_files, tracked_files = frames_in(arguments.implicit), frames_in(arguments.tracked)
    common = sorted(implicit_files.keys() & tracked_files.keys())
    if not common:
        sys.exit(f"contact_sheet: {arguments.implicit} and {arguments.tracked} have no frame in common")
    frames = [common[i] for i in np.unique(np.linspace(0, len(common) - 1, arguments.columns).round().astype(int))]
    implicit = [Mesh(implicit_files[k]) for k in frames]
    tracked = [Mesh(tracked_files[k]) for k in frames]

    far = Camera(arguments.view, arguments.up, implicit + tracked)
    near = [far.moved_to(point, arguments.zoom) for point in followed_point(tracked, far)]
    rows = [("particles alone", implicit, [far] * len(frames)), ("tracked mesh", tracked, [far] * len(frames)),
            ("particles, near", implicit, near), ("tracked, near", tracked, near)]
    draw(rows, [f"frame {k}" for k in frames], arguments.ball, far.aspect, arguments.width, arguments.out)
    print(arguments.out)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--implicit", type=pathlib.Path, required=True, help="folder of PLY files: particles alone")
    parser.add_argument("--tracked", type=pathlib.Path, required=True, help="folder of PLY files: tracked mesh")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="the picture, PNG")
    parser.add_argument("--columns", type=int, default=6, help="number of frames shown")
    parser.add_argument("--width", type=int, default=400, help="of a column [pixels]")
    parser.add_argument("--view", type=float, nargs=3, default=(0.35, -1.0, 0.9), help="direction to the camera")
    parser.add_argument("--up", type=float, nargs=3, default=(0, 0, 1), help="direction that is up in the picture")
    parser.add_argument("--ball", type=float, nargs=4, metavar=("X", "Y", "Z", "RADIUS"), help="also shows a solid ball")
    parser.add_argument("--zoom", type=float, default=3.5, help="of the rows that show the surface from near")
    return parser.parse_args()


def frames_in(folder):
    """{frame number: path}; the number is the last one in the file's name."""
    numbered = {path: re.findall(r"\d+", path.stem) for path in folder.glob("*.ply")}
    return {int(numbers[-1]): path for path, numbers in numbered.items() if numbers}


class Mesh:
    """Positions, triangles, and ids and colours where the file has them."""

    def __init__(self, path):
        with open(path, "rb") as file:
            vertex_count, vertex_type, face_count, face_type = read_ply_header(file, path)
            vertices = np.fromfile(file, vertex_type, vertex_count)
            faces = np.fromfile(file, face_type, face_count)
        names = vertices.dtype.names
        self.positions = np.stack([vertices[axis] for axis in "xyz"], axis=1).astype(np.float64)
        self.triangles = faces["corners"].astype(np.int64)
        self.ids = vertices["id"] if "id" in names else np.arange(vertex_count)
        self.colors = None
        if {"red", "green", "blue"} <= set(names):
            self.colors = np.ascontiguousarray(np.stack([vertices[c] for c in ("red", "green", "blue")], axis=1))

    def normals(self):
        """One per vertex, of length 1."""
        corners = self.positions[self.triangles]
        of_triangles = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals = np.zeros_like(self.positions)
        for corner in range(3):
            np.add.at(normals, self.triangles[:, corner], of_triangles)
        return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)

    def actor(self):
        poly = vtkPolyData()
        points = vtkPoints()
        points.SetData(numpy_to_vtk(self.positions, deep=True))
        poly.SetPoints(points)
        cells = vtkCellArray()
        counted = np.insert(self.triangles, 0, 3, axis=1).ravel()
        cells.SetCells(len(self.triangles), numpy_to_vtkIdTypeArray(counted, deep=True))
        poly.SetPolys(cells)
        if self.colors is not None:
            poly.GetPointData().SetScalars(numpy_to_vtk(self.colors, deep=True))
        normals = vtkPolyDataNormals()
        normals.SetInputData(poly)
        normals.SplittingOff()
        normals.ConsistencyOff()
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(normals.GetOutputPort())
        actor = vtkActor()
        actor.SetMapper(mapper)
        surface = actor.GetProperty()
        surface.SetColor(PALE)
        surface.SetAmbient(0.10)
        surface.SetSpecular(0.25)
        surface.SetSpecularPower(30)
        inside = vtkProperty()
        inside.SetColor(INSIDE)
        inside.SetAmbient(0.5)
        actor.SetBackfaceProperty(inside)
        return actor


def read_ply_header(file, path):
    """Counts and record types of vertices and triangles of a binary little-endian PLY file."""
    elements, line = [], ""
    while line != "end_header":
        line = file.readline().decode("ascii", "replace").strip()
        words = line.split()
        if not words:
            sys.exit(f"contact_sheet: {path} is not a PLY file")
        if words[0] == "format" and words[1] != "binary_little_endian":
            sys.exit(f"contact_sheet: {path} is {words[1]} PLY; only binary_little_endian is read")
        if words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property" and words[1] == "list":
            elements[-1][2].extend([("count", PLY_TYPES[words[2]]), ("corners", "<" + PLY_TYPES[words[3]], 3)])
        elif words[0] == "property":
            elements[-1][2].append((words[2], "<" + PLY_TYPES[words[1]]))
    (_, vertex_count, vertex_type), (_, face_count, face_type) = elements[:2]
    return vertex_count, np.dtype(vertex_type), face_count, np.dtype(face_type)


class Camera:
    """A parallel projection that shows all meshes of all frames."""

    def __init__(self, view, up, meshes):
        self.direction = np.array(view) / np.linalg.norm(view)
        self.right = np.cross(up, self.direction)
        self.right /= np.linalg.norm(self.right)
        self.up = np.cross(self.direction, self.right)
        everything = np.concatenate([mesh.positions for mesh in meshes])
        across, upward = everything @ self.right, everything @ self.up
        depth = everything @ self.direction
        middle = [(values.min() + values.max()) / 2 for values in (across, upward, depth)]
        self.focus = middle[0] * self.right + middle[1] * self.up + middle[2] * self.direction
        self.reach = np.ptp(depth) + np.ptp(across) + np.ptp(upward)
        self.aspect = np.clip(1.04 * np.ptp(across) / (1.04 * np.ptp(upward)), 0.6, 2.0)
        self.scale = 0.53 * max(np.ptp(upward), np.ptp(across) / self.aspect)

    def moved_to(self, focus, zoom):
        other = Camera.__new__(Camera)
        other.__dict__.update(self.__dict__, focus=focus, scale=self.scale / zoom)
        return other

    def apply(self, camera):
        camera.ParallelProjectionOn()
        camera.SetFocalPoint(self.focus)
        camera.SetPosition(self.focus + self.reach * self.direction)
        camera.SetViewUp(self.up)
        camera.SetParallelScale(self.scale)


def followed_point(meshes, camera):
    """Where one vertex is in every mesh: of those that live throughout and face the camera, the one nearest to it.

    Without such a vertex, the point of every mesh that is nearest to the camera.
    """
    alive = meshes[0].ids
    for mesh in meshes[1:]:
        alive = np.intersect1d(alive, mesh.ids)
    facing, nearness = np.full(len(alive), np.inf), np.full(len(alive), np.inf)
    rows = []
    for mesh in meshes:
        order = np.argsort(mesh.ids)
        row = order[np.searchsorted(mesh.ids, alive, sorter=order)]
        rows.append(row)
        facing = np.minimum(facing, mesh.normals()[row] @ camera.direction)
        nearness = np.minimum(nearness, mesh.positions[row] @ camera.direction)
    visible = facing > 0.6
    if not visible.any():
        return [mesh.positions[np.argmax(mesh.positions @ camera.direction)] for mesh in meshes]
    best = np.argmax(np.where(visible, nearness, -np.inf))
    return [mesh.positions[row[best]] for mesh, row in zip(meshes, rows)]


def draw(rows, titles, ball, aspect, width, path):
    """Renders all cells of the sheet in one window and saves it."""
    height = round(width / aspect)
    size = (MARGIN_LEFT + width * len(titles), MARGIN_TOP + height * len(rows))
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(8)
    window.SetSize(*size)
    labels = vtkRenderer()
    labels.SetBackground(1, 1, 1)
    window.AddRenderer(labels)
    for column, title in enumerate(titles):
        labels.AddActor2D(label(title, MARGIN_LEFT + width * (column + 0.5), size[1] - MARGIN_TOP / 2, 0))
    for row, (title, meshes, cameras) in enumerate(rows):
        bottom = size[1] - MARGIN_TOP - height * (row + 1)
        labels.AddActor2D(label(title, MARGIN_LEFT / 2, bottom + height / 2, 90))
        for column, (mesh, camera) in enumerate(zip(meshes, cameras)):
            left = MARGIN_LEFT + width * column
            renderer = lit_renderer([mesh.actor()] + ([ball_actor(*ball)] if ball else []))
            renderer.SetViewport((left + 1) / size[0], (bottom + 1) / size[1], (left + width - 1) / size[0],
                                 (bottom + height - 1) / size[1])
            camera.apply(renderer.GetActiveCamera())
            renderer.ResetCameraClippingRange()
            window.AddRenderer(renderer)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(image.GetOutputPort())
    writer.SetFileName(str(path))
    writer.Write()


def lit_renderer(actors):
    renderer = vtkRenderer()
    renderer.SetBackground(0.96, 0.96, 0.97)
    renderer.AutomaticLightCreationOff()
    for position, intensity in (((-1.0, 1.4, 1.0), 0.80), ((1.5, 0.2, 0.8), 0.30), ((0.2, -1.0, 0.6), 0.15)):
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(*position)
        light.SetIntensity(intensity)
        renderer.AddLight(light)
    for actor in actors:
        renderer.AddActor(actor)
    return renderer


def ball_actor(x, y, z, radius):
    ball = vtkSphereSource()
    ball.SetCenter(x, y, z)
    ball.SetRadius(radius)
    ball.SetThetaResolution(60)
    ball.SetPhiResolution(30)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(ball.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(BALL)
    return actor


def label(text, x, y, angle):
    actor = vtkTextActor()
    actor.SetInput(text)
    actor.SetOrientation(angle)
    actor.SetPosition(x, y)
    style = actor.GetTextProperty()
    style.SetFontSize(18)
    style.SetColor(0.15, 0.15, 0.15)
    style.SetJustificationToCentered()
    style.SetVerticalJustificationToCentered()
    return actor


if __name__ == "__main__":
    main()
