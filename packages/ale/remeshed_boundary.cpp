#include "ale/remeshed_boundary.hpp"

#include <algorithm>
#include <map>
#include <memory>

#include "ale/fixed_gaps.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

using Ends = std::pair<int, int>;  // ascending

Ends ends(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

class SurfaceRemeshing {
 public:
  SurfaceRemeshing(const Remesher& plan, const Positions& x, const State& state)
      : boundary_(plan.boundary()),
        surfaces_(boundary_.parts()),
        x_(x),
        body_([this, &state](const Point& at) { return boundary_.projection(state, at); }),
        gaps_(body_, x),
        locator_(surfaces_.faces, x) {
    for (const MeshPath& path : surfaces_.curves)
      curves_.push_back(std::make_unique<PathPlaces>(boundary_, path, x, state));
    for (std::size_t p = 0; p < surfaces_.patches.size(); ++p) planes_.emplace_back(surfaces_, static_cast<int>(p), x);
    const SurfaceSizes sizes{boundary_.relative_sizes(), plan.wanted_on_surface(state)};
    made_.mesh = SurfaceRemesher(surfaces_, x, sizes).remesh();
  }

  RemeshedBoundary make() {
    place_vertices();
    if (!surfaces_.faces.empty() && order(surfaces_.faces.front().shape) == 2) place_mid_side_nodes();
    return std::move(made_);
  }

 private:
  void place_vertices();
  void place_mid_side_nodes();
  /// Point of a patch's surface, with the gap to bodies kept; `span`: length of the edges there [m].
  Point on_patch(int patch, const SurfacePlace& place, double span);
  /// Point of a curve; s: parameter of its rounded copy [m].
  Point on_curve(std::size_t curve, double s, double span) const;

  const BoundaryMotion& boundary_;
  const MeshSurfaces& surfaces_;
  const Positions& x_;
  BodySearch body_;
  FixedGaps gaps_;
  FaceLocator locator_;
  std::vector<std::unique_ptr<PathPlaces>> curves_;
  std::vector<PatchPlane> planes_;
  RemeshedBoundary made_;
};

Point SurfaceRemeshing::on_patch(int patch, const SurfacePlace& place, double span) {
  const Point at = planes_[patch].of_all.kept(locator_.at(place));
  return planes_[patch].flat ? at : gaps_.kept(surfaces_.faces[place.face], place.xi, at, span);
}

Point SurfaceRemeshing::on_curve(std::size_t curve, double s, double span) const {
  const double length = curves_[curve]->curve().length();
  return curves_[curve]->at(s * length / made_.mesh.curves[curve].back().s, span);
}

void SurfaceRemeshing::place_vertices() {
  std::vector<double> shortest(made_.mesh.vertices.size(), 1e300);  // (vertex) its shortest edge [m]
  for (const RemeshedSurface::Face& face : made_.mesh.faces)
    for (int k = 0; k < 3; ++k) {
      const int a = face.vertices[k], b = face.vertices[(k + 1) % 3];
      const double edge = distance(made_.mesh.vertices[a].place, made_.mesh.vertices[b].place);
      shortest[a] = std::min(shortest[a], edge);
      shortest[b] = std::min(shortest[b], edge);
    }
  for (std::size_t v = 0; v < made_.mesh.vertices.size(); ++v) {
    const SurfaceVertex& vertex = made_.mesh.vertices[v];
    const bool inside = vertex.node < 0 && vertex.curve < 0;
    made_.places.push_back(vertex.node >= 0 ? x_[vertex.node]
                           : inside         ? on_patch(surfaces_.faces[vertex.on.face].patch, vertex.on, shortest[v])
                                            : on_curve(vertex.curve, vertex.s, shortest[v]));
  }
}

void SurfaceRemeshing::place_mid_side_nodes() {
  std::map<Ends, int> old;  // old mid-side nodes by the ends of their edge
  for (const SurfaceFace& face : surfaces_.faces)
    for (int k = 0; k < 3; ++k) old[ends(face.nodes[k], face.nodes[(k + 1) % 3])] = face.nodes[3 + k];
  std::map<Ends, Point> on_curves;
  const auto old_mid_side_node = [&](int a, int b) {
    const int from = made_.mesh.vertices[a].node, to = made_.mesh.vertices[b].node;
    const auto found = from >= 0 && to >= 0 ? old.find(ends(from, to)) : old.end();
    return found != old.end() ? found->second : -1;
  };
  for (std::size_t c = 0; c < made_.mesh.curves.size(); ++c)
    for (std::size_t i = 0; i + 1 < made_.mesh.curves[c].size(); ++i) {
      const auto &from = made_.mesh.curves[c][i], &to = made_.mesh.curves[c][i + 1];
      if (old_mid_side_node(from.vertex, to.vertex) < 0)
        on_curves[ends(from.vertex, to.vertex)] = on_curve(c, 0.5 * (from.s + to.s), to.s - from.s);
    }
  std::map<Ends, std::size_t> number;
  for (const RemeshedSurface::Face& face : made_.mesh.faces)
    for (int k = 0; k < 3; ++k) {
      const int a = face.vertices[k], b = face.vertices[(k + 1) % 3];
      const auto [found, added] = number.emplace(ends(a, b), made_.mid_side_nodes.size());
      const auto on_curve = on_curves.find(ends(a, b));
      const double edge = distance(made_.places[a], made_.places[b]);
      const Point centre = 0.5 * (made_.places[a] + made_.places[b]);
      if (added) {
        const int node = old_mid_side_node(a, b);
        made_.mid_side_nodes.push_back({{a, b}, {}, node});
        made_.mid_side_nodes.back().place = node >= 0 ? x_[node]
                                            : on_curve != on_curves.end()
                                                ? on_curve->second
                                                : on_patch(face.patch, locator_.over(face.patch, centre), edge);
      }
      RemeshedBoundary::MidSideNode& middle = made_.mid_side_nodes[found->second];
      if (middle.node >= 0 || planes_[face.patch].flat) continue;
      const Point normal = locator_.normal(locator_.nearest(face.patch, middle.place));
      middle.place = without_bulge(middle.place, centre, normal, edge);
    }
  for (const RemeshedSurface::Face& face : made_.mesh.faces)  // planes stay planes
    if (planes_[face.patch].flat)
      for (int k = 0; k < 3; ++k) {
        RemeshedBoundary::MidSideNode& middle =
            made_.mid_side_nodes[number.at(ends(face.vertices[k], face.vertices[(k + 1) % 3]))];
        if (middle.node < 0) middle.place = planes_[face.patch].of_all.kept(middle.place);
      }
}

}  // namespace

RemeshedBoundary remeshed_boundary(const Remesher& plan, const Positions& x, const State& state) {
  return SurfaceRemeshing(plan, x, state).make();
}

}  // namespace mudline
