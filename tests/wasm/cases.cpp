// Small runs, numbers and files, each as a line of text. Built natively and as WebAssembly; tests/wasm/compare.mjs holds
// the two against each other. Fields are printed with all digits.
//   cases        the cases
//   cases time   milliseconds of a step
#include <pelage/analyse.h>
#include <pelage/grow.h>
#include <pelage/io.h>

#include <chrono>
#include <cstdio>
#include <functional>
#include <iostream>
#include <string>

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

void run(const char* name, const char* shape, const std::string& text, int steps) {
  pelage::Recipe recipe = pelage::parse_recipe(text, "recipe.toml");
  for (pelage::Stage& stage : recipe.stages) stage.steps = steps;
  const pelage::ShapeFile file = pelage::read_shape(shape);
  pelage::Growth growth(file.mesh, recipe);
  while (!growth.done()) growth.advance(50);
  for (const pelage::Growth::Field& field : growth.fields())
    print(std::string(name) + ":" + field.name, field.values);
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

std::string stage(const std::string& rest) { return "[[stage]]\n" + rest + "\n[look]\ndetail = 0\n"; }

void run_all() {
  const char* sphere = "builtin:sphere?n=642";
  run("rkc2", sphere, stage("model = \"gray-scott:spots\"\nsize = 0.2"), 200);
  run("fixed", sphere, stage("model = \"gray-scott:spots\"\nsize = 0.2\nstep = 0.5"), 200);
  run("sbdf2", sphere, stage("model = \"schnakenberg\"\nstepper = \"sbdf2\"\nsize = 0.2"), 50);
  run("loop", "builtin:torus?n=600", stage("model = \"turing\"\nmethod = \"loop\"\nsize = 0.25"), 30);
  run("linear", "builtin:knot?n=800", stage("model = \"brusselator\"\nmethod = \"linear\"\nsize = 0.2"), 50);
  run("cells", sphere, stage("model = \"turing\"\nmethod = \"cells\"\ncells = 600\nsize = 0.25"), 30);
  run("animal", "builtin:animal?n=2000", stage("model = \"turing\"\nsize = 0.1"), 30);
  run("stripes", "builtin:animal?n=1500", stage("model = \"combed-stripes\"\nsize = 0.1"), 20);
}

void time_steps() {
  for (const double size : {0.085, 0.0425}) {
    char text[200];
    std::snprintf(text, sizeof text, "model = \"gray-scott:spots\"\nsize = %g\nstep = 1", size);
    pelage::Growth growth(pelage::load_shape("builtin:sphere?n=2562"), pelage::parse_recipe(stage(text), "recipe.toml"));
    growth.advance(20);
    constexpr int steps = 100;
    const auto begin = std::chrono::steady_clock::now();
    growth.advance(steps);
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begin;
    std::printf("%zu vertices: %.3f ms a step\n", growth.dress().points.size(), taken.count() / steps);
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
