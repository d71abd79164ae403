# pvpython check_paraview.py FILE: reads it with ParaView's own reader and renders it once.
import os
import sys

from paraview import servermanager
from paraview.simple import (ColorBy, CreateView, PLYReader, Render, Show, WavefrontOBJReader, XMLPolyDataReader)

path = sys.argv[1]
kind = path.rsplit(".", 1)[-1]
reader = (PLYReader(FileNames=[path]) if kind == "ply" else
          XMLPolyDataReader(FileName=[path]) if kind == "vtp" else WavefrontOBJReader(FileName=path))
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
if data.GetNumberOfPoints() == 0 or data.GetNumberOfPolys() == 0:
    fault = "nothing was read"
if kind != "obj" and not ("RGB" in arrays and arrays["RGB"][0] < arrays["RGB"][1]):
    fault = "no colours in %s" % arrays
if kind == "vtp" and "Normals" not in arrays:
    fault = "no normals in %s" % arrays
print(fault or "ok %d points %d triangles, arrays %s" % (
    data.GetNumberOfPoints(), data.GetNumberOfPolys(), " ".join(sorted(arrays))))
sys.stdout.flush()
os._exit(1 if fault else 0)  # ParaView 5.11 may crash while it closes down without a display
