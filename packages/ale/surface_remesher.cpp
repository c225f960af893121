#include "ale/surface_remesher.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "tensor/vec.hpp"

namespace mudline {

namespace {

constexpr double longest = 4.0 / 3, shortest = 4.0 / 5;  // shares of the wanted length
constexpr double good = 0.7, poor = 0.6;                 // mean ratios
constexpr double facing_enough = 0.7;                    // cosine

}  // namespace

SurfaceRemesher::SurfaceRemesher(const MeshSurfaces& surfaces, const Positions& x, SurfaceSizes sizes)
    : surfaces_(surfaces), sizes_(std::move(sizes)), rounded_(x), x_(rounded_(x)), locator_(surfaces.faces, x_) {
  for (std::size_t p = 0; p < surfaces.patches.size(); ++p) planes_.emplace_back(surfaces, static_cast<int>(p), x_);
  take_vertices();
  take_curves();
  find_normals();
}

void SurfaceRemesher::take_vertices() {
  const std::vector<char> fixed = fixed_nodes(surfaces_, x_.size());
  std::map<int, int> number;
  for (const SurfaceFace& face : surfaces_.faces) {
    Face made{{}, face.patch};
    for (int k = 0; k < 3; ++k) {
      const int node = face.nodes[k];
      const auto [found, added] = number.emplace(node, static_cast<int>(vertices_.size()));
      if (added) {
        Vertex vertex;
        vertex.place = x_[node];
        vertex.node = node;
        vertex.relative = sizes_.relative[node];
        vertex.fixed = fixed[node];
        vertices_.push_back(vertex);
        resize(vertices_.back());
      }
      Vertex& vertex = vertices_[found->second];
      vertex.faces.push_back(static_cast<int>(faces_.size()));
      made.corners[k] = found->second;
    }
    faces_.push_back(made);
  }
}

void SurfaceRemesher::take_curves() {
  std::map<int, int> number;
  for (std::size_t v = 0; v < vertices_.size(); ++v) number[vertices_[v].node] = static_cast<int>(v);
  for (std::size_t c = 0; c < surfaces_.curves.size(); ++c) {
    const MeshPath& path = surfaces_.curves[c];
    Positions places;
    for (int node : path.nodes) places.push_back(x_[node]);
    Curve curve{PathCurve(places), {}, SharedCoordinates(places)};
    for (std::size_t i = 0; i < path.nodes.size(); ++i) {
      const bool middle = path.stride == 2 && i % 2 == 1;
      curve.relative.push_back(middle ? 0.5 * (sizes_.relative[path.nodes[i - 1]] + sizes_.relative[path.nodes[i + 1]])
                                      : sizes_.relative[path.nodes[i]]);
    }
    for (int v = 0; v < path.num_vertices(); ++v) {
      const int here = number.at(path.nodes[v * path.stride]);
      const double s = curve.path.parameter(v * path.stride);
      if (v > 0 && v + 1 < path.num_vertices()) {
        vertices_[here].curve = static_cast<int>(c);
        vertices_[here].s = s;
      }
      if (v == 0) continue;
      const int before = number.at(path.nodes[(v - 1) * path.stride]);
      const double s_before = curve.path.parameter((v - 1) * path.stride);
      const bool up = before < here;
      curve_edges_[ends(before, here)] = {static_cast<int>(c), up ? s_before : s, up ? s : s_before};
    }
    curves_.push_back(std::move(curve));
  }
}

void SurfaceRemesher::find_normals() {
  for (std::size_t f = 0; f < faces_.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto xi = reference_node(CellShape::tri3, k);
      Point& sum = vertices_[faces_[f].corners[k]].normals[faces_[f].patch];
      sum += unit(face_normal(surfaces_.faces[f], {xi[0], xi[1]}, x_));
    }
  for (Vertex& vertex : vertices_)
    for (auto& [patch, normal] : vertex.normals) normal = unit(normal);
}

void SurfaceRemesher::resize(Vertex& vertex) const {
  vertex.size = rounded_(sizes_.wanted(vertex.relative, vertex.place));
}

void SurfaceRemesher::put_on_patch(Vertex& vertex, int patch, const Point& at) const {
  vertex.node = -1;
  vertex.on = locator_.nearest(patch, at, vertex.on.face);
  vertex.place = planes_[patch].of_all.kept(rounded_(locator_.at(vertex.on)));
  vertex.normals = {{patch, locator_.normal(vertex.on)}};
  double N[3], dN[6];
  evaluate_shape(CellShape::tri3, vertex.on.xi.data(), N, dN);
  vertex.relative = 0;
  for (int k = 0; k < 3; ++k) vertex.relative += N[k] * sizes_.relative[surfaces_.faces[vertex.on.face].nodes[k]];
  resize(vertex);
}

void SurfaceRemesher::put_on_curve(Vertex& vertex, int c, double s) const {
  const Curve& curve = curves_[c];
  vertex.node = -1;
  vertex.curve = c;
  vertex.s = s;
  vertex.place = curve.shared.kept(rounded_(curve.path.at(s)));
  vertex.relative = curve.path.interpolate(curve.relative, s);
  for (auto& [patch, normal] : vertex.normals) normal = locator_.normal(locator_.nearest(patch, vertex.place));
  resize(vertex);
}

SurfaceRemesher::Vertex SurfaceRemesher::between(int a, int b, const std::vector<int>& around) const {
  Vertex made;
  const auto on_curve = curve_edges_.find(ends(a, b));
  if (on_curve == curve_edges_.end()) {
    put_on_patch(made, faces_[around[0]].patch, 0.5 * (vertices_[a].place + vertices_[b].place));
  } else {
    for (int f : around) made.normals[faces_[f].patch];
    put_on_curve(made, on_curve->second.curve, 0.5 * (on_curve->second.low + on_curve->second.high));
  }
  return made;
}

double SurfaceRemesher::ratio(int a, int b) const {
  return 2 * length(vertices_[a].place - vertices_[b].place) / (vertices_[a].size + vertices_[b].size);
}

SurfaceRemesher::Shape SurfaceRemesher::shape(const Corners& corners, int patch) const {
  const Point &a = vertices_[corners[0]].place, &b = vertices_[corners[1]].place, &c = vertices_[corners[2]].place;
  const Point ab = b - a, bc = c - b, ca = a - c, area = cross(ab, bc);
  Point outwards{};
  for (int corner : corners) outwards += vertices_[corner].normals.at(patch);
  const double facing = dot(area, unit(outwards));
  const double squares = dot(ab, ab) + dot(bc, bc) + dot(ca, ca);
  return {2 * std::sqrt(3.0) * facing / std::max(squares, 1e-300), facing / std::max(length(area), 1e-300)};
}

SurfaceRemesher::Shape SurfaceRemesher::worst_around(int vertex) const {
  Shape worst;
  for (int f : vertices_[vertex].faces) worst.take(shape(faces_[f].corners, faces_[f].patch));
  return worst;
}

std::vector<int> SurfaceRemesher::faces_of(int a, int b) const {
  std::vector<int> result;
  for (int f : vertices_[a].faces) {
    const Corners& corners = faces_[f].corners;
    if (std::find(corners.begin(), corners.end(), b) != corners.end()) result.push_back(f);
  }
  return result;
}

std::vector<int> SurfaceRemesher::neighbours(int vertex) const {
  std::set<int> result;
  for (int f : vertices_[vertex].faces) result.insert(faces_[f].corners.begin(), faces_[f].corners.end());
  result.erase(vertex);
  return {result.begin(), result.end()};
}

bool SurfaceRemesher::keeps_edge(int a, int b, const std::vector<int>& around) const {
  const auto on_curve = curve_edges_.find(ends(a, b));
  return on_curve != curve_edges_.end() ? surfaces_.curves[on_curve->second.curve].material
                                        : surfaces_.patches[faces_[around[0]].patch].material;
}

std::vector<SurfaceRemesher::Ends> SurfaceRemesher::edges() const {
  std::set<Ends> all;
  for (const Face& face : faces_)
    if (face.patch >= 0)
      for (int k = 0; k < 3; ++k) all.insert(ends(face.corners[k], face.corners[(k + 1) % 3]));
  std::vector<std::pair<double, Ends>> sorted;
  for (const Ends& edge : all) sorted.emplace_back(-ratio(edge.first, edge.second), edge);
  std::sort(sorted.begin(), sorted.end());
  std::vector<Ends> result;
  for (const auto& [unused, edge] : sorted) result.push_back(edge);
  return result;
}

void SurfaceRemesher::replace(int f, const Corners& corners) {
  const int patch = faces_[f].patch;
  remove(f);
  faces_[f] = {corners, patch};
  for (int corner : corners) vertices_[corner].faces.push_back(f);
}

void SurfaceRemesher::remove(int f) {
  for (int corner : faces_[f].corners) {
    std::vector<int>& around = vertices_[corner].faces;
    around.erase(std::remove(around.begin(), around.end(), f), around.end());
  }
  faces_[f].patch = -1;
}

void SurfaceRemesher::wake(int vertex) {
  vertices_[vertex].active = true;
  for (int near : neighbours(vertex)) vertices_[near].active = true;
}

void SurfaceRemesher::wake_poor() {
  for (const Face& face : faces_)
    if (face.patch >= 0 && shape(face.corners, face.patch).quality < poor)
      for (int corner : face.corners) vertices_[corner].active = true;
}

bool SurfaceRemesher::split(int a, int b) {
  const std::vector<int> around = faces_of(a, b);
  if (around.empty() || ratio(a, b) <= longest || keeps_edge(a, b, around)) return false;
  const int middle = static_cast<int>(vertices_.size());
  vertices_.push_back(between(a, b, around));
  Shape before, after;
  std::vector<std::array<Corners, 2>> parts;
  for (int f : around) {
    Corners with_a = faces_[f].corners, with_b = with_a;
    std::replace(with_a.begin(), with_a.end(), b, middle);
    std::replace(with_b.begin(), with_b.end(), a, middle);
    before.take(shape(faces_[f].corners, faces_[f].patch));
    for (const Corners& corners : {with_a, with_b}) after.take(shape(corners, faces_[f].patch));
    parts.push_back({with_a, with_b});
  }
  if (after.quality < 0.3 * before.quality || after.facing < std::min(facing_enough, before.facing)) {
    vertices_.pop_back();
    return false;
  }
  for (std::size_t i = 0; i < around.size(); ++i) {
    const int patch = faces_[around[i]].patch;
    replace(around[i], parts[i][0]);
    faces_.push_back({parts[i][1], patch});
    for (int corner : parts[i][1]) vertices_[corner].faces.push_back(static_cast<int>(faces_.size()) - 1);
  }
  const auto on_curve = curve_edges_.find(ends(a, b));
  if (on_curve != curve_edges_.end()) {
    const CurveEdge edge = on_curve->second;
    const double s = vertices_[middle].s;
    curve_edges_.erase(on_curve);
    curve_edges_[{std::min(a, b), middle}] = {edge.curve, edge.low, s};
    curve_edges_[{std::max(a, b), middle}] = {edge.curve, edge.high, s};
  }
  wake(middle);
  return true;
}

bool SurfaceRemesher::may_collapse(int a, int b, const std::vector<int>& around, Shape& after) const {
  if (vertices_[a].fixed) return false;
  const auto on_curve = curve_edges_.find(ends(a, b));
  if (vertices_[a].curve >= 0 && on_curve == curve_edges_.end()) return false;
  const std::vector<int> of_a = neighbours(a), of_b = neighbours(b);
  std::vector<int> common;
  std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(common));
  if (common.size() != around.size()) return false;
  for (int near : of_a)
    if (near != b && ratio(near, b) > longest) return false;
  for (int f : vertices_[a].faces) {
    if (std::find(around.begin(), around.end(), f) != around.end()) continue;
    if (!vertices_[b].normals.count(faces_[f].patch)) return false;
    Corners corners = faces_[f].corners;
    std::replace(corners.begin(), corners.end(), a, b);
    after.take(shape(corners, faces_[f].patch));
  }
  const Shape before = worst_around(a);
  return after.quality >= std::min(0.5, before.quality) && after.quality > 0 &&
         after.facing >= std::min(facing_enough, before.facing);
}

