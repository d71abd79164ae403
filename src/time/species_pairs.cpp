#include "time/species_pairs.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "base/random.h"
#include "discretise/lattice_stencil.h"

namespace pelage {

SpeciesPairs::SpeciesPairs(InstructionSet instructions, int sweeps)
    : loops_(&node_loops(instructions)), sweeps_(sweeps) {}

namespace {

const std::shared_ptr<const Held>& shared_held(const System& system, std::size_t species) {
  const auto& own = system.species[species].held;
  return own ? own : system.held;
}

bool same(const std::shared_ptr<const Held>& a, const std::shared_ptr<const Held>& b) {
  return a == b || (a && b && *a == *b);
}

/// Where the value of a species is given and not only held.
Held given_values(const System& system, std::size_t species) {
  const auto& own = system.species[species].held;
  if (!own || !system.set_values) return {};
  Held given = *own;
  for (std::size_t k = 0; system.held && k < given.size(); ++k) given[k] &= !(*system.held)[k];
  return given;
}

}  // namespace

bool SpeciesPairs::unchanged(const System& system) const {
  if (species_ != system.species.size() || held_ != system.held) return false;
  return std::ranges::all_of(evolving_, [&](std::size_t i) {
    const SpeciesPair& p = pairs_[place_[i] / 2];
    const std::size_t lane = place_[i] % 2;
    const Species& s = system.species[i];
    if (p.diffusion[lane] != static_cast<float>(s.diffusion / area_) || !same(p.held, shared_held(system, i)))
      return false;
    return s.diffusion == 0 ||
           (p.stiffness[p.stiffness.size() == 2 ? lane : 0] == s.stiffness && p.mass == mass_of(system, i));
  });
}

namespace {

/// For the two species of a pair; both diffusions in 1 / time.
PairedStencil paired_stencil(const Lattice& lattice, const LatticeStencil& first, const LatticeStencil& second) {
  PairedStencil s{lattice.count, lattice.periodic, {}};
  for (std::size_t n = 0; n < first.neighbours.size(); ++n) {
    const double u = first.neighbours[n].weight, v = second.neighbours[n].weight;
    if (u != 0 || v != 0)
      s.neighbours.push_back({first.neighbours[n].step, {static_cast<float>(u), static_cast<float>(v)}});
  }
  return s;
}

}  // namespace

/// Without matrices: any two species share a pair.
bool SpeciesPairs::update_lattice(const System& system) {
  std::vector<Eigen::Matrix3d> tensors;
  for (const Species& s : system.species) tensors.push_back(s.tensor.value_or(Eigen::Matrix3d::Zero()));
  if (species_ == system.species.size() && lattice_ == *system.lattice && tensors_ == tensors) return false;
  species_ = system.species.size();
  lattice_ = *system.lattice;
  tensors_ = std::move(tensors);
  evolving_.clear();
  pairs_.clear();
  operators_.clear();
  place_.assign(species_, 0);
  for (std::size_t i = 0; i < species_; ++i) {
    if (system.species[i].follows) continue;
    if (pairs_.empty() || pairs_.back().count == 2) pairs_.emplace_back();
    SpeciesPair& p = pairs_.back();
    place_[i] = 2 * (pairs_.size() - 1) + p.count;
    p.diffusion[p.count] = 1;
    p.diffuses |= !tensors_[i].isZero(0);
    p.species[p.count++] = i;
    evolving_.push_back(i);
  }
  for (SpeciesPair& p : pairs_) {
    const auto stencil = [&](std::size_t lane) {
      return lattice_stencil(lattice_, lane < p.count ? tensors_[p.species[lane]] : Eigen::Matrix3d::Zero());
    };
    const LatticeStencil first = stencil(0), second = stencil(1);
    Operator o;
    o.sliced.rows = lattice_.nodes();
    o.sliced.stencil = paired_stencil(lattice_, first, second);
    o.radius = {largest_rate(first), largest_rate(second)};
    p.matrix = operators_.size();
    operators_.push_back(std::move(o));
  }
  return true;
}

bool SpeciesPairs::update(const System& system) {
  if (!system.mass) return update_lattice(system);
  if (unchanged(system)) return false;
  species_ = system.species.size();
  held_ = system.held;
  const Vector& weight = system.sampling->weight;
  area_ = std::accumulate(weight.begin(), weight.end(), 0.0) /
          static_cast<double>(std::max<Eigen::Index>(1, weight.size()));
  if (!(area_ > 0)) area_ = 1;
  evolving_.clear();
  for (std::size_t i = 0; i < species_; ++i)
    if (!system.species[i].follows) evolving_.push_back(i);
  pair_alike(system);
  pair_rest();
  place_.assign(species_, 0);
  std::vector<Operator> before = std::exchange(operators_, {});
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    for (std::size_t lane = 0; lane < pairs_[p].count; ++lane) place_[pairs_[p].species[lane]] = 2 * p + lane;
    pairs_[p].diffuses = !pairs_[p].stiffness.empty();
    note_given(system, pairs_[p]);
    if (pairs_[p].diffuses) pairs_[p].matrix = keep_operator(system, pairs_[p], before);
  }
  return true;
}

