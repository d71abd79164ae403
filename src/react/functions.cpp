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

constexpr std::array<Function, 17> functions = {{
    {"if", "if(condition, a, b)", 3, &operation<Op::select>},
    {"min", "min(a, b)", 2, &operation<Op::minimum>},
    {"max", "max(a, b)", 2, &operation<Op::maximum>},
    {"abs", "abs(a)", 1, &operation<Op::absolute>},
    {"step", "step(edge, x)", 2, &step},
    {"smoothstep", "smoothstep(edge0, edge1, x)", 3, &smoothstep},
    {"clamp", "clamp(x, lower, upper)", 3, &clamp},
    {"exp", "exp(a)", 1, &operation<Op::exponential>},
    {"log", "log(a)", 1, &operation<Op::logarithm>},
    {"sqrt", "sqrt(a)", 1, &operation<Op::square_root>},
    {"sin", "sin(a)", 1, &operation<Op::sine>},
    {"cos", "cos(a)", 1, &operation<Op::cosine>},
    {"tan", "tan(a)", 1, &operation<Op::tangent>},
    {"tanh", "tanh(a)", 1, &operation<Op::hyperbolic_tangent>},
    {"pow", "pow(a, b)", 2, &operation<Op::power>},
    {"mod", "mod(a, b)", 2, &operation<Op::modulo>},
    {"floor", "floor(a)", 1, &operation<Op::floor>},
}};

}  // namespace

std::span<const Function> pure_functions() { return functions; }

}  // namespace pelage