bool SurfaceRemesher::collapse(int a, int b) {
  const std::vector<int> around = faces_of(a, b);
  if (around.empty() || ratio(a, b) >= shortest || keeps_edge(a, b, around)) return false;
  Shape by_a, by_b;
  const bool first = may_collapse(a, b, around, by_a), second = may_collapse(b, a, around, by_b);
  if (!first && !second) return false;
  if (!first || (second && by_b.quality > by_a.quality)) std::swap(a, b);
  const auto s_at = [&](int vertex, int other) {
    const CurveEdge& edge = curve_edges_.at(ends(vertex, other));
    return vertex < other ? edge.low : edge.high;
  };
  if (const int c = vertices_[a].curve; c >= 0) {
    const double s = s_at(b, a);
    for (int near : neighbours(a)) {
      const auto edge = curve_edges_.find(ends(a, near));
      if (near == b || edge == curve_edges_.end()) continue;
      const double s_near = s_at(near, a);
      curve_edges_.erase(edge);
      curve_edges_[ends(b, near)] = {c, b < near ? s : s_near, b < near ? s_near : s};
    }
    curve_edges_.erase(ends(a, b));
  }
  for (int f : around) remove(f);
  for (int f : std::vector<int>(vertices_[a].faces)) {
    Corners corners = faces_[f].corners;
    std::replace(corners.begin(), corners.end(), a, b);
    replace(f, corners);
  }
  wake(b);
  return true;
}

