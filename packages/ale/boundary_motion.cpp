#include "ale/boundary_motion.hpp"

#include <algorithm>
#include <cmath>

#include "core/pi.hpp"
#include "core/text.hpp"

namespace mudline {

namespace {

std::vector<std::array<double, 2>> places(const MeshPath& path, const Positions& x) {
  std::vector<std::array<double, 2>> result;
  for (int node : path.nodes) result.push_back(in_plane(x[node]));
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

SizeField BoundaryMotion::size_field(const std::array<double, 2>& focus) const {
  if (focus_.empty()) return [](const std::array<double, 2>&) { return 1.0; };
  return [this, focus](const std::array<double, 2>& x) {
    return near_size_ + growth_ * std::max(0.0, std::hypot(x[0] - focus[0], x[1] - focus[1]) - near_distance_);
  };
}

void BoundaryMotion::bind(const GhostedMesh& mesh, const Positions& source,
                          const std::map<std::string, std::shared_ptr<RigidBody>>& bodies, const Section& section,
                          const RenewedMesh* renewed) {
  if (mesh.dimension() == 3) {
    for (const std::string& name : section.parameter_names())
      section.fail("has no meaning in three dimensions: nodes of the boundary stay material points", name);
    return;
  }
  bodies_ = bodies;
  axisymmetric_ = mesh.mesh().geometry() == Geometry::axisymmetric;
  for (const std::string& name : corners_)
    if (!mesh.node_sets().count(name)) {
      std::vector<std::string> known;
      for (const auto& [set, nodes] : mesh.node_sets()) known.push_back(set);
      section.fail("unknown point set '" + name + "'" + suggestion(name, known), "corners");
    }
  for (const std::string& name : material_sides_) require_side_set(mesh.mesh(), section, "material sides", name);
  std::array<double, 2> focus{};
  if (!focus_.empty()) {
    std::vector<std::string> known;
    for (const auto& [name, body] : bodies) known.push_back(name);
    if (!bodies.count(focus_)) section.fail("unknown body '" + focus_ + "'" + suggestion(focus_, known), "focus");
    if (!(near_size_ > 0)) section.fail("must be positive where a focus is given", "size near focus");
    focus = in_plane(bodies.at(focus_)->initial_position());
  }
  if (renewed) {
    paths_ = renewed->paths;
    for (MeshPath& path : paths_)
      for (int& node : path.nodes) node = mesh.local_node(node);
    origins_ = renewed->origins;
    focus = renewed->focus;
  } else {
    paths_ = find_paths(mesh, source, corners_, corner_angle_ * pi / 180,
                        [&](int node) { return starts_on_body(in_plane(source[node])); });
  }
  for (const MeshPath& path : paths_) {
    const PathCurve curve(places(path, source));
    const CurveMeasure measure(curve, size_field(focus));
    std::vector<double> shares;
    for (int v = 0; v < path.num_vertices(); ++v)
      shares.push_back(measure.at(curve.parameter(v * path.stride)) / measure.total());
    shares_.push_back(shares);
    if (!renewed) origins_.push_back({shares, measure.total()});
    slides_.push_back(path.num_vertices() > 2 && !material(path));
  }
}

bool BoundaryMotion::material(const MeshPath& path) const {
  return std::any_of(material_sides_.begin(), material_sides_.end(),
                     [&](const std::string& name) { return path.sets.count(name) > 0; });
}

std::array<double, 2> BoundaryMotion::focus(const State& state) const {
  return focus_.empty() ? std::array<double, 2>{} : in_plane(bodies_.at(focus_)->position(state));
}

bool BoundaryMotion::starts_on_body(const std::array<double, 2>& x) const {
  constexpr double near = 1e-3;  // [-] of a contour's length
  return std::any_of(bodies_.begin(), bodies_.end(), [&](const auto& entry) {
    const RigidBody& body = *entry.second;
    return std::abs(body.closest(body.initial_placement(), x).gap) < near * body.contour().length();
  });
}

std::optional<ContourFoot> BoundaryMotion::foot(const State& state, const std::array<double, 2>& x) const {
  std::optional<ContourFoot> nearest;
  for (const auto& [name, body] : bodies_) {
    const ContourFoot here = body->closest(body->placement(state), x);
    if (!nearest || here.gap < nearest->gap) nearest = here;
  }
  return nearest;
}

Positions BoundaryMotion::move(const Positions& x, const State& state) const {
  Positions result = x;
  const SizeField size = size_field(focus(state));
  for (std::size_t p = 0; p < paths_.size(); ++p)
    if (slides_[p]) move_path(p, state, size, result);
  return result;
}

std::vector<double> BoundaryMotion::freedom(const Positions& x, const State& state) const {
  std::vector<double> result(x.size(), 0.0);
  for (std::size_t p = 0; p < paths_.size(); ++p) {
    const MeshPath& path = paths_[p];
    if (!slides_[p] || !path.outer) continue;
    for (std::size_t i = 1; i + 1 < path.nodes.size(); ++i) {
      const auto &before = x[path.nodes[i - 1]], &after = x[path.nodes[i + 1]];
      const double sides = path.stride * std::hypot(after[0] - before[0], after[1] - before[1]);
      result[path.nodes[i]] =
          bodies_.empty() ? 1.0 : std::clamp(foot(state, in_plane(x[path.nodes[i]]))->gap / sides - 1, 0.0, 1.0);
    }
  }
  return result;
}

void BoundaryMotion::move_path(std::size_t p, const State& state, const SizeField& size, Positions& x) const {
  const MeshPath& path = paths_[p];
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
    // what rounding alone moves stays where it is; a squeezed side may be left at once, whatever its own length
    if (std::abs(slide) > 1e-9 * std::min(before, after))
      s[i] = old + std::clamp(slide, -largest_slide_ * before, largest_slide_ * after);
  }
  for (int i = 1; stride == 2 && i < last; i += 2) {
    s[i] = 0.5 * (s[i - 1] + s[i + 1]);
    if (s[i - 1] == curve.parameter(i - 1) && s[i + 1] == curve.parameter(i + 1) &&
        std::abs(s[i] - curve.parameter(i)) < 1e-9 * (s[i + 1] - s[i - 1]))
      s[i] = curve.parameter(i);
  }
  for (int i = 1; i < last; ++i)
    if (s[i] != curve.parameter(i)) x[path.nodes[i]] = on_plane(places.at(s[i], s[i + 1] - s[i - 1]));
}

PathPlaces::PathPlaces(const BoundaryMotion& boundary, const MeshPath& path, const Positions& x, const State& state)
    : boundary_(boundary), state_(state), curve_(places(path, x)) {
  const double near = 1e-9 * curve_.length();
  on_axis_ = boundary.axisymmetric() &&
             std::all_of(path.nodes.begin(), path.nodes.end(), [&](int node) { return std::abs(x[node][0]) <= near; });
  for (int node : path.nodes) {
    const auto foot = boundary.foot(state, in_plane(x[node]));
    if (!foot) return;
    gaps_.push_back(foot->gap);
  }
}

std::array<double, 2> PathPlaces::at(double s, double span) const {
  std::array<double, 2> to = curve_.at(s);
  const double gap = gaps_.empty() ? 1e300 : curve_.interpolate(gaps_, s);
  if (gap < 0.25 * span) {
    const ContourFoot here = *boundary_.foot(state_, to);
    for (int d = 0; d < 2; ++d) to[d] += (gap - here.gap) * here.normal[d];
  }
  if (on_axis_) to[0] = 0;
  return to;
}

}  // namespace mudline
