#pragma once
// Expressions as a directed acyclic graph in which equal sub-expressions are one node ("hash-consed").
// Nodes are simplified as they are made; operands always have smaller numbers than the node that uses
// them, so every pass over a graph is one loop and no depth of nesting can exhaust the stack.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "pelage/error.h"
#include "react/operations.h"

namespace pelage {

using NodeId = std::int32_t;

/// A quantity that is known only when an expression is evaluated.
struct Symbol {
  enum class Kind {
    species,        ///< concentration number `index`
    laplacian,      ///< surface Laplacian of concentration number `index`
    gradients,      ///< scalar product of the surface gradients of concentrations `index` and `other`, index <= other
    divergence,     ///< div(c grad u) of concentration number `index` and the node `other`, c
    time,           ///< model time
    position,       ///< coordinate `index` (0, 1, 2) of the place, world units
    box_position,   ///< the same in the bounding box of all places: -1 at its low side, 1 at its high one
    normal_vector,  ///< component `index` of the unit normal
    curvature,      ///< principal curvature k1 (index 0) or k2 (index 1), 1 / world unit
    attribute,      ///< vertex attribute `name`
    uniform,        ///< white noise, uniform in [0, 1): one independent value per place
    gaussian,       ///< white noise, mean 0, variance 1
    mask,           ///< not 0 inside the mask of a stage
    noise           ///< band-limited noise of `length` model length units, mean 0, variance 1
  };
  Kind kind = Kind::species;
  int index = 0;
  std::string name = {};     ///< of an attribute
  std::uint64_t stream = 0;  ///< of random kinds: tells independent fields apart
  double length = 0;         ///< of band-limited noise
  NodeId other = -1;         ///< of gradients and divergences
  Location where = {};       ///< first use; does not take part in comparisons

  bool operator==(const Symbol& s) const {
    return kind == s.kind && index == s.index && name == s.name && stream == s.stream && length == s.length &&
           other == s.other;
  }
};

/// What the value of an expression varies with: a set of bits.
enum Dependence : unsigned { on_nothing = 0, on_place = 1, on_time = 2, on_species = 4 };

struct Node {
  Op op = Op::constant;
  std::array<NodeId, 3> in = {-1, -1, -1};  ///< operands; of a symbol: in[0] is its number
  double value = 0;                         ///< of a constant
  unsigned dependence = on_nothing;         ///< bits of Dependence
};

class Graph {
 public:
  NodeId constant(double value);
  NodeId symbol(const Symbol& symbol);
  /// The simplified node for op(a, b, c). Simplification keeps values up to rounding wherever all operands are finite.
  NodeId make(Op op, NodeId a, NodeId b = -1, NodeId c = -1);

  const Node& operator[](NodeId id) const { return nodes_[static_cast<std::size_t>(id)]; }
  std::size_t size() const { return nodes_.size(); }
  const Symbol& symbol_of(NodeId id) const;
  std::optional<double> constant_value(NodeId id) const;
  bool is_constant(NodeId id, double value) const { return constant_value(id) == value; }

 private:
  struct Hash {
    std::size_t operator()(const Node& node) const;
  };
  struct Same {
    bool operator()(const Node& a, const Node& b) const;
  };
  NodeId intern(const Node& node);
  std::optional<NodeId> simplify(Op op, NodeId a, NodeId b, NodeId c);
  std::optional<NodeId> simplify_sum(NodeId a, NodeId b);
  std::optional<NodeId> simplify_difference(NodeId a, NodeId b);
  std::optional<NodeId> simplify_product(NodeId a, NodeId b);
  std::optional<NodeId> simplify_quotient(NodeId a, NodeId b);
  std::optional<NodeId> simplify_power(NodeId a, NodeId b);

  std::vector<Node> nodes_;
  std::vector<Symbol> symbols_;
  std::unordered_map<Node, NodeId, Hash, Same> known_;
};

/// A node with its graph, so that formulas can be written as formulas.
struct Term {
  Graph* graph;
  NodeId id;
};
inline Term operator+(Term a, Term b) { return {a.graph, a.graph->make(Op::add, a.id, b.id)}; }
inline Term operator-(Term a, Term b) { return {a.graph, a.graph->make(Op::subtract, a.id, b.id)}; }
inline Term operator*(Term a, Term b) { return {a.graph, a.graph->make(Op::multiply, a.id, b.id)}; }
inline Term operator/(Term a, Term b) { return {a.graph, a.graph->make(Op::divide, a.id, b.id)}; }
inline Term operator-(Term a) { return {a.graph, a.graph->make(Op::negate, a.id)}; }
inline Term operator+(double a, Term b) { return Term{b.graph, b.graph->constant(a)} + b; }
inline Term operator-(double a, Term b) { return Term{b.graph, b.graph->constant(a)} - b; }
inline Term operator*(double a, Term b) { return Term{b.graph, b.graph->constant(a)} * b; }
inline Term operator/(double a, Term b) { return Term{b.graph, b.graph->constant(a)} / b; }
inline Term operator-(Term a, double b) { return a - Term{a.graph, a.graph->constant(b)}; }

/// The nodes that `roots` are made of, the roots included, operands before their users.
std::vector<NodeId> reachable(const Graph& graph, std::span<const NodeId> roots);

/// The roots rebuilt from their leaves upwards; where `replace` gives another node for a rebuilt one, that is taken.
std::vector<NodeId> rewrite(Graph& graph, std::span<const NodeId> roots,
                            const std::function<std::optional<NodeId>(NodeId)>& replace);

/// The roots with small integer powers written as products.
std::vector<NodeId> expand_powers(Graph& graph, std::span<const NodeId> roots);

/// The values of the roots for given values of the symbols.
std::vector<double> evaluate(const Graph& graph, std::span<const NodeId> roots,
                             const std::function<double(const Symbol&)>& value_of);

}  // namespace pelage
