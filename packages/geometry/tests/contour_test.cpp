#include "geometry/contour.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bodies/tests/rigid_body_deck.hpp"
#include "core/tests/input_error.hpp"

namespace mudline {
namespace {

constexpr double pi = 3.14159265358979323846;

Contour contour(const std::string& parameters, Geometry geometry = Geometry::plane_strain) {
  BodyDeck deck(body_xml("b", parameters, text_parameter("type", "prescribed velocity")));
  return deck.body("b", geometry)->contour();
}

std::string contour_error(const std::string& parameters) {
  return input_error([&] { contour(parameters); });
}

std::string cone(double diameter, double angle, double tip, double shoulder) {
  return text_parameter("type", "cone") + number_parameter("diameter", diameter) +
         number_parameter("apex angle [deg]", angle) + number_parameter("tip radius", tip) +
         number_parameter("shoulder radius", shoulder);
}

double brute_force(const std::vector<PlanePoint>& line, const PlanePoint& x) {
  double best = 1e300;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double d[2] = {line[i][0] - line[i - 1][0], line[i][1] - line[i - 1][1]};
    double s = ((x[0] - line[i - 1][0]) * d[0] + (x[1] - line[i - 1][1]) * d[1]) / (d[0] * d[0] + d[1] * d[1]);
    s = std::min(1.0, std::max(0.0, s));
    best = std::min(best, std::hypot(x[0] - line[i - 1][0] - s * d[0], x[1] - line[i - 1][1] - s * d[1]));
  }
  return best;
}

/// Even-odd rule with a ray to the right; `line` is closed along the axis and its top.
bool inside(const std::vector<PlanePoint>& line, const PlanePoint& x) {
  std::vector<PlanePoint> loop = line;
  loop.push_back({0, line.back()[1]});
  bool in = false;
  for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++)
    if ((loop[i][1] > x[1]) != (loop[j][1] > x[1]) &&
        x[0] < loop[i][0] + (loop[j][0] - loop[i][0]) * (x[1] - loop[i][1]) / (loop[j][1] - loop[i][1]))
      in = !in;
  return in;
}

/// Compares the gap with the sampled polyline; normal and turning with differences of gap and normal.
void compare_with_brute_force(const Contour& c, double size) {
  const auto line = c.sample(1e-9 * size);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    const PlanePoint x{1.5 * size * unit(random), 3 * size * (unit(random) - 0.3)};
    const ContourProjection projection = c.closest(x);
    const double distance = brute_force(line, x);
    ASSERT_NEAR(std::abs(projection.gap), distance, 1e-7 * size) << x[0] << " " << x[1];
    if (distance > 1e-6 * size) {
      ASSERT_EQ(projection.gap < 0, inside(line, x)) << x[0] << " " << x[1];
    }
    EXPECT_NEAR(std::hypot(projection.normal[0], projection.normal[1]), 1, 1e-12);
    for (int k = 0; k < 2; ++k)
      EXPECT_NEAR(projection.point[k] + projection.gap * projection.normal[k], x[k], 1e-9 * size);
    const double h = 1e-6 * size;
    ContourProjection side[2][2];
    bool one_piece = true;
    for (int j = 0; j < 2; ++j)
      for (int s = 0; s < 2; ++s) {
        PlanePoint y = x;
        y[j] += s == 0 ? -h : h;
        side[j][s] = c.closest(y);
        one_piece = one_piece && side[j][s].piece == projection.piece && (side[j][s].curvature == projection.curvature);
      }
    if (!one_piece || std::abs(projection.turning) * size > 1e2) continue;
    ++compared;
    for (int j = 0; j < 2; ++j) {
      EXPECT_NEAR((side[j][1].gap - side[j][0].gap) / (2 * h), projection.normal[j], 1e-6);
      for (int k = 0; k < 2; ++k)
        EXPECT_NEAR((side[j][1].normal[k] - side[j][0].normal[k]) / (2 * h),
                    projection.turning * projection.tangent[k] * projection.tangent[j], 1e-4 / size);
    }
  }
  EXPECT_GT(compared, 300);
}

