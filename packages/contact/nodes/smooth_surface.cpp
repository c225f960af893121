#include "contact/nodes/smooth_surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "tensor/vec.hpp"

namespace mudline {

namespace {

PlanePoint right_of(const PlanePoint& t) { return {t[1], -t[0]}; }

/// Weights of nodes.
using Weights = Vec<double, max_piece_nodes>;

Weights unit(int j) {
  Weights result{};
  result[j] = 1;
  return result;
}

/// Slope at the middle one of three nodes of the parabola through them, with respect to the length of the chords.
Weights slope(int before, int at, int after, double h1, double h2) {
  return h1 / (h2 * (h1 + h2)) * (unit(after) - unit(at)) + h2 / (h1 * (h1 + h2)) * (unit(at) - unit(before));
}

}  // namespace

SmoothSurface::SmoothSurface(const std::vector<MasterSurface::MasterSide>& sides, Drawing drawing, double corner_angle,
                             double overhang, const ConstCoordinateView& x)
    : DeformableTarget(2), sides_(sides), drawing_(drawing), overhang_(overhang) {
  if (drawing == Drawing::sides) {
    for (const auto& side : sides)
      add(side.count == 3 ? Kind::parabola : Kind::straight, std::vector<int>(side.node, side.node + side.count), false,
          false);
  } else {
    const auto chains = node_chains(sides);
    for (const NodeChain& chain : drawing == Drawing::linear ? chains : cut_at_corners(chains, corner_angle, x))
      draw(chain);
  }
  join_corners();
  update(x);
}

void SmoothSurface::add(Kind kind, const std::vector<int>& nodes, bool previous, bool next) {
  SurfacePiece piece;
  piece.count = static_cast<int>(nodes.size());
  for (int j = 0; j < max_piece_nodes; ++j) piece.node[j] = nodes[j < piece.count ? j : 0];
  Origin origin{kind, previous, next, -1, -1};
  if (kind != Kind::around && kind != Kind::last_half) origin.first = nodes[0];
  if (kind != Kind::around && kind != Kind::first_half) origin.last = nodes[1];
  pieces_.push_back(piece);
  origins_.push_back(origin);
}

void SmoothSurface::join(int before, int after, PieceEnd how) {
  pieces_[before].end = pieces_[after].start = how;
  pieces_[before].after = after;
  pieces_[after].before = before;
}

void SmoothSurface::draw(const NodeChain& chain) {
  const auto& nodes = chain.nodes;
  const int n = static_cast<int>(nodes.size()), first = static_cast<int>(pieces_.size());
  const auto node = [&](int i) { return nodes[(i + n) % n]; };
  const int intervals = chain.closed ? n : n - 1;
  if (drawing_ == Drawing::linear || (drawing_ == Drawing::bezier && n == 2)) {
    for (int i = 0; i < intervals; ++i) add(Kind::straight, {node(i), node(i + 1)}, false, false);
  } else if (drawing_ == Drawing::hermite) {
    for (int i = 0; i < intervals; ++i) {
      const bool previous = chain.closed || i > 0, next = chain.closed || i + 2 < n;
      std::vector<int> all{node(i), node(i + 1)};
      if (previous) all.push_back(node(i - 1));
      if (next) all.push_back(node(i + 2));
      add(Kind::between, all, previous, next);
    }
  } else {
    if (!chain.closed) add(Kind::first_half, {node(0), node(1)}, false, false);
    for (int i = chain.closed ? 0 : 1; i < (chain.closed ? n : n - 1); ++i)
      add(Kind::around, {node(i), node(i - 1), node(i + 1)}, false, false);
    if (!chain.closed) add(Kind::last_half, {node(n - 2), node(n - 1)}, false, false);
  }
  const int last = static_cast<int>(pieces_.size()) - 1;
  const PieceEnd how = drawing_ == Drawing::linear ? PieceEnd::corner : PieceEnd::smooth;
  for (int i = first; i < last; ++i) join(i, i + 1, how);
  if (chain.closed) join(last, first, how);
}

void SmoothSurface::join_corners() {
  std::map<int, int> starting;
  for (std::size_t i = 0; i < pieces_.size(); ++i)
    if (pieces_[i].start == PieceEnd::open && pieces_[i].before < 0)
      starting.emplace(origins_[i].first, static_cast<int>(i));
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (pieces_[i].after >= 0) continue;
    const auto next = starting.find(origins_[i].last);
    if (next == starting.end()) continue;
    join(static_cast<int>(i), next->second, PieceEnd::corner);
    starting.erase(next);
  }
}

