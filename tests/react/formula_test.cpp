#include "react/formula.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "react/support.h"

namespace pelage {
namespace {

TEST(Formula, ArithmeticAndPrecedence) {
  EXPECT_EQ(value_of("1 + 2*3 - 4/8"), 6.5);
  EXPECT_EQ(value_of("10 - 4 - 3"), 3);
  EXPECT_EQ(value_of("64/8/2"), 4);
  EXPECT_EQ(value_of("-2^2"), -4);
  EXPECT_EQ(value_of("2^3^2"), 512);
  EXPECT_EQ(value_of("2^-1"), 0.5);
  EXPECT_EQ(value_of("2*-3"), -6);
  EXPECT_EQ(value_of("--3 - +2"), 1);
  EXPECT_EQ(value_of("(1 + 2)*3"), 9);
  EXPECT_EQ(value_of(".5 + 1e-1 + 2.E1"), 20.6);
  EXPECT_EQ(value_of("x - y*z", 7, 2, 3), 1);
}

TEST(Formula, LogicBindsLooserThanComparison) {
  EXPECT_EQ(value_of("1 + 1 == 2 and 3 > 2"), 1);
  EXPECT_EQ(value_of("0 and 0 or 1"), 1);
  EXPECT_EQ(value_of("0 and (0 or 1)"), 0);
  EXPECT_EQ(value_of("not 1 == 2"), 1);
  EXPECT_EQ(value_of("not not 3"), 1);
  EXPECT_EQ(value_of("(1 <= 1) + (2 >= 3) + (1 != 1) + (1 < 2)"), 2);
  EXPECT_EQ(value_of("(2 > 2) + 10*(2 >= 2) + 100*(2 < 2) + 1000*(2 <= 2)"), 1010);
  EXPECT_EQ(value_of("if(x < 1, 5, 6)", 0), 5);
  EXPECT_EQ(value_of("if(x < 1, 5, 6)", 1), 6);
}

TEST(Formula, Functions) {
  EXPECT_EQ(value_of("min(x, y) + 10*max(x, y)", 2, 3), 32);
  EXPECT_EQ(value_of("step(2, x)", 2) + value_of("step(2, x)", 1.9), 1);
  EXPECT_EQ(value_of("clamp(x, 0, 1)", 5) + value_of("clamp(x, 0, 1)", -5), 1);
  EXPECT_DOUBLE_EQ(value_of("smoothstep(2, 4, x)", 2.5), 0.25 * 0.25 * 2.5);
  EXPECT_EQ(value_of("smoothstep(2, 4, x)", 9) + value_of("smoothstep(2, 4, x)", 1), 1);
  EXPECT_EQ(value_of("mod(x, 3)", -1), 2);
  EXPECT_EQ(value_of("floor(x) + abs(x)", -1.5), -0.5);
  EXPECT_EQ(value_of("pow(x, 3) + x^0", 2), 9);
  EXPECT_DOUBLE_EQ(value_of("exp(x) + log(y) + sqrt(z)", 1, 2, 3), std::exp(1.0) + std::log(2.0) + std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(value_of("sin(x) + cos(y) + tan(z) + tanh(t)", 1, 2, 3, 4),
                   std::sin(1.0) + std::cos(2.0) + std::tan(3.0) + std::tanh(4.0));
  EXPECT_DOUBLE_EQ(value_of("erf(x)", 0.5), 0.52049987781304654);  // Abramowitz, Stegun, table 7.1
  EXPECT_EQ(value_of("erf(x)", -7) + value_of("erf(x)", 0), -1);
  EXPECT_EQ(value_of("heaviside(x)", 0) + value_of("heaviside(x)", 2) + value_of("heaviside(x)", -1e-9), 2);
  EXPECT_EQ(value_of("sign(x) + 10*sign(y) + 100*sign(z)", -3, 0, 2), 99);
  EXPECT_EQ(value_of("ln(x)", 3), std::log(3.0));
  EXPECT_DOUBLE_EQ(value_of("log10(x)", 1e-7), -7);
  for (const double x : {-3.0, -1e-9, 0.0, 1e-12, 0.5, 4.0}) {
    EXPECT_DOUBLE_EQ(value_of("sinh(x)", x), std::sinh(x));
    EXPECT_DOUBLE_EQ(value_of("cosh(x)", x), std::cosh(x));
  }
  EXPECT_EQ(value_of("pi"), std::numbers::pi);
  EXPECT_EQ(value_of("e"), std::numbers::e);
}

TEST(Formula, EvaluationNeverAborts) {
  EXPECT_TRUE(std::isnan(value_of("0/x", 0) + value_of("log(x)", -1)));
  EXPECT_EQ(value_of("1/x", 0), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(value_of("mod(x, y)", 1, 0)));
  EXPECT_TRUE(std::isnan(value_of("max(x, 0)", std::nan(""))));  // a clamp must not hide a blow-up
}

struct Fault {
  const char* text;
  const char* message;
};

TEST(Formula, FaultsAreLocatedAndSayWhatWasExpected) {
  const Fault faults[] = {
      {"1 + ", "m.toml:7:15: expected a number, a name or '(', the formula ends here"},
      {"1 + * 2", "m.toml:7:15: expected a number, a name or '(', found '*'"},
      {"(1 + 2", "m.toml:7:17: expected ')' to close the '(' at column 11, the formula ends here"},
      {"2 x", "m.toml:7:13: expected an operator or the end of the formula, found 'x'"},
      {"1 < 2 < 3", "m.toml:7:17: expected one comparison (write a < b and b < c), found '<'"},
      {"a = 2", "m.toml:7:13: '=' is not an operator; equality is written a == b"},
      {"2**3", "m.toml:7:12: '**' is not an operator; powers are written a^b"},
      {"1 $ 2", "m.toml:7:13: character '$' has no meaning in a formula"},
      {"1e999", "m.toml:7:11: number 1e999 is too large or too small"},
      {"1 +\n  cosb(2)", "m.toml:8:3: unknown function \"cosb\"; did you mean \"cos\"?"},
      {"laplacian(2)", "m.toml:7:11: unknown function \"laplacian\"; the Laplacian of u is written lap(u)"},
      {"erfc(2)", "m.toml:7:11: unknown function \"erfc\"; erfc(a) is written 1 - erf(a)"},
      {"sgn(2)", "m.toml:7:11: unknown function \"sgn\"; the sign of a is written sign(a)"},
      {"2*time", "m.toml:7:13: unknown name \"time\"; the time is written t"},
      {"2*bta", "m.toml:7:13: unknown name \"bta\"; did you mean \"beta\"?"},
      {"2*qqqqqq", "m.toml:7:13: unknown name \"qqqqqq\"; a mesh attribute is written attribute(name)"},
      {"beta(2)", "m.toml:7:11: \"beta\" is not a function; write a * between factors"},
      {"sin + 1", "m.toml:7:11: \"sin\" is a function: expected '(' after it"},
      {"clamp(1, 2)", "m.toml:7:11: expected clamp(x, lower, upper), found 2 arguments"},
      {"sin()", "m.toml:7:11: expected sin(a), found 0 arguments"},
      {"min(1, 2", "m.toml:7:19: expected ',' or ')' in the arguments of min, the formula ends here"},
      {"min(1,, 2)", "m.toml:7:17: expected a number, a name or '(', found ','"},
      {"noise(x)", "m.toml:7:11: the length of noise must be a number or made of parameters"},
      {"noise(0)", "m.toml:7:11: the length of noise must be greater than 0"},
      {"noise(1, 2.5)", "m.toml:7:11: the seed of noise must be a whole number from 0 to 1e15"},
      {"attribute(3)", "m.toml:7:21: expected the name of a vertex attribute, found '3'"},
      {"\xC3\xA4", "m.toml:7:11: character '\xC3\xA4' has no meaning in a formula"},
      {"x + later", "m.toml:7:15: \"later\" is defined further down"},
      {"", "m.toml:7:11: expected a number, a name or '(', the formula ends here"},
      {"and", "m.toml:7:11: expected a number, a name or '(', found 'and'"},
  };
  for (const auto& [text, message] : faults) {
    Graph graph;
    Scope scope;
    scope.names["beta"] = graph.constant(1);
    scope.names["a"] = graph.constant(1);
    scope.not_yet["later"] = "is defined further down";
    EXPECT_EQ(error_of([&] { parse_formula(graph, {text, {"m.toml", 7, 11}}, scope, "f"); }), message) << text;
  }
}

std::string repeat(const std::string& text, int count) {
  std::string result;
  for (int i = 0; i < count; ++i) result += text;
  return result;
}

/// u = (1, 2, 3) and v = (4, 5, 7), species 0 to 2 and 3 to 5.
struct Vectors {
  Graph graph;
  Scope scope;
  Vectors() {
    for (int i = 0; i < 6; ++i)
      scope.names[component_name(i < 3 ? "u" : "v", i % 3 + 1)] = graph.symbol({Symbol::Kind::species, i});
  }
  NodeId parse(const std::string& text, int component = 0) {
    return parse_formula(graph, {text, {"f", 1, 1}, component}, scope, "f");
  }
  double value(const std::string& text, int component = 0) {
    const std::array<double, 6> values = {1, 2, 3, 4, 5, 7};
    const auto of = [&](const Symbol& s) { return values.at(static_cast<std::size_t>(s.index)); };
    return evaluate(graph, std::vector{parse(text, component)}, of).front();
  }
};

TEST(Formula, VectorsHaveProductsAndComponents) {
  Vectors f;
  EXPECT_EQ(f.value("dot(u, v)"), 4 + 10 + 21);
  EXPECT_EQ(f.value("norm(u)^2 + u_2"), 14 + 2);
  const std::array<double, 3> cross = {2 * 7 - 3 * 5, 3 * 4 - 1 * 7, 1 * 5 - 2 * 4};
  for (int k = 1; k <= 3; ++k) {
    EXPECT_EQ(f.value("cross(u, v)", k), cross[static_cast<std::size_t>(k - 1)]);
    EXPECT_EQ(f.value("2*v - dot(u, u)*u", k), f.value("2*v_" + std::to_string(k) + " - 14*u_" + std::to_string(k)));
    EXPECT_EQ(f.parse("lap(u)", k), f.parse("lap(u_" + std::to_string(k) + ")"));
    EXPECT_EQ(f.parse("div(u_1 grad v)", k), f.parse("div(u_1 grad v_" + std::to_string(k) + ")"));
  }
  EXPECT_EQ(f.parse("grad2(u)"), f.parse("grad2(u_1) + grad2(u_2) + grad2(u_3)"));
  EXPECT_EQ(f.parse("dot(grad v, grad u)"),
            f.parse("dot(grad u_1, grad v_1) + dot(grad u_2, grad v_2) + dot(grad u_3, grad v_3)"));
  EXPECT_EQ(f.parse("norm(first.w)"), f.parse("sqrt(first.w_1*first.w_1 + first.w_2*first.w_2 + first.w_3*first.w_3)"));
}

TEST(Formula, VectorsAreNoNumbers) {
  Vectors f;
  const auto says = [&](const std::string& text, const std::string& what) {
    const std::string message = error_of([&] { f.parse(text); });
    EXPECT_NE(message.find(what), std::string::npos) << message;
  };
  says("2*u", "u_1");
  says("cross(u, v)", "in the formulas of vectors only");
  says("lap(u)", "_1, _2 or _3");
  says("div(2 grad u)", "_1, _2 or _3");
  says("dot(u, w)", "the name of a vector");
  says("norm(u_1)", "the name of a vector");
  says("dot(grad u, grad u_1)", "two species or two vectors");
}

TEST(Formula, NestingAndLengthAreBounded) {
  EXPECT_EQ(value_of(repeat("(", 99) + "1" + repeat(")", 99)), 1);
  for (const char* start : {"(", "-", "not ", "sin(", "2^", "1+("})
    EXPECT_NE(error_of([&] { value_of(repeat(start, 200) + "x"); }).find("levels of nesting"), std::string::npos);
  EXPECT_EQ(value_of("0" + repeat("+x", 4000), 1), 4000);  // long but flat is fine
  EXPECT_NE(error_of([&] { value_of(repeat("x+", 6000) + "x"); }).find("characters"), std::string::npos);
}

TEST(Formula, EqualSubexpressionsAreOneNode) {
  Graph graph;
  const auto parse = [&](const char* text) { return parse_formula(graph, {text, {}}, {}, "f"); };
  EXPECT_EQ(parse("x*y + sin(x*y)"), parse("sin(y*x) + y*x"));
  EXPECT_EQ(parse("2*3 + x - 6"), parse("6 + x - 2*3"));
  EXPECT_EQ(parse("x + 0*y"), parse("1*x"));
  EXPECT_EQ(parse("-(-x)"), parse("x^1"));
}

TEST(Formula, RandomFieldsAreToldApart) {
  Graph graph;
  const auto parse = [&](const char* text, const char* label) { return parse_formula(graph, {text, {}}, {}, label); };
  EXPECT_NE(parse("noise(2)", "a"), parse("noise(2)", "b"));
  EXPECT_EQ(parse("noise(2)", "a"), parse("noise(2)", "a"));
  EXPECT_EQ(parse("noise(2, 5)", "a"), parse("noise(2, 5)", "b"));
  EXPECT_NE(parse("noise(2, 5)", "a"), parse("noise(2, 6)", "a"));
  EXPECT_NE(parse("noise(2) - noise(2)", "a"), parse("0", "a"));
  EXPECT_NE(parse("uniform(0, 1)", "a"), parse("normal(0, 1)", "a"));
}

}  // namespace
}  // namespace pelage
