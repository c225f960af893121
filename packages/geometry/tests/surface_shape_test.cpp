#include "geometry/surface_shape.hpp"

#include <cstdint>
#include <cstdio>
#include <fstream>

#include "core/tests/input_error.hpp"
#include "geometry/rounded_box.hpp"
#include "geometry/stl_file.hpp"
#include "geometry/tests/surface_fixture.hpp"
#include "geometry/triangulated_surface.hpp"

namespace mudline {
namespace {

/// A file in the folder of the tests that is gone afterwards.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content, const std::string& name = "surface_test.stl")
      : name_(testing::TempDir() + name) {
    std::ofstream(name_, std::ios::binary) << content;
  }
  ~TemporaryFile() { std::remove(name_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

std::string ascii_stl(const SurfaceTriangles& triangles) {
  std::string text = "solid body\n";
  for (const auto& facet : triangles.facets) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const int point : facet) {
      char line[100];
      std::snprintf(line, sizeof line, "      vertex %.9e %.9e %.9e\n", triangles.points[point][0],
                    triangles.points[point][1], triangles.points[point][2]);
      text += line;
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid body\n";
}

template <class T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string binary_stl(const SurfaceTriangles& triangles) {
  std::string bytes = "solid written by a program that does not know better";
  bytes.resize(80);
  append(bytes, static_cast<std::uint32_t>(triangles.facets.size()));
  for (const auto& facet : triangles.facets) {
    for (int i = 0; i < 3; ++i) append(bytes, 0.0F);
    for (const int point : facet)
      for (const double x : triangles.points[point]) append(bytes, static_cast<float>(x));
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string triangulation(const std::string& file) {
  return text_parameter("type", "triangulation") + text_parameter("file", file);
}

std::string box(double x, double y, double z, double fillet) {
  return text_parameter("type", "box") + number_parameter("length x", x) + number_parameter("length y", y) +
         number_parameter("length z", z) + number_parameter("fillet radius", fillet);
}

std::string cone() {
  return text_parameter("type", "cone") + number_parameter("diameter", 1) + number_parameter("apex angle [deg]", 90);
}

std::string error(const std::string& parameters) {
  return input_error([&] { surface(parameters); });
}

void expect_error(const std::string& parameters, const std::string& part) {
  const std::string message = error(parameters);
  EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_EQ(message.find("deck.xml:"), 0u) << message;
}

TEST(SurfaceShape, ReadsItsPlace) {
  const auto plate =
      surface(box(2, 1, 0.2, 0) + array_parameter("position", "0, 0, 5") + array_parameter("rotation", "0, 90, 0"));
  EXPECT_NEAR(plate->closest({0.4, 0, 5}).gap, 0.3, 1e-14);  // it is upright
  EXPECT_NEAR(plate->closest({0, 0, 6.5}).gap, 0.5, 1e-14);
  const auto centred = surface(box(2, 1, 0.2, 0.05));
  EXPECT_NE(dynamic_cast<const RoundedBox*>(centred.get()), nullptr);
  EXPECT_NEAR(centred->closest({0, 0, 0.3}).gap, 0.2, 1e-15);
}

TEST(SurfaceShape, RevolvedKeepsItsTip) {
  SurfaceDeck deck(revolved(cone()));
  const auto shape = deck.shape();
  EXPECT_NEAR(shape->tip_height(), 0.5, 1e-12);
  EXPECT_NEAR(shape->surface()->closest({0, 0.8, 3}).gap, 0.3, 1e-14);
}

TEST(SurfaceShape, UnionOfAHullAndATurnedFin) {
  const auto body = surface(
      text_parameter("type", "union") +
      section_xml("parts", section_xml("hull", revolved(cone())) +
                               section_xml("fin", box(1, 0.1, 2, 0.02) + array_parameter("position", "0, 0.6, 3") +
                                                      array_parameter("rotation", "0, 0, 90"))));
  EXPECT_EQ(body->closest({0.2, 1, 3}).part, 1);
  EXPECT_NEAR(body->closest({0.2, 1, 3}).gap, 0.15, 1e-14);
  EXPECT_EQ(body->closest({0.6, 0, 3}).part, 0);
}

TEST(SurfaceShape, ReadsBothKindsOfStl) {
  SurfaceTriangles sphere = icosphere(2);
  for (Point& x : sphere.points) x = Point{10, 20, 30} + 500 * x;  // in millimetres
  for (const std::string& content : {ascii_stl(sphere), binary_stl(sphere)}) {
    const TemporaryFile file(content);
    const auto ball = surface(triangulation(file.name()) + array_parameter("origin", "10, 20, 30") +
                              number_parameter("scale", 0.001));
    EXPECT_NEAR(ball->closest({0.6, 0, -0.8}).gap, 0.5, 1e-4);
    EXPECT_EQ(dynamic_cast<const TriangulatedSurface&>(*ball).facets(), 320u);
  }
}

TEST(SurfaceShape, WarnsOfCoarseFacetsOnly) {
  const auto warning = [](int cuts) {
    const TemporaryFile file(binary_stl(icosphere(cuts)));
    testing::internal::CaptureStderr();
    surface(triangulation(file.name()));
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_NE(warning(2).find("surface/file: neighbouring facets are at up to 11 degrees to each other, and the "
                            "smoothed surface is up to 0.0"),
            std::string::npos)
      << warning(2);
  EXPECT_EQ(warning(3), "");
}

TEST(SurfaceShape, DocumentsItself) {
  SurfaceDeck deck("");
  std::vector<std::string> names;
  for (const EntryDoc& entry : deck.surfaces.document()) {
    names.push_back(entry.name);
    EXPECT_EQ(entry.kind, "surface");
    EXPECT_EQ(entry.parameters.front().name, "position");
  }
  EXPECT_EQ(names, (std::vector<std::string>{"revolved", "box", "union", "triangulation"}));
}

TEST(SurfaceShape, WrongSizesAreNamed) {
  expect_error("", "required parameter 'type' is missing; known surface types: revolved, box, union, triangulation");
  expect_error(text_parameter("type", "revolve"), "unknown surface type 'revolve' (did you mean 'revolved'?)");
  expect_error(box(1, -1, 1, 0), "surface/length y");
  expect_error(text_parameter("type", "box") + number_parameter("length x", 1) + number_parameter("length y", 1),
               "required parameter 'length z' is missing");
  expect_error(box(1, 1, 0.2, 0.15),
               "surface/fillet radius: 'fillet radius' = 0.15 must not exceed half the shortest length, 0.1");
  expect_error(box(1, 1, 1, 0) + array_parameter("position", "1, 2"),
               "surface/position: expected 3 numbers (x, y, z), given 2");
  expect_error(box(1, 1, 1, 0) + array_parameter("rotation", "0, 0, 90, 0"),
               "surface/rotation: expected 3 numbers (x, y, z), given 4");
  expect_error(box(1, 1, 1, 0) + number_parameter("filet radius", 0.1), "did you mean 'fillet radius'?");
  expect_error(text_parameter("type", "revolved"), "surface/contour: required parameter 'type' is missing");
  expect_error(revolved(cone() + text_parameter("extent", "full")),
               "surface/contour/extent: the contour of a surface of revolution is a half one");
  expect_error(revolved(text_parameter("type", "cone") + number_parameter("diameter", -1)), "surface/contour/diameter");
}

TEST(SurfaceShape, WrongUnionsAreNamed) {
  const std::string type = text_parameter("type", "union");
  expect_error(type, "a union needs at least one part");
  expect_error(type + section_xml("parts", ""), "a union needs at least one part");
  expect_error(type + section_xml("parts", section_xml("fin", box(1, 0.1, 1, 0.2))), "surface/parts/fin/fillet radius");
  expect_error(type + section_xml("parts", section_xml("fin", "")),
               "surface/parts/fin: required parameter 'type' is missing");
  expect_error(type + section_xml("parts", number_parameter("fin", 1)), "surface/parts");
  expect_error(type + section_xml("fin", box(1, 1, 1, 0)), "surface/fin");
}

TEST(SurfaceShape, WrongFilesAreNamed) {
  expect_error(triangulation("nowhere.stl"), "surface/file: the file 'nowhere.stl' does not exist");
  const auto with = [](const std::string& content, const std::string& part) {
    const TemporaryFile file(content);
    expect_error(triangulation(file.name()), "surface/file: " + part);
  };
  with("", "the file is no STL file");
  with("v 0 0 0\nv 1 0 0\n", "the file is no STL file");
  with("solid empty\nendsolid\n", "the file has no facets, or is a binary one that was cut short");
  with("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 x\n", "line 5: a vertex has three numbers");
  with("solid a\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n", "line 5: a facet has three vertices");
  with("solid a\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n", "the file ends within a facet");
  const std::string whole = binary_stl(icosphere(0));
  with(whole.substr(0, whole.size() - 50), "the file has no facets, or is a binary one that was cut short");
  std::string unnamed = whole;
  unnamed.replace(0, 5, "model");
  with(unnamed.substr(0, unnamed.size() - 50), "the file is no STL file");
  std::string broken = whole;
  const float bad = std::nanf("");
  broken.replace(84 + 2 * 50 + 12, sizeof bad, reinterpret_cast<const char*>(&bad), sizeof bad);
  with(broken, "facet 3 has a corner that is no number");
  SurfaceTriangles open = icosphere(0);
  open.facets.pop_back();
  with(binary_stl(open), "the surface is not closed: 3 edges have one facet only, the first one at (");
}

}  // namespace
}  // namespace mudline
