#include "ale/remesher.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "ale/remeshed_boundary.hpp"
#include "ale/remesher_builder.hpp"
#include "core/text.hpp"
#include "discretisation/element_map.hpp"
#include "discretisation/gmsh_library.hpp"
#include "discretisation/triangulation.hpp"

namespace mudline {

namespace {

/// Length of the source's sides at a share of the path, over the measure's total; linear between the middles of sides.
double side_at(const std::vector<double>& shares, double share) {
  const int sides = static_cast<int>(shares.size()) - 1;
  const auto middle = [&](int v) { return 0.5 * (shares[v] + shares[v + 1]); };
  const auto length = [&](int v) { return shares[v + 1] - shares[v]; };
  int after = 0;
  while (after < sides && middle(after) < share) ++after;
  if (after == 0) return length(0);
  if (after == sides) return length(sides - 1);
  const double t = (share - middle(after - 1)) / (middle(after) - middle(after - 1));
  return (1 - t) * length(after - 1) + t * length(after);
}

double lowest_quality(const GlobalMesh& mesh) {
  double lowest = 1e300;
  for (const auto& block : mesh.blocks) {
    const std::size_t n = num_nodes(block.shape);
    for (std::size_t first = 0; first < block.nodes.size(); first += n)
      lowest = std::min(lowest, ElementMap(block.shape, [&](int a) {
                                  return mesh.coordinates[block.nodes[first + a]].data();
                                }).scaled_jacobian());
  }
  return lowest;
}

}  // namespace

void RemeshingParameters::parameters(Parameters& p) {
  p.add("when quality below", quality_below, "-", half_open(0, 1),
        "the region is remeshed when the smallest scaled Jacobian is below this");
  p.add("when side above", side_above, "-", positive(),
        "also when a side of its boundary (in space: an edge) is longer than so many times its wanted length; a new "
        "boundary has sides of up to 1.5 times theirs, so that less than this means whenever the steps between two "
        "attempts are over");
  p.choice(
      "size", size, {{"source", Size::source}, {"adaptive", Size::adaptive}},
      "in the plane: wanted sizes of the deck's mesh and the distance from the boundary, or of the error estimate");
  if (p.documenting() || size == Size::adaptive) {
    p.required("smallest size", smallest_size, "m", positive(), "with adaptive sizes: no smaller ones are wanted");
    p.required("largest size", largest_size, "m", positive(), "with adaptive sizes: no larger ones are wanted");
  }
  p.add("least steps", least_steps, "-", closed(1, 1000000), "steps between two attempts, at least");
  p.add("wall size", wall_size, "m", non_negative(),
        "wanted length of the sides at a body; 0: that of the deck's mesh at the same share of the boundary");
  p.add("growth", growth, "-", half_open(0, 2),
        "increase of the wanted size per distance from a body's wall, and of the elements' per distance from the "
        "boundary");
  p.add("time limit", time_limit, "s", positive(), "Gmsh is given up when it has not finished after this time");
}

Remesher::Remesher(const GhostedMesh& mesh, const BoundaryMotion& boundary, const RemeshingParameters& deck,
                   const Section& section)
    : mesh_(mesh), boundary_(boundary), deck_(deck) {
  if (!in_space()) find_neighbours();
  fixed_node_ = fixed_nodes(boundary_.parts(), mesh_.num_nodes());
  check(section);
  if (in_space()) find_names(section);
  check_sets(section);
}

void Remesher::find_neighbours() {
  std::map<std::pair<int, int>, const GhostedMesh::BoundarySide*> sides;  // directed, by nodes
  for (const auto& side : mesh_.boundary()) sides[{side.nodes[0], side.nodes[1]}] = &side;
  for (const MeshPath& path : boundary_.paths()) {
    PathNeighbours here;
    const auto look = [&](int from, int to, int& block, std::set<std::string>& sets) {
      const auto found = sides.find({from, to});
      if (found == sides.end()) return;
      block = found->second->block;
      sets = found->second->sets;
    };
    look(path.nodes[0], path.nodes[path.stride], here.left, here.left_sets);
    look(path.nodes[path.stride], path.nodes[0], here.right, here.right_sets);
    beside_.push_back(here);
  }
}

void Remesher::check(const Section& section) const {
  if (!has_gmsh()) section.fail("remeshing needs Gmsh, and this program was built without it");
  if (adaptive() && deck_.smallest_size > deck_.largest_size)
    section.fail("must not be smaller than the smallest size, " + number_text(deck_.smallest_size) + " m",
                 "largest size");
  for (const ElementBlock& block : mesh_.mesh().blocks())
    if (!is_simplex(block.shape))
      section.fail(std::string("the mesh has cells ") + name(block.shape) +
                   "; only meshes of triangles (tri3, tri6) and tetrahedra (tet4, tet10) can be remeshed" +
                   (simplex_coordinates(block.shape) == 2
                        ? "; a swept mesh has such with 'triangles become' = tetrahedra"
                        : ""));
  if (in_space()) check_space(section);
}

void Remesher::check_space(const Section& section) const {
  if (section.has_parameter("size"))
    section.fail("is for meshes of the plane; sizes in space are those of the source", "size");
}

void Remesher::find_names(const Section& section) {
  const auto corners = [](const auto& nodes) { return std::set<int>{nodes[0], nodes[1], nodes[2]}; };
  std::map<std::set<int>, int> patches;  // by corners
  for (const SurfaceFace& face : boundary_.parts().faces) patches[corners(face.nodes)] = face.patch;
  for (const auto& side : mesh_.boundary()) {
    const auto [names, added] = names_.emplace(std::make_pair(patches.at(corners(side.nodes)), side.block), side.sets);
    if (added || names->second == side.sets) continue;
    std::vector<std::string> different;
    std::set_symmetric_difference(names->second.begin(), names->second.end(), side.sets.begin(), side.sets.end(),
                                  std::back_inserter(different));
    section.fail("the side set '" + different.front() +
                 "' has sides of two regions on one surface between them: it would be lost when the mesh is remeshed");
  }
}

std::map<std::string, double> Remesher::named_sides() const {
  std::map<std::string, double> on_paths;
  if (in_space())
    for (const auto& side : mesh_.boundary())
      for (const std::string& name : side.sets) on_paths[name] += 1;
  for (std::size_t p = 0; p < beside_.size(); ++p) {
    const int sides = boundary_.paths()[p].num_vertices() - 1;
    for (const auto* sets : {&beside_[p].left_sets, &beside_[p].right_sets})
      for (const std::string& name : *sets) on_paths[name] += sides;  // all sides of the path belong to it
  }
  return on_paths;
}

void Remesher::check_sets(const Section& section) const {
  std::map<std::string, double> named = named_sides();
  for (const auto& [name, sides] : mesh_.mesh().side_sets())
    if (named[name] != mesh_.sum(static_cast<double>(sides.size())))
      section.fail("the side set '" + name +
                   "' is not made of whole boundaries of regions: it would be lost when the mesh is remeshed");
  for (const auto& [name, nodes] : mesh_.node_sets())
    for (int node : nodes)
      if (!fixed(node))
        section.fail("the point set '" + name + "' would be lost when the mesh is remeshed" +
                     "; name it in boundary/corners, or a side set that it lies on in boundary/material sides");
}

std::function<double(double s)> Remesher::wanted(std::size_t path, const PathCurve& curve, const State& state,
                                                 const WantedSizes* sizes) const {
  const SizeField field = boundary_.size_field(boundary_.focus(state));
  const CurveMeasure measure(curve, field);
  const PathOrigin& origin = boundary_.origins()[path];
  return [this, field, measure, &origin, &curve, &state, sizes](double s) {
    const Point place = curve.at(s);
    double size = !adaptive() ? field(place) * origin.total * side_at(origin.shares, measure.at(s) / measure.total())
                  : sizes     ? (*sizes)(in_plane(place))
                              : deck_.largest_size;
    return at_wall(size, place, state);
  };
}

double Remesher::at_wall(double size, const Point& at, const State& state) const {
  const auto projection = deck_.wall_size > 0 ? boundary_.projection(state, at) : std::nullopt;
  return projection ? std::min(size, deck_.wall_size + deck_.growth * std::max(0.0, projection->gap)) : size;
}

std::function<double(double relative, const Point& at)> Remesher::wanted_on_surface(const State& state) const {
  return [this, &state, field = boundary_.size_field(boundary_.focus(state))](double relative, const Point& at) {
    return at_wall(relative * field(at), at, state);
  };
}

double Remesher::largest_edge(const Positions& x, const State& state) const {
  const auto wanted = wanted_on_surface(state);
  const MeshSurfaces& surfaces = boundary_.parts();
  std::set<std::pair<int, int>> fixed_edges;  // on curves
  for (const MeshPath& path : boundary_.paths())
    if (path.material)
      for (std::size_t i = path.stride; i < path.nodes.size(); i += path.stride)
        fixed_edges.insert(std::minmax(path.nodes[i - path.stride], path.nodes[i]));
  std::vector<double> size(x.size(), 0.0);
  double largest = 0;
  for (const SurfaceFace& face : surfaces.faces) {
    if (surfaces.patches[face.patch].material) continue;
    for (int k = 0; k < 3; ++k) {
      const int ends[2] = {face.nodes[k], face.nodes[(k + 1) % 3]};
      for (int node : ends)
        if (size[node] == 0) size[node] = wanted(boundary_.relative_sizes()[node], x[node]);
      if (fixed_edges.count(std::minmax(ends[0], ends[1]))) continue;
      largest = std::max(largest, 2 * distance(x[ends[0]], x[ends[1]]) / (size[ends[0]] + size[ends[1]]));
    }
  }
  return largest;
}

double Remesher::largest_side(const Positions& x, const State& state) const {
  double largest = 0;
  if (in_space()) return largest_edge(x, state);
  for (std::size_t p = 0; p < boundary_.paths().size(); ++p) {
    const MeshPath& path = boundary_.paths()[p];
    if (path.material) continue;
    const PathPlaces places(boundary_, path, x, state);
    const PathCurve& curve = places.curve();
    const auto size = wanted(p, curve, state, nullptr);
    for (int i = 0; i + path.stride < static_cast<int>(path.nodes.size()); i += path.stride) {
      const double from = curve.parameter(i), to = curve.parameter(i + path.stride);
      largest = std::max(largest, (to - from) / size(0.5 * (from + to)));
    }
  }
  return largest;
}

DividedPath Remesher::divided(std::size_t p, const Positions& x, const State& state, const WantedSizes* sizes) const {
  const MeshPath& path = boundary_.paths()[p];
  const PathPlaces places(boundary_, path, x, state);
  const PathCurve& curve = places.curve();
  const int last = static_cast<int>(path.nodes.size()) - 1;
  std::vector<double> s;  // of the new vertices [m]
  if (path.material)
    for (int i = 0; i <= last; i += path.stride) s.push_back(curve.parameter(i));
  else
    s = mudline::divided(curve.length(), wanted(p, curve, state, sizes), last);
  DividedPath result;
  const int sides = static_cast<int>(s.size()) - 1;
  for (int v = 0; v <= sides; ++v) {
    const bool end = v == 0 || v == sides;
    if (path.material || end)
      result.vertices.push_back(in_plane(x[path.nodes[path.material ? v * path.stride : v == 0 ? 0 : last]]));
    else
      result.vertices.push_back(in_plane(places.at(s[v], (s[v + 1] - s[v - 1]) / path.stride)));
  }
  if (path.stride == 2)
    for (int k = 0; k < sides; ++k)
      result.mid_side_nodes.push_back(
          in_plane(path.material ? x[path.nodes[2 * k + 1]] : places.at(0.5 * (s[k] + s[k + 1]), s[k + 1] - s[k])));
  return result;
}

RemeshedMesh Remesher::make(const Positions& x, const State& state, double least_quality,
                            const WantedSizes* sizes) const {
  RemeshedMesh made;
  double quality = -1e300;
  std::string problem = "its elements are flat";
  const auto take = [&](auto&& attempt) {
    try {
      RemeshedMesh here = attempt();
      const double quality_here = lowest_quality(here.mesh);
      if (!(quality_here > quality)) return;
      made = std::move(here);
      quality = quality_here;
    } catch (const NoTriangulation& failure) {
      problem = failure.what();
    }
  };
  if (in_space()) {
    const RemeshedBoundary surface = remeshed_boundary(*this, x, state);
    for (double factor : {1.0, 1.2}) take([&] { return remeshed_in_space(*this, surface, state, factor); });
  } else {
    take([&] { return remeshed_in_plane(*this, x, state, sizes); });
  }
  if (made.mesh.blocks.empty()) throw NoTriangulation(problem);
  if (!(quality >= least_quality))
    throw NoTriangulation("its best mesh has a scaled Jacobian of " + number_text(std::round(1e3 * quality) / 1e3));
  return made;
}

}  // namespace mudline
