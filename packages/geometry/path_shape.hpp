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

/// Registers "line", "arc", "bezier", "hermite" and "nurbs".
void register_path_pieces(Registry<PathPiece>& registry);

/// Makes the last piece of an open path continue for ever if it is a line. A path is open unless it ends on the axis
/// (half contour) or at its own start (full contour).
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