bool SurfaceRemesher::flip(int a, int b) {
  const std::vector<int> around = faces_of(a, b);
  if (around.size() != 2 || curve_edges_.count(ends(a, b)) || keeps_edge(a, b, around)) return false;
  const int patch = faces_[around[0]].patch;
  const auto opposite = [&](int f) {
    for (int corner : faces_[f].corners)
      if (corner != a && corner != b) return corner;
    return -1;
  };
  const int c = opposite(around[0]), d = opposite(around[1]);
  if (!faces_of(c, d).empty()) return false;
  // the first face is a, b, c or b, a, c
  Corners one = faces_[around[0]].corners, other = faces_[around[1]].corners;
  Shape before, after;
  for (int f : around) before.take(shape(faces_[f].corners, patch));
  std::replace(one.begin(), one.end(), b, d);
  std::replace(other.begin(), other.end(), a, c);
  for (const Corners& corners : {one, other}) after.take(shape(corners, patch));
  if (!(after.quality > before.quality + 1e-6) || after.facing < std::min(facing_enough, before.facing)) return false;
  replace(around[0], one);
  replace(around[1], other);
  for (int vertex : {a, b, c, d}) vertices_[vertex].active = true;
  return true;
}

Point SurfaceRemesher::middle_of_faces(int vertex) const {
  Point sum{};
  double weights = 0;
  for (int f : vertices_[vertex].faces) {
    const Corners& corners = faces_[f].corners;
    Point centre{};
    double size = 0;
    for (int corner : corners) {
      centre += 1.0 / 3 * vertices_[corner].place;
      size += vertices_[corner].size / 3;
    }
    const Point &a = vertices_[corners[0]].place, &b = vertices_[corners[1]].place, &c = vertices_[corners[2]].place;
    const double weight = length(cross(b - a, c - a)) / (size * size);
    sum += weight * centre;
    weights += weight;
  }
  return 1 / weights * sum;
}

