#include "checks/body_path.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "tensor/vec.hpp"

namespace mudline {

namespace {

double distance(const PlanePoint& a, const PlanePoint& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

}  // namespace

BodyPath::BodyPath(BodyWay way, const Model& model, const GhostedMesh& mesh, const Positions& positions)
    : BodyWay(std::move(way)), positions_(positions) {
  for (const Point& p : body.outline(body.initial_placement()))
    radius_ = std::max(radius_, std::abs(p[0] - body.initial_position()[0]));
  find_surface(model, mesh);
  find_boundaries(model, mesh);
}

void BodyPath::find_surface(const Model& model, const GhostedMesh& mesh) {
  std::set<int> nodes;
  const double middle = body.initial_position()[0];
  for (const auto& [name, contact] : model.contacts()) {
    const ContactPartners partners = contact->partners();
    if (partners.body != &body) continue;
    for (const auto& side : mesh.boundary()) {
      if (side.sets.count(partners.surface) == 0) continue;
      nodes.insert(side.nodes.begin(), side.nodes.end());
      if (std::abs(0.5 * (positions_[side.nodes[0]][0] + positions_[side.nodes[1]][0]) - middle) < radius_)
        under_.push_back(&side);
      for (int node : side.nodes) {
        reach_ = std::max(reach_, std::abs(positions_[node][0] - middle));
        top_ = std::max(top_, positions_[node][1]);
      }
    }
    if (body.contour().extent() == ContourExtent::half) find_corner(mesh, partners.surface);
  }
  surface_.assign(nodes.begin(), nodes.end());
}

/// Finds the corner at which the mesh was made for the body's edge: the end of a side set that is a part of the
/// surface.
void BodyPath::find_corner(const GhostedMesh& mesh, const std::string& surface) {
  std::map<std::string, std::vector<const GhostedMesh::BoundarySide*>> parts;
  std::set<std::string> others;  // sets that reach beyond the surface
  for (const auto& side : mesh.boundary())
    for (const std::string& name : side.sets) {
      parts[name].push_back(&side);
      if (side.sets.count(surface) == 0) others.insert(name);
    }
  const std::size_t whole = parts.at(surface).size();
  for (const auto& [name, sides] : parts) {
    if (others.count(name) > 0 || sides.size() == whole) continue;
    std::map<int, int> met;  // number of sides at a corner node
    for (const auto* side : sides) {
      ++met[side->nodes[0]];
      ++met[side->nodes[1]];
    }
    for (const auto& [node, count] : met) {
      double r = positions_[node][0];
      if (count != 1 || r < 1e-9 * reach_ || r > reach_ * (1 - 1e-9)) continue;
      const ContourProjection projection = projection_at({}, in_plane(positions_[node]));
      const bool on_flank = std::abs(projection.gap) < 0.02 * radius_ && std::abs(projection.normal[0]) > 0.3;
      if (on_flank) r = radius_;  // a hole that fits the body
      if (corner_ == 0 || std::abs(std::log(r / radius_)) < std::abs(std::log(corner_ / radius_))) corner_ = r;
    }
  }
}

/// Finds the boundaries between regions: where the soil changes, or all of them where the mesh moves and regions keep
/// their common nodes.
void BodyPath::find_boundaries(const Model& model, const GhostedMesh& mesh) {
  if (surface_.empty()) return;
  const auto& blocks = model.mesh().blocks();
  for (const auto& side : mesh.boundary()) {
    if (side.other < 0 || !side.first) continue;
    if (blocks[side.block].region == blocks[side.other].region) continue;
    if (!model.ale() && model.soil()->blocks[side.block].made_of == model.soil()->blocks[side.other].made_of) continue;
    const PlanePoint a = in_plane(positions_[side.nodes[0]]), b = in_plane(positions_[side.nodes[1]]);
    const std::string name = "'" + blocks[side.block].region + "' and '" + blocks[side.other].region + "'";
    const double length = distance(a, b);
    boundaries_.push_back({a, {(b[0] - a[0]) / length, (b[1] - a[1]) / length}, name});
    boundaries_.push_back({b, boundaries_.back().along, name});
  }
}

ContourProjection BodyPath::projection_at(const Point& displacement, const PlanePoint& point) const {
  BodyPlacement placement = body.initial_placement();
  placement.centre += displacement;
  return body.closest(placement, point);
}

double BodyPath::gap(const Point& displacement) const {
  double least = 1e300;
  for (int node : surface_) least = std::min(least, gap_at(displacement, in_plane(positions_[node])));
  return least;
}

std::optional<std::size_t> BodyPath::arrival() const {
  const double touching = 1e-6 * radius_;
  double left = first_gap();  // lower bound of the gap
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i > 0) left -= length(places[i].displacement - places[i - 1].displacement);
    if (left > touching) continue;
    left = gap(places[i].displacement);
    if (left <= touching) return i;
  }
  return std::nullopt;
}

