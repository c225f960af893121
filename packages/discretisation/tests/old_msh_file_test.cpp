#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "core/text.hpp"
#include "discretisation/mesh_quality.hpp"
#include "discretisation/old_msh_file.hpp"
#include "discretisation/tests/mesh_fixture.hpp"
#include "tensor/vec.hpp"

namespace mudline {
namespace {

using namespace mesh_test;

std::string replaced(std::string text, const std::string& old, const std::string& with) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return at == std::string::npos ? text : text.replace(at, old.size(), with);
}

const std::string format = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string names =
    "$PhysicalNames\n6\n1 1 \"bottom\"\n1 2 \"right\"\n1 3 \"top\"\n1 4 \"left\"\n2 5 \"clay\"\n2 6 \"sand\"\n"
    "$EndPhysicalNames\n";
/// Two squares beside each other, 2 x 1.
const std::string nodes = "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n$EndNodes\n";
/// Every element has the elementary tag 1, as many converters write it.
const std::string elements =
    "$Elements\n8\n1 1 2 1 1 1 2\n2 1 2 1 1 2 3\n3 1 2 2 1 3 6\n4 1 2 3 1 6 5\n5 1 2 3 1 5 4\n6 1 2 4 1 4 1\n"
    "7 3 2 5 1 1 2 5 4\n8 3 2 6 1 2 3 6 5\n$EndElements\n";
const std::string squares = format + names + nodes + elements;

class OldMshFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("old_msh_file_test_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string file(const std::string& content) const {
    const std::string path = (folder_ / "mesh.msh").string();
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }
  std::unique_ptr<Mesh> mesh(const std::string& content, int order = 1) const {
    return make(gmsh(file(content), parameter("order", "int", std::to_string(order))));
  }
  std::unique_ptr<Mesh> mesh3(const std::string& content, int order = 2) const {
    return make(gmsh3(file(content), parameter("order", "int", std::to_string(order))));
  }
  /// What is said of a spoilt file; one line.
  std::string refusal(const std::string& content) const {
    const std::string text = input_error([&] { mesh(content); });
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 0) << text;
    EXPECT_CONTAINS(text, "deck.xml:1: mesh");
    return text;
  }

  std::filesystem::path folder_;
};

std::map<std::string, std::size_t> sizes(const Mesh& mesh) {
  std::map<std::string, std::size_t> result;
  for (const auto& [set, sides] : mesh.side_sets()) result[set] = sides.size();
  return result;
}

void expect_squares(const Mesh& mesh) {
  EXPECT_EQ(sizes(mesh), (std::map<std::string, std::size_t>{{"bottom", 2}, {"left", 1}, {"right", 1}, {"top", 2}}));
  EXPECT_EQ(mesh.regions(), (std::vector<std::string>{"clay", "sand"}));
  EXPECT_NEAR(area(mesh, "clay"), 1, 1e-14);
  EXPECT_NEAR(area(mesh, "sand"), 1, 1e-14);
  EXPECT_NEAR(side_integral(mesh, "top")[2], 2, 1e-14);
  EXPECT_NEAR(side_integral(mesh, "bottom")[2], -2, 1e-14);
  EXPECT_NEAR(side_integral(mesh, "right")[1], 1, 1e-14);
  EXPECT_EQ(mesh.region_bounds().at("sand").low[0], 1);
}

TEST_F(OldMshFile, GroupsBelongToElementsNotToElementaryTags) { expect_squares(*mesh(squares)); }

TEST_F(OldMshFile, WindowsLineEndsCommentsAndOtherSections) {
  std::string windows;
  for (const char c : squares) windows += c == '\n' ? "\r\n" : std::string(1, c);
  expect_squares(*mesh(windows));
  expect_squares(*mesh("$Comments\n$MeshFormat of another kind\n$EndComments\n" + squares));
  expect_squares(*mesh(squares + "\n$NodeData\n1\n\"u\"\n1\n0\n3\n0\n1\n0\n$EndNodeData\n"));
}

