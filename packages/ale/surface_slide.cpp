// SurfaceMotion::move(): one relocation of the nodes on surfaces.
#include <algorithm>
#include <cmath>
#include <limits>

#include "ale/surface_motion.hpp"
#include "tensor/mat.hpp"

namespace mudline {

namespace {

/// Two unit tangents perpendicular to a unit normal.
std::array<Point, 2> tangents(const Point& normal) {
  Point axis{};
  int least = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(normal[i]) < std::abs(normal[least])) least = i;
  axis[least] = 1;
  const Point first = unit(cross(normal, axis));
  return {first, cross(normal, first)};
}

Point area_vector(const std::array<int, 3>& nodes, const Positions& x) {
  return cross(x[nodes[1]] - x[nodes[0]], x[nodes[2]] - x[nodes[0]]);
}

/// Sum over corners of the squared inverse mean ratio, with its gradient by the place of one vertex along two tangents
/// and a positive approximation of its Hessian, exact where the faces around are plane.
struct RingObjective {
  double value = 0, gradient[2] = {0, 0}, hessian[3] = {0, 0, 0};  // xx, xy, yy

  void add(const std::array<int, 3>& nodes, const double (&w)[3][2], int moving, const Positions& x,
           const std::array<Point, 2>& along) {
    Point t[2] = {};
    for (int v = 0; v < 3; ++v)
      for (int k = 0; k < 2; ++k) t[k] += w[v][k] * x[nodes[v]];
    const Point area = cross(t[0], t[1]);
    const double J = length(area), n = dot(t[0], t[0]) + dot(t[1], t[1]), mu = n / (2 * J);
    const double* own = w[moving];
    const double ddn = 2 * (own[0] * own[0] + own[1] * own[1]);
    double dn[2], dJ[2], dmu[2];
    for (int i = 0; i < 2; ++i) {
      dn[i] = 2 * (own[0] * dot(along[i], t[0]) + own[1] * dot(along[i], t[1]));
      dJ[i] = dot(area, own[0] * cross(along[i], t[1]) + own[1] * cross(t[0], along[i])) / J;
      dmu[i] = (dn[i] - 2 * mu * dJ[i]) / (2 * J);
    }
    const auto second = [&](int i, int j) {
      const double of_mu =
          ((i == j ? ddn : 0.0) - (dn[i] * dJ[j] + dJ[i] * dn[j]) / J) / (2 * J) + n * dJ[i] * dJ[j] / (J * J * J);
      return 2 * mu * of_mu + 2 * dmu[i] * dmu[j];
    };
    value += mu * mu;
    for (int i = 0; i < 2; ++i) gradient[i] += 2 * mu * dmu[i];
    hessian[0] += second(0, 0);
    hessian[1] += second(0, 1);
    hessian[2] += second(1, 1);
  }

  void add(const MeanRatio<3>& space, const std::array<Point, 2>& along) {
    value = space.valid ? value + space.value : std::numeric_limits<double>::infinity();
    const auto second = [&](int a, int b) {
      double sum = 0;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) sum += along[a][i] * space.hessian[std::min(i, j)][std::max(i, j)] * along[b][j];
      return sum;
    };
    for (int a = 0; a < 2; ++a)
      for (int i = 0; i < 3; ++i) gradient[a] += space.gradient[i] * along[a][i];
    hessian[0] += second(0, 0);
    hessian[1] += second(0, 1);
    hessian[2] += second(1, 1);
  }
};

}  // namespace

