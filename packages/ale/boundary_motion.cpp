#include "ale/boundary_motion.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "ale/interior_motion.hpp"
#include "core/pi.hpp"
#include "core/text.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

Positions places(const MeshPath& path, const Positions& x) {
  Positions result;
  for (int node : path.nodes) result.push_back(x[node]);
  return result;
}

}  // namespace

void BoundaryMotion::parameters(Parameters& p) {
  p.add("corners", corners_, "point sets whose nodes stay material points, besides the corners of the mesh");
  p.add("corner angle [deg]", corner_angle_, "-", open(0, 180),
        "a boundary that turns by more in the source's mesh, and does not lie on a body there, has a corner");
  p.add("material sides", material_sides_, "side sets whose nodes do not slide");
  p.add("largest slide", largest_slide_, "-", half_open(0, 0.5),
        "a node slides at most by this share of the side that it moves along at once");
  p.add("focus", focus_,
        "body whose reference point the finest sides travel with; empty: the source's spacing everywhere");
  p.add("size near focus", near_size_, "m", non_negative(),
        "length of the sides near the focus; only its ratio to the growth counts");
  p.add("near distance", near_distance_, "m", non_negative(), "distance from the focus up to which that size holds");
  p.add("growth", growth_, "-", non_negative(), "increase of the size per distance beyond");
}

SizeField BoundaryMotion::size_field(const Point& focus) const {
  if (focus_.empty()) return [](const Point&) { return 1.0; };
  return [this, focus](const Point& x) {
    return near_size_ + growth_ * std::max(0.0, distance(x, focus) - near_distance_);
  };
}

void BoundaryMotion::bind(const GhostedMesh& mesh, const Positions& source,
                          const std::map<std::string, std::shared_ptr<RigidBody>>& bodies, const Section& section,
                          const RemeshedMesh* remeshed) {
  bodies_ = bodies;
  in_space_ = mesh.dimension() == 3;
  axisymmetric_ = mesh.mesh().geometry() == Geometry::axisymmetric;
  for (const std::string& name : corners_)
    if (!mesh.node_sets().count(name)) {
      std::vector<std::string> known;
      for (const auto& [set, nodes] : mesh.node_sets()) known.push_back(set);
      section.fail("unknown point set '" + name + "'" + suggestion(name, known), "corners");
    }
  for (const std::string& name : material_sides_) require_side_set(mesh.mesh(), section, "material sides", name);
  Point focus{};
  if (!focus_.empty()) {
    std::vector<std::string> known;
    for (const auto& [name, body] : bodies) known.push_back(name);
    if (!bodies.count(focus_)) section.fail("unknown body '" + focus_ + "'" + suggestion(focus_, known), "focus");
    if (!(near_size_ > 0)) section.fail("must be positive where a focus is given", "size near focus");
    focus = bodies.at(focus_)->initial_position();
  }
  if (remeshed) {
    origins_ = remeshed->origins;
    focus = remeshed->focus;
  }
  MeshSurfaces parts = remeshed ? remeshed_parts(mesh, *remeshed) : deck_parts(mesh, source);
  for (MeshPath& path : parts.curves) path.material = material(path.sets);
  for (SurfacePatch& patch : parts.patches) patch.material = material(patch.sets);
  surfaces_ = SurfaceMotion(std::move(parts), source, largest_slide_,
                            in_space_ ? CornerSimplices(mesh).on_boundary(mesh) : std::vector<BoundarySimplex>());
  if (in_space_) relative_sizes_ = remeshed ? remeshed_sizes(mesh, *remeshed) : deck_sizes(source, size_field(focus));
  for (const MeshPath& path : paths()) {
    const PathCurve curve(places(path, source));
    const CurveMeasure measure(curve, size_field(focus));
    std::vector<double> shares;
    for (int v = 0; v < path.num_vertices(); ++v)
      shares.push_back(measure.at(curve.parameter(v * path.stride)) / measure.total());
    shares_.push_back(shares);
    if (!remeshed) origins_.push_back({shares, measure.total()});
  }
}

