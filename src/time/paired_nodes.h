#pragma once
// Fields of two species at the nodes in single precision, interleaved (u0 v0 u1 v1 ...), so that one read serves both,
// and the loops over them, compiled once per instruction set. All sets give the same bits.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <vector>

#include "base/instruction_set.h"
#include "linalg/sparse.h"

namespace pelage {

/// Memory that begins where a cache line does.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t line{64};
  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), line)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, line); }
  friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};
template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

/// Two interleaved fields; padded to a multiple of node_step with zeros.
using PairField = AlignedVector<float>;

/// Rows per slice of a matrix.
inline constexpr std::size_t slice_rows = 8;
/// Fields are read and written up to a multiple of this, the last of which may be padding.
inline constexpr std::size_t node_step = 16;
inline std::size_t padded(std::size_t nodes) { return (nodes + node_step - 1) / node_step * node_step; }

/// Weights on an even grid for two species (discretise/lattice_stencil.h). The order in which neighbours are added is
/// the same at all nodes, so that a field that is moved along a periodic axis gives the moved bits.
struct PairedStencil {
  std::array<std::size_t, 3> count{};
  std::array<bool, 3> periodic{};
  /// Two nodes in opposite directions, at most two steps away.
  struct Opposite {
    std::array<int, 3> step;
    std::array<float, 2> weight;  ///< of either species
  };
  std::vector<Opposite> neighbours;
};

/// Two matrices of one pattern whose rows sum to zero, so that only the entries beside the diagonal are kept and
/// (A x)_i = sum_j a_ij (x_j - x_i) is exact where x is constant. Eight rows make a slice, as long as its longest row,
/// and there are as many as padded(rows) needs: entry e of row 8 s + k is at 8 (start[s] + e) + k, filled up with
/// zeros.
struct SlicedMatrix {
  std::size_t rows = 0;
  std::vector<std::size_t> start;
  AlignedVector<std::int32_t> column;  ///< empty where `near` serves
  AlignedVector<std::int16_t> near;    ///< column less the first row of the slice, which is less to read
  AlignedVector<float>
      diffusion;  ///< -a L^-1 K with an area a, which makes it a number; with two K first those of the first, then of
                  ///< the second of a pair of species: entry e of row 8 s + k at 2 (8 (start[s] + e) + k)
  bool twin = false;                     ///< two K
  AlignedVector<float> correction;       ///< E = I - L^-1 M; empty where M is diagonal
  std::optional<PairedStencil> stencil;  ///< instead of start, columns and values

  bool corrects() const { return !correction.empty(); }
  std::size_t slices() const { return stencil ? padded(rows) / slice_rows : start.size() - 1; }
};

/// `stiffness`: one K, or two. `lumped`: L. `area`: a. Rows of held nodes are zero, and E links none to those that are
/// `given`, whose rate is not that of an equation; either may be null. Of one size and pattern all.
SlicedMatrix slice(std::span<const SharedMatrix> stiffness, const SparseMatrix& mass, const Vector& lumped, double area,
                   const std::vector<char>* held, const std::vector<char>* given);

/// What makes a stage out of the ones before, for differences from the start of the step:
///   d_j = mu d_(j-1) + nu d_(j-2) + rate (g_0 + q + r) + first f_0
/// and no further than from `lower` to `upper` of either species: neighbours of a node at a clamp see it there.
struct StageTerms {
  float mu, nu, rate, first;
  float lower[2], upper[2];
};

/// Where the values of a species end, and those so small that they become 0; what deviations are from.
struct SpeciesLimits {
  double lower, upper, smallest, middle;
  double slack;  ///< by which the rounded difference to a clamp may miss it
};

/// Of the values of one species, from `middle`, and of their changes; the largest modulus is that before the clamp.
struct SpeciesSums {
  double minimum = std::numeric_limits<double>::infinity(), maximum = -minimum, largest = 0;
  double deviation = 0, squared_deviation = 0, squared_change = 0;
  SpeciesSums& operator+=(const SpeciesSums& o);
};

/// The error estimate of a step d from y0 to y1 with the slopes f0 and f1,
///   weight (f0 + f1) - 0.8 d,   weight = 0.4 dt,
/// where neither y0 nor y1 is at a clamp: those that are have no derivatives.
/// For either species; `scale` is what errors and values are multiplied by, so that no square leaves the range.
struct ErrorTerms {
  float weight;
  float lower[2], upper[2], scale[2];
};

struct NodeLoops {
  /// out = scale (A x), or base + scale (A x), for the rows of slices [first, last); A: the diffusion, or the
  /// correction of a matrix that is no stencil; `scale`: of either species. `base` and `out` point at slice `first`.
  void (*diffuse)(const SlicedMatrix& matrix, const float* x, const float* scale, std::size_t first, std::size_t last,
                  float* out);
  void (*correct)(const SlicedMatrix& matrix, const float* x, const float* base, const float* scale, std::size_t first,
                  std::size_t last, float* out);
  /// u, v = a + b; `b` may be null.
  void (*separate)(const float* a, const float* b, std::size_t count, float* u, float* v);
  /// d = rate f_0, likewise.
  void (*first_stage)(const StageTerms& terms, const float* y0, const float* f0, std::size_t count, float* d);
  /// d holds d_(j-2) and becomes d_j; r in two fields.
  void (*stage)(const StageTerms& terms, const float* y0, const float* before, const float* g0, const float* q,
                const float* f0, const float* r0, const float* r1, std::size_t count, float* d);
  /// x of two fields.
  void (*join)(const float* u, const float* v, std::size_t count, float* x);
  /// The new values of one species, and sums over them, for at most 256 nodes.
  void (*finish)(const SpeciesLimits& limits, const double* before, const float* d, std::size_t count, double* after,
                 float* y, SpeciesSums& sums);
  /// Adds to the sums of squares of the error estimate and of the values for at most 256 nodes: of the first species at
  /// 0 and 1, of the second at 2 and 3.
  void (*error)(const ErrorTerms& terms, const float* y0, const float* y1, const float* d, const float* f0,
                const float* f1, std::size_t count, double* sums);
  /// f = q + r.
  void (*add_rates)(const float* q, const float* r0, const float* r1, std::size_t count, float* f);
};

const NodeLoops& node_loops(InstructionSet set);

}  // namespace pelage