void SurfaceRemesher::move(int v, double share) {
  Vertex& vertex = vertices_[v];
  if (vertex.curve < 0) {
    const Point to = middle_of_faces(v);
    put_on_patch(vertex, faces_[vertex.faces[0]].patch, vertex.place + share * (to - vertex.place));
    return;
  }
  double sum = 0, weights = 0;
  for (int near : neighbours(v)) {
    const auto edge = curve_edges_.find(ends(v, near));
    if (edge == curve_edges_.end()) continue;
    const double weight = 1 / (vertex.size + vertices_[near].size);
    sum += weight * (near < v ? edge->second.low : edge->second.high);
    weights += weight;
  }
  put_on_curve(vertex, vertex.curve, vertex.s + share * (sum / weights - vertex.s));
}

bool SurfaceRemesher::improve(int v) {
  const Vertex before = vertices_[v];
  const Shape was = worst_around(v);
  for (double share : {1.0, 0.5, 0.25}) {
    move(v, share);
    const double moved = length(vertices_[v].place - before.place);
    const Shape now = worst_around(v);
    const bool better = now.quality >= std::min(was.quality, good) && now.facing >= std::min(facing_enough, was.facing);
    if (moved > 0.01 * before.size && better) {
      for (int near : neighbours(v)) {
        const auto edge = curve_edges_.find(ends(v, near));
        if (edge != curve_edges_.end()) (v < near ? edge->second.low : edge->second.high) = vertices_[v].s;
      }
      return true;
    }
    vertices_[v] = before;
  }
  return false;
}

