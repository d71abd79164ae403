#include "io/msh_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <variant>

#include "io/tet_file.h"
#include "pelage/error.h"
#include "shape/sample_volumes.h"

namespace pelage {
namespace {

/// Numbers of a section, in the forms that the four kinds of files have.
class MshText {
 public:
  MshText(bool binary, bool swapped = false) : binary_(binary), swapped_(swapped) {}
  MshText& line(const std::string& text) {
    if (!binary_ && !text_.empty() && text_.back() != '\n') text_ += "\n";
    if (binary_ && text.starts_with("$") && !text_.empty() && text_.back() != '\n') text_ += "\n";
    text_ += text + "\n";
    return *this;
  }
  template <class T>
  MshText& data(std::initializer_list<T> values) {
    for (const T value : values) {
      if (!binary_) {
        text_ += std::to_string(value) + " ";
        continue;
      }
      std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
      if (swapped_) std::ranges::reverse(raw);
      text_ += raw;
    }
    return *this;
  }
  MshText& i(std::initializer_list<std::int32_t> values) { return data(values); }
  MshText& n(std::initializer_list<std::uint64_t> values) { return data(values); }
  MshText& x(std::initializer_list<double> values) { return data(values); }
  bool binary() const { return binary_; }
  const std::string& text() const { return text_; }

