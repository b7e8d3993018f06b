#!/usr/bin/env python3
"""Opens every fields.<set>.hdf.series of an output folder as ParaView does and compares what comes out with h5py.

usage: open_in_paraview.py FOLDER
Uses pvbatch where there is one (the series itself, as a user opens it), else VTK's reader file by file.
Exit status: 0 all equal, 1 a difference, 77 neither ParaView nor VTK installed.
"""
import glob
import json
import os
import shutil
import subprocess
import sys

import h5py
import numpy as np


def expect(condition, what):
    if not condition:
        print(f"open_in_paraview.py: {what}", file=sys.stderr)
        sys.exit(1)


def arrays(data):
    return {data.GetArrayName(i): data.GetArray(i) for i in range(data.GetNumberOfArrays())}


def compare_data(path, group, data):
    from vtkmodules.util.numpy_support import vtk_to_numpy

    got = arrays(data)
    expect(set(group) == set(got), f"{path}: arrays {sorted(got)}, the file holds {sorted(group)}")
    for name, stored in group.items():
        expect(np.array_equal(vtk_to_numpy(got[name]), stored[()], equal_nan=stored.dtype.kind == "f"), f"{path}: {name} differs")


def compare(path, grid):
    """grid: the vtkUnstructuredGrid that the reader made of the file."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    with h5py.File(path, "r") as file:
        root = file["VTKHDF"]
        expect(grid.GetNumberOfPoints() == root["NumberOfPoints"][0], f"{path}: number of points")
        expect(grid.GetNumberOfCells() == root["NumberOfCells"][0], f"{path}: number of cells")
        expect(np.array_equal(vtk_to_numpy(grid.GetPoints().GetData()), root["Points"][()]), f"{path}: places")
        types = [grid.GetCellType(i) for i in range(grid.GetNumberOfCells())]
        expect(types == list(root["Types"][()]), f"{path}: cell types")
        compare_data(path, root.get("PointData", {}), grid.GetPointData())
        compare_data(path, root.get("CellData", {}), grid.GetCellData())
        return grid.GetNumberOfCells(), grid.GetPointData().GetNumberOfArrays() + grid.GetCellData().GetNumberOfArrays()


def read_series(series):
    with open(series) as file:
        listed = json.load(file)
    expect(listed["file-series-version"] == "1.0", f"{series}: version")
    return [(os.path.join(os.path.dirname(series), f["name"]), f["time"]) for f in listed["files"]]


def with_vtk(series):
    from vtkmodules.vtkIOHDF import vtkHDFReader

    for path, _ in read_series(series):
        reader = vtkHDFReader()
        expect(reader.CanReadFile(path), f"{path}: VTK does not take it")
        reader.SetFileName(path)
        reader.Update()
        yield path, reader.GetOutput()


def with_paraview(series):
    from paraview.simple import OpenDataFile, servermanager, UpdatePipeline

    source = OpenDataFile(series)
    expect(source is not None, f"{series}: ParaView does not take it")
    UpdatePipeline(proxy=source)
    times = source.TimestepValues if hasattr(source.TimestepValues, "__len__") else [source.TimestepValues]
    files = read_series(series)
    expect(np.allclose(times, [t for _, t in files], rtol=1e-14, atol=0), f"{series}: times {list(times)}")
    for path, time in files:
        UpdatePipeline(time=time, proxy=source)
        yield path, servermanager.Fetch(source)


def check(folder, opener, name):
    found = sorted(glob.glob(os.path.join(folder, "fields.*.hdf.series")))
    expect(found, f"{folder}: no fields.*.hdf.series")
    for series in found:
        seen = [compare(path, grid) for path, grid in opener(series)]
        expect(seen, f"{series}: empty")
        print(f"{name} opens {os.path.basename(series)}: {len(seen)} snapshots, {seen[-1][0]} cells, {seen[-1][1]} arrays")


def has_vtk():
    try:
        from vtkmodules.vtkIOHDF import vtkHDFReader  # noqa: F401
    except ImportError:
        return False
    return True


def main():
    folder = sys.argv[1]
    if os.environ.get("MPMICE_INSIDE_PVBATCH"):
        return check(folder, with_paraview, "ParaView")
    pvbatch = shutil.which("pvbatch")
    if pvbatch:
        environment = dict(os.environ, QT_QPA_PLATFORM="offscreen", MPMICE_INSIDE_PVBATCH="1")
        expect(subprocess.run([pvbatch, __file__, folder], env=environment).returncode == 0, "pvbatch failed")
    if has_vtk():
        check(folder, with_vtk, "VTK")
    elif not pvbatch:
        print("open_in_paraview.py: neither pvbatch nor VTK is installed", file=sys.stderr)
        sys.exit(77)


main()
