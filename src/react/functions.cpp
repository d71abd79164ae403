#include "react/functions.h"

#include <array>

namespace pelage {

namespace {

using Arguments = std::span<const Term>;

template <Op op>
Term operation(Arguments in) {
  Graph& graph = *in[0].graph;
  return {&graph, graph.make(op, in[0].id, in.size() > 1 ? in[1].id : -1, in.size() > 2 ? in[2].id : -1)};
}

Term step(Arguments in) { return operation<Op::less_equal>(in); }  // edge <= x

Term clamp(Arguments in) {
  const std::array<Term, 2> raised = {operation<Op::maximum>(in.first(2)), in[2]};
  return operation<Op::minimum>(raised);
}

Term smoothstep(Arguments in) {
  Graph* graph = in[0].graph;
  const std::array<Term, 3> ramp = {(in[2] - in[0]) / (in[1] - in[0]), Term{graph, graph->constant(0)},
                                    Term{graph, graph->constant(1)}};
  const Term s = clamp(ramp);
  return s * s * (3.0 - 2.0 * s);
}

Term number(Arguments in, double value) { return {in[0].graph, in[0].graph->constant(value)}; }

Term heaviside(Arguments in) { return step(std::array{number(in, 0), in[0]}); }

Term sign(Arguments in) {
  const Term zero = number(in, 0);
  return operation<Op::less>(std::array{zero, in[0]}) - operation<Op::less>(std::array{in[0], zero});
}

Term decimal_logarithm(Arguments in) { return operation<Op::logarithm>(in) / number(in, 2.302585092994045684); }

Term hyperbolic_cosine(Arguments in) {
  return 0.5 * (operation<Op::exponential>(in) + operation<Op::exponential>(std::array{-in[0]}));
}

/// exp(a) - exp(-a) would lose all digits near 0.
Term hyperbolic_sine(Arguments in) { return operation<Op::hyperbolic_tangent>(in) * hyperbolic_cosine(in); }

constexpr std::array<Function, 24> functions = {{
    {"if", "if(condition, a, b)", 3, &operation<Op::select>,
     "a where the condition is true (not 0), else b; both are computed"},
    {"min", "min(a, b)", 2, &operation<Op::minimum>, "the smaller one"},
    {"max", "max(a, b)", 2, &operation<Op::maximum>, "the larger one"},
    {"abs", "abs(a)", 1, &operation<Op::absolute>, "modulus"},
    {"sign", "sign(a)", 1, &sign, "-1, 0 or 1; sign(0) is 0"},
    {"step", "step(edge, x)", 2, &step, "1 where x >= edge, else 0"},
    {"heaviside", "heaviside(x)", 1, &heaviside, "1 where x >= 0, else 0"},
    {"smoothstep", "smoothstep(edge0, edge1, x)", 3, &smoothstep, "0 up to edge0, 1 from edge1 on, smooth between"},
    {"clamp", "clamp(x, lower, upper)", 3, &clamp, "x, but at least lower and at most upper"},
    {"exp", "exp(a)", 1, &operation<Op::exponential>, "e^a"},
    {"log", "log(a)", 1, &operation<Op::logarithm>, "natural logarithm; a > 0"},
    {"ln", "ln(a)", 1, &operation<Op::logarithm>, "the same"},
    {"log10", "log10(a)", 1, &decimal_logarithm, "decimal logarithm; a > 0"},
    {"sqrt", "sqrt(a)", 1, &operation<Op::square_root>, "square root; a >= 0"},
    {"sin", "sin(a)", 1, &operation<Op::sine>, "sine; a in radians"},
    {"cos", "cos(a)", 1, &operation<Op::cosine>, "cosine"},
    {"tan", "tan(a)", 1, &operation<Op::tangent>, "tangent"},
    {"sinh", "sinh(a)", 1, &hyperbolic_sine, "hyperbolic sine"},
    {"cosh", "cosh(a)", 1, &hyperbolic_cosine, "hyperbolic cosine"},
    {"tanh", "tanh(a)", 1, &operation<Op::hyperbolic_tangent>, "hyperbolic tangent, from -1 to 1"},
    {"erf", "erf(a)", 1, &operation<Op::error_function>, "error function, from -1 to 1"},
    {"pow", "pow(a, b)", 2, &operation<Op::power>, "a^b"},
    {"mod", "mod(a, b)", 2, &operation<Op::modulo>, "a - b floor(a/b), which has the sign of b"},
    {"floor", "floor(a)", 1, &operation<Op::floor>, "the largest whole number up to a"},
}};

}  // namespace

std::span<const Function> pure_functions() { return functions; }

}  // namespace pelage
