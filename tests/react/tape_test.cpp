#include "react/tape.h"

#include <bit>
#include <cmath>
#include <random>

#include "react/support.h"

namespace pelage {
namespace {

/// Values of the symbols at a sample: x, y per sample, t per run.
struct Sample {
  double x, y, t;
};

/// A second, plain evaluator: recursion over the graph with the standard library's functions.
double recursive(const Graph& graph, NodeId id, const Sample& at) {
  const Node& node = graph[id];
  const auto in = [&](std::size_t k) { return recursive(graph, node.in[k], at); };
  switch (node.op) {
    case Op::constant:
      return node.value;
    case Op::symbol: {
      const Symbol& symbol = graph.symbol_of(id);
      if (symbol.kind == Symbol::Kind::time) return at.t;
      return symbol.index == 0 ? at.x : at.y;
    }
    case Op::add:
      return in(0) + in(1);
    case Op::subtract:
      return in(0) - in(1);
    case Op::multiply:
      return in(0) * in(1);
    case Op::divide:
      return in(0) / in(1);
    case Op::negate:
      return -in(0);
    case Op::power:
      return std::pow(in(0), in(1));
    case Op::minimum:
      return std::min(in(0), in(1));
    case Op::maximum:
      return std::max(in(0), in(1));
    case Op::modulo:
      return in(0) - in(1) * std::floor(in(0) / in(1));
    case Op::absolute:
      return std::fabs(in(0));
    case Op::floor:
      return std::floor(in(0));
    case Op::exponential:
      return std::exp(in(0));
    case Op::logarithm:
      return std::log(in(0));
    case Op::square_root:
      return std::sqrt(in(0));
    case Op::sine:
      return std::sin(in(0));
    case Op::cosine:
      return std::cos(in(0));
    case Op::tangent:
      return std::tan(in(0));
    case Op::hyperbolic_tangent:
      return std::tanh(in(0));
    case Op::error_function:
      return std::erf(in(0));
    case Op::less:
      return in(0) < in(1);
    case Op::less_equal:
      return in(0) <= in(1);
    case Op::equal:
      return in(0) == in(1);
    case Op::logical_and:
      return in(0) != 0 && in(1) != 0;
    case Op::logical_or:
      return in(0) != 0 || in(1) != 0;
    case Op::logical_not:
      return in(0) == 0;
    case Op::select:
      return in(0) != 0 ? in(1) : in(2);
    case Op::count:
      break;
  }
  return 0;
}

struct Symbols {
  NodeId x, y, t;
};

Symbols add_symbols(Graph& graph) {
  return {graph.symbol({Symbol::Kind::position, 0}), graph.symbol({Symbol::Kind::position, 1}),
          graph.symbol({Symbol::Kind::time})};
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}

TEST(Tape, EqualsRecursiveEvaluationOnRandomGraphs) {
  std::mt19937 random(7);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  std::uniform_real_distribution<double> number(-2, 2);
  for (int trial = 0; trial < 400; ++trial) {
    Graph graph;
    const Symbols s = add_symbols(graph);
    std::vector<NodeId> nodes = {s.x, s.y, s.t, graph.constant(number(random)), graph.constant(3)};
    const int size = 3 + static_cast<int>(below(25));
    for (int i = 0; i < size; ++i) {
      constexpr auto first = static_cast<std::size_t>(Op::add), last = static_cast<std::size_t>(Op::count);
      // Two thirds are sums and products, so that pairs of them meet in one loop.
      const auto op = static_cast<Op>(first + below(below(3) ? 3 : last - first));
      const std::size_t recent = std::min<std::size_t>(nodes.size(), 8);
      const auto pick = [&] { return nodes[nodes.size() - 1 - below(recent)]; };
      const NodeId a = pick(), b = pick(), c = pick();
      nodes.push_back(graph.make(op, a, arity(op) > 1 ? b : -1, arity(op) > 2 ? c : -1));
    }
    const std::vector<NodeId> roots = {nodes.back(), nodes[nodes.size() / 2], nodes.back(), s.x, nodes[3]};
    const Tape tape(graph, roots, std::vector{s.x, s.y}, std::vector{s.t});

    constexpr std::size_t samples = 700;  // several blocks, the last one not full
    std::vector<double> x(samples), y(samples);
    for (double& value : x) value = number(random);
    for (double& value : y) value = number(random);
    const double t = number(random);
    std::vector<std::vector<double>> out(roots.size(), std::vector<double>(samples, -77));
    std::vector<double*> to;
    for (auto& values : out) to.push_back(values.data());
    const double* from[] = {x.data(), y.data()};
    const std::size_t begin = below(300), end = samples - below(300);
    tape.run(from, std::vector{t}, begin, end, to);
    for (std::size_t r = 0; r < roots.size(); ++r)
      for (std::size_t i = 0; i < samples; i += 1 + below(20)) {
        const double expected = i < begin || i >= end ? -77 : recursive(graph, roots[r], {x[i], y[i], t});
        ASSERT_TRUE(same_bits(out[r][i], expected)) << trial << " root " << r << " sample " << i;
      }
  }
}

/// All instruction sets give the same bits, and those of arithmetic in float operation by operation.
TEST(Tape, RunsInSinglePrecisionToo) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> number(0.2f, 2);
  constexpr std::size_t samples = 700;
  std::vector<float> x(samples), y(samples);
  for (float& value : x) value = number(random);
  for (float& value : y) value = number(random);
  for (auto k = static_cast<int>(Op::add); k < static_cast<int>(Op::count); ++k) {
    Graph graph;
    const Symbols s = add_symbols(graph);
    const auto op = static_cast<Op>(k);
    const auto node = [&](NodeId a, NodeId b) {
      return graph.make(op, a, arity(op) > 1 ? b : -1, arity(op) > 2 ? a : -1);
    };
    const std::vector<NodeId> roots = {node(s.x, s.y), node(graph.constant(0.75), s.y), node(s.x, s.t),
                                       graph.make(Op::add, graph.make(Op::multiply, s.x, s.y), s.t)};
    const Tape tape(graph, roots, std::vector{s.x, s.y}, std::vector{s.t});
    std::vector<std::vector<float>> first;
    for (const InstructionSet set : instruction_sets()) {
      std::vector<std::vector<float>> out(roots.size(), std::vector<float>(samples));
      std::vector<float*> to;
      for (auto& values : out) to.push_back(values.data());
      const float* from[] = {x.data(), y.data()};
      tape.run(from, std::vector{1.25f}, samples, to, set);
      if (first.empty()) first = out;
      EXPECT_EQ(out, first) << k;
    }
    for (std::size_t i = 0; i < samples; ++i)
      for (std::size_t r = 0; r < roots.size(); ++r) {
        const double expected = recursive(graph, roots[r], {x[i], y[i], 1.25});
        // modulo and floor jump, and cancellation is relative to the operands.
        if (op == Op::floor || op == Op::modulo || op == Op::equal) continue;
        ASSERT_NEAR(first[r][i], expected, 1e-6 * std::max(1.0, std::abs(expected))) << k << " root " << r;
      }
  }
}

TEST(Tape, SharesCommonSubexpressionsAndExpandsPowers) {
  Graph graph;
  const Symbols s = add_symbols(graph);
  const NodeId a = parse_formula(graph, {"x^8 + y", {}}, {}, "a"), b = parse_formula(graph, {"x^8 - y", {}}, {}, "b");
  const auto roots = expand_powers(graph, std::vector{a, b});
  const Tape tape(graph, roots, std::vector{s.x, s.y}, {});
  EXPECT_EQ(tape.instruction_count(), 5u);  // three squarings, one sum, one difference
}

TEST(Tape, IntegerPowersAreProducts) {
  Graph graph;
  for (const double n : {2., 3., 5., 13., -1., -4.}) {
    const Symbols s = add_symbols(graph);
    const NodeId power = graph.make(Op::power, s.x, graph.constant(n));
    const auto product = expand_powers(graph, std::vector{graph.make(Op::power, power, graph.constant(2))});
    for (const NodeId id : reachable(graph, product)) EXPECT_NE(graph[id].op, Op::power);
    for (const double x : {-1.7, 0.3, 2.5})
      EXPECT_NEAR(recursive(graph, product[0], {x, 0, 0}) / std::pow(x, 2 * n), 1, 1e-14);
  }
}

}  // namespace
}  // namespace pelage