TEST_F(OldMshFile, VersionsOneAndTwo) {
  expect_squares(*mesh(replaced(squares, "2.2 0 8", "2.1 0 8")));
  // 2.0 has no dimensions of names
  std::string older = replaced(squares, "2.2 0 8", "2 0 8");
  for (const char* name : {"1 1 \"", "1 2 \"", "1 3 \"", "1 4 \"", "2 5 \"", "2 6 \""})
    older = replaced(older, std::string("\n") + name, std::string("\n") + (name + 2));
  expect_squares(*mesh(older));
  const auto first = mesh(
      "$NOD\n6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n$ENDNOD\n"
      "$ELM\n4\n1 1 3 1 2 6 5\n2 1 3 1 2 5 4\n3 3 5 1 4 1 2 5 4\n4 3 6 1 4 2 3 6 5\n$ENDELM\n");
  EXPECT_EQ(first->regions(), (std::vector<std::string>{"5", "6"}));
  EXPECT_EQ(sizes(*first), (std::map<std::string, std::size_t>{{"3", 2}}));
}

TEST_F(OldMshFile, AnElementListedOncePerGroupIsInAllOfThem) {
  std::string text =
      replaced(squares, "$Elements\n8\n", "$Elements\n11\n9 1 2 7 1 3 6\n10 1 2 7 1 4 1\n11 1 2 8 1 3 6\n");
  text = replaced(text, "$PhysicalNames\n6\n", "$PhysicalNames\n8\n1 7 \"ends\"\n1 8 \"right\"\n");
  const auto found = mesh(text);
  EXPECT_EQ(sizes(*found),
            (std::map<std::string, std::size_t>{{"bottom", 2}, {"ends", 2}, {"left", 1}, {"right", 1}, {"top", 2}}))
      << "8 is another number of the group 'right', which has the side already";
  EXPECT_NEAR(side_integral(*found, "ends")[0], 2, 1e-14);
}

TEST_F(OldMshFile, NoGroupAndGroupsTurnedOver) {
  std::string text = replaced(squares, "3 1 2 2 1 3 6", "3 1 2 0 1 3 6");
  text = replaced(text, "6 1 2 4 1 4 1", "6 1 2 -4 1 1 4");
  EXPECT_EQ(sizes(*mesh(text)), (std::map<std::string, std::size_t>{{"bottom", 2}, {"left", 1}, {"top", 2}}));
  EXPECT_CONTAINS(refusal(replaced(squares, "8 3 2 6 1", "8 3 2 0 1")),
                  "'mesh.msh': the 1 elements of surface 1 belong to no physical group; add a Physical Surface");
}

TEST_F(OldMshFile, PartitionsDoNotCount) {
  std::string text = squares;
  for (const char* old : {"1 1 2 1 1 ", "2 1 2 1 1 ", "3 1 2 2 1 ", "4 1 2 3 1 ", "5 1 2 3 1 ", "6 1 2 4 1 "})
    text =
        replaced(text, std::string("\n") + old, "\n9 1 4" + std::string(old + 5) + "1 " + (old[0] > '3' ? "2 " : "1 "));
  text = replaced(text, "7 3 2 5 1 ", "7 3 5 5 1 2 1 -2 ");
  text = replaced(text, "8 3 2 6 1 ", "8 3 5 6 1 2 2 -1 ");
  expect_squares(*mesh(text));
  // what Gmsh puts between partitions of one region: it has that region's tag, and no partition
  text = replaced(text, "8 3 5 6 1 2", "8 3 5 5 1 2");
  text = replaced(text, "$Elements\n8\n", "$Elements\n10\n9 1 2 5 7 2 5\n10 15 2 5 8 5\n");
  EXPECT_EQ(sizes(*mesh(text)),
            (std::map<std::string, std::size_t>{{"bottom", 2}, {"left", 1}, {"right", 1}, {"top", 2}}));
  EXPECT_TRUE(mesh(text)->node_sets().empty());
  // a line of such a number that does not lie between partitions is meant
  EXPECT_EQ(sizes(*mesh(replaced(text, "9 1 2 5 7 2 5", "9 1 2 5 7 3 6"))).at("5"), 1u);
}