int SurfaceRemesher::change_edges() {
  int changes = 0;
  for (const auto& [a, b] : edges()) changes += split(a, b);
  std::vector<Ends> ascending = edges();
  std::reverse(ascending.begin(), ascending.end());
  for (const auto& [a, b] : ascending) changes += collapse(a, b);
  return changes;
}

void SurfaceRemesher::flip_edges() {
  constexpr int sweeps = 10;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    int flips = 0;
    for (const auto& [a, b] : edges()) flips += flip(a, b);
    if (flips == 0) break;
  }
}

void SurfaceRemesher::smooth() {
  constexpr int sweeps = 4;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    bool moved = false;
    for (std::size_t v = 0; v < vertices_.size(); ++v)
      if (vertices_[v].active && !vertices_[v].fixed && !vertices_[v].faces.empty())
        moved = improve(static_cast<int>(v)) || moved;
    if (!moved) break;
  }
}

RemeshedSurface SurfaceRemesher::remesh() {
  constexpr int rounds = 12;
  for (int round = 0; round < rounds; ++round) {
    const int changes = change_edges();
    wake_poor();
    flip_edges();
    smooth();
    flip_edges();
    if (changes == 0) break;
  }
  return result();
}

RemeshedSurface SurfaceRemesher::result() const {
  RemeshedSurface made;
  std::vector<int> number(vertices_.size(), -1);
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    if (vertices_[v].faces.empty()) continue;
    number[v] = static_cast<int>(made.vertices.size());
    made.vertices.push_back(vertices_[v]);
  }
  for (const Face& face : faces_)
    if (face.patch >= 0) {
      const Corners& c = face.corners;
      made.faces.push_back({{number[c[0]], number[c[1]], number[c[2]]}, face.patch});
    }
  std::vector<std::vector<std::array<RemeshedSurface::OnCurve, 2>>> edges(curves_.size());
  for (const auto& [pair, edge] : curve_edges_) {
    std::array<RemeshedSurface::OnCurve, 2> on{{{number[pair.first], edge.low}, {number[pair.second], edge.high}}};
    if (on[0].s > on[1].s) std::swap(on[0], on[1]);
    edges[edge.curve].push_back(on);
  }
  for (auto& curve : edges) {
    std::sort(curve.begin(), curve.end(), [](const auto& a, const auto& b) { return a[0].s < b[0].s; });
    std::vector<RemeshedSurface::OnCurve> chain{curve[0][0]};
    for (const auto& edge : curve) chain.push_back(edge[1]);
    made.curves.push_back(std::move(chain));
  }
  return made;
}

}  // namespace mudline
