#include <algorithm>
#include <cmath>

#include "discretise/loop_patch.h"
#include "verify/figure.h"
#include "verify/neighbourhoods.h"

namespace pelage {

namespace {

struct Deviations {
  double sum = 0, first = 0, second = 0;
};

double largest(const Eigen::RowVectorXd& row) { return row.cwiseAbs().maxCoeff(); }

/// Fourth-order central differences of the values against the first derivatives, and of those against the second. The
/// places are inside of one polynomial piece: across its edges the third derivatives jump.
Deviations deviations_at(const LoopPatches& patches, Index patch_class, double v, double w) {
  constexpr double h = 1e-4;  // truncation h^4 and round-off 1e-16 / h are both far below the bound
  auto at = [&](int dv, int dw) { return patches.evaluate(patch_class, v + dv * h, w + dw * h); };
  auto difference = [](const PatchJet& minus2, const PatchJet& minus1, const PatchJet& plus1,
                       const PatchJet& plus2) -> PatchJet {
    return (8 * (plus1 - minus1) - (plus2 - minus2)) / (12 * h);
  };
  const PatchJet jet = at(0, 0);
  const PatchJet by_v = difference(at(-2, 0), at(-1, 0), at(1, 0), at(2, 0));
  const PatchJet by_w = difference(at(0, -2), at(0, -1), at(0, 1), at(0, 2));
  return {std::abs(jet.row(0).sum() - 1),
          std::max(largest(by_v.row(0) - jet.row(1)), largest(by_w.row(0) - jet.row(2))),
          std::max({largest(by_v.row(1) - jet.row(3)), largest(by_v.row(2) - jet.row(4)),
                    largest(by_w.row(1) - jet.row(4)), largest(by_w.row(2) - jet.row(5))})};
}

std::vector<Figure> check(const std::string& name, const std::vector<Neighbourhood>& cases) {
  Deviations worst;
  for (const Neighbourhood& n : cases) {
    LoopPatches patches;
    std::vector<Index> points;
    const Index patch_class = patches.classify(n.topology, n.face, points);
    for (auto [v, w] : {std::pair{0.3, 0.25}, {0.15, 0.62}, {0.05, 0.03}, {0.4, 0.45}, {0.91, 0.06}, {0.02, 0.93}}) {
      const Deviations d = deviations_at(patches, patch_class, v, w);
      worst = {std::max(worst.sum, d.sum), std::max(worst.first, d.first), std::max(worst.second, d.second)};
    }
  }
  return {at_most("sum of the basis functions less 1, " + name, worst.sum, 1e-12),
          at_most("first derivatives against differences, " + name, worst.first, 1e-6),
          at_most("second derivatives against differences, " + name, worst.second, 1e-6)};
}

}  // namespace

std::vector<Figure> verify_basis() {
  std::vector<Figure> figures;
  for (const auto& part :
       {check("valences 3 to 12", one_extraordinary_corner()),
        check("several extraordinary corners", several_extraordinary_corners()), check("boundary", boundary_corners())})
    figures.insert(figures.end(), part.begin(), part.end());
  return figures;
}

}  // namespace pelage
