#include "contact/nodes/surface_piece.hpp"

#include "contact/vector.hpp"
#include "geometry/closest_on_curve.hpp"

namespace mudline {

namespace {

CurvePoint<2> curve_at(const SurfacePiece& piece, const PieceCoordinates& nodes, double eta) {
  double W[max_piece_nodes], dW[max_piece_nodes], ddW[max_piece_nodes];
  piece.weights(eta, W, dW, ddW);
  return {combine(piece.count, W, nodes.data()), combine(piece.count, dW, nodes.data()),
          combine(piece.count, ddW, nodes.data())};
}

}  // namespace

PlanePoint piece_point(const SurfacePiece& piece, const PieceCoordinates& nodes, double eta) {
  return curve_at(piece, nodes, eta).x;
}

PlanePoint piece_direction(const SurfacePiece& piece, const PieceCoordinates& nodes, double eta) {
  return unit(curve_at(piece, nodes, eta).d);
}

PieceProjection closest_on_piece(const SurfacePiece& piece, const PieceCoordinates& nodes, const PlanePoint& x,
                                 double low, double high) {
  const auto curve = [&](double eta) { return curve_at(piece, nodes, eta); };
  const auto square = [&](int, double eta) {
    const PlanePoint offset = x - curve(eta).x;
    return dot(offset, offset);
  };
  PieceProjection result;
  result.eta = closest_on_curve(curve, x, around_closest_sample(low, high, 8, square));
  result.distance = length(x - curve(result.eta).x);
  result.at_low = result.eta == low;
  result.at_high = result.eta == high;
  return result;
}

}  // namespace mudline