/// The same elements as a binary file; `turned`: with the other order of bytes.
std::string binary_squares(bool turned) {
  std::string result = replaced(format, "2.2 0 8\n$End", "2.2 1 8\nONE\n$End") + names;
  const auto put = [&](auto value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    if (turned) std::reverse(bytes, bytes + sizeof value);
    return std::string(bytes, sizeof value);
  };
  result = replaced(result, "ONE", put(1)) + "$Nodes\n6\n";
  for (int n = 0; n < 6; ++n) result += put(n + 1) + put(n % 3 * 1.0) + put(n / 3 * 1.0) + put(0.0);
  result += "\n$EndNodes\n$Elements\n8\n";
  const std::vector<std::vector<int>> lines = {{1, 1, 2}, {1, 2, 3}, {2, 3, 6}, {3, 6, 5}, {3, 5, 4}, {4, 4, 1}},
                                      cells = {{5, 1, 2, 5, 4}, {6, 2, 3, 6, 5}};
  int number = 0;
  for (const auto& [type, list] : {std::pair{1, lines}, {3, cells}}) {
    result += put(type) + put(static_cast<int>(list.size())) + put(2);
    for (const std::vector<int>& e : list) {
      result += put(++number) + put(e[0]) + put(1);
      for (std::size_t a = 1; a < e.size(); ++a) result += put(e[a]);
    }
  }
  return result + "\n$EndElements\n";
}

TEST_F(OldMshFile, BinaryFilesOfBothOrdersOfBytes) {
  for (const bool turned : {false, true}) {
    const std::string whole = binary_squares(turned);
    expect_squares(*mesh(whole));
    for (std::size_t length = format.size(); length + 14 < whole.size(); length += 7)
      EXPECT_CONTAINS(refusal(whole.substr(0, length)), "mesh.msh: byte ");
  }
  std::string spoilt = binary_squares(false);
  const double none = std::numeric_limits<double>::quiet_NaN();
  std::memcpy(&spoilt[spoilt.find("$Nodes\n6\n") + 9 + 4], &none, sizeof none);
  EXPECT_CONTAINS(refusal(spoilt), "node 1 has a coordinate that is no finite number");
}

TEST_F(OldMshFile, QuadrilateralsOfEightNodesGetCentres) {
  const std::string text = format +
                           "$Nodes\n8\n1 0 0 0\n2 2 0 0\n3 2 1 0\n4 0 1 0\n5 1 -0.2 0\n6 2.1 0.5 0\n7 0.9 1.2 0\n"
                           "8 0.1 0.5 0\n$EndNodes\n$Elements\n2\n1 8 2 9 1 3 4 7\n2 16 2 5 1 1 2 3 4 5 6 7 8\n"
                           "$EndElements\n";
  const auto found = mesh(text, 2);
  ASSERT_EQ(found->blocks().size(), 1u);
  EXPECT_EQ(found->blocks()[0].shape, CellShape::quad9);
  EXPECT_EQ(found->num_nodes(), 9);
  const int centre = found->blocks()[0].nodes(0, 8);
  EXPECT_NEAR(found->coordinates()(centre, 0), 0.5 * (1 + 2.1 + 0.9 + 0.1) - 0.25 * 4, 1e-14);
  EXPECT_NEAR(found->coordinates()(centre, 1), 0.5 * (-0.2 + 0.5 + 1.2 + 0.5) - 0.25 * 2, 1e-14);
  EXPECT_EQ(found->nodes_of_set("9").size(), 3u);
  EXPECT_CONTAINS(refusal(text), "region '5' has quad9 elements, which are of order 2, but 'order' is 1");
}

/// Values of the serendipity shapes of a hexahedron at a reference place; nodes as those of hex27 begin.
std::vector<double> serendipity(const Vec<double, 3>& xi) {
  std::vector<double> N;
  for (int a = 0; a < 20; ++a) {
    const Vec<double, 3> at = reference_node(CellShape::hex27, a);
    double value = a < 8 ? 0.125 : 0.25, sum = -2;
    for (int d = 0; d < 3; ++d) {
      value *= at[d] == 0 ? 1 - xi[d] * xi[d] : 1 + at[d] * xi[d];
      sum += at[d] * xi[d];
    }
    N.push_back(a < 8 ? value * sum : value);
  }
  return N;
}