TEST(Contour, RoundedConeAgainstBruteForce) { compare_with_brute_force(contour(cone(1.0, 60, 0.05, 0.1)), 1.0); }
TEST(Contour, SharpConeAgainstBruteForce) { compare_with_brute_force(contour(cone(0.04, 90, 0, 0)), 0.04); }
TEST(Contour, SphereAgainstBruteForce) {
  compare_with_brute_force(contour(text_parameter("type", "sphere") + number_parameter("diameter", 1.2)), 1.2);
}
TEST(Contour, FlatPileAgainstBruteForce) {
  compare_with_brute_force(contour(text_parameter("type", "flat pile") + number_parameter("diameter", 1.0) +
                                   number_parameter("corner radius", 0.2)),
                           1.0);
}
TEST(Contour, PolylineWithHollowFilletAgainstBruteForce) {
  // an enlarged end: the shaft is narrower than the base
  compare_with_brute_force(
      contour(text_parameter("type", "polyline") + array_parameter("x", "0, 0.5, 0.5, 0.25, 0.25") +
              array_parameter("y", "0, 0.1, 0.4, 0.6, 5") + array_parameter("fillet radii", "0.05, 0.1, 0.1, 0.2, 0")),
      1.0);
}

TEST(Contour, TipOfTheRoundedConeIsTheReferencePoint) {
  const double r = 0.05, half = pi / 6;
  const Contour c = contour(cone(1.0, 60, r, 0.1));
  const PlanePoint tip = c.pieces().front()->point(0);
  EXPECT_NEAR(tip[0], 0, 1e-15);
  EXPECT_NEAR(tip[1], 0, 1e-15);
  EXPECT_NEAR(c.closest({0, -0.3}).gap, 0.3, 1e-15);
  EXPECT_NEAR(c.closest({0, -0.3}).normal[1], -1, 1e-15);
  EXPECT_NEAR(c.closest({0, 0}).curvature, 1 / r, 1e-12);
  // the flank's line passes through the sharp apex, r (1/sin - 1) below the tip
  const PlanePoint apex{0, -r * (1 / std::sin(half) - 1)};
  const PlanePoint flank = c.pieces()[1]->point(0.1);
  EXPECT_NEAR(std::atan2(flank[0] - apex[0], flank[1] - apex[1]), half, 1e-12);
  // smooth joints, shaft at the given radius
  for (std::size_t i = 1; i < c.pieces().size(); ++i) {
    const auto a = c.pieces()[i - 1]->tangent(c.pieces()[i - 1]->length()), b = c.pieces()[i]->tangent(0);
    EXPECT_NEAR(a[0] * b[0] + a[1] * b[1], 1, 1e-13);
  }
  EXPECT_NEAR(c.closest({0.7, 3}).gap, 0.2, 1e-12);
  EXPECT_EQ(c.pieces().size(), 4u);
}

TEST(Contour, ShaftContinuesAboveItsDrawnEnd) {
  const Contour c = contour(cone(1.0, 60, 0, 0.1) + number_parameter("shaft length", 0.5));
  EXPECT_NEAR(c.closest({0.4, 50}).gap, -0.1, 1e-12);
  EXPECT_LT(c.sample(1e-3).back()[1], 1.5);
}

TEST(Contour, ArcLengthGrowsAlongThePath) {
  const Contour c = contour(cone(1.0, 60, 0.05, 0.1));
  double last = -1;
  for (const PlanePoint& p : c.sample(1e-4)) {
    const double s = c.closest(p).arc_length;
    EXPECT_GT(s, last);
    last = s;
  }
  EXPECT_NEAR(last, c.length(), 1e-9);
}

