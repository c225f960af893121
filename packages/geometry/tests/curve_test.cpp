// Curved pieces of contours, paths, library shapes, approximations.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bodies/contour_volume.hpp"
#include "bodies/tests/rigid_body_deck.hpp"
#include "core/tests/input_error.hpp"
#include "geometry/curve_piece.hpp"

namespace mudline {
namespace {

constexpr double pi = 3.14159265358979323846;

std::string sublist(const std::string& name, const std::string& content) {
  return "<ParameterList name=\"" + name + "\">\n" + content + "</ParameterList>\n";
}

/// A path of one closed NURBS circle of radius 1 about (0, 1), from its lowest point.
std::string circle() {
  const double w = std::sqrt(0.5);
  return text_parameter("type", "path") + text_parameter("extent", "full") + array_parameter("start", "0, 0") +
         sublist("pieces", sublist(
                               "round", text_parameter("type", "nurbs") +
                                            "<Parameter name=\"degree\" type=\"int\" value=\"2\"/>\n" +
                                            array_parameter("x", "1, 1, 1, 0, -1, -1, -1, 0") +
                                            array_parameter("y", "0, 1, 2, 2, 2, 1, 0, 0") +
                                            [&] {
                                              char text[200];
                                              std::snprintf(text, sizeof text,
                                                            "1, %.16g, 1, %.16g, 1, %.16g, 1, %.16g, 1", w, w, w, w);
                                              return array_parameter("weights", text);
                                            }() +
                                            array_parameter("knots", "0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4")));
}

Contour contour(const std::string& parameters) {
  BodyDeck deck(body_xml("b", parameters, ""));
  const Section section = deck.deck.root().section("bodies").section("b").section("contour");
  return deck.contours.create(section)->contour(section);
}

TEST(Curve, TheLongerAndTheShorterArcMakeACircle) {
  const auto arc = [](const std::string& name, const std::string& to, bool large) {
    return sublist(name, text_parameter("type", "arc") + array_parameter("to", to) + number_parameter("radius", 1.25) +
                             "<Parameter name=\"large\" type=\"bool\" value=\"" + (large ? "true" : "false") +
                             "\"/>\n");
  };
  const Contour c =
      contour(text_parameter("type", "path") + text_parameter("extent", "full") + array_parameter("start", "0, 0") +
              sublist("pieces", arc("right", "0, 2", true) + arc("left", "0, 0", false)));
  EXPECT_NEAR(c.length(), 2 * pi * 1.25, 1e-12);
  EXPECT_NEAR(c.closest({3, 1}).gap, 3 - (0.75 + 1.25), 1e-12);  // the centre is (0.75, 1)
}

TEST(Curve, AStripIsAsThickAsItsThickness) {
  const Contour c =
      contour(text_parameter("type", "strip") + number_parameter("width", 0.4) + number_parameter("thickness", 0.1));
  EXPECT_NEAR(c.length(), 0.5 * 0.4 + 0.1 + 0.5 * 0.4, 1e-12);
  EXPECT_NEAR(c.closest({0.1, 0.3}).gap, 0.2, 1e-12);
}

TEST(Curve, NurbsCircleIsACircle) {
  const Contour c = contour(circle());
  EXPECT_NEAR(c.length(), 2 * pi, 1e-12);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 200; ++i) {
    const double angle = 2 * pi * unit(random), distance = 0.3 + 2 * unit(random);
    const PlanePoint x{distance * std::cos(angle), 1 + distance * std::sin(angle)};
    const ContourProjection projection = c.closest(x);
    EXPECT_NEAR(projection.gap, distance - 1, 1e-12);
    EXPECT_NEAR(projection.normal[0], std::cos(angle), 1e-10);
    EXPECT_NEAR(projection.normal[1], std::sin(angle), 1e-10);
    EXPECT_NEAR(projection.curvature, 1, 1e-9);
    EXPECT_NEAR(std::remainder(projection.arc_length - (angle + pi / 2), 2 * pi), 0, 1e-9);
  }
}

std::vector<PlanePoint> quarter(int n) {
  std::vector<PlanePoint> points;
  for (int i = 0; i <= n; ++i) points.push_back({std::sin(0.5 * pi * i / n), 1 - std::cos(0.5 * pi * i / n)});
  return points;
}

TEST(Curve, HermiteThroughACircleIsAsGoodAsItShouldBe) {
  // largest radial error with n pieces in a quarter, tangents of the neighbouring points: 1.9e-4, 1.2e-5, 7.3e-7
  const double expected[] = {1.9e-4, 1.2e-5, 7.3e-7};
  int k = 0;
  for (const int n : {4, 8, 16}) {
    double error = 0;
    for (const auto& piece : hermite_pieces(quarter(n), {1, 0}, {0, 1}))
      for (int i = 0; i <= 20; ++i) {
        const PlanePoint x = piece->point(piece->length() * i / 20);
        error = std::max(error, std::abs(std::hypot(x[0], x[1] - 1) - 1));
      }
    EXPECT_NEAR(error, expected[k], 0.05 * expected[k]);
    ++k;
  }
}

TEST(Curve, ClosestPointIsTheNearestPointAndGeometryIsDifferentiated) {
  const CurvePiece piece(std::make_shared<CubicBezier>(PlanePoint{0, 0}, PlanePoint{1.5, -0.2}, PlanePoint{-0.4, 1.1},
                                                       PlanePoint{1, 1.3}));
  const double length = piece.length();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-0.5, 2);
  for (int i = 0; i < 300; ++i) {
    const PlanePoint x{unit(random), unit(random)};
    const auto distance = [&](double s) { return std::hypot(x[0] - piece.point(s)[0], x[1] - piece.point(s)[1]); };
    double best = 1e300;
    for (int k = 0; k <= 2000; ++k) best = std::min(best, distance(length * k / 2000));
    EXPECT_LE(distance(piece.closest(x)), best + 1e-12);
  }
  for (int k = 1; k < 20; ++k) {
    const double s = length * k / 20, h = 1e-5;
    const PlanePoint a = piece.point(s - h), b = piece.point(s + h), t = piece.tangent(s);
    EXPECT_NEAR((b[0] - a[0]) / (2 * h), t[0], 1e-7);
    EXPECT_NEAR((b[1] - a[1]) / (2 * h), t[1], 1e-7);
    const PlanePoint t0 = piece.tangent(s - h), t1 = piece.tangent(s + h);
    EXPECT_NEAR((t1[1] * t0[0] - t1[0] * t0[1]) / (2 * h), piece.curvature(s),
                1e-5 * (1 + std::abs(piece.curvature(s))));
    EXPECT_NEAR(piece.closest(piece.point(s)), s, 1e-9);
    // the mirror image is traversed backwards
    const auto image = piece.mirrored();
    EXPECT_NEAR(image->point(length - s)[0], -piece.point(s)[0], 1e-12);
    EXPECT_NEAR(image->curvature(length - s), piece.curvature(s), 1e-8);
  }
  EXPECT_EQ(piece.closest({-0.1, -0.1}), 0);
  EXPECT_EQ(piece.closest({1.2, 2.3}), length);
}

