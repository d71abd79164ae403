# %% [markdown]
# # Patterns on what grows
#
# On a line that grows exponentially, the peaks of Schnakenberg's model split and double, again and again (Crampin,
# Gaffney, Maini 1999, Bull. Math. Biol. 61, 1093-1120). In coordinates that grow with the line its diffusions fall as
# exp(-2 r t), and growth dilutes.

# %%
import os
import sys
from pathlib import Path

import numpy as np

import pelage

out = Path(sys.argv[1] if len(sys.argv) == 2 else "out")
out.mkdir(parents=True, exist_ok=True)
until = float(os.environ.get("UNTIL", 300))
nodes = int(os.environ.get("NODES", 801))
growth = 0.01

line = pelage.Model(f"""
name = "growing-line"
title = "Schnakenberg on a growing line"
wavelength = 1
[species.v]
diffusion = "exp(-2*{growth}*t)"
rate = "0.9 - u^2*v - {growth}*v"
initial = "0.9"
[species.u]
diffusion = "0.01*exp(-2*{growth}*t)"
rate = "0.1 - u + u^2*v - {growth}*u"
initial = "1 + 0.1*cos(pi*x)"
""", "growing-line")

# %%
run = pelage.Run(f"builtin:line?n={nodes}", model=line, unit="1u", until=until)
rows, peaks = [], []
for moment in np.arange(10, until + 1, 10):
    while not run.done and run.time < moment:
        run.advance(1)
    u = run.get("u")
    rows.append(u)
    high = np.concatenate([[-np.inf], u, [-np.inf]])
    top = (high[1:-1] > high[:-2]) & (high[1:-1] >= high[2:]) & (u > (u.min() + u.max()) / 2)
    peaks.append((2 * top.sum() - top[0] - top[-1]) if np.ptp(u) > 0.1 else 0)  # in halves: those at an end are half
    print(f"t {run.time:5.1f}, length {np.exp(growth * run.time):6.1f}: {peaks[-1] / 2:g} peaks")
rows = np.array(rows)
pelage.save_png(np.repeat(np.repeat((rows / rows.max())[..., None], 3, 2), 8, 0), out / "growing-line.png")

# %% [markdown]
# On surfaces `growth` does it: all lengths of the sphere grow as exp(r t), and spots divide to keep their distance.

# %%
counts = []
for t in (40, 75):
    sphere = pelage.grow("builtin:sphere?n=642", model="schnakenberg", size=0.3, growth=growth, until=t)
    counts.append(sphere.measure()["spots"]["count"])
print("spots on the growing sphere:", counts)
