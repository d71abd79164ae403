#include "look/contact_sheet.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "look/canvas.h"
#include "look/text.h"

namespace pelage {

namespace {

constexpr double title_size = 44, text_size = 34, small_size = 28;
constexpr int gap = 6;  // pixels between tiles
constexpr int least_left_margin = 190, right_margin = 50, top_margin = 150, bottom_margin = 130;

const Color ink = {0.012, 0.012, 0.014}, pale_ink = {0.12, 0.12, 0.13}, paper = {1, 1, 1}, plain = {0.86, 0.86, 0.85};

/// Below this nobody reads a label.
constexpr double least_size = 12;

double widest(const std::vector<std::string>& labels) {
  double width = 0;
  for (const std::string& label : labels) width = std::max(width, text_width(label, small_size));
  return width;
}

/// Smaller where the labels of columns have no room otherwise.
double label_size(const std::vector<std::string>& labels, double pitch) {
  constexpr double between = 14;
  return std::clamp(small_size * (pitch - between) / std::max(widest(labels), 1.0), least_size, double{small_size});
}

/// Every how many columns, or rows, a label has room.
int label_stride(double needed, double pitch) { return std::max(1, static_cast<int>(std::ceil(needed / pitch))); }

/// Room for the words at the rows.
int left_margin_of(const ContactSheet& sheet) {
  return std::max(least_left_margin, static_cast<int>(std::ceil(widest(sheet.y))) + 90);
}

class SheetPainter {
 public:
  explicit SheetPainter(const ContactSheet& sheet)
      : sheet_(sheet),
        columns_(static_cast<int>(sheet.x.size())),
        rows_(static_cast<int>(sheet.y.size())),
        pitch_(sheet.tile + gap),
        left_(left_margin_of(sheet)),
        canvas_(left_ + columns_ * pitch_ - gap + right_margin, top_margin + rows_ * pitch_ - gap + bottom_margin,
                paper) {}

  Image paint() {
    for (int j = 0; j < rows_; ++j)
      for (int i = 0; i < columns_; ++i) paint_cell(i, j);
    paint_words();
    paint_labels();
    return canvas_.image();
  }

 private:
  int left(int i) const { return left_ + i * pitch_; }
  int top(int j) const { return top_margin + (rows_ - 1 - j) * pitch_; }

  void paint_cell(int i, int j) {
    const SheetCell& cell = sheet_.cells[static_cast<std::size_t>(j * columns_ + i)];
    const double x = left(i), y = top(j), tile = sheet_.tile;
    if (cell.picture) {
      canvas_.picture(*cell.picture, left(i), top(j));
      return;
    }
    canvas_.fill({x, y, x + tile, y + tile}, plain);
    if (cell.crossed) {
      canvas_.line({{x, y}, {x + tile, y + tile}}, 2, pale_ink);
      canvas_.line({{x, y + tile}, {x + tile, y}}, 2, pale_ink);
    }
    const double size = std::min(small_size, tile / 6);
    if (size < 12 || cell.word.empty()) return;
    const double half = text_width(cell.word, size) / 2 + 6;
    const Spot middle = {x + tile / 2, y + tile / 2};
    canvas_.fill({middle.x - half, middle.y - 0.6 * size, middle.x + half, middle.y + 0.6 * size}, plain);
    canvas_.text(cell.word, {middle.x, middle.y + size / 3.4}, {size, pale_ink, Align::centre});
  }

  void paint_words() {
    const double room = canvas_.width() - left_ - right_margin;
    canvas_.text(fitted_text(sheet_.title, title_size, room), {double(left_), 62}, {title_size, ink});
    canvas_.text(fitted_text(sheet_.subtitle, small_size, room), {double(left_), 110}, {small_size, pale_ink});
    const double middle_x = left_ + (columns_ * pitch_ - gap) / 2.0;
    const double middle_y = top_margin + (rows_ * pitch_ - gap) / 2.0;
    canvas_.text(sheet_.x_label, {middle_x, canvas_.height() - 34.0}, {text_size, ink, Align::centre});
    canvas_.text(sheet_.y_label, {52, middle_y}, {text_size, ink, Align::centre, true});
  }

  void paint_labels() {
    const auto &across = sheet_.x, &upwards = sheet_.y;
    const double size = label_size(across, pitch_);
    for (int i = 0; i < columns_; i += label_stride(widest(across) * size / small_size, pitch_))
      canvas_.text(across[static_cast<std::size_t>(i)],
                   {left(i) + sheet_.tile / 2.0, top(0) + sheet_.tile + 1.4 * small_size}, {size, ink, Align::centre});
    for (int j = 0; j < rows_; j += label_stride(1.2 * small_size, pitch_))
      canvas_.text(upwards[static_cast<std::size_t>(j)], {left_ - 16.0, top(j) + sheet_.tile / 2.0 + small_size / 3.4},
                   {small_size, ink, Align::right});
  }

  const ContactSheet& sheet_;
  const int columns_, rows_, pitch_, left_;
  Canvas canvas_;
};

}  // namespace

int sheet_tile(int columns, int rows) { return std::clamp(1440 / std::max(columns, rows) - gap, 40, 280); }

Image draw(const ContactSheet& sheet) {
  assert(sheet.cells.size() == sheet.x.size() * sheet.y.size());
  return SheetPainter(sheet).paint();
}

}  // namespace pelage
