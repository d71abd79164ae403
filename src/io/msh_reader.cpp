#include "io/msh_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include "base/checked.h"
#include "base/suggest.h"
#include "io/msh_scanner.h"
#include "io/text_scanner.h"
#include "pelage/error.h"

namespace pelage {

namespace {

/// A kind of elements of Gmsh.
struct MshElement {
  int type;
  const char* name;
  std::optional<CellShape> shape;  ///< of volumes
  std::size_t nodes;
};

constexpr auto tetrahedron = CellShape::tetrahedron, pyramid = CellShape::pyramid, wedge = CellShape::wedge,
               hexahedron = CellShape::hexahedron;

constexpr MshElement kinds[] = {
    {1, "line", {}, 2},
    {2, "triangle", {}, 3},
    {3, "quadrangle", {}, 4},
    {4, "tetrahedron", tetrahedron, 4},
    {5, "hexahedron", hexahedron, 8},
    {6, "prism", wedge, 6},
    {7, "pyramid", pyramid, 5},
    {8, "line of order 2", {}, 3},
    {9, "triangle of order 2", {}, 6},
    {10, "quadrangle of order 2", {}, 9},
    {11, "tetrahedron of order 2", tetrahedron, 10},
    {12, "hexahedron of order 2", hexahedron, 27},
    {13, "prism of order 2", wedge, 18},
    {14, "pyramid of order 2", pyramid, 14},
    {15, "point", {}, 1},
    {16, "quadrangle of 8 nodes", {}, 8},
    {17, "hexahedron of 20 nodes", hexahedron, 20},
    {18, "prism of 15 nodes", wedge, 15},
    {19, "pyramid of 13 nodes", pyramid, 13},
    {20, "triangle of 9 nodes", {}, 9},
    {21, "triangle of order 3", {}, 10},
    {22, "triangle of 12 nodes", {}, 12},
    {23, "triangle of order 4", {}, 15},
    {24, "triangle of 15 nodes", {}, 15},
    {25, "triangle of order 5", {}, 21},
    {26, "line of order 3", {}, 4},
    {27, "line of order 4", {}, 5},
    {28, "line of order 5", {}, 6},
    {29, "tetrahedron of order 3", tetrahedron, 20},
    {30, "tetrahedron of order 4", tetrahedron, 35},
    {31, "tetrahedron of order 5", tetrahedron, 56},
    {36, "quadrangle of order 3", {}, 16},
    {37, "quadrangle of order 4", {}, 25},
    {38, "quadrangle of order 5", {}, 36},
    {90, "prism of order 3", wedge, 40},
    {91, "prism of order 4", wedge, 75},
    {92, "hexahedron of order 3", hexahedron, 64},
    {93, "hexahedron of order 4", hexahedron, 125},
    {118, "pyramid of order 3", pyramid, 30},
    {119, "pyramid of order 4", pyramid, 55},
};

/// "2 prisms of order 2".
std::string counted_kind(std::size_t n, const MshElement& kind) {
  const std::string name = kind.name;
  const std::size_t noun = std::min(name.find(" of "), name.size());
  return counted(n, name.substr(0, noun)) + name.substr(noun);
}

constexpr int volume = 3;  // dimension

class MshReader {
 public:
  MshReader(std::string_view bytes, const std::string& path, std::vector<Finding>& findings)
      : text_(bytes, path), findings_(findings) {}

  SolidCells read() {
    read_format();
    while (!text_.at_end()) read_section();
    if (!have_nodes_) text_.fail("the file has no section $Nodes");
    note_elements();
    add_groups();
    for (auto& [name, view] : node_views_)
      add_view(name, view, "node", Domain::vertex, result_.at_nodes, result_.points.size());
    for (auto& [name, view] : cell_views_)
      add_view(name, view, "cell", Domain::face, result_.in_cells, result_.cells.size());
    return std::move(result_);
  }

 private:
  using Numbers = std::unordered_map<std::uint64_t, std::size_t>;  ///< of tags

  void note(const std::string& kind, const std::string& text, std::size_t count = 1) {
    findings_.push_back({kind, text, count, 0, false});
  }

  // --- sections ---