TEST(Contour, CornersOutsideInsideAndAtThePoint) {
  const Contour c = contour(text_parameter("type", "flat pile") + number_parameter("diameter", 2.0));
  const ContourProjection fan = c.closest({1.3, -0.4});
  EXPECT_NEAR(fan.gap, 0.5, 1e-14);
  EXPECT_NEAR(fan.normal[0], 0.6, 1e-14);
  EXPECT_NEAR(fan.normal[1], -0.8, 1e-14);
  EXPECT_NEAR(fan.turning, 2, 1e-13);
  const ContourProjection at = c.closest({1, 0});
  EXPECT_EQ(at.gap, 0);
  EXPECT_NEAR(at.normal[0], std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(at.normal[1], -std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(c.closest({0.9, 0.2}).normal[0], 1, 1e-14);   // nearer to the shaft
  EXPECT_NEAR(c.closest({0.8, 0.1}).normal[1], -1, 1e-14);  // nearer to the base
  // a re-entrant corner: inside the body the fan belongs to it
  const Contour hollow =
      contour(text_parameter("type", "polyline") + array_parameter("x", "0, 1, 2") + array_parameter("y", "0, 1, 1"));
  const ContourProjection projection = hollow.closest({0.95, 1.2});
  EXPECT_LT(projection.gap, 0);
  EXPECT_NEAR(projection.gap, -std::hypot(0.05, 0.2), 1e-12);
  EXPECT_NEAR(projection.normal[1], (1.2 - 1) / projection.gap, 1e-12);
}

TEST(Contour, ArcLengthTravelsWithThePointAndRoundTheSeam) {
  const Contour ball = contour(text_parameter("type", "sphere") + number_parameter("diameter", 2.0)).mirrored();
  const double inside = 0.9, turn = 1e-3, seam = 2 * std::atan(1.0);  // a full circle starts and ends at the top
  const auto at = [&](double angle) { return ball.closest({inside * std::cos(angle), 1 + inside * std::sin(angle)}); };
  for (const double angle : {-1.2, 0.3, seam - turn / 2})
    EXPECT_NEAR(ball.distance(at(angle), at(angle + turn)), turn, 1e-12) << angle;
  EXPECT_NEAR(at(0.3).travel, 1 / inside, 1e-12);  // per distance travelled by the point at its smaller radius
  const Contour c = contour(cone(1.0, 60, 0.0, 0.0));
  EXPECT_EQ(c.closest({0.1, 0.0}).travel, 1);
}

TEST(Contour, NodesJustLeftOfTheAxisMirror) {
  const Contour c = contour(cone(1.0, 60, 0.0, 0.0));
  const ContourProjection right = c.closest({1e-3, 0.1}), left = c.closest({-1e-3, 0.1});
  EXPECT_EQ(left.gap, right.gap);
  EXPECT_EQ(left.normal[0], -right.normal[0]);
  EXPECT_NEAR(c.closest({-1e-18, -0.1}).normal[1], -1, 1e-14);
}

TEST(Contour, FullContourIsTheHalfAndItsImage) {
  const Contour half = contour(cone(1.0, 60, 0.05, 0.1)),
                full = contour(cone(1.0, 60, 0.05, 0.1) + text_parameter("extent", "full"));
  EXPECT_NEAR(full.length(), 2 * half.length(), 1e-12);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 100; ++i) {
    const PlanePoint x{unit(random), 2 * unit(random)};
    EXPECT_NEAR(full.closest(x).gap, half.closest(x).gap, 1e-12);
    EXPECT_NEAR(full.closest(x).turning, half.closest(x).turning, 1e-9);
  }
}

TEST(Contour, SampleKeepsTheChordError) {
  const Contour c = contour(text_parameter("type", "sphere") + number_parameter("diameter", 2.0));
  const auto line = c.sample(1e-3);
  for (std::size_t i = 1; i < line.size(); ++i) {
    const ContourProjection middle =
        c.closest({0.5 * (line[i][0] + line[i - 1][0]), 0.5 * (line[i][1] + line[i - 1][1])});
    EXPECT_LE(std::abs(middle.gap), 1e-3);
  }
  EXPECT_LT(line.size(), 50u);
}

TEST(Contour, WrongSizesAreNamed) {
  const auto has = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  has(contour_error(cone(-1, 60, 0, 0)), "diameter");
  has(contour_error(cone(0, 60, 0, 0)), "diameter");
  has(contour_error(cone(1, 0, 0, 0)), "apex angle [deg]");
  has(contour_error(cone(1, 200, 0, 0)), "apex angle [deg]");
  has(contour_error(cone(1, 60, 0.7, 0)),
      "contour/tip radius: 'tip radius' = 0.7 is too large: its fillet takes 1.21244 m of the 1 m long flank");
  has(contour_error(cone(1, 60, 0.5, 0.9)), "contour/shoulder radius: 'shoulder radius' = 0.9 is too large");
  has(contour_error(cone(1, 60, 0, 0.5) + number_parameter("shaft length", 0.1)), "'shaft length' = 0.1 is too short");
  const std::string pile = text_parameter("type", "flat pile") + number_parameter("diameter", 1);
  has(contour_error(pile + number_parameter("corner radius", 0.6)),
      "'corner radius' = 0.6 must not exceed half the diameter, 0.5");
  const auto polyline = [](const std::string& x, const std::string& y) {
    return text_parameter("type", "polyline") + array_parameter("x", x) + array_parameter("y", y);
  };
  has(contour_error(polyline("0, 1, 1", "0, 1")), "'y' has 2 values, 'x' has 3");
  has(contour_error(polyline("1, 1, 0", "5, 1, 0")), "the first x must be 0");
  has(contour_error(polyline("0, 1, 0", "2, 1, 0")), "inverted");
  has(contour_error(polyline("0, 1, 1", "0, 0, 0")), "points 2 and 3 are the same");
  has(contour_error(polyline("0, 1, 1", "0, 0, 1") + array_parameter("fillet radii", "0, 2, 0")),
      "points 1 and 2 are too large for the 1 m");
  has(contour_error(polyline("1, 1, -1, -1", "3, 0, 0, 3") + text_parameter("extent", "full")), "inverted");
  has(contour_error(text_parameter("type", "cube")), "unknown contour type 'cube'");
}

}  // namespace
}  // namespace mudline
