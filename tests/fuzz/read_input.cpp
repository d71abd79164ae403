#include "fuzz/read_input.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "catalog/models.h"
#include "catalog/plan.h"
#include "fuzz/read_arguments.h"
#include "gridgen/generate.h"
#include "gridgen/patches.h"
#include "io/grid_file.h"
#include "io/mtl_reader.h"
#include "io/tet_file.h"
#include "io/texture_reader.h"
#include "io/vtk_grid.h"
#include "io/vtu_writer.h"
#include "pelage/fair.h"
#include "pelage/grow.h"
#include "pelage/io.h"
#include "react/formula.h"
#include "react/kinetics.h"
#include "react/place_formula.h"
#include "react/stability.h"
#include "react/wavelength.h"
#include "recipe/document.h"
#include "run/checkpoint.h"
#include "shape/atlas.h"
#include "shape/cells.h"
#include "shape/describe.h"
#include "shape/grid.h"
#include "shape/sample_meshes.h"
#include "shape/tet_cut.h"

namespace pelage {

namespace {

void promise(bool kept, const std::string& what) {
  if (!kept) throw std::logic_error(what);
}

/// Runs a call whose faults are those of the input.
template <class Call>
bool accepted(Call&& call) {
  try {
    call();
    return true;
  } catch (const Error& error) {
    const std::string_view message = error.what();
    promise(!message.empty() && message.find('\n') == std::string_view::npos, "a message is one line");
    return false;
  }
}

// --- shapes ----------------------------------------------------------------------------------------------

/// Whatever was read can be written in every format, or is refused with a message; so is what was written. (Floats may
/// have lost the shape: what is 1e-300 wide is a point.)
void write_everywhere(const PolygonMesh& mesh) {
  for (const std::string& extension : mesh_extensions()) {
    losses(mesh, extension);
    std::string bytes;
    if (!accepted([&] { bytes = mesh_bytes(mesh, extension); })) continue;
    if (extension == ".ply" || extension == ".vtp") accepted([&] { read_shape_bytes(bytes, "again" + extension); });
  }
}

void use(const ShapeFile& file) {
  if (file.mesh.triangles.empty()) {
    accepted([&] { make_cells(std::make_shared<const TriangleMesh>(file.mesh), 50); });
    return;
  }
  const std::string violation = test::first_violation(file.mesh);
  promise(violation.empty(), violation);
  describe(file.mesh, file.findings);
  if (file.source) write_everywhere(as_in_file(*file.source, file.mesh));
  constexpr std::size_t few = 300;  // triangles: fairing takes long
  if (file.mesh.triangles.size() > few) return;
  accepted([&] { fair(file.mesh, {.steps = 1}); });
}

void read_as(const char* name, std::string_view bytes) {
  std::optional<ShapeFile> file;
  if (accepted([&] { file = read_shape_bytes(bytes, name); })) use(*file);
}

template <std::size_t N>
struct Name {
  constexpr Name(const char (&text)[N]) { std::copy_n(text, N, value); }  // NOLINT(google-explicit-constructor)
  char value[N];
};

template <Name name>
void read_shape_as(std::string_view bytes) {
  read_as(name.value, bytes);
}

// --- files beside others --------------------------------------------------------------------------------

class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("pelage-inputs-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string file(const char* name) const { return (path_ / name).string(); }
  std::string write(const char* name, std::string_view bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return file(name);
  }

 private:
  std::filesystem::path path_;
};

const Folder& folder() {
  static const Folder one;
  return one;
}

void read_materials(std::string_view bytes) {
  folder().write("input.mtl", bytes);
  std::map<std::string, MtlMaterial> materials;
  std::vector<Finding> findings;
  read_mtl(folder().file("shape.obj"), "input.mtl", materials, findings);
}

void read_image(std::string_view bytes) {
  const std::string path = folder().write("input.image", bytes);
  accepted([&] {
    check_texture(path);
    const Texture texture = read_texture(path);
    promise(texture.rgb->size() == std::size_t{3} * texture.width * texture.height, "pixels are counted");
  });
}

/// A grid goes through a file and comes back with its points.
void read_grid_as(const char* name, std::string_view bytes) {
  std::optional<GridFile> file;
  if (!accepted([&] { file = read_grid_bytes(bytes, name); })) return;
  constexpr std::size_t few = 1000000;  // nodes: of a grid without values there may be many more
  if (file->grid.nodes() > few) return;
  accepted([&] {
    const Grid again = read_grid_bytes(vts_bytes(file->grid), "again.vts").grid;
    promise(again.count == file->grid.count && again.point(0) == file->grid.point(0), "a grid comes back");
  });
}

/// A volume goes through a file and comes back, and can be cut.
template <Name name>
void read_volume_as(std::string_view bytes) {
  std::optional<TetFile> file;
  if (!accepted([&] { file = read_tet_bytes(bytes, name.value); })) return;
  const TetMesh& volume = file->volume;
  for (const Tetrahedron& t : volume.tets)
    for (const std::int32_t v : t) promise(v >= 0 && static_cast<std::size_t>(v) < volume.nodes(), "corners are nodes");
  for (const Attribute& a : volume.attributes)
    promise(a.values.size() == static_cast<std::size_t>(a.components) * volume.nodes(), "values are counted");
  const Cut cut = plane_cut(volume.points, {1, 0.5, 0.25}, volume.points[0][0]);
  carve(volume, {&cut, 1}).places(volume.points);
  accepted([&] {
    const TetMesh again = read_tet_bytes(vtu_bytes(volume), "again.vtu").volume;
    promise(again.tets == volume.tets && again.points == volume.points, "a volume comes back");
  });
}

void read_vtk(std::string_view bytes) { read_grid_as("input.vti", bytes); }

void read_sheet(std::string_view bytes) { read_grid_as("input.png", bytes); }

// --- texts ----------------------------------------------------------------------------------------------

void evaluate(const Model& model) {
  const std::vector<Point> place = {{0.1, -0.2, 0.3}, {1, 2, 3}, {-4, 5, 6}};
  const std::vector<double> zero(place.size(), 0.0);
  const Places places{.positions = place, .normals = place, .k1 = zero, .k2 = zero};
  const Kinetics kinetics(model, places, 1);
  const std::size_t n = model.species_count();
  std::vector<std::vector<double>> u(n, std::vector<double>(place.size())), rate = u;
  std::vector<const double*> in;
  std::vector<double*> out;
  for (std::size_t i = 0; i < n; ++i) {
    u[i] = initial_values(model, i, places, 1);
    in.push_back(u[i].data());
    out.push_back(rate[i].data());
  }
  in.resize(kinetics.input_count(), zero.data());  // products of gradients
  kinetics.rates(in, 0.5, 0, place.size(), out);
}

void read_model(std::string_view text) {
  accepted([&] {
    const Model model = compile(parse_model(text, "input.toml"));
    analyse(model);
    known_wavelength(model);
    evaluate(model);
  });
}

void read_recipe(std::string_view text) {
  accepted([&] { plan(parse_recipe(std::string(text), "input.toml")); });
}

void read_formula(std::string_view text) {
  accepted([&] {
    const std::vector<Point> place = {{0.1, -0.2, 0.3}, {1, 2, 3}, {-4, 5, 6}};
    const std::vector<double> zero(place.size(), 0.0), one(place.size(), 1.0);
    const PlaceFormula formula({std::string(text), {"input.toml", 1, 1}}, {"mark"}, {{"speed", 2.5}});
    formula.symbols();
    formula.at({.positions = place, .normals = place, .k1 = zero, .k2 = one}, 1);
  });
}

void read_command_line(std::string_view lines) {
  accepted([&] { read_arguments(lines); });
}

// --- regions and patches --------------------------------------------------------------------------------

/// A grid of few nodes: it is sound and has no folds, or the region is refused.
void read_region(std::string_view text) {
  accepted([&] {
    Region region = parse_region(text, folder().file("region.toml"));
    if (region.volume) region.volume->nodes = 4;
    const GeneratedGrid made = generate(region, {.nodes = std::array{7, 6}, .most_iterations = 30});
    require_sound(made.grid);
    promise(made.quality.folded == 0, "no cell is folded");
  });
}

/// Every node of a patch is one of the atlas, and triangles are between these.
void use(const Atlas& atlas) {
  for (const Atlas::Patch& patch : atlas.patches)
    for (const std::int32_t n : patch.node) promise(n >= 0 && n < atlas.nodes, "nodes are numbered");
  for (const Triangle& t : mesh_of(atlas).triangles)
    promise(t[0] != t[1] && t[1] != t[2] && t[2] != t[0], "triangles have three corners");
}

/// What a file of patches asks for may be large, as it may for a user; here it may not.
bool asks_for_little(const Value& document) {
  constexpr double few = 40;
  const auto little = [](const Value& table) {
    const Value* nodes = table.find("nodes");
    return !nodes || std::ranges::all_of(nodes->items(), [](const Value& n) { return n.number() <= few; });
  };
  return little(document) && std::ranges::all_of(document.at("patch").items(), little);
}

void read_patches(std::string_view text) {
  accepted([&] {
    if (asks_for_little(parse_document(text, "input.toml"))) use(parse_patches(text, folder().file("patches.toml"), 1));
  });
}

void read_bezier(std::string_view bytes) {
  folder().write("input.bpt", bytes);
  accepted([&] {
    use(parse_patches("nodes = [5, 4]\n[[patch]]\nfile = \"input.bpt\"\n", folder().file("patches.toml"), 1));
  });
}

// --- checkpoints ----------------------------------------------------------------------------------------

Growth small_growth() {
  Recipe recipe;
  recipe.stages[0].size = {{0.5}, {}};
  recipe.stages[0].steps = 2;
  return {load_shape("builtin:sphere?n=100"), recipe};
}

/// A checkpoint that fits, with changes: of every three bytes two are a place in it and the third is what stands there
/// then; one that is left over cuts the end off. So the inputs stay what they are when the format changes. The checksum
/// is made right again, since it would hide what lies behind it.
std::string damaged(std::string checkpoint, std::string_view changes) {
  checkpoint.resize(checkpoint.size() - seal_length);
  const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(changes[i])); };
  std::size_t i = 0;
  for (; i + 2 < changes.size(); i += 3) checkpoint[(256 * byte(i) + byte(i + 1)) % checkpoint.size()] = changes[i + 2];
  if (i + 1 == changes.size()) checkpoint.resize(checkpoint.size() * byte(i) / 256);
  return seal(std::move(checkpoint));
}

