# blender -b --factory-startup --python-exit-code 3 -P check_exr.py -- FILE: reads an EXR image with OpenEXR.
import sys

import bpy

image = bpy.data.images.load(sys.argv[sys.argv.index("--") + 1])
width, height = image.size
pixels = list(image.pixels)
assert width * height > 0 and len(pixels) == 4 * width * height, "no pixels"
values = set(pixels[0::4]) | set(pixels[1::4]) | set(pixels[2::4])
assert len(values) > 2, "only %d different values" % len(values)
print("ok %d x %d pixels, %d values from %g to %g" % (width, height, len(values), min(values), max(values)))
