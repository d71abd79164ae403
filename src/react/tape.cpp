#include "react/tape.h"

#include <algorithm>
#include <cassert>
#include <memory>
#include <optional>

#include "react/tape_kernels.h"

namespace pelage {

namespace {

// 256 doubles are 2 kB: a dozen registers fit the L1 cache, and the dispatch of an instruction (a few
// nanoseconds) is spread over enough samples to vanish.
constexpr std::size_t block_size = 256;

/// Memory for `count` things, on the stack if they are few: a run of one block takes less time than an allocation.
template <class T, std::size_t few>
class Scratch {
 public:
  explicit Scratch(std::size_t count) {
    if (count > few) many_ = std::make_unique_for_overwrite<T[]>(count);
  }
  T* data() { return many_ ? many_.get() : few_; }

 private:
  alignas(64) T few_[few];
  std::unique_ptr<T[]> many_;
};

}  // namespace

/// Chooses the order of the instructions and the registers.
class TapeBuilder {
 public:
  TapeBuilder(const Graph& graph, std::span<const NodeId> roots, std::span<const NodeId> inputs,
              std::span<const NodeId> scalars, Tape& tape)
      : graph_(graph),
        tape_(tape),
        state_(graph.size(), unseen),
        place_(graph.size()),
        fusion_(graph.size()),
        absorbed_(graph.size(), 0) {
    tape.input_count_ = inputs.size();
    tape.output_count_ = roots.size();
    tape.scalar_count_ = scalars.size();
    for (std::size_t k = 0; k < inputs.size(); ++k) set_place(inputs[k], {Place::Kind::input, k});
    for (std::size_t k = 0; k < scalars.size(); ++k) set_place(scalars[k], {Place::Kind::scalar, k});
  }

  void build(std::span<const NodeId> roots) {
    for (const NodeId root : roots) schedule(root);
    count_uses();
    for (std::size_t k = 0; k < roots.size(); ++k) {
      auto& place = place_[index(roots[k])];
      if (state_[index(roots[k])] == scheduled && place.kind == Place::Kind::none) place = {Place::Kind::output, k};
    }
    for (const NodeId id : order_) choose_fusion(id);
    for (const NodeId id : order_)
      if (!absorbed_[index(id)]) emit(id);
    for (std::size_t k = 0; k < roots.size(); ++k) {
      const Place from = place_[index(roots[k])];
      if (from.kind != Place::Kind::output || from.number != k) copies_.push_back({from, {Place::Kind::output, k}});
    }
    finish();
  }

 private:
  struct Place {
    enum class Kind { none, reg, input, output, scalar, constant };
    Kind kind = Kind::none;
    std::size_t number = 0;
    bool is_scalar() const { return kind == Kind::scalar || kind == Kind::constant; }
  };
  struct Step {
    Op op = Op::constant;
    std::optional<std::size_t> fused_operand;  ///< the operand that is computed in the same loop
    Op inner = Op::constant;
    std::vector<Place> in;
    Place out;
  };
  struct Copy {
    Place from, to;
  };
  enum State : char { unseen, opened, scheduled, given };

  static std::size_t index(NodeId id) { return static_cast<std::size_t>(id); }

  void set_place(NodeId id, Place place) {
    place_[index(id)] = place;
    state_[index(id)] = given;
  }

  /// Appends the nodes that `root` needs, operands first, in depth-first order (which keeps few values alive).
  void schedule(NodeId root) {
    std::vector<NodeId> stack = {root};
    while (!stack.empty()) {
      const NodeId id = stack.back();
      const Node& node = graph_[id];
      State& state = state_[index(id)];
      if (state == unseen && node.op == Op::constant) {
        set_place(id, {Place::Kind::constant, tape_.constants_.size()});
        tape_.constants_.push_back(node.value);
      }
      if (state == unseen) {
        assert(node.op != Op::symbol && "every symbol must be an input or a scalar");
        state = opened;
        for (int k = arity(node.op) - 1; k >= 0; --k) {
          const NodeId in = node.in[static_cast<std::size_t>(k)];
          if (state_[index(in)] == unseen) stack.push_back(in);
        }
        continue;
      }
      if (state == opened) {
        state = scheduled;
        order_.push_back(id);
      }
      stack.pop_back();
    }
  }

  void count_uses() {
    uses_.assign(graph_.size(), 0);
    for (const NodeId id : order_)
      for (int k = 0; k < arity(graph_[id].op); ++k) ++uses_[index(graph_[id].in[static_cast<std::size_t>(k)])];
  }

  /// An operand that is used only here is computed in the same loop, if both operations are fusible.
  void choose_fusion(NodeId id) {
    const Node& node = graph_[id];
    if (!is_fusible(node.op)) return;
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t in = index(node.in[k]);
      const bool is_free = state_[in] == scheduled && place_[in].kind == Place::Kind::none && uses_[in] == 1;
      if (!is_free || !is_fusible(graph_[node.in[k]].op) || fusion_[in]) continue;
      fusion_[index(id)] = k;
      absorbed_[in] = 1;
      return;
    }
  }

  /// The nodes whose values an instruction reads.
  std::vector<NodeId> operands(NodeId id) const {
    const Node& node = graph_[id];
    const auto k = fusion_[index(id)];
    if (!k) return {node.in.begin(), node.in.begin() + arity(node.op)};
    const Node& inner = graph_[node.in[*k]];
    return {inner.in[0], inner.in[1], node.in[1 - *k]};
  }

