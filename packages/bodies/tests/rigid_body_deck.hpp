#pragma once

#include <map>
#include <memory>
#include <string>

#include "bodies/rigid_body.hpp"
#include "core/deck.hpp"
#include "core/tests/deck_text.hpp"

namespace mudline {

/// A deck in memory with one body.
struct BodyDeck {
  explicit BodyDeck(const std::string& bodies) {
    deck.overlay("<ParameterList name=\"deck\">\n" + bodies + "</ParameterList>\n", "deck.xml");
    register_contours(contours);
    register_surfaces(surfaces);
    register_motions(motions);
  }
  std::shared_ptr<RigidBody> body(const std::string& name, Geometry geometry) {
    return RigidBody::read(deck.root().section("bodies").section(name), geometry, {contours, surfaces, motions});
  }
  Deck deck;
  Registry<ContourShape> contours{"contour"};
  SurfaceRegistry surfaces{"surface"};
  Registry<BodyMotion> motions{"motion"};
};

/// bodies/<name> with the given contour parameters, vertical velocity and position.
inline std::string body_xml(const std::string& name, const std::string& contour, const std::string& motion,
                            const std::string& position = "0, 0", const std::string& more = "") {
  return "<ParameterList name=\"bodies\">\n<ParameterList name=\"" + name + "\">\n" + more +
         array_parameter("position", position) + "<ParameterList name=\"contour\">\n" + contour +
         "</ParameterList>\n<ParameterList name=\"motion\">\n" + motion +
         "</ParameterList>\n</ParameterList>\n</ParameterList>\n";
}

/// The entry bodies/b with a "surface" in space, or with a "contour" in the plane, given as text; at rest unless a
/// motion is given.
inline std::string shaped_xml(const std::string& shape, const std::string& parameters, const std::string& more,
                              const std::string& position,
                              const std::string& motion = text_parameter("type", "prescribed velocity")) {
  const std::string space =
      shape == "surface" ? section_xml("mesh", text_parameter("geometry", geometry_in_space)) : "";
  return space +
         section_xml("bodies", section_xml("b", more + array_parameter("position", position) +
                                                    section_xml(shape, parameters) + section_xml("motion", motion)));
}

/// A box with its centre at the body's reference point.
inline std::string beam(double x, double y, double z) {
  return text_parameter("type", "box") + number_parameter("length x", x) + number_parameter("length y", y) +
         number_parameter("length z", z) + number_parameter("fillet radius", 0.02);
}

}  // namespace mudline