  void read_format() {
    if (text_.at_end() || text_.line() != "$MeshFormat")
      text_.fail("a file of Gmsh begins with $MeshFormat; this one does not");
    version_ = text_.text_real("the version of the format");
    const std::int64_t binary = text_.text_integer("0 for text or 1 for bytes"), size = text_.text_integer("a size");
    new_ = version_ == 4.1;
    if (!new_ && !(version_ >= 2 && version_ < 3))
      text_.fail("is of version " + std::to_string(version_).substr(0, 3) +
                 " of the format; known are 2.2 and 4.1 (gmsh -save -format msh41 writes such)");
    text_.line();
    if (binary != 0) read_order(size);
    end_section("MeshFormat");
  }

  void read_order(std::int64_t size) {
    if (size != 8) text_.fail("numbers of " + std::to_string(size) + " bytes are not known; 8 are");
    text_.set_binary(false);
    if (text_.integer("the number 1") == 1) return;
    text_.set_binary(true);  // as on machines that begin with the highest byte, 1 is 2^24
  }

  void end_section(const std::string& name) {
    if (text_.at_end() || text_.line() != "$End" + name)
      text_.fail("the section $" + name +
                 " does not end where it should: a count in it is wrong, or the file is damaged");
  }

  void read_section() {
    const std::string_view line = text_.line();
    if (!line.starts_with('$')) text_.fail("expected a section that begins with $, found " + in_quotes(line));
    const std::string name(line.substr(1));
    if (name == "PhysicalNames")
      read_names();
    else if (name == "Entities" && new_)
      read_entities();
    else if (name == "Nodes")
      new_ ? read_node_blocks() : read_nodes();
    else if (name == "Elements")
      new_ ? read_element_blocks() : read_elements();
    else if (name == "NodeData")
      read_view(node_views_, node_number_);
    else if (name == "ElementData")
      read_view(cell_views_, cell_number_);
    else
      return skip_section(name);
    end_section(name);
  }

  void skip_section(const std::string& name) {
    if (!text_.skip_behind("$End" + name)) text_.fail("the section $" + name.substr(0, 40) + " has no end");
    if (name != "Comments") note("left-out", "the section $" + name.substr(0, 40) + " is left out");
  }

  void read_names() {
    const std::int64_t count = text_.text_integer("a number of names");
    for (std::int64_t i = 0; i < count; ++i) {
      const std::int64_t dimension = text_.text_integer("a dimension"), tag = text_.text_integer("a group");
      std::string_view name = text_.line();
      if (name.starts_with('"')) name.remove_prefix(1);
      if (name.ends_with('"')) name.remove_suffix(1);
      if (dimension == volume)
        names_[tag] = name;
      else
        other_names_.emplace_back(name);
    }
    if (!other_names_.empty())
      note("left-out", "the groups " + join_names(other_names_) + " are of surfaces, lines or points; left out",
           other_names_.size());
  }

  /// Only the groups of the volumes matter.
  void read_entities() {
    std::array<std::size_t, 4> count{};
    for (std::size_t& n : count) n = text_.room(text_.size("a number of entities"), 36, 4, "entities");
    for (std::size_t dimension = 0; dimension < 4; ++dimension)
      for (std::size_t i = 0; i < count[dimension]; ++i) {
        const std::int32_t tag = text_.integer("the number of an entity");
        for (std::size_t k = 0; k < (dimension == 0 ? 3U : 6U); ++k) text_.real("a place");
        const std::size_t groups = text_.room(text_.size("a number of groups"), 4, 1, "groups");
        for (std::size_t k = 0; k < groups; ++k) {
          const std::int32_t group = text_.integer("a group");
          if (dimension != volume) continue;
          if (k == 0) group_of_entity_[tag] = group;
          if (k == 1) note("left-out", "volume " + std::to_string(tag) + " is in several groups; the first is taken");
        }
        if (dimension == 0) continue;
        const std::size_t borders = text_.room(text_.size("a number of borders"), 4, 1, "borders");
        for (std::size_t k = 0; k < borders; ++k) text_.integer("a border");
      }
  }

  // --- nodes ---

