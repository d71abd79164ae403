# pvpython check_paraview.py FILE: reads it with ParaView's own reader and renders it once.
import os
import sys

from paraview import servermanager
from paraview.simple import (ColorBy, CreateView, PLYReader, Render, Show, WavefrontOBJReader, XMLImageDataReader,
                             XMLPolyDataReader, XMLStructuredGridReader)

path = sys.argv[1]
kind = path.rsplit(".", 1)[-1]
xml = {"vtp": XMLPolyDataReader, "vti": XMLImageDataReader, "vts": XMLStructuredGridReader}
grid = kind in ("vti", "vts")
reader = (PLYReader(FileNames=[path]) if kind == "ply" else
          xml[kind](FileName=[path]) if kind in xml else WavefrontOBJReader(FileName=path))
reader.UpdatePipeline()
data = servermanager.Fetch(reader)
arrays = {}
for k in range(data.GetPointData().GetNumberOfArrays()):
    array = data.GetPointData().GetArray(k)
    arrays[array.GetName()] = array.GetRange(0)
view = CreateView("RenderView")
shown = Show(reader, view)
if "RGB" in arrays:
    ColorBy(shown, ("POINTS", "RGB"))
    shown.MapScalars = 0
Render(view)
fault = None
cells = data.GetNumberOfCells() if grid else data.GetNumberOfPolys()
if data.GetNumberOfPoints() == 0 or cells == 0:
    fault = "nothing was read"
if kind != "obj" and not ("RGB" in arrays and arrays["RGB"][0] < arrays["RGB"][1]):
    fault = "no colours in %s" % arrays
if kind == "vtp" and "Normals" not in arrays:
    fault = "no normals in %s" % arrays
print(fault or "ok %d points %d %s, arrays %s" % (
    data.GetNumberOfPoints(), cells, "cells" if grid else "triangles", " ".join(sorted(arrays))))
sys.stdout.flush()
os._exit(1 if fault else 0)  # ParaView 5.11 may crash while it closes down without a display
