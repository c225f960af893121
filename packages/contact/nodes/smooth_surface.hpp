#pragma once

#include <string>
#include <vector>

#include "contact/deformable_target.hpp"
#include "contact/nodes/node_chain.hpp"
#include "contact/nodes/surface_piece.hpp"

namespace mudline {

/// How a surface is drawn over its nodes. sides: the elements' own sides, straight or parabolic. linear: straight from
/// node to node, with the mid-side nodes of quadratic sides. hermite: C1, cubic through the nodes, tangents of the
/// parabola through a node and its neighbours. bezier: C1, from the middle between two nodes to the middle between the
/// next two, with the node as control point; it cuts corners by an eighth of spacing squared over radius.
enum class Drawing { sides, linear, hermite, bezier };

/// A side set of the plane as pieces of curves, which nodes of another surface touch. The coefficients of `hermite` are
/// those of the coordinates at the last update().
class SmoothSurface : public DeformableTarget {
 public:
  /// Corners: straight lines between neighbouring nodes that turn by more than `corner_angle` [rad] in x are not
  /// smoothed. `overhang`: an open end continues for this fraction of its last piece.
  SmoothSurface(const std::vector<MasterSurface::MasterSide>& sides, Drawing drawing, double corner_angle,
                double overhang, const ConstCoordinateView& x);

  int pieces() const override { return static_cast<int>(pieces_.size()); }
  const SurfacePiece& piece(int index) const { return pieces_[index]; }
  TargetNodes nodes(int piece) const override { return {pieces_[piece].count, pieces_[piece].node}; }
  const std::vector<MasterSurface::MasterSide>& sides() const override { return sides_; }
  PieceCoordinates coordinates(int piece, const ConstCoordinateView& x) const;
  void update(const ConstCoordinateView& x) override;
  std::vector<int> near(const Bounds& box, double distance) const override { return boxes_.near(box, distance); }
  bool find(const std::vector<int>& candidates, const Point& at, const Point& outward, double capture,
            const ConstCoordinateView& x, TargetPlace& place) const override;
  /// At a corner the normal is the direction from the corner to the point, or the mean normal on the corner itself.
  ClosestPoint closest(const TargetPlace& place, const Point& at, const ConstCoordinateView& x) const override;
  void weights(int piece, const double* at, double* weight) const override;

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
  bool projection_on(int piece, const PlanePoint& at, const ConstCoordinateView& x, TargetPlace& place,
                     PlanePoint& normal) const;

  std::vector<MasterSurface::MasterSide> sides_;
  Drawing drawing_;
  double overhang_;
  std::vector<SurfacePiece> pieces_;
  std::vector<Origin> origins_;
  BoxTree boxes_;
};

}  // namespace mudline
