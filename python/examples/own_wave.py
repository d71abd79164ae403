# %% [markdown]
# # Three species that chase each other
#
# A model of one's own: three species, each of which is suppressed by the next (May, Leonard 1975, SIAM J. Appl. Math.
# 29, 243-253). With diffusion they make spirals that never rest. Once as text, once with rates as a function in
# Python; the library has the diffusion and the steps in both.

# %%
import os
import sys
import time
from pathlib import Path

import numpy as np

import pelage

out = Path(sys.argv[1] if len(sys.argv) == 2 else "out")
out.mkdir(parents=True, exist_ok=True)
nodes = int(os.environ.get("NODES", 192))
until = float(os.environ.get("UNTIL", 150))

# %%
rate = "{0}*(1 - {0} - {1} - {2}) - 2*{0}*{1}"
cycle = [("a", "b", "c"), ("b", "c", "a"), ("c", "a", "b")]
text = 'name = "chase"\ntitle = "Three that chase each other"\nwavelength = 40\n[suggested]\nstep = 0.1\n' + "".join(
    f'[species.{s[0]}]\ndiffusion = 1\nrate = "{rate.format(*s)}"\ninitial = "0.3 + 0.1*noise(6, {i})"\nmin = 0\n'
    for i, s in enumerate(cycle))
chase = pelage.Model(text, "chase")


def rates(t, a, b, c):
    free = 1 - a - b - c
    return a * free - 2 * a * b, b * free - 2 * b * c, c * free - 2 * c * a


in_python = pelage.Model(text, "chase", rates=rates)

# %%
shape = pelage.load(f"builtin:tile?n={nodes}")
seconds, fields = {}, {}
for name, model in (("text", chase), ("Python", in_python)):
    run = pelage.Run(shape, model=model, unit="1px", until=until, seed=3, stepper="sbdf2")  # by the same steps
    start = time.perf_counter()
    while not run.done and run.time < 5:
        run.advance(1)
    fields[name] = run.get("a").copy()
    run.finish()
    seconds[name] = time.perf_counter() - start
difference = np.abs(fields["text"] - fields["Python"]).max()
print(f"after a time of 5 the two differ by {difference:.1e}; ", {k: f"{v:.1f} s" for k, v in seconds.items()})

# %%
a, b, c = (run.get(s).reshape(nodes, nodes)[::-1] for s in "abc")
pelage.save_png(np.stack([a, b, c], 2).clip(0, 1), out / "chase.png")
first = run.get("a")
rest = pelage.Run(shape, model=chase, unit="1px", until=20)
for s in "abc":
    rest.set(s, run.get(s))
change = np.abs(rest.finish().get("a") - first).max()
print(f"in a further time of 20 the field changes by {change:.2f}: a wave")
