// Volumes, sections and frontal areas of contours whose formulas are known.
#include "bodies/contour_volume.hpp"

#include <gtest/gtest.h>

#include "bodies/tests/rigid_body_deck.hpp"
#include "core/pi.hpp"

namespace mudline {
namespace {

std::shared_ptr<RigidBody> read(const std::string& contour, Geometry geometry) {
  BodyDeck deck(body_xml("b", contour, text_parameter("type", "held")));
  return deck.body("b", geometry);
}

TEST(ContourVolume, CapsOfASphere) {
  const auto body = read(text_parameter("type", "sphere") + number_parameter("diameter", 2), Geometry::axisymmetric);
  const ContourVolume& volume = *body->properties().enclosed;
  EXPECT_NEAR(volume.total(), 4 * pi / 3, 1e-12);
  EXPECT_NEAR(volume.frontal_area(), pi, 1e-12);
  for (const double h : {-0.1, 0.0, 0.03, 0.7, 1.0, 1.9, 2.0, 2.5}) {
    const double in = std::min(std::max(h, 0.0), 2.0);  // the lowest point is the reference point
    EXPECT_NEAR(volume.below(h), pi * in * in * (3 - in) / 3, 1e-12) << h;
    EXPECT_NEAR(volume.section(h), pi * in * (2 - in), 1e-12) << h;
  }
  EXPECT_EQ(body->properties().volume, volume.total());
}

TEST(ContourVolume, SegmentsOfALyingCylinder) {
  const auto body =
      read(text_parameter("type", "cylinder") + text_parameter("extent", "full") + number_parameter("diameter", 2),
           Geometry::plane_strain);
  const ContourVolume& volume = *body->properties().enclosed;
  EXPECT_NEAR(volume.total(), pi, 1e-12);
  EXPECT_NEAR(volume.frontal_area(), 2, 1e-12);
  for (const double h : {0.2, 1.0, 1.5}) {
    const double y = h - 1;
    EXPECT_NEAR(volume.below(h), pi / 2 + y * std::sqrt(1 - y * y) + std::asin(y), 1e-12) << h;
    EXPECT_NEAR(volume.section(h), 2 * std::sqrt(1 - y * y), 1e-10) << h;
  }
}

TEST(ContourVolume, AnOpenContourHasNoVolumeButOneBelowAHeight) {
  const std::string tube = text_parameter("type", "polyline") + array_parameter("x", "0, 1, 2, 2") +
                           array_parameter("y", "0, 0, 1, 4");  // a truncated cone and a cylinder
  for (const Geometry geometry : {Geometry::axisymmetric, Geometry::plane_strain}) {
    const bool round = geometry == Geometry::axisymmetric;
    const auto body = read(tube, geometry);
    const ContourVolume& volume = *body->properties().enclosed;
    EXPECT_EQ(volume.total(), 0);
    EXPECT_EQ(body->properties().volume, 0);
    EXPECT_NEAR(volume.below(3), round ? pi * (7 / 3.0 + 2 * 4) : 1.5 + 2 * 2, 1e-12);
    EXPECT_NEAR(volume.section(0.5), round ? pi * 2.25 : 1.5, 1e-12);
    EXPECT_NEAR(volume.section(3), round ? pi * 4 : 2, 1e-12);
    EXPECT_NEAR(volume.frontal_area(), round ? pi * 4 : 2, 1e-12);
  }
}

}  // namespace
}  // namespace mudline