bool BodyPath::leaves() const {
  const double rounding = 1e-3 * radius_, start = first_gap();
  Point step{};
  if (places.size() > 1) {
    double least = 1e300;
    for (std::size_t i = 0; i < places.size(); i += 10) least = std::min(least, gap(places[i].displacement));
    return least >= start - rounding && gap(places.back().displacement) > start + rounding;
  }
  const auto [velocity, acceleration] = start_of_fall();
  step[1] = (velocity != 0 ? velocity : acceleration) > 0 ? 0.1 * radius_ : 0;
  return step[1] > 0 && gap(step) > start + rounding;
}

double BodyPath::lowest() const {
  double lowest = 1e300;
  if (release && release->releases(1)) {
    for (std::size_t i = 0; i < positions_.size(); ++i) lowest = std::min(lowest, positions_[i][1]);
    return lowest;
  }
  for (const Point& p : body.outline(body.initial_placement())) lowest = std::min(lowest, p[1]);
  double down = 0;
  for (const Place& place : places) down = std::min(down, place.displacement[1]);
  return lowest + down;
}

std::pair<double, double> BodyPath::start_of_fall() const {
  if (!release) return {0, 0};
  Point velocity{}, spin{};
  release->initial_velocity(velocity, spin);
  const double mass = body.properties().mass + release->added_mass(body.properties()).mass[1];
  BodyInstant at = body.initial_instant();
  at.time = places.back().time;
  at.velocity = constant_vector(velocity);
  const BodyNumber up = release->load(body.properties(), at).force[1];
  return {velocity[1], mass > 0 ? up.v / mass : 0.0};
}

std::string BodyPath::crossing() const {
  const double inside = -0.01 * radius_;
  for (const Boundary& boundary : boundaries_) {
    double left = gap_at({}, boundary.at);
    if (left < 0) continue;
    for (std::size_t i = 1; i < places.size(); ++i) {
      const Point &now = places[i].displacement, &before = places[i - 1].displacement;
      const double step = length(now - before);
      left -= step;
      if (left > inside || step == 0) continue;
      // a boundary parallel to the path is pushed aside with the soil on both of its sides
      const double across =
          std::abs((now[0] - before[0]) * boundary.along[1] - (now[1] - before[1]) * boundary.along[0]);
      left = gap_at(now, boundary.at);
      if (left <= inside && across > 0.5 * step) return boundary.name;
    }
  }
  return "";
}

std::string BodyPath::crossing_below(double below) const {
  if (!release || !release->releases(1)) return "";
  const Point& last = places.back().displacement;
  const double tip = body.initial_position()[1] + last[1], middle = body.initial_position()[0] + last[0];
  for (const Boundary& boundary : boundaries_)
    if (std::abs(boundary.along[0]) > 0.5 && std::abs(boundary.at[0] - middle) < radius_ && boundary.at[1] < tip &&
        boundary.at[1] > tip - below)
      return boundary.name;
  return "";
}

}  // namespace mudline