  void add_node(std::uint64_t tag) {
    if (!node_number_.try_emplace(tag, result_.points.size()).second)
      text_.fail("node " + std::to_string(tag) + " is there twice");
    Point p;
    for (double& x : p) x = text_.real("a coordinate");
    result_.points.push_back(p);
  }

  void begin_nodes() {
    if (have_nodes_) text_.fail("a second section $Nodes");
    have_nodes_ = true;
  }

  void read_nodes() {
    begin_nodes();
    const std::size_t count = text_.room(counted_line("a number of nodes"), 28, 4, "nodes");
    result_.points.reserve(count);
    for (std::size_t i = 0; i < count; ++i) add_node(tag_of(text_.integer("the number of a node")));
    checked_count<std::int32_t>(count, "nodes");
  }

  std::uint64_t tag_of(std::int32_t number) const {
    if (number < 0) text_.fail("a number of a node or an element is below 0: " + std::to_string(number));
    return static_cast<std::uint64_t>(number);
  }

  /// The same where data begin on the next line.
  std::uint64_t counted_line(const char* what) {
    const std::uint64_t count = counted(what);
    if (text_.binary()) text_.line();
    return count;
  }

  void read_node_blocks() {
    begin_nodes();
    const std::uint64_t blocks = text_.size("a number of blocks"), count = text_.size("a number of nodes");
    for (int i = 0; i < 2; ++i) text_.size("a number of a node");
    text_.room(count, 32, 4, "nodes");
    bool parametric = false;
    for (std::uint64_t b = 0; b < blocks; ++b) parametric |= read_node_block();
    if (result_.points.size() != count)
      text_.fail("there are " + std::to_string(result_.points.size()) + " nodes where " + std::to_string(count) +
                 " are said to be");
    checked_count<std::int32_t>(count, "nodes");
    if (parametric) note("left-out", "the parametric coordinates of nodes are left out");
  }

  bool read_node_block() {
    const std::int32_t dimension = text_.integer("a dimension");
    text_.integer("the number of an entity");
    const bool parametric = text_.integer("0 or 1") != 0;
    if (dimension < 0 || dimension > volume)
      text_.fail("the dimension " + std::to_string(dimension) + " is not 0 to 3");
    const std::size_t count = text_.room(text_.size("a number of nodes"), 32, 4, "nodes");
    std::vector<std::uint64_t> tags(count);
    for (std::uint64_t& tag : tags) tag = text_.size("the number of a node");
    for (const std::uint64_t tag : tags) {
      add_node(tag);
      for (std::int32_t k = 0; parametric && k < dimension; ++k) text_.real("a coordinate");
    }
    return parametric && count > 0;
  }

  // --- elements ---

  const MshElement& kind_of(std::int32_t type) const {
    const auto* found = std::ranges::find(kinds, type, &MshElement::type);
    if (found == std::end(kinds))
      text_.fail("an element of the kind " + std::to_string(type) +
                 ", which is not known here; save the mesh with order 1");
    return *found;
  }

  void begin_elements() const {
    if (!have_nodes_) text_.fail("the section $Elements stands before $Nodes");
  }

  template <class NextTag>
  void add_element(const MshElement& kind, std::uint64_t tag, std::int64_t group, std::int64_t entity, NextTag&& next) {
    ++seen_[&kind];
    if (!kind.shape) {
      for (std::size_t k = 0; k < kind.nodes; ++k) next();
      return;
    }
    SolidCell cell{*kind.shape, {}};
    for (std::size_t k = 0; k < kind.nodes; ++k) {
      const std::uint64_t node = next();
      const auto found = node_number_.find(node);
      if (found == node_number_.end())
        text_.fail("element " + std::to_string(tag) + " has the node " + std::to_string(node) + ", which is not there");
      if (k < static_cast<std::size_t>(*kind.shape)) cell.corner[k] = static_cast<std::int32_t>(found->second);
    }
    if (!cell_number_.try_emplace(tag, result_.cells.size()).second)
      text_.fail("element " + std::to_string(tag) + " is there twice");
    result_.cells.push_back(cell);
    groups_.push_back(std::abs(group));
    entities_.insert(entity);
  }