  void emit(NodeId id) {
    Step step;
    step.op = graph_[id].op;
    step.fused_operand = fusion_[index(id)];
    if (step.fused_operand) step.inner = graph_[graph_[id].in[*step.fused_operand]].op;
    const std::vector<NodeId> in = operands(id);
    for (const NodeId operand : in) step.in.push_back(place_[index(operand)]);
    Place& place = place_[index(id)];
    if (place.kind == Place::Kind::none) place = {Place::Kind::reg, take_register()};
    step.out = place;
    steps_.push_back(step);
    // Operands are released only now: a result never shares memory with an operand.
    for (std::size_t k = 0; k < in.size(); ++k)
      if (--uses_[index(in[k])] == 0 && step.in[k].kind == Place::Kind::reg) free_.push_back(step.in[k].number);
  }

  std::size_t take_register() {
    if (free_.empty()) return tape_.register_count_++;
    const std::size_t number = free_.back();
    free_.pop_back();
    return number;
  }

  /// The place in the table of pointers.
  std::uint32_t address(const Place& place) const {
    std::size_t base = 0;
    if (place.kind > Place::Kind::reg) base += tape_.register_count_;
    if (place.kind > Place::Kind::input) base += tape_.input_count_;
    if (place.kind > Place::Kind::output) base += tape_.output_count_;
    if (place.kind > Place::Kind::scalar) base += tape_.scalar_count_;
    return static_cast<std::uint32_t>(base + place.number);
  }

  void finish() {
    for (const Step& step : steps_) {
      unsigned mask = 0;
      Tape::Instruction instruction;
      for (unsigned k = 0; k < static_cast<unsigned>(step.in.size()); ++k) {
        if (step.in[k].is_scalar()) mask |= 1u << k;
        instruction.in[k] = address(step.in[k]);
      }
      instruction.kernel = static_cast<std::uint32_t>(
          step.fused_operand ? fused_kernel(step.inner, step.op, *step.fused_operand == 1, mask)
                             : tape_kernel(step.op, mask));
      instruction.out = address(step.out);
      tape_.instructions_.push_back(instruction);
    }
    for (const Copy& copy : copies_) {
      Tape::Instruction instruction;
      instruction.kernel = static_cast<std::uint32_t>(copy_kernel(copy.from.is_scalar()));
      instruction.in[0] = address(copy.from);
      instruction.out = address(copy.to);
      tape_.instructions_.push_back(instruction);
    }
    tape_.float_constants_.assign(tape_.constants_.begin(), tape_.constants_.end());
  }

  const Graph& graph_;
  Tape& tape_;
  std::vector<State> state_;
  std::vector<Place> place_;
  std::vector<int> uses_;
  std::vector<std::optional<std::size_t>> fusion_;  ///< which operand is computed in the same loop
  std::vector<char> absorbed_;                      ///< computed in the loop of its user
  std::vector<NodeId> order_;
  std::vector<Step> steps_;
  std::vector<Copy> copies_;
  std::vector<std::size_t> free_;
};

Tape::Tape(const Graph& graph, std::span<const NodeId> roots, std::span<const NodeId> inputs,
           std::span<const NodeId> scalars) {
  TapeBuilder(graph, roots, inputs, scalars, *this).build(roots);
}

template <class T, class Kernels>
void Tape::execute(Kernels kernels, const std::vector<T>& constants, std::span<const T* const> inputs,
                   std::span<const T> scalars, std::size_t begin, std::size_t end, std::span<T* const> out) const {
  assert(inputs.size() == input_count_ && scalars.size() == scalar_count_ && out.size() == output_count_);
  Scratch<T, 12 * block_size> registers(register_count_ * block_size);
  // The table of pointers is written for T*, because registers and outputs are written through it.
  Scratch<T*, 64> pointers(register_count_ + input_count_ + output_count_ + scalar_count_ + constants.size());
  T** const table = pointers.data();
  T** next = table;
  for (std::size_t k = 0; k < register_count_; ++k) *next++ = registers.data() + k * block_size;
  for (const T* input : inputs) *next++ = const_cast<T*>(input) + begin;
  for (T* output : out) *next++ = output + begin;
  for (const T& scalar : scalars) *next++ = const_cast<T*>(&scalar);
  for (const T& constant : constants) *next++ = const_cast<T*>(&constant);

  const std::span moving(table + register_count_, input_count_ + output_count_);
  for (std::size_t block = begin; block < end; block += block_size) {
    const std::size_t count = std::min(block_size, end - block);
    for (const Instruction& i : instructions_)
      kernels[i.kernel](table[i.in[0]], table[i.in[1]], table[i.in[2]], table[i.out], count);
    for (T*& pointer : moving) pointer += count;
  }
}

void Tape::run(std::span<const double* const> inputs, std::span<const double> scalars, std::size_t begin,
               std::size_t end, std::span<double* const> out) const {
  execute<double>(double_kernels(), constants_, inputs, scalars, begin, end, out);
}

void Tape::run(std::span<const float* const> inputs, std::span<const float> scalars, std::size_t count,
               std::span<float* const> out, InstructionSet set) const {
  execute<float>(float_kernels(set), float_constants_, inputs, scalars, 0, count, out);
}

}  // namespace pelage
