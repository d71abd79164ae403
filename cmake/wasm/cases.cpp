// Small runs, numbers and files, each as a line of text. Built natively and as WebAssembly; tests/wasm/compare.mjs
// holds the two against each other. Fields are printed with all digits.
//   cases        the cases
//   cases time   milliseconds of a step
#include <pelage/analyse.h>
#include <pelage/grow.h>
#include <pelage/io.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <limits>
#include <string>
#include <utility>

namespace {

std::string hash(const std::string& bytes) {
  std::uint64_t h = 14695981039346656037u;
  for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211u;
  char text[32];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(h));
  return text;
}

void print(const std::string& name, const std::vector<double>& values) {
  std::printf("values %s %zu", name.c_str(), values.size());
  for (const double x : values) std::printf(" %.17g", x);
  std::printf("\n");
}

void print(const std::string& name, const std::string& bytes) {
  std::printf("bytes %s %zu %s\n", name.c_str(), bytes.size(), hash(bytes).c_str());
}

void run(const char* name, const pelage::TriangleMesh& shape, const std::string& text, int steps) {
  pelage::Recipe recipe = pelage::parse_recipe(text, "recipe.toml");
  for (pelage::Stage& stage : recipe.stages) stage.steps = steps;
  pelage::Growth growth(shape, recipe);
  while (!growth.done()) growth.advance(50);
  for (const pelage::Growth::Field& field : growth.fields()) print(std::string(name) + ":" + field.name, field.values);
  const pelage::TriangleMesh coat = growth.dress();
  for (const pelage::Point& p : {coat.points.front(), coat.points.back()})
    print(std::string(name) + ":place", std::vector<double>{p[0], p[1], p[2]});
  for (const char* format : {".ply", ".obj", ".glb", ".stl"}) {
    const std::string bytes = pelage::mesh_bytes(coat, format);
    print(std::string(name) + format, bytes);
    if (format == std::string(".ply")) continue;  // which is read back below
    const pelage::ShapeFile back = pelage::read_shape_bytes(bytes, std::string("back") + format);
    std::printf("count %s%s %zu %zu\n", name, format, back.mesh.points.size(), back.mesh.triangles.size());
  }
  std::fflush(stdout);
}

/// Numbers as text and back: powers of two, whose neighbours below are nearer than those above, and any others.
void print_numbers() {
  std::string obj, written;
  std::uint64_t state = 1;
  for (int i = 0; i < 3000; ++i) {
    pelage::TriangleMesh mesh;
    const double power = std::ldexp(1.0, i / 13 - 120);
    state = state * 6364136223846793005u + 1442695040888963407u;
    const double any = static_cast<double>(state >> 11) * std::ldexp(1.0, static_cast<int>(state % 200) - 150);
    mesh.points = {{power, std::nextafter(power, 0.0), any},
                   {std::round(1000 * power) / 1000, static_cast<float>(any), -0.0},
                   {std::trunc(any), any / 3, 1 / power}};
    mesh.triangles = {{0, 1, 2}};
    written += pelage::mesh_bytes(mesh, ".obj");
  }
  print("numbers", written);
  for (const char* number : {"1e-300", "4.9e-324", "2.4703282292062327e-324", "0.1e400", "1e22", "9007199254740993",
                             "123456789012345678901234567890", "1.7976931348623157e308", "1e999", "-1e-999", "0x10",
                             "nan", "inf", "1e", ".5", "5.", "+1", "1_0"}) {
    try {
      print(std::string("number:") + number,
            std::vector<double>{pelage::parse_length(std::string(number) + "u", {}).value});
    } catch (const pelage::Error& error) {
      print(std::string("number:") + number, std::string(error.what()));
    }
  }
}

std::string stage(const std::string& rest) { return "[[stage]]\n" + rest + "\n[look]\ndetail = 0\n"; }

/// A shape without symmetries, by arithmetic alone. The built-in animal is another mesh where sines round otherwise:
/// what makes its triangles even decides by comparisons.
pelage::TriangleMesh bumps() {
  pelage::TriangleMesh mesh = pelage::load_shape("builtin:sphere?n=642");
  for (pelage::Point& p : mesh.points) {
    const double factor = 1 + 0.3 * p[0] * p[1] + 0.25 * p[2] * p[0] * p[0] - 0.2 * p[1] * p[2] * p[2];
    for (double& x : p) x *= factor;
  }
  return pelage::check_shape(std::move(mesh)).mesh;
}

void run_all() {
  print_numbers();
  const pelage::TriangleMesh sphere = pelage::load_shape("builtin:sphere?n=642");
  run("rkc2", sphere, stage("model = \"gray-scott:spots\"\nsize = 0.2"), 200);
  run("fixed", sphere, stage("model = \"gray-scott:spots\"\nsize = 0.2\nstep = 0.5"), 200);
  run("sbdf2", sphere, stage("model = \"schnakenberg\"\nstepper = \"sbdf2\"\nsize = 0.2"), 50);
  run("loop", pelage::load_shape("builtin:torus?n=600"), stage("model = \"turing\"\nmethod = \"loop\"\nsize = 0.25"),
      30);
  run("linear", pelage::load_shape("builtin:knot?n=800"),
      stage("model = \"brusselator\"\nmethod = \"linear\"\nsize = 0.2"), 50);
  run("cells", sphere, stage("model = \"turing\"\nmethod = \"cells\"\ncells = 600\nsize = 0.25"), 30);
  run("bumps", bumps(), stage("model = \"turing\"\nsize = 0.1"), 30);
  run("stripes", bumps(), stage("model = \"combed-stripes\"\nsize = 0.15"), 20);
}

void time_steps() {
  for (const double size : {0.085, 0.0425}) {
    char text[200];
    std::snprintf(text, sizeof text, "model = \"gray-scott:spots\"\nsize = %g\nstep = 1", size);
    pelage::Growth growth(pelage::load_shape("builtin:sphere?n=2562"),
                          pelage::parse_recipe(stage(text), "recipe.toml"));
    double best = std::numeric_limits<double>::infinity();  // of several, as other programs run beside it
    for (int batch = 0; batch < 20; ++batch) {
      constexpr int steps = 10;
      const auto begin = std::chrono::steady_clock::now();
      growth.advance(steps);
      const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begin;
      best = std::min(best, taken.count() / steps);
    }
    std::printf("%zu vertices: %.3f ms a step\n", growth.dress().points.size(), best);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc > 1 && std::string(argv[1]) == "time")
    time_steps();
  else
    run_all();
  return 0;
} catch (const pelage::Error& error) {
  std::cerr << "error: " << error.what() << "\n";
  return 1;
}
