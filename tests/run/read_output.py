"""Reads with h5py what check_output.c wrote from its invented state, and compares with the formulas of fake.h.

usage: read_output.py FOLDER DIM
"""
import json
import sys

import h5py
import numpy as np

FOLDER, DIM = sys.argv[1], int(sys.argv[2])
CELLS = np.array([20, 5, 4][:DIM])
TIMES = [0.25, 0.5]


def linear(x):
    return 100 + 10 * x[:, 0] - 30 * x[:, 1] + 7 * x[:, 2]


def padded(columns):
    """[n][dim] with the missing components as zeros"""
    return np.pad(np.stack(columns[:DIM], axis=1), ((0, 0), (0, 3 - DIM)))


def open_set(name, number):
    file = h5py.File(f"{FOLDER}/fields.{name}.{number:05d}.hdf", "r")
    kind = file["VTKHDF"].attrs.get_id("Type").get_type()
    assert file["VTKHDF"].attrs["Type"] == b"UnstructuredGrid"
    assert kind.get_size() == len("UnstructuredGrid") and kind.get_strpad() == h5py.h5t.STR_NULLPAD
    assert list(file["VTKHDF"].attrs["Version"]) == [1, 0]
    assert file["mpmice"].attrs["time"] == TIMES[number]
    return file["VTKHDF"]


def check_series(name):
    series = json.load(open(f"{FOLDER}/fields.{name}.hdf.series"))
    assert [f["time"] for f in series["files"]] == TIMES, series
    assert [f["name"] for f in series["files"]] == [f"fields.{name}.{i:05d}.hdf" for i in range(len(TIMES))]


def check_points(root, n):
    x = root["Points"][()]
    assert x.shape == (n, 3) and list(root["NumberOfPoints"]) == [n] and list(root["NumberOfCells"]) == [n]
    assert np.array_equal(root["Connectivity"], np.arange(n)) and np.array_equal(root["Offsets"], np.arange(n + 1))
    assert root["Connectivity"].dtype == np.int64 and root["Types"].dtype == np.uint8 and set(root["Types"]) == {1}
    if DIM == 2:
        assert not x[:, 2].any()
    return x


def check_solid(root):
    layers = 4 if DIM == 3 else 1
    x = check_points(root, 20 * 3 * layers * 2**DIM)
    data, f = root["PointData"], linear(x)
    assert set(data) == {"vel", "stress", "gradient", "volume", "group"}, set(data)
    assert np.allclose(data["vel"], padded([f, 2 * f, 3 * f]), rtol=1e-14)
    assert np.allclose(data["stress"], f[:, None] + np.arange(6), rtol=1e-14)
    gradient = np.zeros((3, 3))
    gradient[:DIM, :DIM] = 1 + np.arange(DIM * DIM).reshape(DIM, DIM)
    assert np.array_equal(data["gradient"], np.broadcast_to(gradient.ravel(), (len(x), 9)))
    assert data["volume"].shape == (len(x),) and data["vel"].attrs["unit"] == b"m/s"
    assert sorted(set(data["group"])) == [0, 1]


def check_cells(root):
    corners = root["Points"][()]
    n, k = np.prod(CELLS), 2**DIM
    assert len(corners) == np.prod(CELLS + 1) and root["Connectivity"].shape == (n * k,)
    cells = root["Connectivity"][()].reshape(n, k)
    assert np.array_equal(root["Offsets"], k * np.arange(n + 1)) and set(root["Types"]) == {12 if DIM == 3 else 9}
    centre = corners[cells].mean(axis=1)
    if DIM == 2:  # round the cell, not across it
        a = corners[cells]
        area = 0.5 * sum(a[:, i, 0] * a[:, (i + 1) % 4, 1] - a[:, (i + 1) % 4, 0] * a[:, i, 1] for i in range(4))
        assert np.allclose(area, 0.01)
    assert set(root["CellData"]) == {"P", "vel_fluid"}
    assert np.allclose(root["CellData/P"], linear(centre), rtol=1e-13)
    assert np.allclose(root["CellData/vel_fluid"], padded(list(centre.T)), rtol=1e-13, atol=1e-15)


for name in ("solid", "water", "cells"):
    check_series(name)
for number in range(len(TIMES)):
    check_solid(open_set("solid", number))
    water = open_set("water", number)
    assert np.allclose(water["PointData/P"], linear(check_points(water, 20 * 5 * (4 if DIM == 3 else 1) * 2**DIM)), rtol=1e-14)
    check_cells(open_set("cells", number))