/// Two bent bricks in Gmsh's order of nodes; `first_of_27`: the first one has all its nodes.
std::string bricks(std::vector<Point>& given, bool first_of_27 = false) {
  std::string nodes, cells;
  std::map<Point, int> numbers;
  int count = 0;
  for (int brick = 0; brick < 2; ++brick) {
    const bool all = brick == 0 && first_of_27;
    std::vector<int> in_order(27);
    for (int a = 0; a < (all ? 27 : 20); ++a) {
      const Vec<double, 3> xi = reference_node(CellShape::hex27, a);
      const double x = 0.5 * (xi[0] + 1) + brick, y = 0.5 * (xi[1] + 1), z = 0.5 * (xi[2] + 1);
      const auto [number, added] = numbers.emplace(Point{x, y, z}, count + 1);
      if (added) {
        const Point bent{x + 0.05 * std::sin(3 * y + z), y + 0.06 * std::cos(2 * x + z),
                         z + 0.07 * std::sin(2 * x - y)};
        given.push_back(bent);
        ++count;
        nodes += std::to_string(count) + " " + number_text(bent[0]) + " " + number_text(bent[1]) + " " +
                 number_text(bent[2]) + "\n";
      }
      in_order[a] = number->second;
    }
    // the node of hex27 at each place in Gmsh's order
    const int gmsh[27] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 16, 9,  17, 10,
                          18, 19, 12, 15, 13, 14, 24, 22, 20, 21, 23, 25, 26};
    cells += std::to_string(brick + 1) + (all ? " 12" : " 17") + " 2 5 1";
    for (int k = 0; k < (all ? 27 : 20); ++k) cells += " " + std::to_string(in_order[gmsh[k]]);
    cells += "\n";
  }
  return format + "$Nodes\n" + std::to_string(count) + "\n" + nodes + "$EndNodes\n$Elements\n2\n" + cells +
         "$EndElements\n";
}

TEST_F(OldMshFile, HexahedraOfTwentyNodesGetCentresAndKeepTheirGeometry) {
  std::vector<Point> given;
  const auto found = mesh3(bricks(given));
  ASSERT_EQ(found->blocks().size(), 1u);
  const ElementBlock& block = found->blocks()[0];
  EXPECT_EQ(block.shape, CellShape::hex27);
  EXPECT_EQ(found->num_nodes(), 45) << "the face between them has one centre";
  EXPECT_GT(mesh_quality(*found, found->coordinates()).lowest, 0.3);
  EXPECT_LT(gradient_error(*found), 1e-11);
  for (int e = 0; e < 2; ++e) {
    const ElementMap map = map_of(*found, block, e);
    for (const Vec<double, 3>& xi :
         {Vec<double, 3>{0, 0, 0}, {0.3, -0.7, 0.9}, {-1, 0.2, 0.4}, {0.6, 1, -0.5}, {-0.8, -0.1, -1}}) {
      const std::vector<double> N = serendipity(xi);
      const Point at = map.at(xi.data());
      for (int i = 0; i < 3; ++i) {
        double expected = 0;
        for (int a = 0; a < 20; ++a) expected += N[a] * found->coordinates()(block.nodes(e, a), i);
        EXPECT_NEAR(at[i], expected, 1e-14);
      }
    }
  }
}

TEST_F(OldMshFile, ANeighbourThatHasTheCentreOfACommonFaceGivesIt) {
  std::vector<Point> given;
  const auto found = mesh3(bricks(given, true));
  EXPECT_EQ(found->num_nodes(), 45);
  EXPECT_EQ(found->blocks().size(), 1u);
}

