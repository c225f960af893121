#pragma once

#include "discretisation/shapes.hpp"
#include "geometry/contour_piece.hpp"

namespace mudline {

constexpr int max_piece_nodes = 4;

/// How a piece meets its neighbour: with the same tangent, at an angle, or there is none.
enum class PieceEnd { smooth, corner, open };

/// One smooth piece of a surface that is drawn over its nodes: a cubic Bezier curve y(eta), eta in [0, 1], whose
/// control points are combinations of nodes, y = sum_j W_j(eta) x_j, sum_j W_j = 1. The body lies on its left.
struct SurfacePiece {
  int count = 0;                            // nodes that it depends on
  int node[max_piece_nodes] = {};           // local; entries beyond count repeat the first
  double control[4][max_piece_nodes] = {};  // (control point, node)
  PieceEnd start = PieceEnd::open, end = PieceEnd::open;
  int before = -1, after = -1;  // neighbours

  /// W_j and its first two derivatives by eta.
  template <class T>
  void weights(const T& eta, T (&W)[max_piece_nodes], T (&dW)[max_piece_nodes], T (&ddW)[max_piece_nodes]) const {
    const T rest = 1.0 - eta;
    const T B[4] = {rest * rest * rest, 3.0 * eta * rest * rest, 3.0 * eta * eta * rest, eta * eta * eta};
    const T dB[4] = {-3.0 * rest * rest, 3.0 * rest * rest - 6.0 * eta * rest, 6.0 * eta * rest - 3.0 * eta * eta,
                     3.0 * eta * eta};
    const T ddB[4] = {6.0 * rest, 6.0 * eta - 12.0 * rest, 6.0 * rest - 12.0 * eta, 6.0 * eta};
    for (int j = 0; j < max_piece_nodes; ++j) {
      W[j] = dW[j] = ddW[j] = T(0.0);
      for (int i = 0; i < 4; ++i) {
        W[j] = W[j] + control[i][j] * B[i];
        dW[j] = dW[j] + control[i][j] * dB[i];
        ddW[j] = ddW[j] + control[i][j] * ddB[i];
      }
    }
  }
};

/// Positions of the nodes of a piece [m].
using PieceCoordinates = std::array<PlanePoint, max_piece_nodes>;

/// Nearest point of a piece.
struct PieceProjection {
  double eta = 0;                        // within [low, high]
  double distance = 0;                   // [m] >= 0
  bool at_low = false, at_high = false;  // the nearest point of the extended curve lies outside
};

/// The nearest point with eta within [low, high]; at an end exactly that number.
PieceProjection closest_on_piece(const SurfacePiece& piece, const PieceCoordinates& nodes, const PlanePoint& x,
                                 double low, double high);

/// Unit tangent in the direction of travel, at eta.
PlanePoint piece_direction(const SurfacePiece& piece, const PieceCoordinates& nodes, double eta);
PlanePoint piece_point(const SurfacePiece& piece, const PieceCoordinates& nodes, double eta);

}  // namespace mudline
