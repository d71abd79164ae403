#include "look/carving.h"

#include <gtest/gtest.h>

#include "catalog/bind.h"
#include "pelage/error.h"
#include "run/run.h"
#include "shape/builtin_grids.h"
#include "shape/sample_volumes.h"

namespace pelage {
namespace {

const std::vector<Point> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};

std::vector<double> kept(const std::string& text, UpAxis up = UpAxis::y) {
  const std::vector<Cut> cuts = SpaceCut(text, up).at(corners);
  EXPECT_EQ(cuts.size(), 1U);
  EXPECT_FALSE(cuts.back().and_next);
  return cuts[0].values;
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-15) << i;
}

TEST(SpaceCut, IsWhatIsTakenAway) {
  expect_near(kept("x<0.25"), {-0.25, 0.75, -0.25, -0.25, 0.75});
  expect_near(kept("x > 0.25"), {0.25, -0.75, 0.25, 0.25, -0.75});
  expect_near(kept("y>=2*x"), {0, 2, -1, 0, 1});
  EXPECT_TRUE(SpaceCut("x + 2*y > z - 1", UpAxis::y).at(corners)[0].plane);
  EXPECT_FALSE(SpaceCut("x*y < 0.5", UpAxis::y).at(corners)[0].plane);
}

/// Pictures look from +x, +y and +z, or with z upwards from -y.
TEST(SpaceCut, WithoutASideTheViewerSeesTheCut) {
  expect_near(kept("z=0.25"), {0.25, 0.25, 0.25, -0.75, -0.75});
  expect_near(kept("y=0.25"), {0.25, 0.25, -0.75, 0.25, -0.75});
  expect_near(kept("y=0.25", UpAxis::z), {-0.25, -0.25, 0.75, -0.25, 0.75});
}

TEST(SpaceCut, ConditionsMayBelongTogether) {
  const std::vector<Cut> cuts = SpaceCut("x>0.5 and y>0.5 and z<1", UpAxis::y).at(corners);
  ASSERT_EQ(cuts.size(), 3U);
  EXPECT_TRUE(cuts[0].and_next && cuts[1].and_next && !cuts[2].and_next);
}

TEST(SpaceCut, RefusesWhatIsNoCondition) {
  for (const char* text :
       {"", "x", "<1", "x<", "x<y<1", "x<b", "x<1 and", "x<1 and y", "nx<0", "attribute(a)<1", "x=<>"})
    EXPECT_THROW(SpaceCut(text, UpAxis::y), Error) << text;
}

TEST(LevelPart, IsReadFromItsText) {
  EXPECT_EQ(parse_level_part("b").species, "b");
  EXPECT_FALSE(parse_level_part("b").level);
  EXPECT_EQ(*parse_level_part("b = 1.5").level, 1.5);
  EXPECT_TRUE(parse_level_part("b=1e-3").above);
  EXPECT_TRUE(parse_level_part("base.b>-2").above);
  EXPECT_FALSE(parse_level_part("b<-2").above);
  EXPECT_EQ(parse_level_part("base.b<-2").species, "base.b");
  for (const char* text : {"", "=1", "b=", "b=x", "b=1 2", "b<1<2"})
    EXPECT_THROW(parse_level_part(text), Error) << text;
}

/// The fields of a small block with a wave in it.
CoatFields waves() {
  Recipe recipe;
  recipe.stages[0].size = {{6, Length::Unit::cells}, {}};
  recipe.stages[0].steps = 1;
  const Run run(make_program(recipe, builtin_grid("builtin:box?n=10x9x8")));
  CoatFields fields = run.fields();
  for (std::vector<double>& field : fields.coefficients)
    for (std::size_t v = 0; v < field.size(); ++v) {
      const Point& p = fields.shape->points[v];
      field[v] = std::sin(9 * p[0]) + std::cos(8 * p[1]) * std::sin(7 * p[2]);
    }
  fields.uniform.assign(fields.uniform.size(), 0);
  return fields;
}

TEST(DressBody, HasTheColoursOfTheWholeAndIsClosed) {
  const CoatFields fields = waves();
  Carving carving;
  carving.cuts.emplace_back("x>0.45 and y>0.3", UpAxis::y);
  const TriangleMesh body = dress_body(fields, {}, carving), whole = dress(fields, {});
  EXPECT_EQ(test::open_edges(body), 0U);
  const Point size = {0.9, 0.8, 0.7};
  EXPECT_NEAR(test::enclosed(body), size[2] * (size[0] * size[1] - 0.45 * 0.5), 1e-12);
  EXPECT_EQ(body.find("normal")->domain, Domain::corner);
  std::size_t at_nodes = 0;
  for (std::size_t v = 0; v < body.points.size(); ++v)
    for (std::size_t n = 0; n < whole.points.size(); ++n)
      if (length(difference(body.points[v], whole.points[n])) < 1e-12) {
        ++at_nodes;
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_EQ(body.find("color")->values[3 * v + k], whole.find("color")->values[3 * n + k]);
      }
  EXPECT_GT(at_nodes, 100U);
}

TEST(DressBody, HoldsWhatIsAboveOrBelowALevel) {
  const CoatFields fields = waves();
  double sum = 0;
  for (const char* text : {"b=0.3", "b<0.3"}) {
    Carving carving;
    carving.part = parse_level_part(text);
    EXPECT_EQ(fit_level(carving, fields), "");
    const TriangleMesh body = dress_body(fields, {}, carving);
    EXPECT_EQ(test::open_edges(body), 0U);
    sum += test::enclosed(body);
    for (const double b : body.find("b")->values) EXPECT_TRUE(text[1] == '=' ? b > 0.25 : b < 0.35) << b;
  }
  EXPECT_NEAR(sum, 0.9 * 0.8 * 0.7, 0.01);  // near nodes the surface keeps off them, on either side
}

TEST(FitLevel, TakesTheMiddleWhereNoneFits) {
  CoatFields fields = waves();
  Carving carving;
  carving.part = parse_level_part("b=99");
  EXPECT_NE(fit_level(carving, fields).find("lies between"), std::string::npos);
  EXPECT_LT(std::abs(*carving.part->level), 1);
  carving.part = parse_level_part("q");
  EXPECT_THROW(fit_level(carving, fields), Error);
  carving.part = parse_level_part("b");
  for (auto& field : fields.coefficients) field.assign(field.size(), 4);
  EXPECT_NE(fit_level(carving, fields).find("everywhere"), std::string::npos);
  EXPECT_FALSE(carving.part);
}

}  // namespace
}  // namespace pelage