void SpeciesPairs::note_given(const System& system, SpeciesPair& p) const {
  for (std::size_t lane = 0; lane < p.count; ++lane) {
    const Held given = given_values(system, p.species[lane]);
    for (std::size_t k = 0; k < given.size(); ++k)
      if (given[k]) p.given[lane].push_back(k);
  }
}

/// Two species share a pair when they have one operator, or when one of them does not diffuse.
void SpeciesPairs::pair_alike(const System& system) {
  pairs_.clear();
  for (const std::size_t i : evolving_) {
    const Species& s = system.species[i];
    const bool diffuses = s.diffusion != 0;
    const auto fits = [&](const SpeciesPair& p) {
      return p.count < 2 && same(p.held, shared_held(system, i)) &&
             (!diffuses || p.stiffness.empty() || (p.stiffness[0] == s.stiffness && p.mass == mass_of(system, i)));
    };
    auto p = std::ranges::find_if(pairs_, fits);
    if (p == pairs_.end()) {
      p = pairs_.insert(p, SpeciesPair{});
      p->held = shared_held(system, i);
    }
    if (diffuses && p->stiffness.empty()) {
      p->stiffness = {s.stiffness};
      p->mass = mass_of(system, i);
    }
    p->diffusion[p->count] = static_cast<float>(s.diffusion / area_);
    p->species[p->count++] = i;
  }
}

/// Of those that are left alone two share a pair when they have one mass.
void SpeciesPairs::pair_rest() {
  for (std::size_t a = 0; a < pairs_.size(); ++a) {
    SpeciesPair& p = pairs_[a];
    if (p.count == 2 || p.stiffness.empty()) continue;
    const auto fits = [&](const SpeciesPair& q) {
      return q.count == 1 && q.mass == p.mass && same(q.held, p.held) &&
             q.stiffness[0]->pattern == p.stiffness[0]->pattern;
    };
    const auto q = std::find_if(pairs_.begin() + static_cast<std::ptrdiff_t>(a) + 1, pairs_.end(), fits);
    if (q == pairs_.end()) continue;
    p.species[1] = q->species[0];
    p.diffusion[1] = q->diffusion[0];
    p.stiffness.push_back(q->stiffness[0]);
    p.count = 2;
    pairs_.erase(q);
  }
}

/// Its number; made unless it is there, or among those `before`.
std::size_t SpeciesPairs::keep_operator(const System& system, const SpeciesPair& pair, std::vector<Operator>& before) {
  const auto fits = [&](const Operator& o) {
    return o.stiffness == pair.stiffness && o.mass == pair.mass && same(o.held, pair.held);
  };
  if (const auto known = std::ranges::find_if(operators_, fits); known != operators_.end())
    return static_cast<std::size_t>(known - operators_.begin());
  if (const auto old = std::ranges::find_if(before, fits); old != before.end()) {
    operators_.push_back(std::move(*old));
  } else {
    const std::size_t diffusing = pair.species[pair.diffusion[0] != 0 ? 0 : 1];
    const Held given = given_values(system, diffusing);
    SlicedMatrix sliced = slice(pair.stiffness, *pair.mass, weight_of(system, diffusing), area_, pair.held.get(),
                                given.empty() ? nullptr : &given);
    const std::array<double, 2> radius = radius_of(sliced);
    operators_.push_back({pair.stiffness, pair.mass, pair.held, std::move(sliced), radius});
  }
  return operators_.size() - 1;
}

