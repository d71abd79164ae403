#include "gridgen/patches.h"

#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "base/named_files.h"
#include "gridgen/formula_function.h"
#include "recipe/document.h"
#include "shape/atlas.h"

namespace pelage {

namespace {

using Counts = std::array<std::int32_t, 2>;
constexpr std::int32_t most_nodes = 10000;  // along a side

Counts read_counts(const Value& value) {
  const auto count = [&](const Value& v) {
    const double n = v.number();
    if (!(n >= 3 && n <= most_nodes && n == std::floor(n)))
      throw Error(Fault::usage, "a patch has whole numbers of nodes from 3 to 10000 along its sides", v.where());
    return static_cast<std::int32_t>(n);
  };
  if (value.kind() != Value::Kind::array || value.items().size() != 2)
    throw Error(Fault::usage, "nodes are two numbers, along u and along v", value.where());
  return {count(value.items()[0]), count(value.items()[1])};
}

/// Error(usage) where so many more patches would need more memory than there is.
void require_room(const Counts& nodes, std::size_t count, const std::vector<Atlas::Patch>& patches,
                  const Location& where) {
  constexpr double most = 3e7;  // nodes
  double all = static_cast<double>(count) * nodes[0] * nodes[1];
  for (const Atlas::Patch& p : patches) all += static_cast<double>(p.grid.points.size());
  if (all > most) throw Error(Fault::usage, "patches of more than 30 million nodes need too much memory", where);
}

/// Places for u and v at even steps from 0 to 1.
std::vector<std::vector<double>> parameters_of(const Counts& nodes) {
  std::vector<std::vector<double>> uv(2);
  for (std::int32_t j = 0; j < nodes[1]; ++j)
    for (std::int32_t i = 0; i < nodes[0]; ++i) {
      uv[0].push_back(static_cast<double>(i) / (nodes[0] - 1));
      uv[1].push_back(static_cast<double>(j) / (nodes[1] - 1));
    }
  return uv;
}

Atlas::Patch patch_of(std::string name, const Counts& nodes, std::vector<Point> points) {
  Atlas::Patch patch;
  patch.name = std::move(name);
  patch.grid.count = {nodes[0], nodes[1], 1};
  patch.grid.points = std::move(points);
  return patch;
}

using Numbers = std::map<std::string, double>;

std::vector<Point> formula_points(const Value& formulas, const Counts& nodes, const Numbers& numbers) {
  const std::vector<std::vector<double>> uv = parameters_of(nodes);
  std::vector<Point> points(uv[0].size());
  constexpr std::array<const char*, 3> names = {"x", "y", "z"};
  for (std::size_t d = 0; d < 3; ++d) {
    const Value& text = formulas.at(names[d]);
    const std::vector<double> values = FormulaFunction({text.string(), text.text_where()}, {"u", "v"}, numbers).at(uv);
    for (std::size_t v = 0; v < points.size(); ++v) {
      if (!std::isfinite(values[v]))
        throw Error(Fault::usage,
                    "this is not finite at u = " + std::to_string(uv[0][v]) + ", v = " + std::to_string(uv[1][v]),
                    text.where());
      points[v][d] = values[v];
    }
  }
  return points;
}

std::array<Point, 16> read_control(const Value& list) {
  std::array<Point, 16> control;
  if (list.items().size() != control.size())
    throw Error(Fault::usage, "a bicubic Bezier patch has 16 control points [x, y, z], along u first", list.where());
  for (std::size_t k = 0; k < control.size(); ++k) {
    const Value& point = list.items()[k];
    if (point.items().size() != 3) throw Error(Fault::usage, "a control point is [x, y, z]", point.where());
    for (std::size_t d = 0; d < 3; ++d) control[k][d] = point.items()[d].number();
  }
  return control;
}

std::vector<Point> bezier_points(const std::array<Point, 16>& control, const Counts& nodes) {
  const std::vector<std::vector<double>> uv = parameters_of(nodes);
  std::vector<Point> points;
  for (std::size_t v = 0; v < uv[0].size(); ++v) points.push_back(bezier_point(control, uv[0][v], uv[1][v]));
  return points;
}

/// What one [[patch]] describes; several, if it names a file of Bezier patches.
class PatchReader {
 public:
  PatchReader(const Value& document, std::int32_t refine) : refine_(refine) {
    if (const Value* all = document.find("nodes")) default_ = read_counts(*all);
    if (const Value* parameters = document.find("parameters"))
      for (const auto& [name, value] : parameters->entries()) numbers_[name] = value->number();
  }

