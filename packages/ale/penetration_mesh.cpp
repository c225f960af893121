#include "ale/penetration_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ale/path_curve.hpp"
#include "ale/simplex_mesh.hpp"
#include "core/told.hpp"
#include "discretisation/gmsh_library.hpp"
#include "discretisation/triangulation.hpp"

namespace mudline {

void PenetrationMesh::parameters(Parameters& p) {
  refuse_without_gmsh(p);
  position_.remember(p);
  geometry_ = declare_geometry(p);
  if (!p.documenting() && geometry_ == Geometry::space)
    p.deck().fail("a penetration mesh is plane: allowed are 'axisymmetric' and 'plane strain'", "geometry");
  p.required("body", body_name_, "the body, with a half contour, that the mesh is made for");
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

void PenetrationMesh::read_body(const Section& bodies, const BodyRegistries& registries) {
  const std::vector<std::string> names = bodies.section_names();
  if (std::find(names.begin(), names.end(), body_name_) == names.end())
    position_.fail("unknown body '" + body_name_ + "'" + suggestion(body_name_, names), "body");
  const Section section = bodies.section(body_name_);
  body_ = RigidBody::read(section, geometry_, registries);
  if (body_->contour().extent() != ContourExtent::half)
    section.section("contour").fail(
        "a penetration mesh is for bodies with a half contour, whose axis is the edge of the mesh", "extent");
  if (body_->initial_position()[0] != 0)
    section.fail("the first value must be 0: the axis of the body is the edge of the mesh", "position");
  if (!hole().empty()) return;
  std::vector<Curve> contour;
  for (const auto& piece : body_->contour().pieces())
    contour.push_back({"", piece->length(), [piece](double s) { return piece->point(s); }});
  lip_ = 1.04 * widest(contour);
}

double PenetrationMesh::widest(const std::vector<Curve>& curves) {
  double most = 0;
  for (const Curve& curve : curves)
    for (int k = 0; k <= 20; ++k) most = std::max(most, curve.point_at(curve.length * k / 20)[0]);
  return most;
}

std::vector<PenetrationMesh::Curve> PenetrationMesh::hole() const {
  std::vector<Curve> curves;  // from the tip up, each of them from its upper end down
  const double place = body_->initial_position()[1], tolerance = 1e-9 * (1 + body_->contour().length());
  for (const auto& piece : body_->contour().pieces()) {
    const double length = piece->length();
    const auto height = [&](double s) { return piece->point(s)[1] + place - mudline_; };
    const double start = height(0);
    if (curves.empty() && start > -tolerance) return {};  // the tip is not in the ground
    double end = length;
    constexpr int steps = 200;
    for (int k = 1; k <= steps && end == length; ++k)
      if (height(length * k / steps) >= -tolerance)
        end = place_at_height(*piece, length * (k - 1) / steps, length * k / steps, mudline_ - place);
    const bool out = height(end) >= -tolerance;
    curves.push_back({"hole", end, [piece, end, place](double s) {
                        const PlanePoint x = piece->point(end - s);
                        return PlanePoint{x[0], x[1] + place};
                      }});
    if (out || std::abs(piece->point(length)[0]) < tolerance) {
      std::reverse(curves.begin(), curves.end());
      return curves;
    }
  }
  position_.fail("the contour of body '" + body_name_ +
                     "' ends in the ground, off the axis: it must reach the mudline, at " + told(mudline_, "%.6g m") +
                     ", or the axis",
                 "body");
}

std::vector<PenetrationMesh::Curve> PenetrationMesh::boundary() const {
  const auto line = [](const std::string& set, const PlanePoint& from, const PlanePoint& to) {
    const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
    return Curve{set, length, [=](double s) { return from + (s / length) * (to - from); }};
  };
  const std::vector<Curve> along = hole();
  const double base = mudline_ - depth_;
  const PlanePoint edge = along.empty() ? PlanePoint{0, mudline_} : PlanePoint{along.front().point_at(0)[0], mudline_};
  const PlanePoint tip = along.empty() ? edge : PlanePoint{0, along.back().point_at(along.back().length)[1]};
  const auto refuse = [&](const char* entry, double reach) {
    position_.fail("body '" + body_name_ + "' reaches to " + told(reach, "%.6g m") + " in the ground", entry);
  };
  const double reach = std::max({lip_, edge[0], widest(along)});
  if (reach >= width_) refuse("width", reach);
  if (mudline_ - tip[1] >= depth_) refuse("depth", mudline_ - tip[1]);
  std::vector<Curve> curves{line("axis", tip, {0, base}), line("base", {0, base}, {width_, base}),
                            line("far side", {width_, base}, {width_, mudline_})};
  if (along.empty()) {
    const PlanePoint corner{lip_, mudline_};
    curves.push_back(line("seabed", {width_, mudline_}, corner));
    curves.push_back(line("seabed", corner, edge));
    return curves;
  }
  const PlanePoint top = along.front().point_at(0);
  const bool buried = top[1] < mudline_ - 1e-9 * depth_;
  curves.push_back(line("seabed", {width_, mudline_}, buried ? PlanePoint{0, mudline_} : edge));
  if (buried) curves.push_back(line("axis", {0, mudline_}, {0, top[1]}));
  curves.insert(curves.end(), along.begin(), along.end());
  return curves;
}

double PenetrationMesh::size(const PlanePoint& x) const {
  double away = body_->contour().closest({x[0], x[1] - body_->initial_position()[1]}).gap;
  // the surface under a body becomes the wall of its hole
  if (lip_ > 0) away = std::min(away, std::hypot(std::max(0.0, x[0] - lip_), x[1] - mudline_));
  return std::min(largest_, near_size_ + growth_ * std::max(0.0, away - near_distance_));
}

GlobalMesh PenetrationMesh::generate() const {
  constexpr int parts = 64;  // of a curve; in each of them the size is smooth
  std::vector<PlanePoint> vertices, middles;
  std::vector<std::string> sets;  // of the sides that start at the vertices
  for (const Curve& curve : boundary()) {
    const std::vector<double> ends = divided(
        curve.length, [&](double s) { return size(curve.point_at(s)); }, parts);
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      vertices.push_back(curve.point_at(ends[k]));
      middles.push_back(curve.point_at(0.5 * (ends[k] + ends[k + 1])));
      sets.push_back(curve.set);
    }
  }
  // an arc that ends on the axis misses it by rounding
  for (PlanePoint& x : vertices)
    if (std::abs(x[0]) < 1e-12 * width_) x[0] = 0;
  const int number = static_cast<int>(vertices.size());
  const auto next = [&](int vertex) { return (vertex + 1) % number; };
  std::vector<int> loop(number);
  std::iota(loop.begin(), loop.end(), 0);
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
  SimplexMesh simplices(region_, order_ == 2 ? CellShape::tri6 : CellShape::tri3);
  for (const PlanePoint& x : made.points) simplices.places.push_back(on_plane(x));
  for (const auto& t : made.triangles.front()) simplices.add(0, {t[0], t[1], t[2], -1});
  for (int v = 0; v < number; ++v) simplices.bend(v, next(v), on_plane(middles[v]));
  GlobalMesh mesh = simplices.number();
  const auto sides = simplices.sides();
  for (int v = 0; v < number; ++v) {
    const GlobalMesh::Side& side = sides.at({v, next(v)});
    mesh.side_sets[sets[v]].push_back(side);
    if (sets[v] == "seabed" || sets[v] == "hole") mesh.side_sets["surface"].push_back(side);
  }
  return mesh;
}

}  // namespace mudline
