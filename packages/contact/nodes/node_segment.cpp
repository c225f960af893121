#include "contact/nodes/node_segment.hpp"

#include <algorithm>
#include <cmath>

#include "contact/vector.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// Positions as numbers of type T, with derivatives where they are unknowns.
template <class T>
struct Positions {
  explicit Positions(const NodeCoordinates& x) : slave(unknown<T>(x.slave, 0)) {
    for (int j = 0; j < max_piece_nodes; ++j) master[j] = unknown<T>(x.master[j], 2 + 2 * j);
  }
  Vec<T, 2> slave, master[max_piece_nodes];
};

/// The closest point with its derivatives.
template <class T>
struct ProjectionPlace {
  T W[max_piece_nodes];
  T gap;
  Vec<T, 2> normal, along, point;
};

/// Normal and gap at a corner: the normal is the direction from the corner to the node, or the mean normal on the
/// corner itself.
template <class T>
void look_from_corner(const SurfacePiece& piece, const NodeProjection& at, const Positions<T>& x,
                      ProjectionPlace<T>& g) {
  const Vec<T, 2> offset = x.slave - g.point, chord = x.master[piece.count - 1] - x.master[0];
  g.normal = constant<T>(at.outward);
  g.gap = dot(offset, g.normal);
  if (std::sqrt(value(dot(offset, offset))) > 1e-12 * std::sqrt(value(dot(chord, chord)))) {
    g.gap = value(g.gap) < 0 ? -1.0 * length(offset) : length(offset);
    g.normal = offset / g.gap;
  }
  g.along = {-1.0 * g.normal[1], g.normal[0]};
}

template <class T>
ProjectionPlace<T> geometry(const SurfacePiece& piece, const NodeProjection& at, const Positions<T>& x) {
  ProjectionPlace<T> g;
  T dW[max_piece_nodes], ddW[max_piece_nodes];
  piece.weights(T(at.eta), g.W, dW, ddW);
  g.point = combine(piece.count, g.W, x.master);
  if (at.corner) {
    look_from_corner(piece, at, x, g);
    return g;
  }
  // eta follows from way . y' = 0 by one step of Newton's method, which does not change its value
  const Vec<T, 2> offset = x.slave - g.point, tangent = combine(piece.count, dW, x.master),
                  bend = combine(piece.count, ddW, x.master);
  const T ahead = dot(offset, tangent);
  const double slope = value(dot(offset, bend) - dot(tangent, tangent));
  const T eta = at.eta - (ahead - value(ahead)) / slope;
  piece.weights(eta, g.W, dW, ddW);
  g.point = combine(piece.count, g.W, x.master);
  const Vec<T, 2> direction = combine(piece.count, dW, x.master);
  g.along = direction / length(direction);
  g.normal = {g.along[1], -1.0 * g.along[0]};
  g.gap = dot(x.slave - g.point, g.normal);
  return g;
}

template <class T>
ContactMotion<T> motion_of_node(const NodeLaw& law, const SurfacePiece& piece, const ProjectionPlace<T>& g,
                                const Positions<T>& x, const NodeCoordinates& old) {
  ContactMotion<T> motion;
  motion.gap = g.gap;
  motion.shift = T(law.normal / law.penalty);
  motion.soil = law.soil;
  motion.pore_pressure = T(law.soil.pore_pressure);
  motion.gap_old = T(law.gap_old);
  motion.force_old = T(law.normal_old);
  motion.area = T(law.area);
  if (!law.friction || !presses(law, motion)) return motion;
  Vec<T, 2> was_master[max_piece_nodes];
  for (int j = 0; j < max_piece_nodes; ++j) was_master[j] = constant<T>(old.master[j]);
  const Vec<T, 2> was = constant<T>(old.slave), projection_was = combine(piece.count, g.W, was_master);
  motion.travel = dot((x.slave - was) - (g.point - projection_was), g.along);
  if (law.normal == 0) motion.opened = dot(was - projection_was, g.normal);
  motion.shear_old = T(law.shear);
  motion.slip_old = law.slip;
  motion.position = {old.slave[0], old.slave[1], 0};
  return motion;
}

/// Adds a force on the slave node, and the opposite at its closest point.
template <class T>
void act(const SurfacePiece& piece, const ProjectionPlace<T>& g, const Vec<T, 2>& force, T (&to)[node_dofs]) {
  to[0] = force[0];
  to[1] = force[1];
  spread(piece.count, g.W, force * -1.0, to + 2);
}

template <class T>
void evaluate(const NodeLaw& law, const SurfacePiece& piece, const NodeProjection& projection,
              const NodeCoordinates& old, const NodeCoordinates& at, NodeForce& out) {
  const Positions<T> x(at);
  const ProjectionPlace<T> g = geometry(piece, projection, x);
  const ContactResponse<T> now = respond(law, motion_of_node(law, piece, g, x, old));
  StepForces<T, node_dofs> forces;
  if (law.viscous > 0) act(piece, g, g.normal * now.damping, forces.more);
  if (now.presses) act(piece, g, (g.normal * now.pressure + g.along * now.shear) * law.area, forces.end);
  const T share = now.end_share / (1 - law.start_weight);
  forces.write(share, 1 / (1 - law.start_weight), out.f, out.damping, out.k);
  if constexpr (!std::is_same_v<T, double>) std::copy_n(now.start_share.d, node_dofs, out.start_share_slope);
  out.start_share = value(now.start_share);
  if (now.presses) out.share = value(share);
  out.gap = value(g.gap);
  out.pressure = value(now.pressure);
  out.shear = value(now.shear);
  out.presses = now.presses;
  out.slides = now.slides;
  out.slip = now.slip;
  out.heat = now.heat;
  out.damped = now.damping_heat;
}

}  // namespace

void node_force(const NodeLaw& law, const SurfacePiece& piece, const NodeProjection& projection,
                const NodeCoordinates& old, const NodeCoordinates& now, bool want_tangent, NodeForce& out) {
  out = {};
  want_tangent ? evaluate<Dual<node_dofs>>(law, piece, projection, old, now, out)
               : evaluate<double>(law, piece, projection, old, now, out);
}

double node_gap(const SurfacePiece& piece, const NodeProjection& projection, const NodeCoordinates& now) {
  return geometry(piece, projection, Positions<double>(now)).gap;
}

}  // namespace mudline
