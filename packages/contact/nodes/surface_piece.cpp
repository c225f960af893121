#include "contact/nodes/surface_piece.hpp"

#include <cmath>

namespace mudline {

namespace {

struct CurveValue {
  double x[2] = {0, 0}, d[2] = {0, 0}, dd[2] = {0, 0};
};

CurveValue curve_at(const SurfacePiece& piece, const PieceCoordinates& nodes, double eta) {
  double W[max_piece_nodes], dW[max_piece_nodes], ddW[max_piece_nodes];
  piece.weights(eta, W, dW, ddW);
  CurveValue result;
  for (int j = 0; j < piece.count; ++j)
    for (int i = 0; i < 2; ++i) {
      result.x[i] += W[j] * nodes[j][i];
      result.d[i] += dW[j] * nodes[j][i];
      result.dd[i] += ddW[j] * nodes[j][i];
    }
  return result;
}

}  // namespace

PlanePoint piece_point(const SurfacePiece& piece, const PieceCoordinates& nodes, double eta) {
  const CurveValue at = curve_at(piece, nodes, eta);
  return {at.x[0], at.x[1]};
}

PlanePoint piece_direction(const SurfacePiece& piece, const PieceCoordinates& nodes, double eta) {
  const CurveValue at = curve_at(piece, nodes, eta);
  const double size = std::hypot(at.d[0], at.d[1]);
  return {at.d[0] / size, at.d[1] / size};
}

PieceFoot closest_on_piece(const SurfacePiece& piece, const PieceCoordinates& nodes, const PlanePoint& x, double low,
                           double high) {
  constexpr int samples = 8;
  const auto at = [&](double eta, double& ahead, double& slope) {  // ahead > 0: the foot has a larger eta
    const CurveValue c = curve_at(piece, nodes, eta);
    const double way[2] = {x[0] - c.x[0], x[1] - c.x[1]};
    ahead = way[0] * c.d[0] + way[1] * c.d[1];
    slope = way[0] * c.dd[0] + way[1] * c.dd[1] - c.d[0] * c.d[0] - c.d[1] * c.d[1];
    return std::hypot(way[0], way[1]);
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
  PieceFoot result;
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
