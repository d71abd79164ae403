#include "shape/builtin_grids.h"

#include <algorithm>
#include <charconv>

#include "base/suggest.h"
#include "pelage/error.h"
#include "shape/grid.h"

namespace pelage {

namespace {

constexpr std::string_view prefix = "builtin:";
constexpr double most_nodes = 1e8;  // some GB in the course of a run

struct Kind {
  const char* name;
  int dimension;
  std::int32_t nodes;  ///< along every axis
  bool periodic;
};
constexpr Kind kinds[] = {
    {"line", 1, 60, false}, {"tile", 2, 512, true}, {"sheet", 2, 512, false}, {"box", 3, 64, false}};

const Kind* kind_of(std::string_view spec) {
  if (!spec.starts_with(prefix)) return nullptr;
  const std::string_view name = spec.substr(prefix.size(), spec.find('?') - prefix.size());
  const auto kind = std::ranges::find(kinds, name, &Kind::name);
  return kind == std::end(kinds) ? nullptr : kind;
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts{""};
  for (const char c : text)
    if (c == at)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

void take_counts(const std::string& text, const Kind& kind, Grid& grid) {
  const auto counts = parse_counts(text, kind.dimension);
  if (!counts)
    throw Error(Fault::usage, "the nodes n=" + text + " of a built-in " + kind.name + " must be " +
                                  (kind.dimension == 1   ? "a whole number"
                                   : kind.dimension == 2 ? "one whole number or one per axis, like 512x256"
                                                         : "one whole number or one per axis, like 96x96x64"));
  grid.count = *counts;
}

void take_periodic(const std::string& text, const Kind& kind, Grid& grid) {
  const std::string axes = std::string("xyz").substr(0, static_cast<std::size_t>(kind.dimension));
  grid.periodic = {};
  if (text == "none") return;
  for (const char c : text) {
    const std::size_t axis = axes.find(c);
    if (axis == std::string::npos)
      throw Error(Fault::usage, "the periodic axes \"" + text + "\" of a built-in " + kind.name + " must be some of " +
                                    axes + ", or none");
    grid.periodic[axis] = true;
  }
}

void require_possible(const Grid& grid, const Kind& kind) {
  double nodes = 1;
  for (std::size_t d = 0; d < static_cast<std::size_t>(kind.dimension); ++d) {
    nodes *= grid.count[d];
    if (grid.count[d] < (grid.periodic[d] ? 3 : 2))
      throw Error(Fault::usage, "a built-in " + std::string(kind.name) + " needs at least " +
                                    (grid.periodic[d] ? "3 nodes along a periodic axis" : "2 nodes along every axis"));
  }
  if (nodes > most_nodes)
    throw Error(Fault::usage,
                "a built-in " + std::string(kind.name) + " of more than 100 million nodes needs too much memory");
}

Grid parse(const std::string& spec) {
  const Kind* kind = kind_of(spec);
  Grid grid;
  for (int d = 0; d < kind->dimension; ++d) {
    grid.count[static_cast<std::size_t>(d)] = kind->nodes;
    grid.periodic[static_cast<std::size_t>(d)] = kind->periodic;
  }
  const std::size_t question = spec.find('?');
  if (question != std::string::npos)
    for (const std::string& parameter : split(spec.substr(question + 1), '&')) {
      const std::size_t equals = parameter.find('=');
      const std::string name = parameter.substr(0, equals);
      const std::string value = equals == std::string::npos ? "" : parameter.substr(equals + 1);
      if (name == "n")
        take_counts(value, *kind, grid);
      else if (name == "periodic")
        take_periodic(value, *kind, grid);
      else
        throw Error(Fault::usage, unknown_name("parameter of a built-in grid", name, {"n", "periodic"}));
    }
  require_possible(grid, *kind);
  return grid;
}

}  // namespace

std::optional<std::array<std::int32_t, 3>> parse_counts(const std::string& text, int axes) {
  const std::vector<std::string> numbers = split(text, 'x');
  if (numbers.size() != 1 && numbers.size() != static_cast<std::size_t>(axes)) return {};
  std::array<std::int32_t, 3> counts{1, 1, 1};
  for (std::size_t d = 0; d < static_cast<std::size_t>(axes); ++d) {
    const std::string& number = numbers[numbers.size() == 1 ? 0 : d];
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), counts[d]);
    if (error != std::errc() || end != number.data() + number.size()) return {};
  }
  return counts;
}

std::vector<std::string> builtin_grid_names() {
  std::vector<std::string> names;
  for (const Kind& kind : kinds) names.emplace_back(kind.name);
  return names;
}

bool is_builtin_grid(std::string_view spec) { return kind_of(spec) != nullptr; }

void check_builtin_grid(const std::string& spec) { parse(spec); }

Grid builtin_grid(const std::string& spec) {
  Grid grid = parse(spec);
  grid.spacing.fill(1.0 / *std::ranges::max_element(grid.count));
  grid.metres_per_unit = 1;
  return grid;
}

}  // namespace pelage