  void read(const Value& table, std::vector<Atlas::Patch>& patches) const {
    const std::string name = table.string_or("name", "patch" + std::to_string(patches.size() + 1));
    const Value *own = table.find("nodes"), *formula = table.find("formula"), *bezier = table.find("bezier"),
                *file = table.find("file");
    Counts nodes = own ? read_counts(*own) : default_;
    for (std::int32_t& n : nodes) n = refine_ * (n - 1) + 1;
    if ((formula != nullptr) + (bezier != nullptr) + (file != nullptr) != 1)
      throw Error(Fault::usage, "a patch has either formulas of u and v, or 16 Bezier control points, or a .bpt file",
                  table.where());
    require_room(nodes, file ? 0 : 1, patches, table.where());
    if (formula) patches.push_back(patch_of(name, nodes, formula_points(*formula, nodes, numbers_)));
    if (bezier) patches.push_back(patch_of(name, nodes, bezier_points(read_control(*bezier), nodes)));
    if (file) read_file(name, named_file(file->string(), file->where()), nodes, patches);
  }

 private:
  void read_file(const std::string& name, const std::string& path, const Counts& nodes,
                 std::vector<Atlas::Patch>& patches) const {
    std::size_t number = 0;
    const std::vector<std::array<Point, 16>> all = parse_bpt(read_text(path), path);
    require_room(nodes, all.size(), patches, {path});
    for (const std::array<Point, 16>& control : all)
      patches.push_back(patch_of(name + std::to_string(++number), nodes, bezier_points(control, nodes)));
  }

  std::int32_t refine_;
  Counts default_{33, 33};
  Numbers numbers_{{"pi", std::numbers::pi}};
};

/// The numbers of a text, with their lines.
class NumberScanner {
 public:
  NumberScanner(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  double next(const std::string& what) {
    while (!text_.empty() && (text_[0] == ' ' || text_[0] == '\t' || text_[0] == '\r' || text_[0] == '\n')) skip();
    double number = 0;
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), number);
    if (error != std::errc{} || !std::isfinite(number)) throw Error(Fault::input, "expected " + what, {file_, line_});
    text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
    return number;
  }
  void refuse_rest() {
    while (!text_.empty() && static_cast<unsigned char>(text_[0]) <= ' ') skip();
    if (!text_.empty()) throw Error(Fault::input, "more follows behind the last patch", {file_, line_});
  }

 private:
  void skip() {
    line_ += text_[0] == '\n';
    text_.remove_prefix(1);
  }
  std::string_view text_;
  const std::string& file_;
  int line_ = 1;
};

}  // namespace

std::vector<std::array<Point, 16>> parse_bpt(std::string_view text, const std::string& file) {
  NumberScanner scanner(text, file);
  const double count = scanner.next("the number of patches");
  constexpr double shortest_patch = 16 * 3 * 2;  // characters
  if (!(count >= 1 && count == std::floor(count) && count * shortest_patch <= static_cast<double>(text.size())))
    throw Error(Fault::input, "the number of patches is not one that the file can hold", {file, 1});
  std::vector<std::array<Point, 16>> patches(static_cast<std::size_t>(count));
  for (std::array<Point, 16>& control : patches) {
    for (int k = 0; k < 2; ++k)
      if (scanner.next("the degree of a patch") != 3)
        throw Error(Fault::input, "only bicubic patches, of degree 3 3, are known", {file});
    for (Point& p : control)
      for (double& x : p) x = scanner.next("a coordinate of a control point");
  }
  scanner.refuse_rest();
  return patches;
}

Point bezier_point(const std::array<Point, 16>& control, double u, double v) {
  const auto weights = [](double t) {
    const double s = 1 - t;
    return std::array{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
  };
  const auto a = weights(u), b = weights(v);
  Point p{};
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t d = 0; d < 3; ++d) p[d] += a[i] * b[j] * control[4 * j + i][d];
  return p;
}

Atlas parse_patches(std::string_view text, const std::string& file, std::int32_t refine) {
  const Value document = parse_document(text, file);
  document.string_or("name", "");
  document.string_or("summary", "");
  const PatchReader reader(document, refine);
  std::vector<Atlas::Patch> patches;
  for (const Value& table : document.at("patch").items()) reader.read(table, patches);
  document.require_all_read();
  try {
    return sew(std::move(patches));
  } catch (const Error& error) {
    if (error.fault() != Fault::input) throw;
    throw Error(Fault::input, error.what(), {file});
  }
}

}  // namespace pelage