PieceCoordinates SmoothSurface::coordinates(int piece, const ConstCoordinateView& x) const {
  PieceCoordinates result;
  for (int j = 0; j < max_piece_nodes; ++j) result[j] = {x(pieces_[piece].node[j], 0), x(pieces_[piece].node[j], 1)};
  return result;
}

void SmoothSurface::set_coefficients(int index, const ConstCoordinateView& x) {
  SurfacePiece& piece = pieces_[index];
  const Origin& origin = origins_[index];
  const PieceCoordinates at = coordinates(index, x);
  const auto chord = [&](int i, int j) { return std::hypot(at[i][0] - at[j][0], at[i][1] - at[j][1]); };
  Weights control[4];
  if (origin.kind == Kind::parabola) {  // through the mid-side node m: its control point is 2 m - (a + b) / 2
    const Weights middle = 2 * unit(2) - 0.5 * unit(0) - 0.5 * unit(1);
    control[0] = unit(0);
    control[1] = 1.0 / 3 * unit(0) + 2.0 / 3 * middle;
    control[2] = 1.0 / 3 * unit(1) + 2.0 / 3 * middle;
    control[3] = unit(1);
  } else if (origin.kind == Kind::around) {  // a parabola with the node as its control point
    control[0] = 0.5 * unit(0) + 0.5 * unit(1);
    control[1] = 5.0 / 6 * unit(0) + 1.0 / 6 * unit(1);
    control[2] = 5.0 / 6 * unit(0) + 1.0 / 6 * unit(2);
    control[3] = 0.5 * unit(0) + 0.5 * unit(2);
  } else {
    const double from = origin.kind == Kind::last_half ? 0.5 : 0.0, to = origin.kind == Kind::first_half ? 0.5 : 1.0;
    for (int i = 0; i < 4; ++i) {
      const double share = from + (to - from) * i / 3;
      control[i] = (1 - share) * unit(0) + share * unit(1);
    }
    const int next = origin.previous ? 3 : 2;
    if (origin.previous || origin.next) {
      const double h = chord(0, 1);
      const Weights straight = 1 / h * unit(1) - 1 / h * unit(0);
      Weights start{}, end{};
      if (origin.previous) start = slope(2, 0, 1, chord(2, 0), h);
      if (origin.next) end = slope(0, 1, next, h, chord(1, next));
      if (!origin.previous) start = 2 * straight - end;
      if (!origin.next) end = 2 * straight - start;
      control[1] = unit(0) + h / 3 * start;
      control[2] = unit(1) - h / 3 * end;
    }
  }
  for (int i = 0; i < 4; ++i) std::copy(control[i].begin(), control[i].end(), piece.control[i]);
}

void SmoothSurface::update(const ConstCoordinateView& x) {
  std::vector<Bounds> boxes;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    set_coefficients(static_cast<int>(i), x);
    boxes.push_back(side_box(pieces_[i].node, pieces_[i].count, x));
  }
  boxes_ = BoxTree(std::move(boxes));
}

bool SmoothSurface::projection_on(int index, const PlanePoint& at, const ConstCoordinateView& x, TargetPlace& place,
                                  PlanePoint& normal) const {
  const SurfacePiece& piece = pieces_[index];
  const PieceCoordinates nodes = coordinates(index, x);
  const double low = piece.start == PieceEnd::open ? -overhang_ : 0.0,
               high = piece.end == PieceEnd::open ? 1 + overhang_ : 1.0;
  const PieceProjection found = closest_on_piece(piece, nodes, at, low, high);
  if ((found.at_low && piece.start == PieceEnd::open) || (found.at_high && piece.end == PieceEnd::open)) return false;
  normal = right_of(piece_direction(piece, nodes, found.eta));
  place = {index, {found.eta, 0}, found.distance, false, {}};
  const int other = found.at_low && piece.start == PieceEnd::corner  ? piece.before
                    : found.at_high && piece.end == PieceEnd::corner ? piece.after
                                                                     : -1;
  if (other < 0) return true;
  const PlanePoint beyond = right_of(piece_direction(pieces_[other], coordinates(other, x), found.at_low ? 1.0 : 0.0));
  const double mean[2] = {normal[0] + beyond[0], normal[1] + beyond[1]}, size = std::hypot(mean[0], mean[1]);
  if (size > 1e-6) normal = {mean[0] / size, mean[1] / size};
  place.corner = true;
  place.outward = normal;
  return true;
}

