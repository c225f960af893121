#pragma once

#include <string>
#include <vector>

#include "contact/box_search.hpp"
#include "contact/nodes/node_chain.hpp"
#include "contact/nodes/node_segment.hpp"

namespace mudline {

/// How a surface is drawn over its nodes. sides: the elements' own sides, straight or parabolic. linear: straight from
/// node to node, with the mid-side nodes of quadratic sides. hermite: C1, cubic through the nodes, tangents of the
/// parabola through a node and its neighbours. bezier: C1, from the middle between two nodes to the middle between the
/// next two, with the node as control point; it cuts corners by an eighth of spacing squared over radius.
enum class Drawing { sides, linear, hermite, bezier };

/// A side set as pieces of curves, for contact with the nodes of another surface. Its topology is fixed, and so are the
/// nodes that each piece depends on. The coefficients of `hermite` are those of the coordinates at the last update().
class SmoothSurface {
 public:
  /// Corners: straight lines between neighbouring nodes that turn by more than `corner_angle` [rad] in x are not
  /// smoothed. `overhang`: an open end continues for this fraction of its last piece.
  SmoothSurface(const std::vector<MasterSurface::MasterSide>& sides, Drawing drawing, double corner_angle,
                double overhang, const ConstCoordinateView& x);

  const std::vector<SurfacePiece>& pieces() const { return pieces_; }
  PieceCoordinates coordinates(int piece, const ConstCoordinateView& x) const;
  /// Updates coefficients and boxes; called at the start of a step.
  void update(const ConstCoordinateView& x);
  /// Pieces whose nodes' box comes within `distance` [m] of a point, in ascending order.
  std::vector<int> near(const PlanePoint& at, double distance) const {
    const Point x{at[0], at[1], 0};
    return boxes_.near({x, x}, distance);
  }

  /// Finds the closest point of a node on one of `candidates`; false where none of them faces it within `capture` [m].
  /// `facing`: a direction along the slave surface, its body on the left.
  bool find_projection(const std::vector<int>& candidates, const PlanePoint& at, const PlanePoint& facing,
                       double capture, const ConstCoordinateView& x, int& piece, NodeProjection& projection) const;

 private:
  /// Kind and nodes of a piece. Its nodes are those that it runs between (and a parabola through), or the one that it
  /// runs around and its neighbours.
  enum class Kind { straight, parabola, first_half, last_half, around, between };
  struct Origin {
    Kind kind;
    bool previous = false, next = false;  // between: the nodes before and after are known, and follow in this order
    int first = -1, last = -1;            // node at the start, at the end; -1: none there
  };
  void draw(const NodeChain& chain);
  void add(Kind kind, const std::vector<int>& nodes, bool previous, bool next);
  void join(int before, int after, PieceEnd how);
  void join_corners();
  void set_coefficients(int piece, const ConstCoordinateView& x);
  bool projection_on(int piece, const PlanePoint& at, const ConstCoordinateView& x, NodeProjection& projection,
                     double& distance, PlanePoint& normal) const;

  Drawing drawing_;
  double overhang_;
  std::vector<SurfacePiece> pieces_;
  std::vector<Origin> origins_;
  BoxSearch boxes_;
};

}  // namespace mudline
