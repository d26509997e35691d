#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens .vtu files with VTK's own reader and compares them: check_vtk.py FILE [SAME_DATA_AS]
Ends with status 0 when the reader has no complaint (and both hold the same), 77 without VTK."""
import sys

try:
    from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkFileOutputWindow
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError:
    print("VTK is not installed here: this check is left out")
    sys.exit(77)

import os
import tempfile


def read(name):
    log = tempfile.mktemp()
    window = vtkFileOutputWindow()
    window.SetFileName(log)
    vtkOutputWindow.SetInstance(window)
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(name)
    reader.Update()
    complaint = open(log).read() if os.path.exists(log) else ""
    if complaint:
        print(complaint)
        sys.exit(1)
    grid = reader.GetOutput()
    data = {}
    for i in range(grid.GetPointData().GetNumberOfArrays()):
        array = grid.GetPointData().GetArray(i)
        data[array.GetName()] = [array.GetValue(k) for k in range(array.GetNumberOfValues())]
    points = [grid.GetPoint(i) for i in range(grid.GetNumberOfPoints())]
    return points, grid.GetNumberOfCells(), data


points, cells, data = read(sys.argv[1])
print("%s: %d points, %d cells, %d arrays" % (sys.argv[1], len(points), cells, len(data)))
if not points or not cells or len(set(data)) != len(data):
    sys.exit(1)
if len(sys.argv) > 2:
    other = read(sys.argv[2])
    for name in data:
        largest = max(map(abs, data[name])) or 1
        if any(abs(a - b) > 1e-6 * largest for a, b in zip(data[name], other[2][name])):
            print("array %s differs" % name)
            sys.exit(1)
    if other[1] != cells or len(other[0]) != len(points):
        sys.exit(1)