bool SmoothSurface::find(const std::vector<int>& candidates, const Point& at, const Point& outward, double capture,
                         const ConstCoordinateView& x, TargetPlace& place) const {
  double nearest = capture;
  bool found = false;
  PlanePoint facing{};
  for (int candidate : candidates) {
    TargetPlace here;
    PlanePoint normal{};
    if (!projection_on(candidate, in_plane(at), x, here, normal) || here.gap > nearest ||
        (found && here.gap == nearest))
      continue;
    if (normal[0] * outward[0] + normal[1] * outward[1] >= 0) continue;  // back to back
    nearest = here.gap;
    place = here;
    facing = normal;
    found = true;
  }
  if (!found) return false;
  const PlanePoint foot = piece_point(pieces_[place.piece], coordinates(place.piece, x), place.at[0]);
  if (dot(in_plane(at) - foot, facing) < 0) place.gap = -place.gap;
  return true;
}

ClosestPoint SmoothSurface::closest(const TargetPlace& place, const Point& at, const ConstCoordinateView& x) const {
  const SurfacePiece& piece = pieces_[place.piece];
  const PieceCoordinates nodes = coordinates(place.piece, x);
  double W[max_piece_nodes], dW[max_piece_nodes], ddW[max_piece_nodes];
  piece.weights(place.at[0], W, dW, ddW);
  PlanePoint y{}, slope{}, bend{};
  for (int j = 0; j < piece.count; ++j) {
    y += W[j] * nodes[j];
    slope += dW[j] * nodes[j];
    bend += ddW[j] * nodes[j];
  }
  ClosestPoint result;
  result.nodes = piece.count;
  std::copy_n(W, piece.count, result.weight);
  const PlanePoint offset = in_plane(at) - y;
  if (place.corner) {
    const double distance = length(offset);
    PlanePoint normal = place.outward;
    result.gap = dot(offset, normal);
    if (distance > 1e-12 * length(nodes[piece.count - 1] - nodes[0])) {
      result.gap = result.gap < 0 ? -distance : distance;
      normal = offset / result.gap;
      const PlanePoint along{-normal[1], normal[0]};
      for (int i = 0; i < 2; ++i)
        for (int k = 0; k < 2; ++k) result.normal_slope[i][k] = along[i] * along[k] / result.gap;
    }
    result.normal = {normal[0], normal[1], 0};
    std::copy_n(result.normal.data(), 2, result.gap_slope);
    return result;
  }
  const double stretch = length(slope);
  const PlanePoint along = slope / stretch, normal = right_of(along);
  result.gap = dot(offset, normal);
  result.normal = {normal[0], normal[1], 0};
  std::copy_n(result.normal.data(), 2, result.gap_slope);
  // derivatives of the place on the piece, and of the rotation from the direction of travel to the normal
  const double whole = dot(slope, slope) - dot(offset, bend), curvature = dot(normal, bend) / stretch;
  const double eta[] = {slope[0] / whole, slope[1] / whole, result.gap * stretch / whole};
  for (int k = 0; k < ClosestPoint::motions; ++k) {
    const double rotation = curvature * eta[k] + (k == 2 ? 1.0 : 0.0);
    for (int i = 0; i < 2; ++i) result.normal_slope[i][k] = -along[i] * rotation;
    for (int j = 0; j < piece.count; ++j) result.weight_slope[j][k] = dW[j] * eta[k];
  }
  for (int j = 0; j < piece.count; ++j) result.turn[j] = dW[j] / stretch;
  return result;
}

void SmoothSurface::weights(int piece, const double* at, double* weight) const {
  double dW[max_piece_nodes], ddW[max_piece_nodes], W[max_piece_nodes];
  pieces_[piece].weights(at[0], W, dW, ddW);
  std::copy_n(W, pieces_[piece].count, weight);
}

}  // namespace mudline
