#pragma once

#include "contact/contact_rule.hpp"
#include "contact/laws/contact_point.hpp"
#include "tensor/mat.hpp"

namespace mudline {

/// A face of the master surface: its nodes [m], and their unit normals, outward. The normal between them is
/// interpolated, so that it is continuous over the edges of faces that share it.
struct MasterFace {
  CellShape shape;
  int count;  // nodes
  SideCoordinates x, normal;
};

/// Where a point is above a face: x = y(xi) + gap n(xi).
struct FaceFoot {
  double xi[2] = {};
  double gap = 0;  // [m]
};

/// The foot of a point; false where the face has none: it is beside the face, or the face is too bent.
bool find_foot(const MasterFace& face, const Point& at, FaceFoot& foot);

/// Unit normal of the face at the foot.
Point face_normal(const MasterFace& face, const FaceFoot& foot);

/// A point of the slave surface before it is evaluated. The area is that of the start of the step [m2]; `x_old` is the
/// face there [m]; normals are those of the start of the step.
struct FacePoint {
  const ContactPointLaw& law;
  const MasterFace& face;
  const SideCoordinates& x_old;
  FaceFoot foot;
  Point slave_old;                    // [m] at the start of the step
  double area;                        // [m2]
  double gap_old = 0, force_old = 0;  // [m], [N] normal: committed
  Point shear_old{}, normal_old{};    // [Pa] on the slave, across the normal that it was found with: committed
  double slip_old = 0;                // [m] committed
  bool slid = false;                  // in the step before
  TouchingSoil soil{};                // of the slave
};

/// What acts between the point and the face. Derivatives are by the point's place less its foot's,
/// d = x - sum_a N_a(xi) x_a with xi held: since x = y + g n, all that the step's end changes follows from d.
struct FaceForce {
  bool presses = false, slides = false;
  Point force{}, damping{};       // [N] on the slave: at the end of the step; added by damping to the mean over it
  Point acting{};                 // [N] share * force + damping / the end's weight in the integrator's force
  Mat<double, 3> acting_slope;    // [N/m] (component, direction of d)
  double weight[max_side_nodes];  // of the face's nodes: they get the opposite forces
  double weight_slope[max_side_nodes][3];  // [1/m]
  double share = 1, start_share = 0;       // see NodeForce
  double start_share_slope[3];             // [1/m]
  double pressure = 0;                     // [Pa]
  Point shear{}, normal{};                 // [Pa] on the slave; of the master
  double slip = 0, heat = 0, damped = 0;   // [m], [J], [J] of this step
};

/// The point law at a point against its foot: pressure along the master's normal, friction from the relative
/// displacement of the point and of the material at its foot in the step. The tangent is exact but for the normals of
/// nodes and the area, which are those of the start of the step.
void face_force(const FacePoint& point, bool want_tangent, FaceForce& out);

}  // namespace mudline
