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

/// Slope at the middle one of three nodes of the parabola through them, by the length of the chords.
Weights slope(int before, int at, int after, double h1, double h2) {
  return h1 / (h2 * (h1 + h2)) * (unit(after) - unit(at)) + h2 / (h1 * (h1 + h2)) * (unit(at) - unit(before));
}

}  // namespace

SmoothSurface::SmoothSurface(const std::vector<MasterSurface::MasterSide>& sides, Drawing drawing, double corner_angle,
                             double overhang, const ConstCoordinateView& x)
    : drawing_(drawing), overhang_(overhang) {
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
  if (origin.kind == Kind::parabola) {  // through the middle node: its control point is 2 m - (a + b) / 2
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
  std::vector<BoxSearch::Corners> boxes;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    set_coefficients(static_cast<int>(i), x);
    boxes.push_back(side_box(pieces_[i].node, pieces_[i].count, x));
  }
  boxes_.sort(boxes);
}

bool SmoothSurface::foot_on(int index, const PlanePoint& at, const ConstCoordinateView& x, NodeFoot& foot,
                            double& distance, PlanePoint& normal) const {
  const SurfacePiece& piece = pieces_[index];
  const PieceCoordinates nodes = coordinates(index, x);
  const double low = piece.start == PieceEnd::open ? -overhang_ : 0.0,
               high = piece.end == PieceEnd::open ? 1 + overhang_ : 1.0;
  const PieceFoot found = closest_on_piece(piece, nodes, at, low, high);
  if ((found.at_low && piece.start == PieceEnd::open) || (found.at_high && piece.end == PieceEnd::open)) return false;
  distance = found.distance;
  normal = right_of(piece_direction(piece, nodes, found.eta));
  foot = {found.eta, false, {}};
  const int other = found.at_low && piece.start == PieceEnd::corner  ? piece.before
                    : found.at_high && piece.end == PieceEnd::corner ? piece.after
                                                                     : -1;
  if (other < 0) return true;
  const PlanePoint beyond = right_of(piece_direction(pieces_[other], coordinates(other, x), found.at_low ? 1.0 : 0.0));
  const double mean[2] = {normal[0] + beyond[0], normal[1] + beyond[1]}, size = std::hypot(mean[0], mean[1]);
  if (size > 1e-6) normal = {mean[0] / size, mean[1] / size};
  foot.corner = true;
  foot.outward = normal;
  return true;
}

bool SmoothSurface::find_foot(const std::vector<int>& candidates, const PlanePoint& at, const PlanePoint& facing,
                              double capture, const ConstCoordinateView& x, int& piece, NodeFoot& foot) const {
  const PlanePoint outward = right_of(facing);
  double nearest = capture;
  bool found = false;
  for (int candidate : candidates) {
    NodeFoot here;
    double distance = 0;
    PlanePoint normal{};
    if (!foot_on(candidate, at, x, here, distance, normal) || distance > nearest || (found && distance == nearest))
      continue;
    if (normal[0] * outward[0] + normal[1] * outward[1] >= 0) continue;  // back to back
    nearest = distance;
    piece = candidate;
    foot = here;
    found = true;
  }
  return found;
}

}  // namespace mudline
