// Deck entries of a penalty contact, and their binding to the model.
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "contact/body/penalty_contact.hpp"
#include "core/guarded.hpp"
#include "discretisation/mesh_topology.hpp"

namespace mudline {

void PenaltyParameters::parameters(Parameters& p) {
  p.required("body", body, "Entry of 'bodies' that touches the soil");
  p.required("surface", surface, "Side set of the soil that the body may touch");
  p.choice("method", method, {{"surface quadrature", ContactPoints::quadrature}, {"nodes", ContactPoints::nodes}},
           "Where contact is checked: at Gauss points of the sides, or at the nodes with their tributary areas");
  p.add("quadrature degree", quadrature_degree, "-", closed(1, 11),
        "Polynomial degree that the integration over a side is exact for");
  EnforcementParameters::parameters(p);
  p.add("capture distance", capture_distance, "m", non_negative(),
        "Sides farther away than this at the start of a step are skipped in it; 0: two sides and the body's advance");
  drainage.parameters(p);
  initial_gap.parameters(p);
  p.choice(
      "impact", impact,
      {{"automatic", Impact::automatic}, {"conserving", Impact::conserving}, {"interpolated", Impact::interpolated}},
      "Forces over a dynamic step. conserving: points exert the share of their force that adds no "
      "energy, whatever the step and the spectral radius; interpolated: the integrator's mean of start and end, "
      "smoother where a body is pushed "
      "steadily; automatic: conserving for a body that may be free in a contact by penalty, interpolated otherwise");
  p.add("damping", damping, "s/m", non_negative(), damping_documentation);
  ContactLaws::declare_normal_law(p);
  p.add("advance limit", advance_limit, "-", positive(),
        "Largest advance of the body in one step, as a fraction of the surface's shortest side; while the body is far "
        "away, half the distance to the surface");
}

void PenaltyContact::document(Parameters& p) {
  PenaltyParameters().parameters(p);
  declare_friction(p);
}

void PenaltyContact::parameters(Parameters& p) {
  deck_.parameters(p);
  declare_friction(p);
}

void PenaltyContact::check(const Section& section) {
  const Mesh& mesh = context_.space.mesh();
  const auto body = context_.bodies.find(deck_.body);
  if (body == context_.bodies.end()) {
    std::vector<std::string> names;
    for (const auto& entry : context_.bodies) names.push_back(entry.first);
    section.fail("unknown body '" + deck_.body + "'" + suggestion(deck_.body, names), "body");
  }
  body_ = body->second;
  read(section);
  require_boundary(mesh, section, "surface", deck_.surface);
  if (deck_.penalty == 0 && !context_.stiffness)
    throw std::logic_error("an automatic penalty needs the soil's stiffness");
  check_enforcement(section);
  check_quadrature(section);
  laws_.read(context_, section);
  laws_.check_linear(section, deck_.augmented(), deck_.impact == PenaltyParameters::Impact::conserving);
  check_parts(section, deck_.impact == PenaltyParameters::Impact::conserving, deck_.damping > 0);
  make_points(deck_.surface, body_->unknowns(), deck_.method, deck_.quadrature_degree);
  if (surface_->num_global_sides() == 0) section.fail("side set '" + deck_.surface + "' has no sides", "surface");
  gap_tolerance_ = deck_.gap_tolerance > 0 ? deck_.gap_tolerance : 1e-6 * surface_->shortest(mesh.coordinates());
  candidate_.assign(surface_->sides().size(), 1);
  if (context_.remeshed) return;
  check_overlap(section);
  check_above(section);
}

void PenaltyContact::check_enforcement(const Section& section) const {
  deck_.check(section);
  if (!deck_.augmented()) return;
  if (deck_.impact == PenaltyParameters::Impact::conserving)
    section.fail(
        "conserving is for 'enforcement' = penalty: its shares are those of the penalty spring's energy, which "
        "multipliers "
        "do not have; allowed with augmented Lagrangian: automatic, interpolated",
        "impact");
}

void PenaltyContact::check_quadrature(const Section& section) const {
  const Mesh& mesh = context_.space.mesh();
  if (mesh.dimension() == 2) return;
  if (deck_.method == ContactPoints::nodes)
    section.fail("nodes has no tributary areas on quadratic triangles; allowed in space: surface quadrature", "method");
  constexpr int most = 8;  // largest degree of the rules for triangles
  for (const ElementBlock& block : mesh.blocks())
    for (int s = 0; s < num_sides(block.shape); ++s)
      if (is_simplex(side_shape(block.shape, s)) && deck_.quadrature_degree > most)
        section.fail("on triangles the largest 'quadrature degree' is " + std::to_string(most) + ", given " +
                         std::to_string(deck_.quadrature_degree),
                     "quadrature degree");
}

void PenaltyContact::check_above(const Section& section) const {
  const Mesh& mesh = context_.space.mesh();
  const Teuchos::Comm<int>& comm = *mesh.comm();
  const int up = axes() - 1;
  double lowest = 1e300, everywhere = 0, upwards = 0, faces_up = 0;
  for (const SurfaceSide& side : surface_->sides()) {
    for (int a = 0; a < side.count; ++a) lowest = std::min(lowest, mesh.place(side.node[a])[up]);
    const Point first = mesh.place(side.node[0]), along = mesh.place(side.node[1]) - first;
    // outward: in the plane on the right of the side's direction; in space the corners are counter-clockwise seen from
    // outside
    upwards += up == 1 ? -along[0] : cross(along, mesh.place(side.node[2]) - first)[2];
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, lowest, Teuchos::outArg(everywhere));
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, upwards, Teuchos::outArg(faces_up));
  if (body_->surface() && !std::isfinite(body_->surface()->bounds().extent())) return;  // it goes on for ever
  double top = -1e300;
  for (const Point& point : body_->outline(body_->initial_placement())) top = std::max(top, point[up]);
  if (top >= everywhere - 0.5 * surface_->shortest(mesh.coordinates()) || faces_up <= 0) return;
  char text[160];
  std::snprintf(
      text, sizeof text,
      "' lies below the surface: its top is at %.6g m, the surface reaches down to %.6g m; move its 'position'", top,
      everywhere);
  section.fail("body '" + deck_.body + text, "body");
}

void PenaltyContact::check_overlap(const Section& section) const {
  const auto& x = context_.space.mesh().coordinates();
  const Teuchos::Comm<int>& comm = *context_.space.mesh().comm();
  double deepest = 0;
  Point worst{};
  for (const SurfaceSide& side : surface_->sides())
    for (int a = 0; a < side.count; ++a) {
      const Point at = surface_->mesh().place(side.node[a]);
      const double gap = body_->gap(body_->initial_placement(), at);
      if (gap >= deepest) continue;
      deepest = gap;
      worst = at;
    }
  double everywhere = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, deepest, Teuchos::outArg(everywhere));
  const double edge = surface_->shortest(x);
  // A side that is straight between its nodes reaches a little into a round contour that it follows.
  if (-everywhere <= 0.5 * edge) return;
  const int mine = deepest == everywhere ? comm.getRank() : comm.getSize();
  int teller = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(teller));
  Teuchos::broadcast(comm, teller, 3, worst.data());
  char text[200];
  std::snprintf(text, sizeof text,
                "' overlaps the surface by %.4g m at %s at the start, more than half of its shortest side, %.4g m; "
                "move its 'position'",
                -everywhere, place_text(worst, axes()).c_str(), edge);
  section.fail("body '" + deck_.body + text, "body");
}

}  // namespace mudline