TEST(Curve, PathJoinsAllKindsOfPieces) {
  const std::string pieces =
      sublist("tip",
              text_parameter("type", "arc") + array_parameter("to", "0.5, 0.5") + number_parameter("radius", 0.5)) +
      sublist("neck", text_parameter("type", "hermite") + array_parameter("x", "0.45, 0.5") +
                          array_parameter("y", "0.8, 1.1") + array_parameter("first direction", "0, 1") +
                          array_parameter("last direction", "0, 1")) +
      sublist("bulge", text_parameter("type", "bezier") + array_parameter("x", "0.5, 0.6, 0.6") +
                           array_parameter("y", "1.2, 1.3, 1.5")) +
      sublist("shaft", text_parameter("type", "line") + array_parameter("to", "0.6, 3"));
  const Contour c =
      contour(text_parameter("type", "path") + array_parameter("start", "0, 0") + sublist("pieces", pieces));
  EXPECT_NEAR(c.closest({0, -0.3}).gap, 0.3, 1e-14);
  EXPECT_NEAR(c.closest({0.7, 2}).gap, 0.1, 1e-14);
  EXPECT_NEAR(c.closest({0.5, 50}).gap, -0.1, 1e-12);  // the shaft goes on
  EXPECT_EQ(c.pieces().size(), 5u);
}

