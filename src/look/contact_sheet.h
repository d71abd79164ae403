#pragma once
// Small pictures in rows and columns, with labelled axes.

#include <optional>
#include <string>
#include <vector>

#include "pelage/image.h"

namespace pelage {

struct SheetCell {
  std::optional<Image> picture;  ///< tile x tile pixels; without one the cell is plain
  std::string word;              ///< on a plain cell, where it fits
  bool crossed = false;          ///< whether a plain cell is crossed out
};

struct ContactSheet {
  std::string title, subtitle;
  std::string x_label, y_label;
  std::vector<std::string> x, y;  ///< words at the columns and rows
  std::vector<SheetCell> cells;   ///< x runs fastest; the first row is the lowest
  int tile = 160;                 ///< pixels
};

/// The size of tiles that makes a sheet of so many columns and rows about as large as a page [pixels].
int sheet_tile(int columns, int rows);

Image draw(const ContactSheet& sheet);

}  // namespace pelage
