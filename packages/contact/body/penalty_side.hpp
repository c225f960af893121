#pragma once

#include "bodies/rigid_body.hpp"
#include "contact/contact_rule.hpp"
#include "contact/laws/contact_point.hpp"
#include "contact/parts/film_law.hpp"
#include "contact/point_data.hpp"
#include "framework/vector_scatter.hpp"
#include "tensor/mat.hpp"

namespace mudline {

/// Unknowns of the body, and its placements at both ends of a step.
struct BodyInStep {
  BodyUnknowns unknowns;
  BodyPlacement old, now;
  Point turning[3] = {};  // BodyPlacement::turning of `now`
};

/// Closest point of the body to a contact point, as the search on the host found it: from a ContourProjection or a
/// SurfaceProjection.
struct BodyPlace {
  double gap = 0;               // [m]
  Point normal{}, point{};      // [-], [m]
  Mat<double, 3> turning = {};  // [1/m] dn/dx; in the plane (0, 0) is that along the tangent
  double travel = 0;            // [-] in the plane: path of the closest point per displacement along the contour
};

/// History of a contact point, and its closest points as the search on the host found them.
struct ContactStart : PointHistory {
  BodyPlace now, before;        // at the ends of the step; `before` only where looks_back()
  double contour_distance = 0;  // [m] in the plane: from closest point to closest point along the contour
  double height = 0;            // [m] in the body's frame above its reference point
};

/// One side of the soil's surface against a body, at both ends of a step.
struct SideContact {
  bool near = false;             // else it is not evaluated
  int first = 0;                 // row of its first point
  SideCoordinates x_old{}, x{};  // [m]
  ContactPointLaw law;
  /// [m] Points nearer than this count as pressing and sticking in the tangent, not in the force: a body without
  /// inertia that touches nothing yet would have no stiffness at all.
  double reach = 0;
  double reach_share = 1;  // of the penalty that such points have in the tangent
  SideFilm film;
  int pressure_nodes = 0;                // number of the side's first nodes that carry pore pressure; 0: none is read
  double pressure[max_side_nodes] = {};  // [Pa] at these nodes
};

/// Whether the response of a point with this gap depends on the start of the step.
inline bool looks_back(const SideContact& side, double shift, double gap) {
  if (side.law.conserves || side.law.viscous > 0 || side.film.flows) return true;
  ContactMotion<double> motion;
  motion.gap = gap;
  motion.shift = shift;
  return side.law.friction && presses(side.law, motion);
}

/// The sides of one shape, with rows of their points that all shapes share.
struct ContactSides {
  ContactTables rule;
  Geometry geometry;
  BodyInStep body;
  Kokkos::View<SideContact*> sides;    // by row of the shape's dofs
  Kokkos::View<ContactStart*> starts;  // by row of points
  Kokkos::View<ContactPoint*> points;  // results, written by add_side_forces()
};

/// The point law at the contact points of a side: f_a = sum_c shape_ca (t n + s) A_c with the pressure t, the normal n
/// from the body into the soil and the shear stress s along the surface; with a film t is the sum of the normal law's
/// pressure and the pore pressure. The body gets the opposite force and its moment. A film takes the rate of its water
/// from the soil. It conducts h^3/(12 viscosity) (gradient of its pressure less the water's weight), with gradients
/// along the side as it was at the start of the step.
///
/// Dofs of a side: the nodes' displacements, node after node, component after component; then (with laws that read
/// them, and a film) the pore pressures of the first nodes, whose rows are the water that leaves the soil [m3/s] into
/// the film; then the body's unknowns.
///
/// Adds the forces on soil and body at the end of the step to the residual, R -= f; what is to be added at the alpha
/// level (shares of impacts, damping, and the water) goes to `later` (side, dof), with the sign of -R. Returns the
/// number of degenerate sides.
int add_side_forces(const ContactSides& sides, const RowLists& rows, const VectorScatter& to, const PointView& later);

/// Weights of a tangent: `weight` of forces, `moved` of positions for the unknowns. Water is added only with a `film`,
/// with weight 1.
struct SideWeights {
  double weight, moved;
  bool film;
};
/// Adds the exact derivatives of f and of what is added later: by gap, normal (curvature of the body), travel, area and
/// radius of the side, position and rotation of the body.
void add_side_tangents(const ContactSides& sides, const RowLists& rows, const MatrixScatter& to,
                       const SideWeights& weights);

}  // namespace mudline
