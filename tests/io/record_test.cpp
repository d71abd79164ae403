#include "io/record.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "io/atomic_file.h"
#include "io/exr_writer.h"
#include "io/file_bytes.h"
#include "io/gltf_compressor.h"
#include "io/ktx2_writer.h"
#include "io/line_files.h"
#include "io/output_set.h"
#include "io/record_in_file.h"
#include "io/sha256.h"
#include "io/vtk_grid.h"
#include "io/vtu_writer.h"
#include "io/written_meshes.h"
#include "pelage/error.h"
#include "pelage/io.h"
#include "shape/generators.h"
#include "shape/grid.h"
#include "support/expect_error.h"

namespace pelage {
namespace {

namespace fs = std::filesystem;

/// With all that a format could trip over.
Record awkward() {
  std::string long_text;
  for (int i = 0; i < 500; ++i) long_text += "# a \"line\" of <text> & more; end_header\n\t\\\\ \\  ";
  return {"0.1.0",
          "x86_64",
          {"grow", "a b.obj", "--set=s=-->]]>", "--output=*.glb", "\xc3\xa9t\xc3\xa9.ply"},
          {{"a b.obj", 5'000'000'000, sha256("")}},
          {{"seed", "7"}, {"end_header", "\n\r\n"}, {"blanks", std::string(900, ' ') + "\\"}},
          {{"mine.toml", long_text}}};
}

void expect_same(const Record& a, const Record& b) {
  EXPECT_EQ(record_text(a), record_text(b));
  EXPECT_EQ(a.words, b.words);
  ASSERT_EQ(a.inputs.size(), b.inputs.size());
  for (std::size_t i = 0; i < a.inputs.size(); ++i) EXPECT_EQ(a.inputs[i].bytes, b.inputs[i].bytes);
}

/// The vectors of FIPS 180-2, appendix B, and the empty text.
TEST(Record, Sha256) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(std::string(1'000'000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Record, ItsTextIsOneLineOfAsciiAndReadsBack) {
  const std::string text = record_text(awkward());
  for (const char c : text) ASSERT_TRUE(c >= ' ' && c < '\x7f') << static_cast<int>(c);
  expect_same(parse_record(text), awkward());
}

TEST(Record, WhatIsNoneIsRefused) {
  for (const std::string text : {"", "{", "[]", "7", "{\"program\": \"pelage\"}", "{\"program\": \"other\"}"})
    EXPECT_THROW(parse_record(text), Error) << text;
  const std::string sound = record_text(awkward());
  for (std::size_t n = 0; n < sound.size(); n += 97) EXPECT_THROW(parse_record(sound.substr(0, n)), Error);
}

TEST(Record, LinesOfCommentsAreShortAndEndInLetters) {
  std::string lines = comment_lines("# ", record_text(awkward())), joined;
  std::size_t blanks = 0;
  for (std::size_t at = 0; at < lines.size();) {
    const std::size_t end = lines.find('\n', at);
    const std::string line = lines.substr(at, end - at);
    EXPECT_LE(line.size(), 200U);
    blanks += line.ends_with(' ') || line.ends_with('\\') || line.starts_with("#  ");
    joined += line.substr(2);
    at = end + 1;
  }
  EXPECT_LE(blanks, 5U);  // only within the 900 blanks, which have no better place
  EXPECT_EQ(joined, record_text(awkward()));
  EXPECT_EQ(comment_lines("# ", ""), "");
}

Grid small_block() {
  Grid grid;
  grid.count = {3, 4, 2};
  grid.attributes = {{"a", 1, Domain::vertex, std::vector<double>(24, 0.5)}};
  return grid;
}

TetMesh small_volume() {
  TetMesh volume;
  volume.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  volume.tets = {{0, 1, 2, 3}};
  return volume;
}

/// A file of every kind that carries a record.
std::map<std::string, std::string> files() {
  const fs::path folder = test::fresh_folder();
  const TriangleMesh mesh = builtin_shape("builtin:sphere?n=162");
  std::map<std::string, std::string> bytes;
  for (const std::string extension : {".ply", ".obj", ".off", ".glb", ".vtp", ".3mf"})
    bytes[extension] = mesh_bytes(mesh, extension);
  bytes[".vti"] = vti_bytes(small_block());
  bytes[".vts"] = vts_bytes(small_block());
  bytes[".vtu"] = vtu_bytes(small_volume());
  bytes[".exr"] = exr_bytes({"Y"}, {{1, 2, 3, 4}}, 2, 2);
  const Pixels pixels{2, 2, 3, std::vector<std::uint8_t>(12, 99)}, one{1, 1, 3, {1, 2, 3}};
  bytes[".ktx2"] = ktx2_bytes({&pixels, &one});
  const auto written = [&](const std::string& name, auto&& write) {
    write((folder / name).string());
    publish_outputs();
    return read_raw_file((folder / name).string());
  };
  bytes[".png"] = written("a.png", [&](const std::string& path) { write_png(pixels, path); });
  LineDrawing drawing;
  drawing.low = {0, 0};
  drawing.high = {1, 1};
  drawing.parts = {{"lines", {}, {{{{0, 0}, {1, 1}}, false}}, {}}};
  for (const std::string extension : {".svg", ".dxf"})
    bytes[extension] = written("a" + extension, [&](const std::string& path) { write_lines(drawing, path); });
  return bytes;
}

TEST(Record, EveryFormatCarriesIt) {
  OutputSet set({.record = awkward()});
  for (const auto& [extension, bytes] : files()) {
    SCOPED_TRACE(extension);
    const std::string text = record_in_file(bytes, extension);
    ASSERT_FALSE(text.empty());
    expect_same(parse_record(text), awkward());
  }
  std::vector<std::string> known = record_extensions();
  std::erase(known, ".gltf");  // which others write
  EXPECT_EQ(files().size(), known.size());
}

TEST(Record, CompressedGlbCarriesIt) {
  OutputSet set({.record = awkward()});
  try {
    const std::string bytes = mesh_bytes(builtin_shape("builtin:sphere?n=162"), ".glb", {.compress = true});
    expect_same(parse_record(record_in_file(bytes, ".glb")), awkward());
  } catch (const Error& error) {
    GTEST_SKIP() << error.what();
  }
}

/// Files of others may hold anything: a nesting that is deeper than any stack, names in other places.
TEST(Record, HostileJson) {
  const std::string open(1'000'000, '['), close(1'000'000, ']');
  for (const std::string& text : {open, open + close, "{\"asset\":{\"extras\":{\"pelage\":" + open + close + "}}}",
                                  std::string("{\"asset\":7}"), std::string("[\"asset\"]")}) {
    EXPECT_THROW(parse_record(record_in_file(text, ".gltf")), Error);
    EXPECT_THROW(parse_record(text), Error);
  }
  Record nameless = awkward();
  nameless.inputs[0].name = "";
  EXPECT_THROW(parse_record(record_text(nameless)), Error);
}

/// What our own readers make of a file does not depend on it.
TEST(Record, ReadersPassItBy) {
  for (const std::string extension : {".ply", ".obj", ".off", ".glb", ".vtp"}) {
    SCOPED_TRACE(extension);
    const std::string bare = files()[extension];
    EXPECT_EQ(record_in_file(bare, extension), "");
    OutputSet set({.record = awkward()});
    const ShapeFile a = read_shape_bytes(bare, "a" + extension),
                    b = read_shape_bytes(files()[extension], "a" + extension);
    EXPECT_EQ(a.mesh.points, b.mesh.points);
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
    EXPECT_EQ(a.findings.size(), b.findings.size());
  }
}

/// Damaged files have another record, none, or one that is refused, and do no harm.
TEST(Record, DamagedFiles) {
  OutputSet set({.record = awkward()});
  for (auto& [extension, bytes] : files())
    for (std::size_t k = 0; k < 400; ++k) {
      std::string damaged = bytes.substr(0, k % 2 ? bytes.size() : k * bytes.size() / 400);
      for (std::size_t at = k; at < std::min<std::size_t>(damaged.size(), 600); at += 97)
        damaged[at] = static_cast<char>(damaged[at] ^ (1 << k % 8));
      try {
        parse_record(record_in_file(damaged, extension));
      } catch (const Error&) {
      }
    }
}

TEST(Record, InputsAreNamedFromTheFolderOnAndWordsWithThem) {
  const fs::path before = fs::current_path(), folder = fs::absolute(test::fresh_folder());
  fs::create_directory(folder / "home");
  const fs::path inside = folder / "home/image.png", outside = folder / "shape.obj";
  write_file(inside.string(), "abc");
  write_file(outside.string(), "shape");
  fs::current_path(folder / "home");
  OutputSet set({.record = Record{"1", "m", {"grow", outside.string(), "--texture=t=" + inside.string()}, {}, {}, {}}});
  fs::current_path(before);
  read_file(inside.string());
  read_file(outside.string());
  const Record record = set.record().value();
  ASSERT_EQ(record.inputs.size(), 2U);
  EXPECT_EQ(record.inputs[0].name, "image.png");
  EXPECT_EQ(record.inputs[0].sha256, sha256("abc"));
  EXPECT_EQ(record.inputs[1].name, "shape.obj");
  EXPECT_EQ(record.words, (std::vector<std::string>{"grow", "shape.obj", "--texture=t=image.png"}));
}

TEST(Record, AConfinedCommandReadsAndWritesNowhereElse) {
  const fs::path folder = test::fresh_folder();
  for (const char* name : {"in", "out", "else"}) fs::create_directory(folder / name);
  for (const char* name : {"in/a", "else/a"}) write_file((folder / name).string(), "x");
  fs::create_symlink(folder / "else/a", folder / "in/link");
  fs::create_directory_symlink(folder / "else", folder / "out/link");
  OutputSet set({.confinement = {(folder / "in").string(), (folder / "out").string()}});
  EXPECT_EQ(read_file((folder / "in/a").string()), "x");
  write_file((folder / "out/a").string(), "y");
  for (const char* name : {"else/a", "in/../else/a", "in/link", "out/a", "in"})
    EXPECT_THROW(read_file((folder / name).string()), Error) << name;
  for (const char* name : {"else/b", "out/../else/b", "out/link/b", "in/b"})
    EXPECT_THROW(write_file((folder / name).string(), "z"), Error) << name;
}

}  // namespace
}  // namespace pelage
