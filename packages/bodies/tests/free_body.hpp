#pragma once

#include <memory>
#include <string>

#include "bodies/body_terms.hpp"
#include "bodies/tests/rigid_body_deck.hpp"
#include "discretisation/tests/mesh_fixture.hpp"

namespace mudline {

/// A motion "free" or "force" with the given freedom, a list of quoted directions.
inline std::string released_xml(const std::string& type, const std::string& freedom, const std::string& more = "") {
  return text_parameter("type", type) + "<Parameter name=\"freedom\" type=\"Array(string)\" value=\"{" + freedom +
         "}\"/>\n" + more;
}

/// A body with unknowns beside one element of soil, with committed and trial state.
struct FreeBody {
  FreeBody(const std::string& deck_text, Geometry geometry)
      : deck(deck_text),
        body(deck.body("b", geometry)),
        mesh(mesh_test::make(geometry == Geometry::space ? mesh_test::box3("hex8", 1, 1, 1)
                                                         : mesh_test::box("quad4", 1, 1))),
        space(*mesh, {{"displacement", "m", "N", vector_components, Support::all_nodes, 2},
                      {"body motion", "m", "N", RigidBody::unknowns_per_body(geometry), Support::apart, 2, 1}}),
        store(space) {
    body->bind(space, 1, 0);
    body->declare_state(store);
  }

  int dof(int k) const { return body->unknowns().dof[k]; }
  double scale(int k) const { return body->unknowns().scale[k]; }
  /// Releases the body in the committed state, with no force but those of its motion. Returns its accelerations along
  /// the directions [m/s2, rad/s2].
  std::vector<double> release() {
    State& state = store.committed();
    const NodalView rest("rest", state.rate.extent(0)), unbalanced("unbalanced", state.rate.extent(0));
    const BodyLevel resting(*body, state, rest);
    const BodyLoad standing = load(*body, resting);
    for (int k = 0; k < body->unknowns().count; ++k) unbalanced(dof(k)) = -generalised(*body, resting, standing, k).v;
    set_free(*body, state, unbalanced, true);
    std::vector<double> result;
    for (int k = 0; k < body->unknowns().count; ++k) result.push_back(state.acceleration(dof(k)) * scale(k));
    return result;
  }

  BodyDeck deck;
  std::shared_ptr<RigidBody> body;
  std::unique_ptr<Mesh> mesh;
  Space space;
  StateStore store;
};

}  // namespace mudline