  void read_elements() {
    begin_elements();
    const std::size_t count = text_.room(counted_line("a number of elements"), 8, 4, "elements");
    for (std::size_t i = 0; i < count;) i += text_.binary() ? read_element_run(count - i) : read_element();
  }

  std::size_t read_element() {
    const std::uint64_t tag = tag_of(text_.integer("the number of an element"));
    const MshElement& kind = kind_of(text_.integer("a kind of elements"));
    read_element_body(kind, tag, tag_count());
    return 1;
  }

  /// Elements of one kind, so many in a row.
  std::size_t read_element_run(std::size_t most) {
    const MshElement& kind = kind_of(text_.integer("a kind of elements"));
    const std::int32_t count = text_.integer("a number of elements");
    if (count < 1 || static_cast<std::size_t>(count) > most)
      text_.fail("a row of " + std::to_string(count) + " elements");
    const std::size_t tags = tag_count();
    for (std::int32_t i = 0; i < count; ++i)
      read_element_body(kind, tag_of(text_.integer("the number of an element")), tags);
    return static_cast<std::size_t>(count);
  }

  std::size_t tag_count() {
    const std::int32_t count = text_.integer("a number of tags");
    if (count < 0) text_.fail("a number of tags below 0");
    return text_.room(static_cast<std::uint64_t>(count), 4, 1, "tags");
  }

  void read_element_body(const MshElement& kind, std::uint64_t tag, std::size_t tags) {
    std::int32_t group = 0, entity = 0;
    for (std::size_t k = 0; k < tags; ++k) {
      const std::int32_t value = text_.integer("a tag");
      if (k == 0) group = value;
      if (k == 1) entity = value;
    }
    partitions_ |= tags > 2;
    add_element(kind, tag, group, entity, [&] { return tag_of(text_.integer("a node")); });
  }

  void read_element_blocks() {
    begin_elements();
    const std::uint64_t blocks = text_.size("a number of blocks"), count = text_.size("a number of elements");
    for (int i = 0; i < 2; ++i) text_.size("a number of an element");
    std::uint64_t read = 0;
    for (std::uint64_t b = 0; b < blocks; ++b) read += read_element_block();
    if (read != count)
      text_.fail("there are " + std::to_string(read) + " elements where " + std::to_string(count) + " are said to be");
  }

  std::uint64_t read_element_block() {
    const std::int32_t dimension = text_.integer("a dimension"), entity = text_.integer("the number of an entity");
    const MshElement& kind = kind_of(text_.integer("a kind of elements"));
    const std::uint64_t count = text_.size("a number of elements");
    const auto found = group_of_entity_.find(entity);
    const std::int64_t group = dimension == volume && found != group_of_entity_.end() ? found->second : 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t tag = text_.size("the number of an element");
      add_element(kind, tag, group, entity, [&] { return text_.size("a node"); });
    }
    return count;
  }

  void note_elements() {
    for (const MshElement& kind : kinds) {
      const auto seen = seen_.find(&kind);
      if (seen == seen_.end()) continue;
      const std::size_t n = seen->second;
      if (!kind.shape)
        note("left-out", counted_kind(n, kind) + " beside the cells of the volume; left out", n);
      else if (kind.nodes > static_cast<std::size_t>(*kind.shape))
        note("higher-order", "of " + counted_kind(n, kind) + " the corners are taken", n);
    }
    if (partitions_) note("left-out", "the partitions of elements are left out");
  }

  void add_groups() {
    const std::set<std::int64_t> used(groups_.begin(), groups_.end());
    if (used.empty() || *used.rbegin() == 0) {
      if (entities_.size() > 1)
        note("left-out", "the volumes of the geometry are left out; make them physical groups to keep them",
             entities_.size());
      return;
    }
    Attribute a{"group", 1, Domain::face, {}, NumberType::int32};
    std::map<std::int64_t, double> number;
    for (const std::int64_t group : used) {
      number[group] = static_cast<double>(number.size());
      const auto name = names_.find(group);
      a.labels.push_back(name != names_.end() ? name->second : group == 0 ? "none" : std::to_string(group));
    }
    for (const std::int64_t group : groups_) a.values.push_back(number[group]);
    result_.in_cells.push_back(std::move(a));
  }