TEST(Curve, TorpedoHasItsVolumeAndIsSmoothWhereItShouldBe) {
  const std::string sizes = text_parameter("type", "torpedo") + number_parameter("diameter", 1) +
                            number_parameter("length", 12) + number_parameter("tail length", 2) +
                            number_parameter("tail diameter", 0.6);
  const Contour cone = contour(sizes + text_parameter("tip", "cone") + number_parameter("tip length", 1.5));
  const double expected = pi * 0.25 * 1.5 / 3 + pi * 0.25 * 8.5 + pi * 2 * (0.25 + 0.15 + 0.09) / 3;
  EXPECT_NEAR(ContourVolume(cone, Geometry::axisymmetric).total(), expected, 1e-12);
  const Contour ogive = contour(sizes + number_parameter("tip length", 1.5));
  const ContourVolume volume(ogive, Geometry::axisymmetric);
  EXPECT_GT(volume.total(), expected);
  EXPECT_NEAR(volume.frontal_area(), pi * 0.25, 1e-12);
  EXPECT_NEAR(volume.section(5), pi * 0.25, 1e-12);
  EXPECT_NEAR(volume.below(6) - volume.below(5), pi * 0.25, 1e-12);
  const double h = 1e-6;
  EXPECT_NEAR((volume.below(0.7 + h) - volume.below(0.7 - h)) / (2 * h), volume.section(0.7), 1e-7);
  // the ogive meets the shaft without a corner
  EXPECT_NEAR(ogive.closest({0.6, 1.5 - 1e-9}).normal[1], 0, 1e-6);
  EXPECT_NEAR(ogive.closest({0, 12.5}).gap, 0.5, 1e-14);
}

TEST(Curve, ApproximationsGoThroughTheSamePoints) {
  const std::string ball = text_parameter("type", "sphere") + number_parameter("diameter", 2);
  const auto approximate = [&](const std::string& kind, const std::string& extent, double chord) {
    return contour(ball + text_parameter("extent", extent) + text_parameter("approximation", kind) +
                   number_parameter("chord length", chord));
  };
  for (const std::string extent : {"half", "full"}) {
    const Contour facets = approximate("facets", extent, 0.393), smooth = approximate("bezier", extent, 0.393);
    EXPECT_EQ(facets.pieces().size(), extent == "half" ? 8u : 16u);
    EXPECT_EQ(smooth.pieces().size(), facets.pieces().size());
    double coarse = 0, fine = 0, turn = 0;
    for (int i = 0; i <= 400; ++i) {
      const double angle = -pi / 2 + pi * i / 400 * 0.999;
      const PlanePoint x{1.2 * std::cos(angle), 1 + 1.2 * std::sin(angle)};
      const ContourProjection projection = smooth.closest(x);
      coarse = std::max(coarse, std::abs(facets.closest(x).gap - 0.2));
      fine = std::max(fine, std::abs(projection.gap - 0.2));
      turn = std::max(turn, std::hypot(projection.normal[0] - std::cos(angle), projection.normal[1] - std::sin(angle)));
    }
    EXPECT_NEAR(coarse, 1 - std::cos(pi / 16), 1e-3);
    EXPECT_LT(fine, 2.5e-4);
    EXPECT_LT(turn, 3e-3);
  }
}

TEST(Curve, WrongContoursAreNamed) {
  const auto error = [](const std::string& parameters) { return input_error([&] { contour(parameters); }); };
  const auto has = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  const std::string line = text_parameter("type", "polyline") + text_parameter("extent", "full");
  has(error(line + array_parameter("x", "0, 1, 0, 1, 0") + array_parameter("y", "0, 0, 1, 1, 0")),
      "the contour crosses itself near");
  has(error(line + array_parameter("x", "0, 0, 1, 1, 0") + array_parameter("y", "0, 1, 1, 0, 0")),
      "the contour is inverted");
  has(error(text_parameter("type", "sphere") + number_parameter("diameter", 1) +
            text_parameter("approximation", "facets")),
      "needs a 'chord length'");
  has(error(text_parameter("type", "sphere") + number_parameter("diameter", 1) + number_parameter("chord length", 0.1)),
      "takes no 'chord length'");
  const auto path = [](const std::string& piece) {
    return text_parameter("type", "path") + array_parameter("start", "0, 0") + sublist("pieces", sublist("p", piece));
  };
  has(error(path(text_parameter("type", "arc") + array_parameter("to", "1, 1") + number_parameter("radius", 0.5))),
      "contour/pieces/p: the arc's ends");
  has(error(path(text_parameter("type", "bezier") + array_parameter("x", "1, 2") + array_parameter("y", "1, 2"))),
      "three control points");
  has(error(path(text_parameter("type", "nurbs") + array_parameter("x", "1, 2, 3") + array_parameter("y", "0, 1, 2") +
                 array_parameter("knots", "0, 1"))),
      "needed are 8");
  has(error(path(text_parameter("type", "spline"))), "unknown contour piece type 'spline'");
  has(error(text_parameter("type", "torpedo") + number_parameter("diameter", 1) + number_parameter("length", 1) +
            number_parameter("tip length", 2)),
      "longer than the body");
}

}  // namespace
}  // namespace mudline
