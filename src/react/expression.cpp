#include "react/expression.h"

#include <bit>
#include <cassert>
#include <utility>

#include "base/random.h"

namespace pelage {

namespace {

template <std::size_t... I>
double dispatch(Op op, double a, double b, double c, std::index_sequence<I...>) {
  using Function = double (*)(double, double, double);
  static constexpr Function functions[] = {&apply<static_cast<Op>(I), double>...};
  return functions[static_cast<std::size_t>(op)](a, b, c);
}

unsigned dependence_of(const Symbol& symbol) {
  switch (symbol.kind) {
    case Symbol::Kind::species:
    case Symbol::Kind::laplacian:
    case Symbol::Kind::gradients:
    case Symbol::Kind::divergence:
      return on_species;
    case Symbol::Kind::time:
      return on_time;
    default:
      return on_place;
  }
}

}  // namespace

double apply(Op op, double a, double b, double c) {
  return dispatch(op, a, b, c, std::make_index_sequence<static_cast<std::size_t>(Op::count)>{});
}

std::size_t Graph::Hash::operator()(const Node& node) const {
  std::uint64_t key = hash(static_cast<std::uint64_t>(node.op), std::bit_cast<std::uint64_t>(node.value));
  for (const NodeId in : node.in) key = hash(key, static_cast<std::uint64_t>(in));
  return static_cast<std::size_t>(key);
}

bool Graph::Same::operator()(const Node& a, const Node& b) const {
  // Bits are compared, because NaN is a legal constant and -0 is not 0.
  return a.op == b.op && a.in == b.in && std::bit_cast<std::uint64_t>(a.value) == std::bit_cast<std::uint64_t>(b.value);
}

NodeId Graph::intern(const Node& node) {
  const auto [place, is_new] = known_.try_emplace(node, static_cast<NodeId>(nodes_.size()));
  if (is_new) nodes_.push_back(node);
  return place->second;
}

NodeId Graph::constant(double value) {
  Node node;
  node.value = value;
  return intern(node);
}

NodeId Graph::symbol(const Symbol& symbol) {
  std::size_t number = 0;
  while (number < symbols_.size() && !(symbols_[number] == symbol)) ++number;
  if (number == symbols_.size()) symbols_.push_back(symbol);
  Node node;
  node.op = Op::symbol;
  node.in[0] = static_cast<NodeId>(number);
  node.dependence = dependence_of(symbol);
  return intern(node);
}

const Symbol& Graph::symbol_of(NodeId id) const {
  assert((*this)[id].op == Op::symbol);
  return symbols_[static_cast<std::size_t>((*this)[id].in[0])];
}

std::optional<double> Graph::constant_value(NodeId id) const {
  const Node& node = (*this)[id];
  return node.op == Op::constant ? std::optional(node.value) : std::nullopt;
}

NodeId Graph::make(Op op, NodeId a, NodeId b, NodeId c) {
  if (is_commutative(op) && a > b) std::swap(a, b);  // exact, and a*b and b*a become one node
  if (const auto simple = simplify(op, a, b, c)) return *simple;
  Node node;
  node.op = op;
  node.in = {a, b, c};
  for (const NodeId in : node.in)
    if (in >= 0) node.dependence |= (*this)[in].dependence;
  return intern(node);
}

std::optional<NodeId> Graph::simplify(Op op, NodeId a, NodeId b, NodeId c) {
  const auto value = [&](NodeId id) { return id < 0 ? std::optional(0.0) : constant_value(id); };
  if (value(a) && value(b) && value(c)) return constant(apply(op, *value(a), *value(b), *value(c)));
  switch (op) {
    case Op::add:
      return simplify_sum(a, b);
    case Op::subtract:
      return simplify_difference(a, b);
    case Op::multiply:
      return simplify_product(a, b);
    case Op::divide:
      return simplify_quotient(a, b);
    case Op::power:
      return simplify_power(a, b);
    case Op::negate:
      if ((*this)[a].op == Op::negate) return (*this)[a].in[0];
      return std::nullopt;
    case Op::select:
      if (value(a)) return *value(a) != 0 ? b : c;
      if (b == c) return b;
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

std::optional<NodeId> Graph::simplify_sum(NodeId a, NodeId b) {
  if (is_constant(a, 0)) return b;
  if (is_constant(b, 0)) return a;
  if (a == b) return make(Op::multiply, constant(2), a);
  if ((*this)[b].op == Op::negate) return make(Op::subtract, a, (*this)[b].in[0]);
  if ((*this)[a].op == Op::negate) return make(Op::subtract, b, (*this)[a].in[0]);
  return std::nullopt;
}

std::optional<NodeId> Graph::simplify_difference(NodeId a, NodeId b) {
  if (is_constant(b, 0)) return a;
  if (is_constant(a, 0)) return make(Op::negate, b);
  if (a == b) return constant(0);
  if ((*this)[b].op == Op::negate) return make(Op::add, a, (*this)[b].in[0]);
  return std::nullopt;
}

std::optional<NodeId> Graph::simplify_product(NodeId a, NodeId b) {
  if (constant_value(b)) std::swap(a, b);  // at most one is constant: call it a
  if (const auto factor = constant_value(a)) {
    if (*factor == 0) return constant(0);
    if (*factor == 1) return b;
    if (*factor == -1) return make(Op::negate, b);
    const Node inner = (*this)[b];
    if (inner.op == Op::negate) return make(Op::multiply, constant(-*factor), inner.in[0]);
    if (inner.op == Op::multiply) {
      for (const std::size_t k : {0, 1})
        if (const auto other = constant_value(inner.in[k]))
          return make(Op::multiply, constant(*factor * *other), inner.in[1 - k]);
    }
    return std::nullopt;
  }
  if ((*this)[a].op == Op::negate) return make(Op::negate, make(Op::multiply, (*this)[a].in[0], b));
  if ((*this)[b].op == Op::negate) return make(Op::negate, make(Op::multiply, a, (*this)[b].in[0]));
  return std::nullopt;
}

std::optional<NodeId> Graph::simplify_quotient(NodeId a, NodeId b) {
  if (is_constant(b, 1)) return a;
  if (is_constant(a, 0)) return constant(0);
  return std::nullopt;
}

std::optional<NodeId> Graph::simplify_power(NodeId a, NodeId b) {
  if (is_constant(b, 0)) return constant(1);
  if (is_constant(b, 1)) return a;
  if (is_constant(b, 0.5)) return make(Op::square_root, a);
  return std::nullopt;
}

std::vector<NodeId> reachable(const Graph& graph, std::span<const NodeId> roots) {
  std::vector<char> used(graph.size(), 0);
  for (const NodeId root : roots) used[static_cast<std::size_t>(root)] = 1;
  for (auto id = static_cast<NodeId>(graph.size()) - 1; id >= 0; --id) {
    if (!used[static_cast<std::size_t>(id)]) continue;
    const Node& node = graph[id];
    for (int k = 0; k < arity(node.op); ++k) used[static_cast<std::size_t>(node.in[static_cast<std::size_t>(k)])] = 1;
  }
  std::vector<NodeId> list;
  for (std::size_t id = 0; id < used.size(); ++id)
    if (used[id]) list.push_back(static_cast<NodeId>(id));
  return list;
}

std::vector<NodeId> rewrite(Graph& graph, std::span<const NodeId> roots,
                            const std::function<std::optional<NodeId>(NodeId)>& replace) {
  const std::vector<NodeId> order = reachable(graph, roots);
  std::vector<NodeId> image(graph.size(), -1);
  for (const NodeId id : order) {
    const Node node = graph[id];  // a copy: making nodes moves the array
    NodeId rebuilt = id;
    if (arity(node.op) > 0) {
      std::array<NodeId, 3> in = {-1, -1, -1};
      for (std::size_t k = 0; k < static_cast<std::size_t>(arity(node.op)); ++k)
        in[k] = image[static_cast<std::size_t>(node.in[k])];
      rebuilt = graph.make(node.op, in[0], in[1], in[2]);
    }
    image[static_cast<std::size_t>(id)] = replace(rebuilt).value_or(rebuilt);
  }
  std::vector<NodeId> result;
  for (const NodeId root : roots) result.push_back(image[static_cast<std::size_t>(root)]);
  return result;
}

namespace {

/// base^exponent by repeated squaring, exponent >= 1.
Term integer_power(Term base, int exponent) {
  if (exponent == 1) return base;
  const Term half = integer_power(base, exponent / 2);
  return exponent % 2 == 0 ? half * half : half * half * base;
}

}  // namespace

std::vector<NodeId> expand_powers(Graph& graph, std::span<const NodeId> roots) {
  // Beyond this the rounding of the products exceeds that of pow().
  constexpr int largest = 32;
  return rewrite(graph, roots, [&](NodeId id) -> std::optional<NodeId> {
    const Node node = graph[id];
    if (node.op != Op::power) return std::nullopt;
    const auto exponent = graph.constant_value(node.in[1]);
    if (!exponent || *exponent != std::floor(*exponent) || std::fabs(*exponent) > largest) return std::nullopt;
    const Term product = integer_power({&graph, node.in[0]}, static_cast<int>(std::fabs(*exponent)));
    return *exponent > 0 ? product.id : (1.0 / product).id;
  });
}

std::vector<double> evaluate(const Graph& graph, std::span<const NodeId> roots,
                             const std::function<double(const Symbol&)>& value_of) {
  std::vector<double> value(graph.size(), 0);
  for (const NodeId id : reachable(graph, roots)) {
    const Node& node = graph[id];
    const auto in = [&](std::size_t k) { return node.in[k] < 0 ? 0.0 : value[static_cast<std::size_t>(node.in[k])]; };
    double& result = value[static_cast<std::size_t>(id)];
    if (node.op == Op::constant)
      result = node.value;
    else if (node.op == Op::symbol)
      result = value_of(graph.symbol_of(id));
    else
      result = apply(node.op, in(0), in(1), in(2));
  }
  std::vector<double> result;
  for (const NodeId root : roots) result.push_back(value[static_cast<std::size_t>(root)]);
  return result;
}

}  // namespace pelage
