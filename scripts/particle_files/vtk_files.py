"""VTK legacy files, VTU and VTP, by VTK."""
import re

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkIOLegacy import vtkGenericDataObjectReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader

from .errors import InputError

READERS = {".vtk": vtkGenericDataObjectReader, ".vtu": vtkXMLUnstructuredGridReader, ".vtp": vtkXMLPolyDataReader}


def read(path):
    # VTK throws nothing, and goes on with what it has: all that it says is taken for an error.
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    said = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(said)
    reader = READERS[path.suffix.lower()]()
    reader.SetFileName(str(path))
    reader.Update()
    if said.GetOutput().strip():
        raise InputError(first_message(said.GetOutput()))
    data = reader.GetOutput()
    if not hasattr(data, "GetPoints") or data.GetPoints() is None:
        raise InputError("it holds no points")
    fields = {"position": vtk_to_numpy(data.GetPoints().GetData())}
    point_data = data.GetPointData()
    for index in range(point_data.GetNumberOfArrays()):
        array = point_data.GetArray(index)  # None for text
        if array is not None and array.GetName():
            fields[array.GetName()] = vtk_to_numpy(array)
    return [fields]


def first_message(text):
    """VTK puts before its messages the place in its own source, and the object."""
    lines = [line.split("): ", 1)[-1] for line in text.splitlines()]
    lines = [line for line in lines if line.strip() and not re.match(r"\s*(ERROR|Warning|Generic Warning): In ", line)]
    return (lines or ["it cannot be read"])[0].strip()
