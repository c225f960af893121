#include "contact/nodes/node_contact.hpp"

#include "core/pi.hpp"

namespace mudline {

void NodeParameters::parameters(Parameters& p) {
  TwoSurfaceParameters::parameters(p);
  p.choice("master surface", drawing,
           {{"hermite", Drawing::hermite},
            {"bezier", Drawing::bezier},
            {"linear", Drawing::linear},
            {"sides", Drawing::sides}},
           "How the master is drawn over its nodes: hermite: smooth (C1) through them; bezier: smooth, from the middle "
           "between two nodes to the "
           "next, with the node as control point; linear: straight from node to node; sides: the elements' own sides, "
           "straight or parabolic");
  declare_corner_angle(p);
  p.add("overhang", overhang, "-", non_negative(),
        "An open end of the master goes on for this fraction of its last piece");
  declare_rest(p);
}

void NodeContact::check(const Section& section) {
  const Mesh& mesh = context_.space.mesh();
  check_entries(section, 2);
  if ((deck_.drawing == Drawing::linear || deck_.drawing == Drawing::sides) &&
      section.has_parameter("corner angle [deg]"))
    section.fail("has a meaning only with a smooth 'master surface'; allowed with it: hermite, bezier",
                 "corner angle [deg]");
  const MasterSurface master(mesh, deck_.master);
  constexpr int quadrature_degree = 5;  // of tributary areas: exact on straight quadratic sides
  bind(section,
       std::make_unique<SmoothSurface>(master.sides(), deck_.drawing, deck_.corner_angle * pi / 180, deck_.overhang,
                                       mesh.coordinates()),
       SideRule::At::nodes, quadrature_degree, deck_.reach > 0 ? deck_.reach : 1e300);
}

}  // namespace mudline
