#pragma once

#include <vector>

#include "geometry/contour_shape.hpp"
#include "geometry/curve_piece.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// One entry of a path's "pieces": goes on from where the one before ended.
class PathPiece {
 public:
  virtual ~PathPiece() = default;
  virtual ContourPieces build(const PlanePoint& from) const = 0;
};

/// "line", "arc", "bezier", "hermite", "nurbs"; a plain list.
void register_path_pieces(Registry<PathPiece>& registry);

/// A path that is open, neither ending on the axis of a half contour nor closed, goes on for ever where its last piece
/// is a line.
void continue_open_end(ContourPieces& pieces, ContourExtent extent);

/// A contour of lines, arcs and curves, piece after piece.
class PathShape : public ContourShape {
 public:
  void parameters(Parameters& p);
  void check(const Section& section);
  Contour build() const override { return Contour(pieces_, extent_); }

 private:
  Vec<double, 2> start_{};
  ContourPieces pieces_;
};

}  // namespace mudline
