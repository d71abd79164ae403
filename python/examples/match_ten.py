# %% [markdown]
# # Ten pictures, matched with models that did not make them
#
# Each target is the picture of a pattern: one seed of one model. `pelage.match` gets the picture alone and another
# model. What it finds is grown anew with seeds and at a resolution of its own, and compared.

# %%
import os
import sys
from pathlib import Path

import numpy as np

import pelage

out = Path(sys.argv[1] if len(sys.argv) == 2 else "out")
out.mkdir(parents=True, exist_ok=True)
pairs = [("gray-scott:spots", "schnakenberg"), ("schnakenberg:stripes", "bvam"),
         ("lengyel-epstein:holes", "brusselator"), ("gray-scott", "lengyel-epstein"),
         ("swift-hohenberg:hexagons", "gray-scott"), ("turing:mixed", "gray-scott"),
         ("gray-scott:mu", "fitzhugh-nagumo"), ("brusselator:stripes", "gray-scott"), ("thomas", "turing"),
         ("klausmeier:labyrinth", "gierer-meinhardt")]
chosen = [int(i) for i in os.environ.get("TARGETS", "0,1,2,3,4,5,6,7,8,9").split(",")]
runs = int(os.environ.get("RUNS", 120))
across = int(os.environ.get("ACROSS", 10))
pixel = 0.5  # mm, as if the pictures were scans


# %%
def picture_of(coat):
    columns, rows = coat.shape.grid["count"][:2]
    return list(coat.fields.values())[-1].reshape(rows, columns)[::-1]


def shades(u, invert=False):
    low, high = np.quantile(u, (0.01, 0.99))
    grey = ((u - low) / (high - low)).clip(0, 1)
    return np.repeat((1 - grey if invert else grey)[..., None], 3, 2)


# %%
sheets, outcomes = [], []
for number in chosen:
    maker, model = pairs[number]
    target = picture_of(pelage.tile(model=maker, nodes=16 * across, size="16px", seed=1000 + number))
    found = pelage.match(target, model, pixel=pixel, runs=runs)
    again = [picture_of(found.tile(16 * across, size=f"{found.size / pixel!r}px", seed=s)) for s in range(501, 505)]
    measured = [pelage.measure_picture(-u if found.invert else u, pixel=pixel) for u in again]
    wanted = pelage.measure_picture(target, pixel=pixel)
    mean = {name: np.mean([m[name] for m in measured]) for name in ("wavelength", "coverage")}
    kinds = [m["kind"] for m in measured]
    kind = max(set(kinds), key=kinds.count)
    good = (abs(mean["wavelength"] / wanted["wavelength"] - 1) <= 0.05 and kind == wanted["kind"]
            and abs(mean["coverage"] - wanted["coverage"]) <= 0.05)
    outcomes.append({"target": maker, "model": model, "wavelength": mean["wavelength"] / wanted["wavelength"],
                     "wanted": wanted["coverage"], "coverage": mean["coverage"], "kind": wanted["kind"],
                     "found": kind, "inverted": found.invert, "missed": " ".join(found.missed), "good": good})
    sheets.append(np.vstack([shades(target), np.ones((8, 16 * across, 3)), shades(again[0], found.invert)]))
    print(f"{maker} by {model}: wavelength {mean['wavelength'] / wanted['wavelength']:.3f} of the target's, coverage "
          f"{wanted['coverage']:.3f} -> {mean['coverage']:.3f}, {wanted['kind']} -> {kind}, "
          f"{'as wanted' if good else 'not as wanted'}", flush=True)
    print(found.summary(), flush=True)

# %%
print(f"{sum(o['good'] for o in outcomes)} of {len(outcomes)} as wanted")
pelage.save_png(np.hstack(sheets), out / "match.png")
