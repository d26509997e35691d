#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens ParaView files with VTK's own reader:
  check_vtk.py FILE.vtu POINTS CELLS ARRAYS   numbers of points, cells and point arrays
  check_vtk.py SERIES.pvd TABLE_anim.dat      every file of the series holds its zone of the table
Ends with status 0 when all is right and the reader has no complaint, 77 without VTK."""
import os
import re
import sys
import tempfile
import xml.etree.ElementTree

try:
    from vtkmodules.vtkCommonCore import vtkFileOutputWindow, vtkOutputWindow
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError:
    print("VTK is not installed here")
    sys.exit(77)

# arrays of the .vtu files by the results' names in the table, where they differ or MPM3D has them
ARRAY = {"mat": "mat", "seqv": "seqv", "epef": "epeff", "pres": "pressure", "volu": "vol", "velx": "vx", "vely": "vy",
         "velz": "vz", "disx": "disx", "disy": "disy", "disz": "disz", "cels": "celsius_t", "damg": "damage",
         "stsx": "stressx", "stsy": "stressy", "stsz": "stressz", "styz": "stressyz", "stxz": "stressxz",
         "stxy": "stressxy"}


def fail(message):
    print(message)
    sys.exit(1)


def read(name):
    """Points, number of cells and point arrays of a .vtu file."""
    with tempfile.TemporaryDirectory() as folder:
        log = os.path.join(folder, "log")
        window = vtkFileOutputWindow()
        window.SetFileName(log)
        vtkOutputWindow.SetInstance(window)
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(name)
        reader.Update()
        if os.path.exists(log) and os.path.getsize(log) > 0:
            with open(log) as complaint:
                fail("%s: %s" % (name, complaint.read()))
    grid = reader.GetOutput()
    data = {}
    for i in range(grid.GetPointData().GetNumberOfArrays()):
        array = grid.GetPointData().GetArray(i)
        if array.GetName() in data:
            fail("%s: two arrays %s" % (name, array.GetName()))
        data[array.GetName()] = [array.GetValue(k) for k in range(array.GetNumberOfValues())]
    points = [grid.GetPoint(i) for i in range(grid.GetNumberOfPoints())]
    return points, grid.GetNumberOfCells(), data


def read_table(name):
    """Names of the columns, and (time, rows) of every zone."""
    names, zones = [], []
    with open(name) as lines:
        for line in lines:
            if line.startswith("VARIABLES"):
                names = [n.strip().lower() for n in re.findall(r'"([^"]*)"', line)]
            elif line.startswith("ZONE"):
                zones.append((float(re.search(r"SOLUTIONTIME=(\S+)", line).group(1)), []))
            elif zones:
                zones[-1][1].append([float(number) for number in line.split()])
    return names, zones


def compare(what, found, expected):
    largest = max(map(abs, expected), default=0) or 1
    if len(found) != len(expected):
        fail("%s: %d values instead of %d" % (what, len(found), len(expected)))
    for i, (a, b) in enumerate(zip(found, expected)):
        if not abs(a - b) <= 1e-9 * largest:
            fail("%s: value %d is %r instead of %r" % (what, i + 1, a, b))


def check_series(series, table):
    names, zones = read_table(table)
    sets = xml.etree.ElementTree.parse(series).getroot().findall("Collection/DataSet")
    if len(sets) != len(zones) or not zones:
        fail("%s: %d files for %d zones" % (series, len(sets), len(zones)))
    for part, (time, rows) in zip(sets, zones):
        name = os.path.join(os.path.dirname(series), part.get("file"))
        compare(name + " time", [float(part.get("timestep"))], [time])
        points, cells, data = read(name)
        if cells != len(rows):
            fail("%s: %d cells for %d points" % (name, cells, len(rows)))
        for axis in range(3):
            compare(name + " points", [point[axis] for point in points], [row[axis] for row in rows])
        for k, result in enumerate(names[3:], 3):
            array = ARRAY.get(result, result)
            if array not in data:
                fail("%s: no array %s" % (name, array))
            compare("%s array %s" % (name, array), data[array], [row[k] for row in rows])
    print("%s: %d files, %d points, %d columns as in %s" % (series, len(sets), len(zones[0][1]), len(names), table))


if len(sys.argv) == 3:
    check_series(sys.argv[1], sys.argv[2])
elif len(sys.argv) == 5:
    found = read(sys.argv[1])
    counts = [len(found[0]), found[1], len(found[2])]
    if counts != [int(number) for number in sys.argv[2:]]:
        fail("%s: %d points, %d cells, %d arrays" % (sys.argv[1], *counts))
else:
    fail(__doc__)
