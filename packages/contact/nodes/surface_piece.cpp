#include "contact/nodes/surface_piece.hpp"

#include <cmath>

#include "contact/vector.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

struct CurveValue {
  Vec<double, 2> x, d, dd;
};

CurveValue curve_at(const SurfacePiece& piece, const PieceCoordinates& nodes, double eta) {
  double W[max_piece_nodes], dW[max_piece_nodes], ddW[max_piece_nodes];
  piece.weights(eta, W, dW, ddW);
  Vec<double, 2> at[max_piece_nodes];
  for (int j = 0; j < piece.count; ++j) at[j] = constant<double>(nodes[j]);
  return {combine(piece.count, W, at), combine(piece.count, dW, at), combine(piece.count, ddW, at)};
}

}  // namespace

PlanePoint piece_point(const SurfacePiece& piece, const PieceCoordinates& nodes, double eta) {
  return in_plane(curve_at(piece, nodes, eta).x);
}

PlanePoint piece_direction(const SurfacePiece& piece, const PieceCoordinates& nodes, double eta) {
  const Vec<double, 2> along = curve_at(piece, nodes, eta).d;
  return in_plane(along * (1 / length(along)));
}

PieceProjection closest_on_piece(const SurfacePiece& piece, const PieceCoordinates& nodes, const PlanePoint& x,
                                 double low, double high) {
  constexpr int samples = 8;
  const auto at = [&](double eta, double& ahead, double& slope) {  // ahead > 0: the closest point has a larger eta
    const CurveValue c = curve_at(piece, nodes, eta);
    const Vec<double, 2> offset = constant<double>(x) - c.x;
    ahead = dot(offset, c.d);
    slope = dot(offset, c.dd) - dot(c.d, c.d);
    return length(offset);
  };
  int nearest = 0;
  double best = 1e300, ahead = 0, slope = 0;
  for (int i = 0; i <= samples; ++i) {
    const double distance = at(low + (high - low) * i / samples, ahead, slope);
    if (distance >= best) continue;
    best = distance;
    nearest = i;
  }
  const auto sample = [&](int i) { return i <= 0 ? low : i >= samples ? high : low + (high - low) * i / samples; };
  PieceProjection result;
  if (nearest == 0) {
    result.distance = at(low, ahead, slope);
    result.eta = low;
    if ((result.at_low = ahead <= 0)) return result;
  }
  if (nearest == samples) {
    result.distance = at(high, ahead, slope);
    result.eta = high;
    if ((result.at_high = ahead >= 0)) return result;
  }
  double from = sample(nearest - 1), to = sample(nearest + 1), eta = sample(nearest);
  for (int i = 0; i < 60; ++i) {
    at(eta, ahead, slope);
    (ahead > 0 ? from : to) = eta;
    double next = eta - ahead / slope;
    if (!(slope < 0) || !(next >= from && next <= to)) next = 0.5 * (from + to);
    const double step = next - eta;
    eta = next;
    if (std::abs(step) < 1e-15) break;
  }
  result.eta = eta;
  result.distance = at(eta, ahead, slope);
  return result;
}

}  // namespace mudline