  // --- views ---

  struct View {
    std::size_t components = 1;
    std::vector<double> values;  ///< of all nodes or cells
    std::vector<char> known;
    std::size_t steps = 0;
  };
  using Views = std::map<std::string, View>;

  void read_view(Views& views, const Numbers& number) {
    std::vector<std::string> names(text_.room(counted("a number of names"), 1, 1, "names"));
    text_.line();
    for (std::string& name : names) name = text_.line();
    for (std::uint64_t n = counted("a number of times"); n > 0; --n) text_.text_real("a time");
    std::vector<std::int64_t> tags(text_.room(counted("a number of tags"), 1, 1, "tags"));
    for (std::int64_t& tag : tags) tag = text_.text_integer("a tag");
    constexpr std::int64_t most = 9;  // of a tensor
    if (names.empty() || tags.size() < 3) text_.fail("a view lacks its name, or the number of its values");
    if (tags[1] < 1 || tags[1] > most || tags[2] < 0) text_.fail("a view of no known number of values");
    text_.line();
    std::erase(names[0], '"');
    View& view = views[names[0].empty() ? "view" : names[0]];
    const auto components = static_cast<std::size_t>(tags[1]);
    view = {components, std::vector<double>(components * number.size()), std::vector<char>(number.size()),
            view.steps + 1};
    read_values(view, static_cast<std::uint64_t>(tags[2]), number);
  }

  /// A count in a line of text.
  std::uint64_t counted(const char* what) {
    const std::int64_t count = text_.text_integer(what);
    if (count < 0) text_.fail(std::string(what) + " is below 0");
    return static_cast<std::uint64_t>(count);
  }

  void read_values(View& view, std::uint64_t count, const Numbers& number) {
    text_.room(count, 4 + 8 * view.components, 1 + view.components, "values");
    std::vector<double> values(view.components);
    for (std::uint64_t i = 0; i < count; ++i) {
      const auto found = number.find(tag_of(text_.integer("the number of a node or an element")));
      for (double& x : values) x = text_.real("a value");
      if (found == number.end()) continue;  // of an element that is left out
      view.known[found->second] = 1;
      std::ranges::copy(values, view.values.begin() + static_cast<std::ptrdiff_t>(view.components * found->second));
    }
  }

  /// `kind`: of what the values are.
  void add_view(const std::string& name, View& view, const std::string& kind, Domain domain,
                std::vector<Attribute>& attributes, std::size_t elements) {
    if (view.known.size() != elements)
      text_.fail("the view \"" + name + "\" stands before the " + kind + "s that it is of");
    if (view.steps > 1)
      note("left-out",
           "of the " + std::to_string(view.steps) + " steps of the view \"" + name + "\" the last is taken");
    if (const auto missing = static_cast<std::size_t>(std::ranges::count(view.known, 0)); missing > 0)
      note("values-missing",
           "the view \"" + name + "\" says nothing about " + pelage::counted(missing, kind) + ": 0 there", missing);
    if (std::ranges::count(attributes, name, &Attribute::name) > 0)
      return note("left-out", "the view \"" + name + "\" is called like the groups; left out");
    attributes.push_back(
        {name, static_cast<int>(view.components), domain, std::move(view.values), NumberType::float64});
  }

  MshScanner text_;
  std::vector<Finding>& findings_;
  double version_ = 0;
  bool new_ = false;  ///< version 4.1
  bool have_nodes_ = false, partitions_ = false;
  SolidCells result_;
  Numbers node_number_, cell_number_;
  std::map<std::int64_t, std::string> names_;  ///< of groups of volumes
  std::vector<std::string> other_names_;
  std::map<std::int32_t, std::int64_t> group_of_entity_;
  std::vector<std::int64_t> groups_;  ///< of the cells; 0: none
  std::set<std::int64_t> entities_;   ///< of the cells
  std::map<const MshElement*, std::size_t> seen_;
  Views node_views_, cell_views_;
};

}  // namespace

SolidCells read_msh(std::string_view bytes, const std::string& path, std::vector<Finding>& findings) {
  return MshReader(bytes, path, findings).read();
}

}  // namespace pelage