double SpeciesPairs::radius(std::size_t species) const {
  const std::size_t lane = place_[species] % 2;
  const SpeciesPair& p = pairs_[place_[species] / 2];
  return !p.diffuses ? 0 : p.diffusion[lane] * operators_[p.matrix].radius[lane];
}

double SpeciesPairs::bytes() const {
  double sum = 0;
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const SlicedMatrix* m = matrix(p);
    if (!m) continue;
    const auto columns = static_cast<double>(sizeof(float) * m->column.size() + sizeof(std::int16_t) * m->near.size());
    const auto nodes = 2.0 * sizeof(float) * static_cast<double>(m->rows);
    sum += columns + sizeof(float) * static_cast<double>(m->diffusion.size()) + 2 * nodes;
    sum += sweeps(p) * (columns + sizeof(float) * static_cast<double>(m->correction.size()) + 3 * nodes);
  }
  return sum;
}

namespace {

/// The norms of both fields, or that of both together twice.
std::array<double, 2> norms(const PairField& f, bool apart) {
  const auto squares = ordered_sum(f.size() / 2, Eigen::Array2d{0, 0}, [&](std::size_t begin, std::size_t end) {
    Eigen::Array2d sum{0, 0};
    for (std::size_t k = begin; k < end; ++k)
      for (std::size_t lane = 0; lane < 2; ++lane)
        sum[static_cast<Eigen::Index>(lane)] += static_cast<double>(f[2 * k + lane]) * f[2 * k + lane];
    return sum;
  });
  if (apart) return {std::sqrt(squares[0]), std::sqrt(squares[1])};
  return {std::sqrt(squares.sum()), std::sqrt(squares.sum())};
}

/// Fields that are largest where the matrix is, with signs at random: short edges and corners of few triangles have the
/// largest eigenvalues.
PairField first_guess(const SlicedMatrix& m) {
  PairField x(2 * slice_rows * m.slices());
  const std::size_t count = m.twin ? 2 : 1;
  parallel_for(m.slices(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s)
      for (std::size_t k = 0; k < slice_rows; ++k)
        for (std::size_t lane = 0; lane < 2; ++lane) {
          float sum = 0;
          for (std::size_t e = m.start[s]; e < m.start[s + 1]; ++e)
            sum += m.diffusion[count * (slice_rows * e + k) + (m.twin ? lane : 0)];
          const std::size_t i = 2 * (s * slice_rows + k) + lane;
          x[i] = hash(1, i) % 2 ? sum : -sum;
        }
  });
  return x;
}

}  // namespace

/// Power iteration, for both species at once.
std::array<double, 2> SpeciesPairs::radius_of(const SlicedMatrix& m) const {
  constexpr int iterations = 60;
  constexpr double enough = 2e-3;
  constexpr std::array<float, 2> one = {1, 1};
  PairField x = first_guess(m), y(x.size()), g;
  const auto by_slices = [&](auto&& product) {
    parallel_for(
        m.slices(), [&](std::size_t begin, std::size_t end) { product(begin, end, 2 * slice_rows * begin); }, 128);
  };
  std::array<double, 2> radius{};
  for (int k = 0; k < iterations; ++k) {
    const std::array<double, 2> before = norms(x, m.twin);
    if (!(before[0] > 0 && before[1] > 0)) return {};
    for (std::size_t i = 0; i < x.size(); ++i) x[i] *= static_cast<float>(1 / before[i % 2]);
    by_slices([&](std::size_t begin, std::size_t end, std::size_t at) {
      loops_->diffuse(m, x.data(), one.data(), begin, end, y.data() + at);
    });
    std::swap(x, y);
    if (!m.correction.empty()) g = x;
    for (int sweep = 0; sweep < (m.correction.empty() ? 0 : sweeps_); ++sweep) {
      by_slices([&](std::size_t begin, std::size_t end, std::size_t at) {
        loops_->correct(m, x.data(), g.data() + at, one.data(), begin, end, y.data() + at);
      });
      std::swap(x, y);
    }
    const std::array<double, 2> next = norms(x, m.twin);
    const bool done = k > 8 && next[0] < radius[0] * (1 + enough) && next[1] < radius[1] * (1 + enough);
    for (std::size_t lane = 0; lane < 2; ++lane) radius[lane] = std::max(radius[lane], next[lane]);
    if (done) break;
  }
  return radius;
}

}  // namespace pelage