/// One relocation: the old surface and the present places of its nodes.
class SurfaceMotion::Step {
 public:
  /// `x_old`, `x`: positions of the nodes, then of the ends of tangents.
  Step(const SurfaceMotion& surface, const Positions& x_old, Positions& x)
      : surface_(surface), x_old_(x_old), x_(x), on_(surface.nodes_) {
    for (std::size_t p = 0; p < surface.patches_.size(); ++p)
      planes_.push_back(surface.patches_[p].faces.empty() ? PatchPlane()
                                                          : PatchPlane(surface.surfaces_, static_cast<int>(p), x_old));
    for (const Corner& corner : surface.corners_) normals_.push_back(area_vector(corner.nodes, x_old));
    for (const Tetrahedron& tetrahedron : surface.tetrahedra_) {
      const std::array<Point, 4> corners = corners_of(tetrahedron.on, x_old);
      std::array<Point, 4> ahead;
      for (int k = 0; k < 4; ++k) ahead[k] = corners[k] - x_old[tetrahedron.on.nodes[k]];
      ahead_.push_back(ahead);
      counts_.push_back(!folded(tetrahedron, ahead));
    }
  }

  bool folded() const {
    for (std::size_t c = 0; c < normals_.size(); ++c)
      if (folded(static_cast<int>(c))) return true;
    for (std::size_t t = 0; t < counts_.size(); ++t)
      if (counts_[t] && folded(surface_.tetrahedra_[t], ahead_[t])) return true;
    return false;
  }

