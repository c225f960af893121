#pragma once

#include "contact/contact_rule.hpp"
#include "contact/laws/contact_point.hpp"
#include "tensor/mat.hpp"

namespace mudline {

/// A face of the master surface: its nodes [m] and their outward unit normals. The normal between them is interpolated,
/// so that it is continuous over the edges of faces that share it.
struct MasterFace {
  CellShape shape;
  int count;  // nodes
  SideCoordinates x, normal;
};

/// Closest point of a point x on a face: x = y(xi) + gap n(xi).
struct FaceProjection {
  double xi[2] = {};
  double gap = 0;  // [m]
};

/// Finds the closest point; false where the face has none: the point is beside the face, or the face is too curved.
bool find_projection(const MasterFace& face, const Point& at, FaceProjection& projection);

/// Unit normal of the face at the closest point.
Point face_normal(const MasterFace& face, const FaceProjection& projection);

/// A point of the slave surface before it is evaluated. The area is that of the start of the step [m2]; `x_old`: the
/// face's nodes then [m]. Normals are those of the start of the step.
struct FacePoint {
  const ContactPointLaw& law;
  const MasterFace& face;
  const SideCoordinates& x_old;
  FaceProjection projection;
  Point slave_old;                    // [m] at the start of the step
  double area;                        // [m2]
  double gap_old = 0, force_old = 0;  // [m], [N] normal: committed
  Point shear_old{}, normal_old{};    // [Pa] on the slave, perpendicular to `normal_old`: committed
  double slip_old = 0;                // [m] committed
  bool slid = false;                  // in the step before
  TouchingSoil soil{};                // of the slave
};

/// Forces between the point and the face. Derivatives are by the distance vector d = x - sum_a N_a(xi) x_a with fixed
/// xi: since x = y + g n, all that depends on the end of the step follows from d.
struct FaceForce {
  bool presses = false, slides = false;
  Point force{}, damping{};       // [N] on the slave: at the end of the step; added by damping to the mean over it
  Point acting{};                 // [N] share * force + damping / the end's weight in the integrator's force
  Mat<double, 3> acting_slope;    // [N/m] (component, direction of d)
  double weight[max_side_nodes];  // of the face's nodes, which get the opposite forces
  double weight_slope[max_side_nodes][3];  // [1/m]
  double share = 1, start_share = 0;       // see NodeForce
  double start_share_slope[3];             // [1/m]
  double pressure = 0;                     // [Pa]
  Point shear{}, normal{};                 // [Pa] on the slave; of the master
  double slip = 0, heat = 0, damped = 0;   // [m], [J], [J] of this step
};

/// The point law at a point against its closest point: pressure along the master's normal, friction from the relative
/// displacement of the point and of the material at its closest point in the step. The tangent is exact except for the
/// normals of nodes and the area, which are those of the start of the step.
void face_force(const FacePoint& point, bool want_tangent, FaceForce& out);

}  // namespace mudline
