// Sheets painted without a mesh against the mesh's colours.

#include "look/sheet_image.h"

#include <gtest/gtest.h>

#include "catalog/bind.h"
#include "look/dress.h"
#include "look/grid_picture.h"
#include "pelage/error.h"
#include "run/run.h"
#include "shape/builtin_grids.h"

namespace pelage {
namespace {

CoatFields fields_on(const char* shape, const Recipe& recipe) {
  Run run(make_program(recipe, builtin_grid(shape)));
  run.advance(3);
  return run.fields();
}

/// More nodes than are painted at once.
TEST(SheetImage, HasThePixelsOfTheMesh) {
  for (const char* text :
       {"[stage]\nmodel = \"turing\"\nsize = \"9px\"\n",
        "[stage]\nmodel = \"turing\"\nsize = \"9px\"\n[look]\nramp = \"mono\"\nspecies = \"a\"\n[[look.layers]]\ncolor "
        "= "
        "\"#884422\"\nopacity = \"smoothstep(-0.5, 0.5, bx + 0.3*noise(0.1) + 0.2*b + nz*x + k1)\"\n"}) {
    const Recipe recipe = parse_recipe(text, "test");
    const CoatFields fields = fields_on("builtin:sheet?n=500x301", recipe);
    ASSERT_TRUE(is_bare_sheet(fields));
    const Image expected = grid_image(*as<Grid>(fields.nodes), dress(fields, recipe.look).find("color")->values);
    const Image image = sheet_image(fields, recipe.look);
    EXPECT_EQ(image.width, expected.width);
    EXPECT_EQ(image.height, expected.height);
    EXPECT_TRUE(image.rgb == expected.rgb) << text;
  }
}

TEST(SheetImage, KnowsWhatIsNone) {
  const Recipe recipe = parse_recipe("[stage]\nmodel = \"turing\"\nsize = \"9px\"\n", "test");
  EXPECT_FALSE(is_bare_sheet(fields_on("builtin:line?n=40", recipe)));
  EXPECT_FALSE(is_bare_sheet(fields_on("builtin:box?n=12", recipe)));
  Look flat;
  flat.flat = true;
  EXPECT_THROW(sheet_image(fields_on("builtin:tile?n=30", recipe), flat), Error);
}

}  // namespace
}  // namespace pelage