void read_checkpoint(std::string_view bytes) {
  static Growth growth = small_growth();
  static const std::string whole = growth.checkpoint();
  accepted([&] {
    growth.restore(damaged(whole, bytes));
    growth.advance(1);
  });
}

}  // namespace

const std::vector<InputReader>& input_readers() {
  static const std::vector<InputReader> all = {{"obj", read_shape_as<"input.obj">},
                                               {"ply", read_shape_as<"input.ply">},
                                               {"stl", read_shape_as<"input.stl">},
                                               {"off", read_shape_as<"input.off">},
                                               {"gltf", read_shape_as<"input.gltf">},
                                               {"glb", read_shape_as<"input.glb">},
                                               {"vtp", read_shape_as<"input.vtp">},
                                               {"mtl", read_materials},
                                               {"png", read_image},
                                               {"jpeg", read_image},
                                               {"sheet", read_sheet},
                                               {"vtk", read_vtk},
                                               {"vtu", read_volume_as<"input.vtu">},
                                               {"msh", read_volume_as<"input.msh">},
                                               {"model", read_model},
                                               {"recipe", read_recipe},
                                               {"formula", read_formula},
                                               {"arguments", read_command_line},
                                               {"region", read_region},
                                               {"patches", read_patches},
                                               {"bpt", read_bezier},
                                               {"checkpoint", read_checkpoint}};
  return all;
}

const InputReader& input_reader(std::string_view name) {
  std::string names;
  for (const InputReader& reader : input_readers()) {
    if (reader.name == name) return reader;
    names += std::string(" ") + reader.name;
  }
  throw std::invalid_argument("no reader \"" + std::string(name) + "\"; known are" + names);
}

}  // namespace pelage
