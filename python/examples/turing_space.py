# %% [markdown]
# # Where Schnakenberg's model makes patterns
#
# Linear theory says at which supplies a and b the uniform state is stable without diffusion and unstable with it: the
# Turing space. `pelage.analyse` says it at no cost; a few coats then show whether it is true.

# %%
import os
import sys
from pathlib import Path

import numpy as np

import pelage

out = Path(sys.argv[1] if len(sys.argv) == 2 else "out")
out.mkdir(parents=True, exist_ok=True)
cells = int(os.environ.get("CELLS", 24))
d = 20

# %%
a = np.linspace(0.02, 0.4, cells)
b = np.linspace(0.3, 2.0, cells)
regimes = [[pelage.analyse("schnakenberg", {"a": x, "b": y, "d": d}).regime for x in a] for y in b]
letters = {"turing": "T", "quiet": ".", "mixed": "m", "oscillation": "o"}
print("b up, a to the right; T: patterns, m: patterns in what would oscillate by itself, .: nothing")
for row in reversed(regimes):
    print(" ".join(letters.get(regime, "?") for regime in row))

# %% [markdown]
# The conditions of textbooks (Murray, *Mathematical Biology II*, section 2.3): with the derivatives of the kinetics
# at the steady state, fu + gv < 0, the determinant > 0, d fu + gv > 0, and (d fu + gv)^2 > 4 d times the determinant.

# %%
A, B = np.meshgrid(a, b)
fu, fv, gu, gv = (B - A) / (A + B), (A + B)**2, -2 * B / (A + B), -(A + B)**2
determinant = fu * gv - fv * gu
textbook = (fu + gv < 0) & (determinant > 0) & (d * fu + gv > 0) & ((d * fu + gv)**2 > 4 * d * determinant)
theory = np.array(regimes) == "turing"
print(f"{theory.sum()} of {theory.size} cells are Turing-unstable; {(theory != textbook).sum()} differ from the book")

# %%
places = [{"a": x, "b": y} for x in (0.05, 0.15, 0.3) for y in (0.7, 1.1, 1.7)]
for place in places:
    place["waves"] = pelage.analyse("schnakenberg", {**place, "d": d}).regime in ("turing", "mixed")
grown = pelage.sweep("builtin:tile?n=48", model="schnakenberg", parameters={"d": d}, unit="0.6px",
                     over=[{"a": p["a"], "b": p["b"]} for p in places], measure=lambda coat: {"spots": coat.uniform})
for place, row in zip(places, grown.rows):
    place["grew"] = not row["uniform"] and not row["error"]
    print(f"a {place['a']:.2f}, b {place['b']:.2f}: theory {place['waves']}, grew {place['grew']} {row['error']}")