MeshSurfaces BoundaryMotion::deck_parts(const GhostedMesh& mesh, const Positions& source) const {
  const auto on_body = [&](int node) { return starts_on_body(source[node]); };
  const double angle = corner_angle_ * pi / 180;
  const std::set<int> corners = corner_nodes(mesh);
  if (in_space_) return split_surfaces(boundary_faces(mesh), source, corners, angle, on_body);
  MeshSurfaces result;
  result.curves = find_paths(mesh, source, corners, angle, on_body);
  return result;
}

/// A mesh from remeshing stores its paths, the patches of its faces and their wanted sizes.
MeshSurfaces BoundaryMotion::remeshed_parts(const GhostedMesh& mesh, const RemeshedMesh& remeshed) const {
  MeshSurfaces result;
  result.curves = remeshed.paths;
  for (MeshPath& path : result.curves)
    for (int& node : path.nodes) node = mesh.local_node(node);
  if (!in_space_) return result;
  std::map<std::array<long long, 3>, int> patches;
  for (const FaceOfPatch& face : remeshed.faces) patches[face.corners] = face.patch;
  std::vector<SurfaceFace> faces = boundary_faces(mesh);
  for (SurfaceFace& face : faces) {
    std::array<long long, 3> ids{};
    for (int k = 0; k < 3; ++k) ids[k] = mesh.node_id(face.nodes[k]);
    std::sort(ids.begin(), ids.end());
    face.patch = patches.at(ids);
  }
  return joined_surfaces(std::move(faces), std::move(result.curves), mesh.num_nodes(), corner_nodes(mesh));
}

std::set<int> BoundaryMotion::corner_nodes(const GhostedMesh& mesh) const {
  std::set<int> result;
  for (const std::string& name : corners_)
    for (int node : mesh.node_sets().at(name)) result.insert(node);
  return result;
}

std::vector<double> BoundaryMotion::remeshed_sizes(const GhostedMesh& mesh, const RemeshedMesh& remeshed) const {
  std::vector<double> result(mesh.num_nodes(), 0.0);
  for (const RelativeSize& at : remeshed.sizes) result[mesh.local_node(at.node)] = at.size;
  return result;
}

std::vector<double> BoundaryMotion::deck_sizes(const Positions& source, const SizeField& size) const {
  std::vector<double> result(source.size(), 0.0);
  std::vector<int> around(source.size(), 0);
  for (const SurfaceFace& face : parts().faces) {
    if (num_corners(face.shape) != 3) continue;
    const Point &a = source[face.nodes[0]], &b = source[face.nodes[1]], &c = source[face.nodes[2]];
    const double area = 0.5 * length(cross(b - a, c - a));
    for (int k = 0; k < 3; ++k) {
      result[face.nodes[k]] += 2 * std::sqrt(area / std::sqrt(3.0)) / size(source[face.nodes[k]]);
      ++around[face.nodes[k]];
    }
  }
  for (std::size_t node = 0; node < source.size(); ++node)
    if (around[node] > 0) result[node] /= around[node];
  return result;
}

bool BoundaryMotion::material(const std::set<std::string>& sets) const {
  return std::any_of(material_sides_.begin(), material_sides_.end(),
                     [&](const std::string& name) { return sets.count(name) > 0; });
}

Point BoundaryMotion::focus(const State& state) const {
  return focus_.empty() ? Point{} : bodies_.at(focus_)->position(state);
}

bool BoundaryMotion::starts_on_body(const Point& x) const {
  constexpr double near = 2e-3;  // [-] share of a body's reach
  return std::any_of(bodies_.begin(), bodies_.end(), [&](const auto& entry) {
    const RigidBody& body = *entry.second;
    return std::abs(body.gap(body.initial_placement(), x)) < near * body.reach();
  });
}

std::optional<NearBody> BoundaryMotion::projection(const State& state, const Point& x) const {
  std::optional<NearBody> nearest;
  for (const auto& [name, body] : bodies_) {
    const BodyPlacement placement = body->placement(state);
    NearBody here;
    if (body->surface()) {
      const SurfaceProjection there = body->projection(placement, x);
      here = {there.gap, there.normal};
    } else {
      const ContourProjection there = body->closest(placement, in_plane(x));
      here = {there.gap, on_plane(there.normal)};
    }
    if (!nearest || here.gap < nearest->gap) nearest = here;
  }
  return nearest;
}

