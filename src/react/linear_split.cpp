#include "react/linear_split.h"

#include <array>

#include "react/derivative.h"

namespace pelage {

namespace {

/// Coefficients of a polynomial in the species, lowest degree first, none of which depends on it.
using Polynomial = std::vector<NodeId>;

// Reaction kinetics are of degree 2 to 5; expanding high powers of sums would only cost accuracy.
constexpr std::size_t largest_degree = 12;

Polynomial sum(Graph& graph, Op op, const Polynomial& a, const Polynomial& b) {
  const NodeId zero = graph.constant(0);
  Polynomial result;
  for (std::size_t k = 0; k < std::max(a.size(), b.size()); ++k)
    result.push_back(graph.make(op, k < a.size() ? a[k] : zero, k < b.size() ? b[k] : zero));
  return result;
}

std::optional<Polynomial> product(Graph& graph, const Polynomial& a, const Polynomial& b) {
  if (a.size() + b.size() > largest_degree + 2) return std::nullopt;
  Polynomial result(a.size() + b.size() - 1, graph.constant(0));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      result[i + j] = graph.make(Op::add, result[i + j], graph.make(Op::multiply, a[i], b[j]));
  return result;
}

std::optional<Polynomial> power(Graph& graph, const Polynomial& base, NodeId exponent) {
  const auto n = graph.constant_value(exponent);
  if (!n || *n != std::floor(*n) || *n < 0 || *n > static_cast<double>(largest_degree)) return std::nullopt;
  std::optional<Polynomial> result = Polynomial{graph.constant(1)};
  for (int k = 0; k < static_cast<int>(*n) && result; ++k) result = product(graph, *result, base);
  return result;
}

class Expansion {
 public:
  Expansion(Graph& graph, NodeId species) : graph_(graph), species_(species) {}

  std::optional<Polynomial> operator()(NodeId root) {
    const std::array<NodeId, 1> roots = {root};
    const std::vector<NodeId> order = reachable(graph_, roots);
    known_.assign(graph_.size(), std::nullopt);
    for (const NodeId id : order) known_[static_cast<std::size_t>(id)] = expand(id);
    return known_[static_cast<std::size_t>(root)];
  }

 private:
  std::optional<Polynomial> expand(NodeId id) {
    if (id == species_) return Polynomial{graph_.constant(0), graph_.constant(1)};
    const Node node = graph_[id];
    std::array<std::optional<Polynomial>, 3> in;
    bool free_of_species = true;
    for (std::size_t k = 0; k < static_cast<std::size_t>(arity(node.op)); ++k) {
      in[k] = known_[static_cast<std::size_t>(node.in[k])];
      free_of_species = free_of_species && in[k] && in[k]->size() == 1;
    }
    if (free_of_species) return Polynomial{id};
    if (!in[0]) return std::nullopt;
    if (node.op == Op::negate) return sum(graph_, Op::subtract, {graph_.constant(0)}, *in[0]);
    if (!in[1]) return std::nullopt;
    if (node.op == Op::add || node.op == Op::subtract) return sum(graph_, node.op, *in[0], *in[1]);
    if (node.op == Op::multiply) return product(graph_, *in[0], *in[1]);
    if (node.op == Op::power) return power(graph_, *in[0], node.in[1]);
    if (node.op == Op::divide && in[1]->size() == 1) return quotient(*in[0], node.in[1]);
    return std::nullopt;
  }

  Polynomial quotient(Polynomial numerator, NodeId denominator) {
    for (NodeId& coefficient : numerator) coefficient = graph_.make(Op::divide, coefficient, denominator);
    return numerator;
  }

  Graph& graph_;
  NodeId species_;
  std::vector<std::optional<Polynomial>> known_;
};

}  // namespace

LinearSplit linear_split(Graph& graph, NodeId rate, NodeId species) {
  const Term u{&graph, species};
  if (const auto polynomial = Expansion(graph, species)(rate)) {
    Term c2{&graph, graph.constant(0)};
    for (std::size_t k = polynomial->size() - 1; k > 0; --k) c2 = c2 * u + Term{&graph, (*polynomial)[k]};  // Horner
    return {c2.id, polynomial->front()};
  }
  const std::array<NodeId, 1> roots = {rate};
  const Term c2{&graph, derivative(graph, roots, species).front()};
  return {c2.id, (Term{&graph, rate} - c2 * u).id};
}

}  // namespace pelage
