#pragma once
// The figures of a paper as data: what each shows and the commands that make it again.

#include <optional>
#include <string>
#include <vector>

#include "pelage/recipe.h"

namespace pelage {

struct FigurePanel {
  std::string caption;
  std::vector<Given<std::string>> commands;  ///< each as one would type it after `pelage`, one after the other
  std::string picture;                       ///< that the commands write
  std::optional<std::string> coat, field;    ///< that they write, and which of its fields is measured
};

/// How a figure has been made again.
enum class FigureVerdict { made, otherwise, misprint };

struct PaperFigure {
  std::string number;  ///< in the paper: "3", "2c"
  std::string shows;   ///< what the paper shows, in our words
  FigureVerdict verdict = FigureVerdict::made;
  std::string said;  ///< what is other, and why; or what the misprint is
  std::vector<FigurePanel> panels;
};

struct Paper {
  std::string name;   ///< of the file: "turk"
  std::string title;  ///< authors, year and title
  std::vector<PaperFigure> figures;
};

/// Error(Fault::usage) with file and line for anything unknown or missing.
Paper parse_paper(const std::string& text, const std::string& file, const std::string& name);

}  // namespace pelage