TEST_F(OldMshFile, Errors) {
  const auto expect = [&](const std::string& text, const std::string& message) {
    EXPECT_CONTAINS(refusal(text), "mesh/file: mesh.msh:" + message);
  };
  expect("$MeshFormat\n",
         "1: expected the version, the kind of file (0: text, 1: binary) and the size of a number, such "
         "as '2.2 0 8', given the end of the file");
  expect(replaced(squares, "2.2 0 8", "x"), "2: expected the version, the kind of file (0: text, 1: binary)");
  expect(replaced(squares, "2.2 0 8", "2.2 0 4"), "2: expected the version");
  expect(replaced(squares, "2.2 0 8", "-1 0 8"), "2: the version '-1' is unknown; allowed: 1 to 4.1");
  expect(replaced(squares, "1 1 \"bottom\"", "1 1 bottom"),
         "6: expected a name of a physical group (dimension number "
         "\"name\"), given '1 1 bottom'");
  expect(replaced(squares, "1 2 \"right\"", "1 1 \"right\""),
         "7: the physical group 1 has two names, 'bottom' and 'right'");
  expect(replaced(squares, "$Nodes\n6\n", "$Nodes\n-6\n"), "14: expected the number of nodes, given '-6'");
  expect(replaced(squares, "$Nodes\n6\n", "$Nodes\n1000000000000\n"),
         "14: 1000000000000 nodes are announced, and the "
         "file ends before them: it is cut off, or");
  expect(replaced(squares, "$Nodes\n6\n", "$Nodes\n7\n"),
         "21: expected node 7 (number x y z), given '$EndNodes' (line 14 "
         "announces 7 nodes)");
  expect(replaced(squares, "$Nodes\n6\n", "$Nodes\n5\n"),
         "20: expected $EndNodes, given '6 2 1 0' (line 14 announces 5 nodes)");
  expect(replaced(squares, "5 1 1 0", "5 1 1"), "19: expected node 5 (number x y z), given '5 1 1'");
  expect(replaced(squares, "5 1 1 0", "5 nan 1 0"), "19: node 5 has the coordinate 'nan'; allowed: finite numbers");
  expect(replaced(squares, "5 1 1 0", "5 1e400 1 0"), "19: node 5 has the coordinate '1e400'");
  expect(replaced(squares, "5 1 1 0", "-5 1 1 0"), "19: a node has the number -5; allowed: 0 and more");
  expect(replaced(squares, "5 1 1 0", "4 1 1 0"), "19: the node 4 is given twice, at different places");
  expect(replaced(squares, "1 2 5 4", "1 2 99 4"), "30: an element has the node 99, which is not among the 6 nodes");
  expect(replaced(squares, "7 3 2 5 1 1 2 5 4", "7 3 2 5 1 1 2 5"),
         "30: an element of the type 'Quadrilateral 4' has 4 "
         "nodes, given 3");
  expect(replaced(squares, "7 3 2", "7 3 20"), "30: an element with 20 tags, and 6 numbers for tags and nodes");
  expect(replaced(squares, "7 3 2", "7 3 2.5"), "30: an element consists of whole numbers, given '2.5'");
  expect(replaced(squares, "7 3 2", "7 777 2"),
         "30: an element of the type 777, which is unknown; allowed: points, lines");
  expect(replaced(squares, "7 3 2", "7 21 2"), "30: an element of the type 21 ('Triangle 10'); allowed: points, lines");
  expect(replaced(squares, "8 3 2 6 1 2 3 6 5", "8 3 2 5 1 5 4 1 2"),
         "31: an element is listed twice in the physical "
         "group 'clay', first in line 30");
  expect(replaced(squares, "8 3 2 6 1 2 3 6 5", "8 3 2 6 1 5 4 1 2"),
         "31: an element is in two physical groups, 'sand' and "
         "in line 30 'clay'; each element needs exactly one");
  expect(replaced(squares, "2 1 2 1 1 2 3", "2 1 2 1 1 1 2"),
         "25: an element is listed twice in the physical group "
         "'bottom', first in line 24");
  expect(replaced(squares, "$EndElements\n", ""),
         "31: expected $EndElements, given the end of the file (line 23 announces 8");
  expect(replaced(squares, "$Nodes\n", ""), "20: '$EndNodes' stands without the beginning of its section");
  expect(replaced(squares, "bottom", "bot\xf6m"),
         "6: the physical group 1 has the name 'bot\\xf6m', which holds the byte 0xf6, which is not UTF-8");
  expect(squares + nodes, "33: a second section '$Nodes'; allowed: one");
  expect(squares + "$NodeData\n1\n", "33: the section '$NodeData' has no end ('$EndNodeData')");
  expect(format + names + nodes, "21: the file ends without a section $Elements");
  EXPECT_CONTAINS(refusal(replaced(squares, "5 1 1 0", "5 1 1 0.1")), "'mesh.msh': the mesh is not in the x-y plane");
}

TEST_F(OldMshFile, CutOffAnywhereItIsRefused) {
  for (std::size_t length = format.size() + 1; length + 14 < squares.size(); ++length)
    EXPECT_CONTAINS(refusal(squares.substr(0, length)), "mesh/file: mesh.msh:");
}

TEST_F(OldMshFile, TellsWhichFilesItReads) {
  EXPECT_TRUE(is_old_msh(file(squares)));
  EXPECT_TRUE(is_old_msh(file("$NOD\n")));
  EXPECT_TRUE(is_old_msh(file("$Comments\nx\n$EndComments\n$MeshFormat\n2 0 8\n")));
  EXPECT_FALSE(is_old_msh(file("$MeshFormat\n4.1 0 8\n")));
  EXPECT_FALSE(is_old_msh(file("SystemCall \"x\";\n")));
  EXPECT_FALSE(is_old_msh(file("")));
}

}  // namespace
}  // namespace mudline
