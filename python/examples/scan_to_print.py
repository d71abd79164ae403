# %% [markdown]
# # From a scan to a part that is printed
#
# A scan is noisy. Here noise is put on a clean shape, so that what fairing takes off can be measured; then a coat
# grows in relief and is written for a printer.

# %%
import os
import sys
from pathlib import Path

import numpy as np

import pelage

out = Path(sys.argv[1] if len(sys.argv) == 2 else "out")
out.mkdir(parents=True, exist_ok=True)
quality = os.environ.get("QUALITY", "normal")

# %%
clean = pelage.load("builtin:animal")
edges = clean.points[clean.triangles] - clean.points[np.roll(clean.triangles, 1, axis=1)]
mean_edge = np.linalg.norm(edges, axis=2).mean()
noise = np.random.default_rng(1).normal(0, 0.15 * mean_edge, clean.points.shape)
scan = pelage.Shape(clean.points + noise, clean.triangles, name="scan")
scan.save(out / "scan.ply")

# %%
faired = pelage.fair(scan)


def roughness(points):
    """Mean angle between neighbouring triangles' normals and those of the clean shape [degrees]."""
    def normals(p):
        a, b, c = (p[clean.triangles[:, k]] for k in range(3))
        n = np.cross(b - a, c - a)
        return n / np.linalg.norm(n, axis=1, keepdims=True)
    return np.degrees(np.arccos((normals(points) * normals(clean.points)).sum(1).clip(-1, 1))).mean()


rough = roughness(scan.points), roughness(faired.points)
print(f"normals are off by {rough[0]:.1f} degrees before fairing, {rough[1]:.1f} after; "
      f"it took {faired.report['steps']} steps")

# %%
coat = pelage.grow(faired.shape, model="schnakenberg", size=0.06, seed=4, quality=quality,
                   materials={"height": "0.08*smoothstep(1, 2, u)"}, displace=True)
for name in ("part.3mf", "part.stl"):
    for loss in coat.save(out / name):
        print(f"{name}: {loss}")
for warning in coat.warnings:
    print("warning:", warning)

# %%
part = pelage.load(out / "part.stl")
print(part, [finding["text"] for finding in part.findings])
