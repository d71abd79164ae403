# %% [markdown]
# # Stripes that become spots
#
# A parameter may be a formula of the place. The model of Barrio, Varea, Aragon and Maini has stripes where its
# quadratic term r2 is 0 and spots where it is large; here it rises from the left side to the right one.

# %%
import os
import sys
from pathlib import Path

import pelage

out = Path(sys.argv[1] if len(sys.argv) == 2 else "out")
out.mkdir(parents=True, exist_ok=True)
rows = int(os.environ.get("ROWS", 160))
quality = os.environ.get("QUALITY", "normal")
rise = {"r1": 2, "r2": "0.6*smoothstep(-0.4, 0.4, bx)"}

# %%
coat = pelage.grow(f"builtin:sheet?n={2 * rows}x{rows}", model="bvam", parameters=rise, size="10px", seed=2)
pelage.save_png(coat.image(), out / "stripes-to-spots.png")

# %% [markdown]
# The Euler number per squared wavelength counts spots: 0.87 for a lattice of them, 0 for stripes. Coherence is 1 for
# straight stripes.

# %%
field = coat.fields["u"].reshape(rows, 2 * rows)[::-1]
left = pelage.measure_picture(field[:, :int(0.6 * rows)])
right = pelage.measure_picture(field[:, -int(0.6 * rows):])
for side, m in (("left", left), ("right", right)):
    print(side, m["kind"], ", ".join(f"{name} {m[name]:.2f}" for name in ("euler", "coherence", "coverage")))

# %%
animal = pelage.grow("builtin:animal", model="bvam", parameters=rise, size=0.04, quality=quality)
animal.save(out / "stripes-to-spots.glb")
print(animal)
