#include "bodies/penetration_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "core/told.hpp"
#include "discretisation/gmsh_library.hpp"
#include "discretisation/tagged_mesh.hpp"
#include "discretisation/triangulation.hpp"

namespace mudline {

namespace {

constexpr int triangle_of_3 = 2, triangle_of_6 = 9;  // Gmsh's types

PlanePoint between(const PlanePoint& a, const PlanePoint& b, double share) {
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
}

}  // namespace

void PenetrationMesh::parameters(Parameters& p) {
  refuse_without_gmsh(p);
  position_.remember(p);
  const Geometry geometry = declare_geometry(p);
  if (!p.documenting() && geometry == Geometry::space)
    p.deck().fail("a penetration mesh is plane: allowed are 'axisymmetric' and 'plane strain'", "geometry");
  p.required("body", body_, "the body, with a half contour, that the mesh is made for");
  p.required("width", width_, "m", positive(), "of the soil, from the axis to the far side");
  p.required("depth", depth_, "m", positive(), "of the soil, from the mudline to the base");
  p.add("mudline", mudline_, "m", any(), "height of the soil's surface");
  p.required("size near body", near_size_, "m", positive(), "length of sides at the body");
  p.add("near distance", near_distance_, "m", non_negative(),
        "distance from the body up to which sides have that length");
  p.add("growth", growth_, "-", closed(0.01, 1), "by which sides become longer per distance from there on");
  p.add("largest size", largest_, "m", non_negative(),
        "bound of the length of sides; 0: an eighth of the smaller of width and depth");
  p.add("region", region_, "name of the material region");
  p.add("order", order_, "-", closed(1, 2), "order of the elements");
  p.add("time limit", time_limit_, "s", positive(), "Gmsh is given up when it has not finished after this time");
  if (!(largest_ > 0)) largest_ = std::min(width_, depth_) / 8;
}

void PenetrationMesh::check(const Section& section) {
  if (near_size_ > largest_)
    section.fail(told(near_size_, "%.6g") + " is more than the largest size, " + told(largest_, "%.6g"),
                 "size near body");
}

void PenetrationMesh::take_body(const Section& bodies, const Registry<ContourShape>& contours) {
  const std::vector<std::string> names = bodies.section_names();
  if (std::find(names.begin(), names.end(), body_) == names.end())
    position_.fail("unknown body '" + body_ + "'" + suggestion(body_, names), "body");
  const Section body = bodies.section(body_);
  if (!body.has_section("contour")) body.fail("the mesh needs the contour of this body", "contour");
  Parameters p(body);
  Point place{};
  p.required("position", place, "m", "");
  place_ = in_plane(place);
  const Section entry = body.section("contour");
  contour_ = std::make_shared<const Contour>(contours.create(entry)->contour(entry));
  if (contour_->extent() != ContourExtent::half)
    entry.fail("a penetration mesh is for bodies with a half contour, whose axis is the edge of the mesh", "extent");
  if (place_[0] != 0) body.fail("the first value must be 0: the axis of the body is the edge of the mesh", "position");
}

std::vector<PenetrationMesh::Curve> PenetrationMesh::hole() const {
  std::vector<Curve> curves;  // from the tip up, each of them from its upper end down
  for (const auto& piece : contour_->pieces()) {
    const double length = piece->length();
    const auto height = [&](double s) { return piece->point(s)[1] + place_[1] - mudline_; };
    const double start = height(0), tolerance = 1e-9 * (1 + contour_->length());
    if (curves.empty() && start > -tolerance) return {};  // the tip is not in the ground
    double end = length;
    constexpr int steps = 200;
    for (int k = 1; k <= steps && end == length; ++k)
      if (height(length * k / steps) >= -tolerance) {
        double low = length * (k - 1) / steps, high = length * k / steps;
        for (int halving = 0; halving < 60; ++halving)
          (height(0.5 * (low + high)) < 0 ? low : high) = 0.5 * (low + high);
        end = high;
        break;
      }
    const bool out = height(end) >= -tolerance;
    curves.push_back({"hole", end, [this, piece, end](double s) {
                        const PlanePoint x = piece->point(end - s);
                        return PlanePoint{x[0] + place_[0], x[1] + place_[1]};
                      }});
    if (out) {
      std::reverse(curves.begin(), curves.end());
      return curves;
    }
  }
  position_.fail("body '" + body_ + "' is wholly below the mudline, at " + told(mudline_, "%.6g m") +
                     ": a hole that is closed above it cannot be meshed here; allowed is a body that reaches it",
                 "body");
}

std::vector<PenetrationMesh::Curve> PenetrationMesh::boundary() const {
  const auto line = [](const std::string& set, const PlanePoint& from, const PlanePoint& to) {
    const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
    return Curve{set, length, [=](double s) { return between(from, to, s / length); }};
  };
  const std::vector<Curve> along = hole();
  const double base = mudline_ - depth_;
  const PlanePoint edge = along.empty() ? PlanePoint{0, mudline_} : PlanePoint{along.front().point_at(0)[0], mudline_};
  const PlanePoint tip = along.empty() ? edge : PlanePoint{0, along.back().point_at(along.back().length)[1]};
  const auto refuse = [&](const char* entry, double reach) {
    position_.fail("body '" + body_ + "' reaches to " + told(reach, "%.6g m") + " in the ground", entry);
  };
  double widest = edge[0];
  for (const Curve& curve : along)
    for (int k = 0; k <= 20; ++k) widest = std::max(widest, curve.point_at(curve.length * k / 20)[0]);
  if (widest >= width_) refuse("width", widest);
  if (mudline_ - tip[1] >= depth_) refuse("depth", mudline_ - tip[1]);
  std::vector<Curve> curves{line("axis", tip, {0, base}), line("base", {0, base}, {width_, base}),
                            line("far side", {width_, base}, {width_, mudline_}),
                            line("seabed", {width_, mudline_}, edge)};
  curves.insert(curves.end(), along.begin(), along.end());
  return curves;
}

double PenetrationMesh::size(const PlanePoint& x) const {
  const double away = contour_->closest({x[0] - place_[0], x[1] - place_[1]}).gap - near_distance_;
  return std::min(largest_, near_size_ + growth_ * std::max(0.0, away));
}

std::vector<double> PenetrationMesh::divided(const Curve& curve) const {
  // the number of wanted sides from the start, at many points
  std::vector<double> at{0}, sides{0};
  while (at.back() < curve.length) {
    const double step = std::min(0.05 * size(curve.point_at(at.back())), curve.length - at.back());
    const double next = step > 1e-9 * curve.length ? at.back() + step : curve.length;
    sides.push_back(sides.back() + (next - at.back()) / size(curve.point_at(0.5 * (at.back() + next))));
    at.push_back(next);
  }
  const int number = std::max(1, static_cast<int>(std::lround(sides.back())));
  std::vector<double> ends{0};
  for (int k = 1; k < number; ++k) {
    const double wanted = sides.back() * k / number;
    const std::size_t above = std::upper_bound(sides.begin(), sides.end(), wanted) - sides.begin();
    const double share = (wanted - sides[above - 1]) / (sides[above] - sides[above - 1]);
    ends.push_back(at[above - 1] + share * (at[above] - at[above - 1]));
  }
  ends.push_back(curve.length);
  return ends;
}

GlobalMesh PenetrationMesh::generate() const {
  std::vector<PlanePoint> vertices;
  std::vector<int> loop;
  std::map<std::pair<int, int>, PlanePoint> middles;  // of sides on the boundary, by their vertices in order
  std::map<std::string, std::vector<int>> firsts;     // vertices at which the sides of a set start
  for (const Curve& curve : boundary()) {
    const std::vector<double> ends = divided(curve);
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      const int vertex = static_cast<int>(vertices.size());
      vertices.push_back(curve.point_at(ends[k]));
      if (curve.set == "axis") vertices.back()[0] = 0;
      middles[{vertex, vertex + 1}] = curve.point_at(0.5 * (ends[k] + ends[k + 1]));
      firsts[curve.set].push_back(vertex);
      loop.push_back(vertex);
    }
  }
  const int boundary_vertices = static_cast<int>(vertices.size());
  const auto after = [&](int vertex) { return (vertex + 1) % boundary_vertices; };
  Triangulation made;
  try {
    made = triangulate(
        vertices, {{{loop}}},
        [&](double x, double y) {
          return size({x, y});
        },
        time_limit_);
  } catch (const NoTriangulation& reason) {
    position_.fail(std::string("the soil around the body cannot be meshed: ") + reason.what(), "body");
  }
  TaggedMesh mesh;
  for (const auto& x : made.points)
    mesh.nodes.push_back({static_cast<TaggedMesh::Tag>(mesh.nodes.size() + 1), {x[0], x[1], 0}});
  std::map<std::pair<int, int>, TaggedMesh::Tag> centres;
  const auto centre = [&](int a, int b) {
    const auto [entry, is_new] =
        centres.emplace(std::minmax(a, b), static_cast<TaggedMesh::Tag>(mesh.nodes.size() + 1));
    if (!is_new) return entry->second;
    const bool on_boundary = std::max(a, b) < boundary_vertices && (after(a) == b || after(b) == a);
    const int first = after(a) == b ? a : b;
    const PlanePoint x = on_boundary ? middles.at({first, first + 1}) : between(made.points[a], made.points[b], 0.5);
    mesh.nodes.push_back({entry->second, {x[0], x[1], 0}});
    return entry->second;
  };
  TaggedMesh::Cells cells{order_ == 2 ? triangle_of_6 : triangle_of_3, region_, "surface 1", {}};
  for (const std::array<int, 3>& triangle : made.triangles.front()) {
    for (int corner : triangle) cells.nodes.push_back(corner + 1);
    for (int k = 0; k < 3 && order_ == 2; ++k) cells.nodes.push_back(centre(triangle[k], triangle[(k + 1) % 3]));
  }
  mesh.cells.push_back(std::move(cells));
  firsts["surface"] = firsts["seabed"];
  if (firsts.count("hole"))
    firsts["surface"].insert(firsts["surface"].end(), firsts["hole"].begin(), firsts["hole"].end());
  for (const auto& [set, of_set] : firsts) {
    TaggedMesh::Sides sides{set, 2, {}};
    for (int vertex : of_set) sides.nodes.insert(sides.nodes.end(), {vertex + 1, after(vertex) + 1});
    mesh.sides.push_back(std::move(sides));
  }
  try {
    return global_mesh(mesh, order_, 2);
  } catch (const InputError& error) {
    position_.fail(error.what());
  }
}

}  // namespace mudline
