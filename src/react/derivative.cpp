#include "react/derivative.h"

#include <cassert>
#include <numbers>

namespace pelage {

namespace {

/// The derivative of a node f = op(a, b, c), given those of its operands.
class ChainRule {
 public:
  ChainRule(Graph& graph, NodeId f, const std::vector<NodeId>& derivatives)
      : graph_(graph), node_(graph[f]), f_{&graph, f}, derivatives_(derivatives) {}

  Term operator()() const;

 private:
  Term in(std::size_t k) const { return {&graph_, node_.in[k]}; }
  Term d(std::size_t k) const { return {&graph_, derivatives_[static_cast<std::size_t>(node_.in[k])]}; }
  Term make(Op op, Term a, Term b) const { return {&graph_, graph_.make(op, a.id, b.id)}; }
  Term make(Op op, Term a) const { return {&graph_, graph_.make(op, a.id)}; }
  Term number(double value) const { return {&graph_, graph_.constant(value)}; }
  Term select(Term condition, Term a, Term b) const {
    return {&graph_, graph_.make(Op::select, condition.id, a.id, b.id)};
  }
  Term power() const;
  Term elementary() const;

  Graph& graph_;
  const Node node_;  // a copy: making nodes moves the array
  const Term f_;
  const std::vector<NodeId>& derivatives_;
};

Term ChainRule::power() const {
  const Term a = in(0), b = in(1);
  const Term from_base = b * make(Op::power, a, b - 1.0) * d(0);
  if (graph_.is_constant(d(1).id, 0)) return from_base;  // avoids log(a), which does not exist for a < 0
  return from_base + f_ * make(Op::logarithm, a) * d(1);
}

Term ChainRule::elementary() const {
  const Term a = in(0);
  switch (node_.op) {
    case Op::absolute:
      return select(make(Op::less, a, number(0)), -d(0), d(0));
    case Op::exponential:
      return f_ * d(0);
    case Op::logarithm:
      return d(0) / a;
    case Op::square_root:
      return 0.5 * d(0) / f_;
    case Op::sine:
      return make(Op::cosine, a) * d(0);
    case Op::cosine:
      return -(make(Op::sine, a) * d(0));
    case Op::tangent:
      return (1.0 + f_ * f_) * d(0);
    case Op::hyperbolic_tangent:
      return (1.0 - f_ * f_) * d(0);
    case Op::error_function:
      return 2 * std::numbers::inv_sqrtpi * make(Op::exponential, -(a * a)) * d(0);
    default:  // floor, comparisons and logic: constant between their jumps
      return number(0);
  }
}

Term ChainRule::operator()() const {
  switch (node_.op) {
    case Op::add:
      return d(0) + d(1);
    case Op::subtract:
      return d(0) - d(1);
    case Op::multiply:
      return d(0) * in(1) + in(0) * d(1);
    case Op::divide:
      return (d(0) - f_ * d(1)) / in(1);
    case Op::negate:
      return -d(0);
    case Op::power:
      return power();
    case Op::minimum:
      return select(make(Op::less, in(1), in(0)), d(1), d(0));
    case Op::maximum:
      return select(make(Op::less, in(0), in(1)), d(1), d(0));
    case Op::modulo:  // a - b floor(a/b)
      return d(0) - make(Op::floor, in(0) / in(1)) * d(1);
    case Op::select:
      return select(in(0), d(1), d(2));
    default:
      return elementary();
  }
}

}  // namespace

std::vector<NodeId> derivative(Graph& graph, std::span<const NodeId> roots, NodeId variable) {
  assert(graph[variable].op == Op::symbol);
  const NodeId zero = graph.constant(0), one = graph.constant(1);
  std::vector<NodeId> derivatives(graph.size(), zero);
  for (const NodeId id : reachable(graph, roots)) {
    if (id == variable) derivatives[static_cast<std::size_t>(id)] = one;
    if (arity(graph[id].op) == 0) continue;
    derivatives[static_cast<std::size_t>(id)] = ChainRule(graph, id, derivatives)().id;
  }
  std::vector<NodeId> result;
  for (const NodeId root : roots) result.push_back(derivatives[static_cast<std::size_t>(root)]);
  return result;
}

}  // namespace pelage
