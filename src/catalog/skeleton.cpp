#include "catalog/skeleton.h"

#include <algorithm>

#include "base/ascii.h"
#include "pelage/error.h"

namespace pelage {

namespace {

constexpr std::string_view text = R"~toml~(title = "Spots to begin with: Schnakenberg's two species"
# summary = "What it is about, in a few words"
# cite = "Who wrote it, where and when"

# `pelage formulas` lists all that formulas may contain. Numbers may stand in place of formulas.

# Spacing of the finished pattern in this file's unit of length, a number or a formula of the parameters; --size
# stretches it to what you want. Leave it out where linear theory tells it (pelage analyse), and where there is none:
# waves, say, which are sized by grow --unit.
# wavelength = 12

# Of a pattern that never rests but comes back: the time after which it does, likewise; grow --loop needs it.
# period = 50

[parameters]
a = { value = 0.1, min = 0.01, max = 0.5, unit = "1", help = "supply of the activator" }
b = { value = 0.9, min = 0.1, max = 2, help = "supply of the substrate" }
d = { value = 30, min = 1, max = 100, help = "how many times faster the substrate spreads" }
# c = 1    # a parameter may be a plain number

# Names for parts of formulas; each may use those above it.
[definitions]
made = "u^2*v"

# One table for each species, in the order of the equations:  d(u)/dt = div(diffusion grad u) + rate
# The last one is shown unless --species says otherwise, so the activator stands below.

[species.v]
diffusion = "d"                            # a formula; 0 where it does not spread
rate = "b - made"
initial = "b/(a + b)^2"                    # at time 0; 0 if left out
min = 0                                    # amounts cannot be negative: without it they may run away
# max = 100

[species.u]
diffusion = 1
rate = "a - u + made"
initial = "(a + b)*(1 + 0.01*noise(3))"    # noise(length): mean 0, deviation 1
min = 0
# max = 100

# In place of diffusion:
# anisotropy = { theta = "0", a1 = "2", a2 = "1" }    # rates along and across the field of directions
# tensor = { xx = "2", yy = "1", zz = "1", xy = "0.5", xz = "0", yz = "0" }    # a matrix along the axes of space
# C0 = "1"    # with C1, the more general  C0 div(C1 grad u)
# C1 = "1"
# In place of rate:
# C2 = "-1"    # with C3,  C2 u + C3
# C3 = "a + made"
# In place of all else, for a species that is a formula of others at all times:
# equals = "u - v"
# vector = true    # three components u_1, u_2, u_3; in rate and initial u stands for each of them in turn

[suggested]
end = 200                                  # time when the pattern is finished
step = 1                                   # longest step of time
tolerance = 2e-4                           # at rest when it changes by less than this share per unit of time
# resolution = 6                           # vertices per wavelength at least, from 6 to 64; more for sharp fronts
# iterations = 3000                        # of the solver until the end: tells how long it will take

[look]
ramp = "tawny"                             # colours of the last species; or layers, as in recipes

# Other values under a name: --model FILE.toml:stripes. A variant may have title, parameters, wavelength, period, suggested.
[variants.stripes]
title = "Stripes"
parameters = { a = 0.01, b = 2 }
)~toml~";

bool is_part(char c) { return is_letter_or_digit(c) || c == '-' || c == '_'; }

}  // namespace

std::string model_skeleton(const std::string& name) {
  if (name.empty() || !std::ranges::all_of(name, is_part))
    throw Error(Fault::usage, "\"" + name + "\" is not a name for a model; use letters, digits, - and _");
  return "# A model of your own; docs/models.md and docs/guides/model.md say more.\nname = \"" + name + "\"\n" +
         std::string(text);
}

}  // namespace pelage