 private:
  bool binary_, swapped_;
  std::string text_;
};

void begin(MshText& f, const std::string& version) {
  f.line("$MeshFormat").line(version + (f.binary() ? " 1 8" : " 0 8"));
  if (f.binary()) f.i({1});
  f.line("$EndMeshFormat");
  f.line("$PhysicalNames")
      .line("3")
      .line("2 3 \"skin of it\"")
      .line("3 5 \"Fur # 1\"")
      .line("3 2 \"Nose\"")
      .line("$EndPhysicalNames");
}

void end(MshText& f) {
  f.line("$NodeData").line("1").line("\"heat\"").line("1").line("0.5").line("3").line("0").line("1").line("6");
  for (const int v : {10, 20, 30, 40, 50, 60}) f.i({v}).x({v / 8.0});
  f.line("$EndNodeData");
  f.line("$ElementData").line("1").line("\"flow\"").line("1").line("0").line("3").line("0").line("3").line("2");
  f.i({102}).x({1, 2, 3}).i({101}).x({1, 1, 1});  // of a triangle, too
  f.line("$EndElementData");
}

constexpr double places[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {0, 0, -1}};

/// Three tetrahedra with a triangle and a point, two groups.
std::string old_file(bool binary, bool swapped = false) {
  MshText f(binary, swapped);
  begin(f, "2.2");
  f.line("$Nodes").line("6");
  for (std::size_t v = 0; v < 6; ++v) {
    f.i({static_cast<int>(10 * v + 10)}).x({places[v][0], places[v][1], places[v][2]});
    if (!binary) f.line("");
  }
  f.line("$EndNodes").line("$Elements").line("5");
  if (binary) {
    f.i({2, 1, 2, 101, 3, 1, 10, 20, 30});
    f.i({4, 3, 2, 102, 5, 1, 10, 20, 30, 40, 103, 5, 1, 20, 50, 30, 40, 104, 2, 2, 10, 30, 20, 60});
    f.i({15, 1, 2, 105, 0, 1, 10});
  } else {
    f.line("101 2 2 3 1 10 20 30").line("102 4 2 5 1 10 20 30 40").line("103 4 2 5 1 20 50 30 40");
    f.line("104 4 2 2 2 10 30 20 60").line("105 15 2 0 1 10");
  }
  f.line("$EndElements");
  end(f);
  return f.text();
}

std::string new_file(bool binary) {
  MshText f(binary);
  begin(f, "4.1");
  f.line("$Entities").n({1, 1, 1, 2});
  f.i({1}).x({0, 0, 0}).n({0});
  f.i({1}).x({0, 0, 0, 1, 0, 0}).n({0}).n({2}).i({1, -1});
  f.i({1}).x({0, 0, 0, 1, 1, 0}).n({1}).i({3}).n({1}).i({1});
  f.i({1}).x({0, 0, 0, 1, 1, 1}).n({1}).i({5}).n({1}).i({1});
  f.i({2}).x({0, 0, -1, 1, 1, 0}).n({1}).i({2}).n({0});
  f.line("$EndEntities").line("$Nodes").n({2, 6, 10, 60});
  f.i({2, 1, 1}).n({3, 10, 20, 30});
  for (std::size_t v = 0; v < 3; ++v) f.x({places[v][0], places[v][1], places[v][2], 0.25, 0.75});
  f.i({3, 1, 0}).n({3, 40, 50, 60});
  for (std::size_t v = 3; v < 6; ++v) f.x({places[v][0], places[v][1], places[v][2]});
  f.line("$EndNodes").line("$Elements").n({4, 5, 101, 105});
  f.i({2, 1, 2}).n({1}).n({101, 10, 20, 30});
  f.i({3, 1, 4}).n({2}).n({102, 10, 20, 30, 40, 103, 20, 50, 30, 40});
  f.i({3, 2, 4}).n({1}).n({104, 10, 30, 20, 60});
  f.i({0, 1, 15}).n({1}).n({105, 10});
  f.line("$EndElements");
  end(f);
  return f.text();
}

std::vector<std::string> kinds_of(const TetFile& file) {
  std::vector<std::string> kinds;
  for (const Finding& f : file.findings) kinds.push_back(f.kind);
  return kinds;
}

class Msh : public testing::TestWithParam<std::string> {
 protected:
  std::string bytes() const {
    if (GetParam() == "OldText") return old_file(false);
    if (GetParam() == "OldBinary") return old_file(true);
    if (GetParam() == "OldBigEndian") return old_file(true, true);
    return new_file(GetParam() == "NewBinary");
  }
};
INSTANTIATE_TEST_SUITE_P(All, Msh, testing::Values("OldText", "OldBinary", "OldBigEndian", "NewText", "NewBinary"),
                         [](const auto& test) { return test.param; });

TEST_P(Msh, HasWhatGmshWrote) {
  const TetFile file = read_tet_bytes(bytes(), "a.msh");
  const TetMesh& volume = file.volume;
  ASSERT_EQ(volume.nodes(), 6U);
  for (std::size_t v = 0; v < 6; ++v)
    for (std::size_t d = 0; d < 3; ++d) EXPECT_EQ(volume.points[v][d], places[v][d]);
  EXPECT_EQ(volume.tets, (std::vector<Tetrahedron>{{0, 1, 2, 3}, {1, 4, 2, 3}, {0, 2, 1, 5}}));
  EXPECT_EQ(volume.find("group")->labels, (std::vector<std::string>{"Nose", "Fur # 1"}));
  EXPECT_EQ(volume.find("group")->values,
            (std::vector<double>{0, 1, 1, 1, 1, 0}));  // the first two: ties, the lower one
  EXPECT_EQ(volume.find("heat")->values, (std::vector<double>{1.25, 2.5, 3.75, 5, 6.25, 7.5}));
  EXPECT_EQ(volume.find("flow")->components, 3);
  EXPECT_EQ(volume.find("flow")->values[2], 1.5);  // of two cells of 1/6 with 3 and 0
  std::vector<std::string> wanted = {"left-out", "left-out", "left-out", "values-missing", "cell-data", "cell-data"};
  if (GetParam().starts_with("New")) wanted.insert(wanted.begin(), "left-out");  // parametric coordinates
  EXPECT_EQ(kinds_of(file), wanted);
}

TEST_P(Msh, WhatIsCutShortIsRefused) {
  const std::string whole = bytes();
  const std::size_t elements = whole.find("$EndElements");
  for (std::size_t n = 0; n < elements; ++n) EXPECT_THROW(read_tet_bytes(whole.substr(0, n), "a.msh"), Error) << n;
}

/// Any byte may be another one: the file is read or refused, and nothing else.
TEST_P(Msh, DamageIsReadOrRefused) {
  const std::string whole = bytes();
  for (std::size_t n = 0; n < whole.size(); ++n)
    for (const char other : {'\0', '\xff', '9', '-', ' '}) {
      std::string text = whole;
      text[n] = other;
      try {
        read_tet_bytes(text, "a.msh");
      } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::input);
      }
    }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

void expect_fault(const std::string& text, const std::string& words) {
  try {
    read_tet_bytes(text, "a.msh");
    FAIL() << "no fault: " << words;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(MshReader, FaultsSayTheirPlace) {
  const std::string text = old_file(false);
  expect_fault("(0 \"Fluent\")", "a.msh:1: a file of Gmsh begins with $MeshFormat");
  expect_fault(replaced(text, "2.2 0", "4.0 0"), "a.msh:2: is of version 4.0");
  expect_fault(replaced(text, "102 4 2 5 1 10 20 30 40", "102 4 2 5 1 10 20 30 41"),
               "a.msh:28: element 102 has the node 41, which is not there");
  expect_fault(replaced(text, "102 4 2", "102 99 2"), "a.msh:28: an element of the kind 99");
  expect_fault(replaced(text, "103 4", "102 4"), "a.msh:29: element 102 is there twice");
  expect_fault(replaced(text, "$Elements\n5", "$Elements\n4"),
               "a.msh:31: the section $Elements does not end where it should");
  expect_fault(replaced(text, "$Nodes\n6", "$Nodes\n60000"), "a.msh:11: there are said to be 60000 nodes");
  expect_fault(replaced(text, "$EndElements", "$EndElement"), "a.msh:32: the section $Elements does not end");
  expect_fault(replaced(text, "$Elements", "$Stuff"), "a.msh:25: the section $Stuff has no end");
  expect_fault(replaced(text, "102 4 2 5 1 10 20 30 40", "102 4 2 5 1 10 20 30 x"),
               "a.msh:28: expected a node, found \"x\"");
  const std::string bytes = old_file(true);
  const std::size_t first = bytes.find("$Elements\n5\n") + 12;
  std::string damaged = bytes;
  damaged[first] = 99;
  expect_fault(damaged, "an element of the kind 99, which is not known here; save the mesh with order 1 (at byte " +
                            std::to_string(first + 4) + ")");
}

TEST(MshReader, TakesTheCornersOfHigherOrders) {
  const std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 .5 0 0\n6 .5 .5 0\n"
      "7 0 .5 0\n8 0 0 .5\n9 0 .5 .5\n10 .5 0 .5\n$EndNodes\n$Elements\n1\n1 11 2 0 1 1 2 3 4 5 6 7 8 9 "
      "10\n$EndElements\n";
  const TetFile file = read_tet_bytes(text, "a.msh");
  EXPECT_EQ(file.volume.nodes(), 4U);
  EXPECT_NEAR(test::volume(file.volume), 1.0 / 6, 1e-15);
  EXPECT_EQ(kinds_of(file), (std::vector<std::string>{"higher-order", "unused-nodes"}));
  EXPECT_EQ(file.findings[0].text, "of 1 tetrahedron of order 2 the corners are taken");
  EXPECT_EQ(file.volume.find("group"), nullptr);
}

}  // namespace
}  // namespace pelage
