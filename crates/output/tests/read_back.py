"""Checks the particle files of a result directory with the real VTK: python3 read_back.py DIRECTORY

Needs the packages `vtk` and `numpy` from PyPI. Prints what it checked; exits with 1 and the reason if something is wrong.
"""

import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

COMPONENTS = {
    "Displacement": 3,
    "Velocity": 3,
    "Density": 1,
    "Pressure": 1,
    "VonMisesStress": 1,
    "CauchyStress": 9,
    "DeformationGradient": 9,
    "ParticleSpacing": 1,
    "ParticleId": 1,
    "Body": 1,
}


def require(condition, message):
    """Ends the check with `message` unless `condition` holds."""
    if not condition:
        sys.exit(f"read_back: {message}")


def listed_frames(pvd):
    """(time, path) of every frame in the list, in its order."""
    require(pvd.is_file(), f"{pvd} is missing")
    entries = ElementTree.parse(pvd).getroot().iter("DataSet")
    frames = [(float(entry.get("timestep")), pvd.parent / entry.get("file")) for entry in entries]
    require(frames, f"{pvd} lists no frame")
    times = [time for time, _ in frames]
    require(all(a < b for a, b in zip(times, times[1:])), f"{pvd}: the times do not increase")
    return frames


def opened(path):
    """The data set in `path`; VTK's own complaints are errors."""
    complaints = []
    reader = vtk.vtkXMLPolyDataReader()
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda *_: complaints.append(event))
    reader.SetFileName(str(path))
    require(path.is_file() and reader.CanReadFile(str(path)), f"VTK cannot read {path}")
    reader.Update()
    require(not complaints, f"VTK complains about {path}")
    return reader.GetOutput()


def check_array(data, name, components, path):
    """One quantity: there, right shape, finite, with a unit. Returns 'name [unit]'."""
    array = data.GetPointData().GetArray(name)
    require(array is not None, f"{path}: no {name}")
    found = (array.GetNumberOfTuples(), array.GetNumberOfComponents())
    expected = (data.GetNumberOfPoints(), components)
    require(found == expected, f"{path}: {name} has shape {found} instead of {expected}")
    require(numpy.isfinite(vtk_to_numpy(array)).all(), f"{path}: {name} has numbers that are not finite")
    unit = array.GetInformation().Get(vtk.vtkDataArray.UNITS_LABEL())
    require(unit, f"{path}: {name} has no unit")
    return f"{name} [{unit}]"


def check_frame(time, path):
    """One file. Returns the identities of its particles and the labels of its quantities."""
    data = opened(path)
    value = data.GetFieldData().GetArray("TimeValue")
    require(value is not None and value.GetNumberOfTuples() == 1, f"{path}: no TimeValue")
    require(value.GetValue(0) == time, f"{path}: TimeValue {value.GetValue(0)} but listed at {time}")
    require(data.GetNumberOfVerts() == data.GetNumberOfPoints(), f"{path}: not one vertex per particle")
    kind = data.GetPoints().GetData().GetDataTypeAsString()
    require(kind == "double", f"{path}: positions are {kind} instead of double")
    labels = [check_array(data, name, components, path) for name, components in COMPONENTS.items()]
    ids = vtk_to_numpy(data.GetPointData().GetArray("ParticleId")).tolist()
    require(len(set(ids)) == len(ids), f"{path}: a ParticleId stands twice")
    return set(ids), labels


def main():
    require(len(sys.argv) == 2, "give one result directory")
    frames = listed_frames(Path(sys.argv[1]) / "particles" / "particles.pvd")
    first, labels = check_frame(*frames[0])
    for time, path in frames[1:]:
        ids, _ = check_frame(time, path)
        require(ids == first, f"{path}: other particles than in the first frame")
    print(f"VTK {vtk.vtkVersion.GetVTKVersion()} reads {len(frames)} frames, {frames[0][0]} s to {frames[-1][0]} s")
    print(f"{len(first)} particles, the same ParticleId in every frame, one vertex each, positions double")
    print("times increase and equal TimeValue; quantities: " + ", ".join(labels))


if __name__ == "__main__":
    main()
