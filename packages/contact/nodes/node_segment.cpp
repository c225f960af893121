#include "contact/nodes/node_segment.hpp"

#include <algorithm>
#include <cmath>

#include "contact/vector.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// Positions as numbers of kind T: with derivatives where they are unknowns.
template <class T>
struct Positions {
  explicit Positions(const NodeCoordinates& x) : slave(unknown<T>(x.slave, 0)) {
    for (int j = 0; j < max_piece_nodes; ++j) master[j] = unknown<T>(x.master[j], 2 + 2 * j);
  }
  Vec<T, 2> slave, master[max_piece_nodes];
};

/// The foot with its derivatives.
template <class T>
struct FootPlace {
  T W[max_piece_nodes];
  T gap;
  Vec<T, 2> normal, along, foot;
};

/// At a corner: along the way from it, or from the mean normal on the corner itself.
template <class T>
void look_from_corner(const SurfacePiece& piece, const NodeFoot& at, const Positions<T>& x, FootPlace<T>& g) {
  const Vec<T, 2> way = x.slave - g.foot, chord = x.master[piece.count - 1] - x.master[0];
  g.normal = constant<T>(at.outward);
  g.gap = dot(way, g.normal);
  if (std::sqrt(value(dot(way, way))) > 1e-12 * std::sqrt(value(dot(chord, chord)))) {
    g.gap = value(g.gap) < 0 ? -1.0 * length(way) : length(way);
    g.normal = way / g.gap;
  }
  g.along = {-1.0 * g.normal[1], g.normal[0]};
}

template <class T>
FootPlace<T> geometry(const SurfacePiece& piece, const NodeFoot& at, const Positions<T>& x) {
  FootPlace<T> g;
  T dW[max_piece_nodes], ddW[max_piece_nodes];
  piece.weights(T(at.eta), g.W, dW, ddW);
  g.foot = combine(piece.count, g.W, x.master);
  if (at.corner) {
    look_from_corner(piece, at, x, g);
    return g;
  }
  // eta follows from way . y' = 0 by one step of Newton's method, which leaves its value
  const Vec<T, 2> way = x.slave - g.foot, tangent = combine(piece.count, dW, x.master),
                  bend = combine(piece.count, ddW, x.master);
  const T ahead = dot(way, tangent);
  const double slope = value(dot(way, bend) - dot(tangent, tangent));
  const T eta = at.eta - (ahead - value(ahead)) / slope;
  piece.weights(eta, g.W, dW, ddW);
  g.foot = combine(piece.count, g.W, x.master);
  const Vec<T, 2> direction = combine(piece.count, dW, x.master);
  g.along = direction / length(direction);
  g.normal = {g.along[1], -1.0 * g.along[0]};
  g.gap = dot(x.slave - g.foot, g.normal);
  return g;
}

template <class T>
ContactMotion<T> motion_of_node(const NodeLaw& law, const SurfacePiece& piece, const FootPlace<T>& g,
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
  const Vec<T, 2> was = constant<T>(old.slave), foot_was = combine(piece.count, g.W, was_master);
  motion.travel = dot((x.slave - was) - (g.foot - foot_was), g.along);
  if (law.normal == 0) motion.opened = dot(was - foot_was, g.normal);
  motion.shear_old = T(law.shear);
  motion.slip_old = law.slip;
  motion.position = {old.slave[0], old.slave[1], 0};
  return motion;
}

/// A force on the slave node, the opposite at its foot.
template <class T>
void act(const SurfacePiece& piece, const FootPlace<T>& g, const Vec<T, 2>& force, T (&to)[node_dofs]) {
  to[0] = force[0];
  to[1] = force[1];
  spread(piece.count, g.W, force * -1.0, to + 2);
}

template <class T>
void evaluate(const NodeLaw& law, const SurfacePiece& piece, const NodeFoot& foot, const NodeCoordinates& old,
              const NodeCoordinates& at, NodeForce& out) {
  const Positions<T> x(at);
  const FootPlace<T> g = geometry(piece, foot, x);
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

void node_force(const NodeLaw& law, const SurfacePiece& piece, const NodeFoot& foot, const NodeCoordinates& old,
                const NodeCoordinates& now, bool want_tangent, NodeForce& out) {
  out = {};
  want_tangent ? evaluate<Dual<node_dofs>>(law, piece, foot, old, now, out)
               : evaluate<double>(law, piece, foot, old, now, out);
}

double node_gap(const SurfacePiece& piece, const NodeFoot& foot, const NodeCoordinates& now) {
  return geometry(piece, foot, Positions<double>(now)).gap;
}

}  // namespace mudline
