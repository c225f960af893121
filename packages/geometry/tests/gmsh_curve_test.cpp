// Contours of curves that Gmsh reads, compared with the same contours of other shapes.
#ifdef MUDLINE_HAVE_GMSH
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bodies/tests/rigid_body_deck.hpp"
#include "core/tests/input_error.hpp"
#include "geometry/curve_piece.hpp"

namespace mudline {
namespace {

Contour contour(const std::string& parameters) {
  BodyDeck deck(body_xml("b", parameters, ""));
  const Section section = deck.deck.root().section("bodies").section("b").section("contour");
  return deck.contours.create(section)->contour(section);
}

std::string curve(const std::string& file, const std::string& more) {
  return text_parameter("type", "gmsh curve") +
         text_parameter("file", std::string(MUDLINE_SOURCE_DIR) + "/packages/geometry/tests/data/" + file) + more;
}

std::string physical(const std::string& name) { return text_parameter("physical curve", name); }

/// Largest differences over random points of [0, width] x [low, high]: gap and closest point [m], normal [-], curvature
/// [1/m].
struct Difference {
  double gap = 0, projection = 0, normal = 0, curvature = 0;
  Difference(const Contour& a, const Contour& b, double width, double low, double high) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    int compared = 0;
    for (int i = 0; i < 500; ++i) {
      const PlanePoint x{width * unit(random), low + (high - low) * unit(random)};
      const ContourProjection p = a.closest(x), q = b.closest(x);
      gap = std::max(gap, std::abs(p.gap - q.gap));
      if (p.gap < 0) continue;  // deep inside two closest points may be equally near
      ++compared;
      projection = std::max(projection, std::hypot(p.point[0] - q.point[0], p.point[1] - q.point[1]));
      normal = std::max(normal, std::hypot(p.normal[0] - q.normal[0], p.normal[1] - q.normal[1]));
      curvature = std::max(curvature, std::abs(p.curvature - q.curvature));
    }
    EXPECT_GT(compared, 200);
  }
};

TEST(GmshCurve, ConeIsTheLibrarysCone) {
  const auto library = [](double diameter) {
    return contour(text_parameter("type", "cone") + number_parameter("diameter", diameter) +
                   number_parameter("tip radius", 0.1) + number_parameter("shoulder radius", 0.3));
  };
  const Contour drawn = contour(curve("cone.geo", physical("cone") + array_parameter("origin", "2, 3")));
  EXPECT_EQ(drawn.pieces().size(), 4u);
  const Difference one(drawn, library(1), 2, -1, 4);
  EXPECT_LT(one.gap, 1e-12);
  EXPECT_LT(one.projection, 1e-11);
  EXPECT_LT(one.normal, 1e-11);
  EXPECT_LT(one.curvature, 1e-10);
  EXPECT_NEAR(drawn.closest({0.7, 50}).gap, 0.2, 1e-12) << "the shaft goes on";
  const Contour by_numbers = contour(curve(
      "cone.geo", array_parameter("curves", "3, 1, 4, 2") + array_parameter("origin", "2, 3") +
                      "<ParameterList name=\"parameters\">" + number_parameter("diameter", 1.5) + "</ParameterList>"));
  EXPECT_LT(Difference(by_numbers, library(1.5), 2, -1, 4).gap, 1e-12);
}

TEST(GmshCurve, TorpedoOfACadModelInMillimetres) {
  const Contour library = contour(text_parameter("type", "torpedo") + number_parameter("diameter", 1) +
                                  number_parameter("length", 12) + number_parameter("tip length", 1.5));
  // a CAD kernel keeps points to 1e-7 of its unit
  for (const std::string file : {"torpedo.step", "torpedo.brep"}) {
    const Contour drawn = contour(curve(file, array_parameter("curves", "1, 2, 3") + number_parameter("scale", 1e-3)));
    const Difference difference(drawn, library, 3, -2, 14);
    EXPECT_LT(difference.gap, 1e-10) << file;
    EXPECT_LT(difference.normal, 1e-9) << file;
    EXPECT_LT(difference.curvature, 1e-9) << file;
  }
}

TEST(GmshCurve, BezierCurveIsTheSamePolynomial) {
  const Contour drawn = contour(curve("curves.geo", physical("bezier")));
  EXPECT_EQ(drawn.pieces().size(), 1u);
  const std::string piece = "<ParameterList name=\"pieces\"><ParameterList name=\"p\">" +
                            text_parameter("type", "bezier") + array_parameter("x", "0.5, 0.3, 0.6") +
                            array_parameter("y", "-0.1, 0.9, 1.5") + "</ParameterList></ParameterList>";
  const Contour exact = contour(text_parameter("type", "path") + array_parameter("start", "0, 0") + piece);
  const Difference difference(drawn, exact, 2, -0.5, 2);
  EXPECT_LT(difference.gap, 1e-12);
  EXPECT_LT(difference.normal, 1e-10);
  EXPECT_LT(difference.curvature, 1e-8);
}

TEST(GmshCurve, EllipseIsFollowedWithItsCurvature) {
  const Contour drawn = contour(curve("curves.geo", physical("ellipse") + array_parameter("origin", "0, -1")));
  for (int i = 0; i <= 100; ++i) {
    const double angle = -1.5 + 3.0 * i / 100, c = std::cos(angle), s = std::sin(angle);
    const ContourProjection projection = drawn.closest({2 * c, 1 + s});
    const double size = std::hypot(c, 2 * s);
    EXPECT_NEAR(projection.gap, 0, 1e-10);
    EXPECT_NEAR(projection.normal[0], c / size, 1e-8);
    EXPECT_NEAR(projection.normal[1], 2 * s / size, 1e-8);
    EXPECT_NEAR(projection.curvature, 2 / (size * size * size), 1e-6);
  }
}

TEST(GmshCurve, SplineIsCutAtItsPoints) {
  const Contour drawn = contour(curve("curves.geo", physical("spline")));
  // its second derivative jumps at the three points inside; slivers around them are allowed
  EXPECT_GE(drawn.pieces().size(), 4u);
  EXPECT_LE(drawn.pieces().size(), 8u);
  for (const PlanePoint x : {PlanePoint{0.6, 0.1}, PlanePoint{0.8, 0.9}, PlanePoint{0.7, 1.8}})
    EXPECT_NEAR(drawn.closest(x).gap, 0, 1e-10);
  for (std::size_t i = 1; i < drawn.pieces().size(); ++i) {
    const PlanePoint before = drawn.pieces()[i - 1]->tangent(drawn.pieces()[i - 1]->length()),
                     after = drawn.pieces()[i]->tangent(0);
    EXPECT_NEAR(before[0] * after[1] - before[1] * after[0], 0, 1e-5) << i;
  }
}

TEST(GmshCurve, MistakesAreNamed) {
  const auto error = [](const std::string& parameters) { return input_error([&] { contour(parameters); }); };
  const auto has = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  has(error(curve("cone.geo", "")), "bodies/b/contour/physical curve: which curves are the contour?");
  has(error(curve("cone.geo", physical("cone") + array_parameter("curves", "1"))), "not both");
  has(error(curve("cone.geo", physical("con"))), "unknown physical curve 'con' (did you mean 'cone'?); the model has");
  has(error(curve("cone.geo", array_parameter("curves", "7"))),
      "bodies/b/contour/curves: the model has no curve 7; it has 1, 2, 3, 4");
  has(error(curve("cone.geo", array_parameter("curves", "1, 1"))), "curve 1 is there twice");
  has(error(curve("cone.geo", array_parameter("curves", "1.5"))), "given 1.5");
  has(error(curve("cone.geo", physical("flank") + array_parameter("origin", "2, 3"))),
      "a half contour starts on its axis, x = 2");
  has(error(curve("cone.geo", physical("parts") + array_parameter("origin", "2, 3"))), "does not meet the others");
  has(error(curve("cone.geo", physical("cone") + "<ParameterList name=\"parameters\">" + number_parameter("radius", 1) +
                                  "</ParameterList>")),
      "unknown parameter 'radius'");
  has(error(curve("curves.geo", physical("lifted"))), "curve 31 is not in the x-y plane");
  has(error(curve("curves.geo", physical("fork"))), "a contour does not branch");
  has(error(curve("rigid.txt", physical("cone"))), "rigid.txt");
  has(error(text_parameter("type", "gmsh curve") +
            text_parameter("file", std::string(MUDLINE_SOURCE_DIR) + "/README.md") + physical("cone")),
      "expected a .geo, .step, .stp or .brep file");
}

}  // namespace
}  // namespace mudline
#endif
