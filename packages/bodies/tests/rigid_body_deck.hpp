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

}  // namespace mudline