Positions BoundaryMotion::move(const Positions& x, const State& state) const {
  Positions result = x;
  const SizeField size = size_field(focus(state));
  for (std::size_t p = 0; p < paths().size(); ++p)
    if (paths()[p].slides()) move_path(p, state, size, result);
  if (!parts().patches.empty())
    surfaces_.move(
        x, [&](const Point& at) { return projection(state, at); }, result);
  return result;
}

std::vector<double> BoundaryMotion::freedom(const Positions& x, const State& state) const {
  std::vector<double> result(x.size(), 0.0);
  const auto free = [&](int node, double sides) {
    return bodies_.empty() ? 1.0 : std::clamp(projection(state, x[node])->gap / sides - 1, 0.0, 1.0);
  };
  for (const MeshPath& path : paths()) {
    if (!path.slides() || !path.outer) continue;
    for (std::size_t i = 1; i + 1 < path.nodes.size(); ++i)
      result[path.nodes[i]] = free(path.nodes[i], path.stride * distance(x[path.nodes[i + 1]], x[path.nodes[i - 1]]));
  }
  for (const auto& [node, edge] : surfaces_.outer_nodes(x)) result[node] = free(node, 2 * edge);
  return result;
}

void BoundaryMotion::move_path(std::size_t p, const State& state, const SizeField& size, Positions& x) const {
  const MeshPath& path = paths()[p];
  const PathPlaces places(*this, path, x, state);
  const PathCurve& curve = places.curve();
  const CurveMeasure measure(curve, size);
  const int vertices = path.num_vertices(), stride = path.stride, last = static_cast<int>(path.nodes.size()) - 1;
  std::vector<double> s(path.nodes.size());
  for (int v = 0; v < vertices; ++v) {
    const int i = v * stride;
    const double old = curve.parameter(i);
    s[i] = old;
    if (v == 0 || v == vertices - 1) continue;
    const double before = old - curve.parameter(i - stride), after = curve.parameter(i + stride) - old;
    const double slide = measure.place(shares_[p][v] * measure.total()) - old;
    // Slides by rounding alone are not made. The limit on a slide is the length of the side ahead, so that a squeezed
    // side can recover at once.
    if (std::abs(slide) > 1e-12 * std::min(before, after))
      s[i] = old + std::clamp(slide, -largest_slide_ * before, largest_slide_ * after);
  }
  if (stride == 2)
    for (int i = 1; i < last; i += 2) {
      s[i] = 0.5 * (s[i - 1] + s[i + 1]);
      if (s[i - 1] == curve.parameter(i - 1) && s[i + 1] == curve.parameter(i + 1) &&
          std::abs(s[i] - curve.parameter(i)) < 1e-9 * (s[i + 1] - s[i - 1]))
        s[i] = curve.parameter(i);
    }
  for (int i = 1; i < last; ++i)
    if (s[i] != curve.parameter(i)) x[path.nodes[i]] = places.at(s[i], s[i + 1] - s[i - 1]);
}

PathPlaces::PathPlaces(const BoundaryMotion& boundary, const MeshPath& path, const Positions& x, const State& state)
    : boundary_(boundary), state_(state), curve_(places(path, x)) {
  if (boundary.in_space()) of_all_ = SharedCoordinates(places(path, x));
  const double near = 1e-9 * curve_.length();
  if (boundary.axisymmetric())
    of_all_.shared[0] =
        std::all_of(path.nodes.begin(), path.nodes.end(), [&](int node) { return std::abs(x[node][0]) <= near; });
  for (int node : path.nodes) {
    const auto projection = boundary.projection(state, x[node]);
    if (!projection) return;
    gaps_.push_back(projection->gap);
  }
}

Point PathPlaces::at(double s, double span) const {
  Point to = curve_.at(s);
  const double gap = gaps_.empty() ? 1e300 : curve_.interpolate(gaps_, s);
  if (gap < 0.25 * span) {
    const NearBody here = *boundary_.projection(state_, to);
    for (int d = 0; d < place_size; ++d) to[d] += (gap - here.gap) * here.normal[d];
  }
  return of_all_.kept(to);
}

}  // namespace mudline
