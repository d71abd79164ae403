#pragma once
// The page of the papers' figures.

#include <string>
#include <vector>

#include "recipe/paper.h"

namespace pelage {

/// What came of a panel.
struct MadePanel {
  std::string numbers;  ///< what was measured, in words
  std::string failure;  ///< instead, if not empty
};

/// A paper and those of its figures that are shown, with what came of their panels in order.
struct FiguresOfPaper {
  const Paper* paper;
  std::vector<const PaperFigure*> figures;
  std::vector<std::vector<MadePanel>> made;
};

/// "turk-2": what the command line calls a figure.
std::string figure_id(const Paper& paper, const PaperFigure& figure);
/// "made", "made otherwise", "misprint".
std::string verdict_in_words(FigureVerdict verdict);

/// The text of index.html.
std::string figures_page(const std::vector<FiguresOfPaper>& papers);

}  // namespace pelage