  /// Passes over the vertices until none moves much.
  void relax() {
    constexpr int sweeps = 40;
    constexpr double tolerance = 1e-3;  // share of the size of the faces around
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      double largest = 0;
      for (std::size_t p = 0; p < planes_.size(); ++p) {
        const std::vector<int>& vertices = surface_.patches_[p].vertices;
        const int count = static_cast<int>(vertices.size());
        for (int k = 0; k < count; ++k)
          largest = std::max(largest, improve(vertices[sweep % 2 == 0 ? k : count - 1 - k], planes_[p]));
      }
      if (largest < tolerance) break;
    }
  }

  void place_mid_side_nodes() {
    for (std::size_t p = 0; p < planes_.size(); ++p)
      for (const MidSideNode& middle : surface_.patches_[p].mid_side_nodes) {
        const auto rests = [&](int node) { return x_[node] == x_old_[node]; };
        const bool stays = std::all_of(middle.ends.begin(), middle.ends.end(), rests) &&
                           std::all_of(middle.sides.begin(), middle.sides.end(), rests) &&
                           surface_.drift_of(middle, x_old_) <= std::max(1e-9, 2 * middle.drift);
        if (!stays) x_[middle.node] = above_centre(middle, planes_[p]);
      }
  }

  void limit_bulges() {
    for (std::size_t p = 0; p < planes_.size(); ++p)
      for (const MidSideNode& middle : surface_.patches_[p].mid_side_nodes)
        if (!planes_[p].flat && middle.sides.empty()) limit_bulge(middle, surface_.normal_at(middle, x_old_));
    for (const MidSideNode& middle : surface_.curve_mid_side_nodes_) {
      Point sum{};
      for (const auto& [f, place] : middle.on) {
        const SurfaceFace& face = surface_.surfaces_.faces[f];
        if (!planes_[face.patch].flat) sum += unit(face_normal(face, place, x_old_));
      }
      limit_bulge(middle, unit(sum));
    }
  }

  void keep_gaps(const BodySearch& body) {
    FixedGaps gaps(body, x_old_);
    for (std::size_t p = 0; p < planes_.size(); ++p) {
      if (planes_[p].flat) continue;
      const Patch& patch = surface_.patches_[p];
      for (int node : patch.vertices) keep_gap(node, surface_.shortest_edge(node, x_old_), gaps);
      for (const MidSideNode& middle : patch.mid_side_nodes) keep_gap(middle.node, edge_of(middle, x_old_), gaps);
    }
  }

 private:
  bool folded(int corner) const {
    return !(dot(area_vector(surface_.corners_[corner].nodes, x_), normals_[corner]) > 0);
  }
  bool folded(const Tetrahedron& tetrahedron, const std::array<Point, 4>& ahead) const {
    const std::array<int, 4>& nodes = tetrahedron.on.nodes;
    MeanRatio<3> ratio;
    ratio.add(tetrahedron.ideal, 0, [&](int k) { return x_[nodes[k]] + ahead[k]; });
    return !ratio.valid;
  }
  bool folded_at(int node) const {
    const std::vector<int>& around = surface_.at_[node];
    return std::any_of(around.begin(), around.end(), [&](int corner) { return folded(corner); });
  }

  Point normal_at(int node, const Positions& x) const {
    Point sum{};
    for (int c : surface_.at_[node]) sum += unit(area_vector(surface_.corners_[c].nodes, x));
    return unit(sum);
  }

  RingObjective objective(int node, const std::array<Point, 2>& along) const {
    RingObjective result;
    for (int c : surface_.at_[node]) {
      const Corner& corner = surface_.corners_[c];
      const int moving =
          static_cast<int>(std::find(corner.nodes.begin(), corner.nodes.end(), node) - corner.nodes.begin());
      result.add(corner.nodes, corner.w, moving, x_, along);
    }
    MeanRatio<3> space;
    for (int t : surface_.tetrahedra_at_[node]) {
      if (!counts_[t]) continue;
      const std::array<int, 4>& nodes = surface_.tetrahedra_[t].on.nodes;
      const int moving = static_cast<int>(std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
      space.add(surface_.tetrahedra_[t].ideal, moving, [&](int k) { return x_[nodes[k]] + ahead_[t][k]; });
    }
    result.add(space, along);
    return result;
  }

  /// Moves a vertex; returns its motion as a share of the size of the faces around.
  double improve(int node, const PatchPlane& plane) {
    const std::array<Point, 2> along = tangents(plane.flat ? plane.normal : normal_at(node, x_));
    const RingObjective now = objective(node, along);
    const auto& h = now.hessian;
    const double det = h[0] * h[2] - h[1] * h[1];
    if (!(det > 0) || !std::isfinite(now.value)) return 0;
    const double step[2] = {-(h[2] * now.gradient[0] - h[1] * now.gradient[1]) / det,
                            -(h[0] * now.gradient[1] - h[1] * now.gradient[0]) / det};
    double square = 0;
    for (int c : surface_.at_[node]) square = std::max(square, length(area_vector(surface_.corners_[c].nodes, x_)));
    const double size = std::sqrt(square);
    // Steps this small are rounding: the vertex stays, so that a surface at its optimum does not creep.
    if (std::hypot(step[0], step[1]) < 1e-9 * size) return 0;
    const Point from = x_[node];
    const SurfacePlace place = on_[node];
    double factor = 1;
    for (int cut = 0; cut < 12; ++cut, factor *= 0.5) {
      const Point to = from + factor * step[0] * along[0] + factor * step[1] * along[1];
      x_[node] = on_surface(node, limited(node, to), plane);
      if (folded_at(node) || !(objective(node, along).value <= now.value)) continue;
      return length(x_[node] - from) / size;
    }
    x_[node] = from;
    on_[node] = place;
    return 0;
  }

  /// Limits the new place to the distance that the vertex may slide at once.
  Point limited(int node, const Point& to) const {
    const Point way = to - x_old_[node];
    const double far = length(way);
    if (!(far > 0)) return to;
    const double limit = surface_.largest_slide_ * reach(node, way);
    return far <= limit ? to : x_old_[node] + limit / far * way;
  }

  /// Distance from a vertex to the edges opposite to it [m], in the direction of a displacement projected on the
  /// tangent plane.
  double reach(int node, const Point& way) const {
    const std::array<Point, 2> along = tangents(normal_at(node, x_old_));
    double u[2] = {dot(way, along[0]), dot(way, along[1])};
    const double size = std::hypot(u[0], u[1]);
    double nearest = 1e300;
    for (int c : surface_.at_[node]) {
      Mat<double, 2> ends;
      int count = 0;
      for (int other : surface_.corners_[c].nodes) {
        if (other == node) continue;
        for (int i = 0; i < 2; ++i) ends[count][i] = dot(x_old_[other] - x_old_[node], along[i]);
        ++count;
      }
      const double edge[2] = {ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]};
      const double across = (u[0] * edge[1] - u[1] * edge[0]) / size;
      if (across == 0) continue;
      const double t = (ends[0][0] * edge[1] - ends[0][1] * edge[0]) / across;
      const double s = (ends[0][0] * u[1] - ends[0][1] * u[0]) / size / across;
      if (t > 0 && s > -1e-9 && s < 1 + 1e-9) nearest = std::min(nearest, t);
    }
    return nearest < 1e300 ? nearest : surface_.shortest_edge(node, x_old_);
  }

  Point on_surface(int node, Point to, const PatchPlane& plane) {
    if (!plane.flat) {
      on_[node] = surface_.nearest(node, on_[node].face, x_old_, to);
      return surface_.at(on_[node], x_old_);
    }
    return plane.of_all.kept(to);
  }

  /// Point of the surface on its normal through the middle of the node's ends. The closest point to that middle would
  /// not do: where an edge bulges by more than a quarter of its length, it moves from side to side and away.
  Point above_centre(const MidSideNode& middle, const PatchPlane& plane) {
    const Point centre = middle_of(middle, x_), normal = surface_.normal_at(middle, x_old_);
    const double rounding = 1e-14 * edge_of(middle, x_);
    Point at = on_surface(middle.node, centre, plane);
    if (!plane.flat)
      for (int k = 0; k < 20; ++k) {
        const Point before = at;
        at = on_surface(middle.node, centre + dot(at - centre, normal) * normal, plane);
        if (length(at - before) <= rounding) break;
      }
    return at;
  }

  void limit_bulge(const MidSideNode& middle, const Point& normal) {
    Point& at = x_[middle.node];
    if (at == x_old_[middle.node]) return;
    // A curve in a coordinate plane stays in it.
    const SharedCoordinates plane({at, x_[middle.ends[0]], x_[middle.ends[1]]});
    at = plane.kept(without_bulge(at, middle_of(middle, x_), normal, edge_of(middle, x_)));
  }

  void keep_gap(int node, double span, FixedGaps& gaps) {
    if (x_[node] == x_old_[node]) return;
    const SurfacePlace& on = on_[node];
    x_[node] = gaps.kept(surface_.surfaces_.faces[on.face], on.xi, x_[node], span);
  }

  const SurfaceMotion& surface_;
  const Positions& x_old_;
  Positions& x_;
  std::vector<SurfacePlace> on_;    // (node) closest point on the old surface
  std::vector<PatchPlane> planes_;  // (patch)
  Positions normals_;               // (corner) old normal, twice the area long [m2]
  /// (tetrahedron) vectors from its nodes to its corners, constant in the relocation: a tangent's end moves with its
  /// node, as if the middle of the edge moved by the mean of the ends.
  std::vector<std::array<Point, 4>> ahead_;
  std::vector<char> counts_;  // (tetrahedron) whether it was sound before
};

void SurfaceMotion::move(const Positions& x_old, const BodySearch& body, Positions& x) const {
  const Positions wanted = x;
  Positions with_tangents = x_old;
  add_tangents(with_tangents);
  x = with_tangents;
  Step step(*this, with_tangents, x);
  double done = 0, part = 1;
  while (done < 1 && part >= 1.0 / 64) {
    const double share = done + part;
    const Positions before = x;
    for (const MeshPath& curve : surfaces_.curves)
      for (int node : curve.nodes)
        x[node] = share < 1 ? x_old[node] + share * (wanted[node] - x_old[node]) : wanted[node];
    add_tangents(x);
    if (step.folded()) {
      x = before;
      part *= 0.5;
      continue;
    }
    step.relax();
    done = share;
  }
  step.place_mid_side_nodes();
  step.keep_gaps(body);
  step.limit_bulges();
  x.resize(nodes_);
}

}  // namespace mudline
