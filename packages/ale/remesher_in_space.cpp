// The new mesh itself in space: regions within the boundary's new faces, tetrahedra in these, and names.
#include <Teuchos_DefaultSerialComm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "ale/interior_motion.hpp"
#include "ale/remesher_builder.hpp"
#include "ale/simplex_mesh.hpp"
#include "ale/size_around.hpp"
#include "ale/vertex_colours.hpp"
#include "core/pi.hpp"
#include "discretisation/disjoint_sets.hpp"
#include "discretisation/element_map.hpp"
#include "discretisation/triangulation.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

using Face = std::array<int, 3>;  // vertices
using Faces = std::vector<Face>;

double six_volumes(const Point& a, const Point& b, const Point& c) { return dot(a, cross(b, c)); }

/// Six times the volume within closed faces [m3]; negative where they bound a hole.
double six_volumes(const Faces& faces, const Positions& x) {
  const Point& origin = x[faces[0][0]];
  double sum = 0;
  for (const Face& f : faces) sum += six_volumes(x[f[0]] - origin, x[f[1]] - origin, x[f[2]] - origin);
  return sum;
}

/// Whether closed faces enclose a point, by the solid angle that they subtend there (van Oosterom & Strackee 1983).
bool around(const Faces& faces, const Point& point, const Positions& x) {
  double angle = 0;
  for (const Face& f : faces) {
    const Point a = x[f[0]] - point, b = x[f[1]] - point, c = x[f[2]] - point;
    const double la = length(a), lb = length(b), lc = length(c);
    angle += 2 * std::atan2(six_volumes(a, b, c), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return std::abs(angle) > 2 * pi;
}

/// Splits faces into closed surfaces that are connected by edges.
std::vector<Faces> shells(const Faces& faces) {
  DisjointSets joined(faces.size());
  std::map<SimplexMesh::Ends, int> beside;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = faces[f][k], b = faces[f][(k + 1) % 3];
      const auto [other, added] = beside.emplace(SimplexMesh::Ends{std::min(a, b), std::max(a, b)}, f);
      if (!added) joined.join(f, other->second);
    }
  std::map<int, Faces> result;
  for (std::size_t f = 0; f < faces.size(); ++f) result[joined.leader(static_cast<int>(f))].push_back(faces[f]);
  std::vector<Faces> list;
  for (auto& [first, shell] : result) list.push_back(std::move(shell));
  return list;
}

/// The connected parts of a region, each with the surfaces of its holes.
std::vector<EnclosedRegion> parts(const Faces& faces, const Positions& x) {
  std::vector<EnclosedRegion> result;
  std::vector<Faces> holes;
  for (Faces& shell : shells(faces)) {
    if (six_volumes(shell, x) > 0)
      result.push_back({std::move(shell)});
    else
      holes.push_back(std::move(shell));
  }
  const std::vector<EnclosedRegion> outer = result;
  for (const Faces& hole : holes) {
    std::size_t in = outer.size();
    double least = 1e300;
    for (std::size_t r = 0; r < outer.size(); ++r) {
      const double volume = six_volumes(outer[r].faces, x);
      if (volume >= least || !around(outer[r].faces, x[hole[0][0]], x)) continue;
      least = volume;
      in = r;
    }
    if (in == outer.size()) throw NoTriangulation("its boundary cuts itself");
    result[in].faces.insert(result[in].faces.end(), hole.begin(), hole.end());
  }
  return result;
}

/// Puts mid-side nodes halfway between their ends, where `free`(node).
template <class Free>
void straighten(GlobalMesh& mesh, Free&& free) {
  for (const GlobalMesh::Block& block : mesh.blocks) {
    const int nodes = num_nodes(block.shape), first = num_corners(block.shape);
    for (std::size_t e = 0; e < block.nodes.size(); e += nodes)
      for (int a = first; a < nodes; ++a) {
        const auto [from, to] = edge_corners(block.shape, a - first);
        const long long middle = block.nodes[e + a];
        if (!free(static_cast<int>(middle))) continue;
        const Point &x = mesh.coordinates[block.nodes[e + from]], &y = mesh.coordinates[block.nodes[e + to]];
        mesh.coordinates[middle] = 0.5 * (x + y);
      }
  }
}

bool folded(const CornerSimplices& corners, const Positions& x) {
  return std::any_of(corners.simplices.begin(), corners.simplices.end(),
                     [&](const Simplex& t) { return !(determinant(t, x) > 0); });
}

/// Moves the inner vertices to make all elements, those at curved faces included, as regular as possible. The boundary
/// is bent from straight sides to its curved shape in as few parts as the interior can follow.
void optimise(GlobalMesh& made, Geometry geometry) {
  GlobalMesh straight = made;
  straighten(straight, [](int) { return true; });
  const Mesh mesh(Teuchos::rcp(new Teuchos::SerialComm<int>()), geometry, std::move(straight));
  const GhostedMesh whole(mesh);
  Positions x = whole.gather(mesh.coordinates());
  const Positions start = x;
  const CornerSimplices corners(whole);
  std::vector<char> movable;
  for (int node = 0; node < whole.num_nodes(); ++node)
    movable.push_back(whole.is_vertex(node) && !whole.on_boundary(node));
  const auto colours = vertex_colours(whole, movable);
  const OptimisationMotion motion(OptimisationMotion::Ideal::equilateral);
  const auto bent = [&](double share) {
    Positions next = x;
    for (int node = 0; node < whole.num_nodes(); ++node)
      if (whole.on_boundary(node)) next[node] = start[node] + share * (made.coordinates[node] - start[node]);
    corners.add_tangents(next, next);
    return next;
  };
  const auto move = [&](Positions next) {
    motion.move({whole, corners, next, next, movable, colours}, next);
    x = std::move(next);
  };
  double done = 0, share = 0, part = 1;
  while (done < 1 && part > 1.0 / 64) {
    Positions next = bent(share);
    if (folded(corners, next)) {
      part *= 0.5;
    } else {
      move(std::move(next));
      done = share;
    }
    share = std::min(1.0, done + part);
  }
  if (done < 1) move(bent(1));  // vertices beside folded simplices do not move
  for (int node = 0; node < whole.num_nodes(); ++node)
    if (movable[node]) made.coordinates[node] = x[node];
  straighten(made, [&](int node) { return !whole.on_boundary(node); });
}

class SpaceBuilder {
 public:
  SpaceBuilder(const Remesher& plan, const RemeshedBoundary& surface, double factor)
      : plan_(plan),
        mesh_(plan.mesh()),
        surface_(surface),
        factor_(factor),
        size_(plan.deck().growth),
        simplices_(mesh_.mesh().blocks()) {
    take_faces();
  }

  RemeshedMesh build() {
    fill();
    RemeshedMesh result;
    made_ = simplices_.number();
    optimise(made_, mesh_.mesh().geometry());
    name_sets();
    keep_surfaces(result);
    result.mesh = std::move(made_);
    result.origins = plan_.boundary().origins();
    return result;
  }

 private:
  /// A face of one block, as seen from its outside.
  struct Side {
    int block, patch;
    Face corners;
  };
  std::vector<Side> sides() const;
  void take_faces();
  void fill();
  /// Removes tetrahedra that are poor because two of their faces lie on one patch of the mesh's outer boundary, bent as
  /// on the lip beside a body: no inner vertex could repair them. Their other two faces replace these on the boundary.
  void peel(std::vector<std::array<int, 4>>& tetrahedra);
  /// Scaled Jacobian of a tetrahedron with the curved edges of the surface.
  double quality(const std::array<int, 4>& corners) const;
  bool may_change(int patch) const;
  void name_sets();
  void keep_surfaces(RemeshedMesh& result) const;

  const Remesher& plan_;
  const GhostedMesh& mesh_;
  RemeshedBoundary surface_;
  double factor_;
  SizeAround size_;
  SimplexMesh simplices_;
  std::vector<Faces> faces_;  // (block), as seen from its outside
  GlobalMesh made_;
};

std::vector<SpaceBuilder::Side> SpaceBuilder::sides() const {
  const MeshSurfaces& surfaces = plan_.boundary().parts();
  std::vector<Side> result;
  for (const RemeshedSurface::Face& face : surface_.mesh.faces) {
    const SurfaceFace& old = surfaces.faces[surfaces.patches[face.patch].faces.front()];
    const auto [a, b, c] = face.vertices;
    result.push_back({old.block, face.patch, {a, b, c}});
    if (old.other >= 0) result.push_back({old.other, face.patch, {a, c, b}});
  }
  return result;
}

void SpaceBuilder::take_faces() {
  simplices_.places = surface_.places;
  for (const RemeshedBoundary::MidSideNode& middle : surface_.mid_side_nodes)
    simplices_.bend(middle.ends[0], middle.ends[1], middle.place);
  faces_.resize(mesh_.mesh().blocks().size());
  for (const Side& side : sides()) faces_[side.block].push_back(side.corners);
}

void SpaceBuilder::fill() {
  const Positions vertices = Rounding(simplices_.places)(simplices_.places);
  std::vector<EnclosedRegion> regions;
  std::vector<int> block_of;
  for (std::size_t b = 0; b < faces_.size(); ++b) {
    if (faces_[b].empty()) continue;
    for (EnclosedRegion& part : parts(faces_[b], vertices)) {
      regions.push_back(std::move(part));
      block_of.push_back(static_cast<int>(b));
    }
    for (const Face& f : faces_[b]) {
      const Point &a = vertices[f[0]], &b = vertices[f[1]], &c = vertices[f[2]];
      const double area = 0.5 * length(cross(b - a, c - a));
      // The size is the edge of a regular triangle of this area.
      size_.add(1.0 / 3 * (a + b + c), 2 * std::sqrt(area / std::sqrt(3.0)));
    }
  }
  Tetrahedra made = tetrahedra_in(
      vertices, regions, [this](const Point& x) { return factor_ * size_(x); }, plan_.deck().time_limit);
  simplices_.places.insert(simplices_.places.end(), made.points.begin() + simplices_.places.size(), made.points.end());
  for (std::size_t r = 0; r < regions.size(); ++r) {
    peel(made.tetrahedra[r]);
    for (const auto& t : made.tetrahedra[r]) simplices_.add(block_of[r], t);
  }
}

double SpaceBuilder::quality(const std::array<int, 4>& corners) const {
  const CellShape shape = mesh_.mesh().blocks().front().shape;
  std::array<Point, 10> x;
  for (int a = 0; a < 4; ++a) x[a] = simplices_.places[corners[a]];
  for (int a = 4; a < num_nodes(shape); ++a) {
    const auto [from, to] = edge_corners(shape, a - 4);
    x[a] = simplices_.middle_place(corners[from], corners[to]);
  }
  return ElementMap(shape, [&](int a) { return x[a].data(); }).scaled_jacobian();
}

bool SpaceBuilder::may_change(int patch) const {
  const SurfacePatch& of = plan_.boundary().parts().patches[patch];
  return of.outer && !of.material;
}

void SpaceBuilder::peel(std::vector<std::array<int, 4>>& tetrahedra) {
  const auto ascending = [](Face face) {
    std::sort(face.begin(), face.end());
    return face;
  };
  std::map<Face, std::size_t> at;  // faces of the surface
  std::set<SimplexMesh::Ends> edges;
  for (std::size_t f = 0; f < surface_.mesh.faces.size(); ++f) {
    const Face& corners = surface_.mesh.faces[f].vertices;
    at[ascending(corners)] = f;
    for (int k = 0; k < 3; ++k) edges.insert(std::minmax(corners[k], corners[(k + 1) % 3]));
  }
  std::set<SimplexMesh::Ends> gone;
  const auto poor_on_surface = [&](const std::array<int, 4>& t) {
    std::vector<std::size_t> outside;
    for (int s = 0; s < 4; ++s) {
      const auto found = at.find(ascending({t[(s + 1) % 4], t[(s + 2) % 4], t[(s + 3) % 4]}));
      if (found != at.end()) outside.push_back(found->second);
    }
    if (outside.size() != 2 || quality(t) >= plan_.deck().quality_below) return false;
    RemeshedSurface::Face &one = surface_.mesh.faces[outside[0]], &other = surface_.mesh.faces[outside[1]];
    if (one.patch != other.patch || !may_change(one.patch)) return false;
    const auto alone = [](const Face& of, const Face& beside) {
      return *std::find_if(of.begin(), of.end(),
                           [&](int v) { return std::count(beside.begin(), beside.end(), v) == 0; });
    };
    const int c = alone(one.vertices, other.vertices), d = alone(other.vertices, one.vertices);
    Face ends{};
    std::remove_copy(one.vertices.begin(), one.vertices.end(), ends.begin(), c);
    if (!edges.insert(std::minmax(c, d)).second) return false;
    edges.erase(std::minmax(ends[0], ends[1]));
    gone.insert(std::minmax(ends[0], ends[1]));
    for (const RemeshedSurface::Face& face : {one, other}) at.erase(ascending(face.vertices));
    std::replace(one.vertices.begin(), one.vertices.end(), ends[0], d);
    std::replace(other.vertices.begin(), other.vertices.end(), ends[1], c);
    at[ascending(one.vertices)] = outside[0];
    at[ascending(other.vertices)] = outside[1];
    return true;
  };
  constexpr int layers = 3;
  for (int layer = 0; layer < layers; ++layer) {
    const std::size_t before = tetrahedra.size();
    tetrahedra.erase(std::remove_if(tetrahedra.begin(), tetrahedra.end(), poor_on_surface), tetrahedra.end());
    if (tetrahedra.size() == before) break;
  }
  std::vector<RemeshedBoundary::MidSideNode>& mid_side_nodes = surface_.mid_side_nodes;
  mid_side_nodes.erase(
      std::remove_if(mid_side_nodes.begin(), mid_side_nodes.end(),
                     [&](const auto& middle) { return gone.count(std::minmax(middle.ends[0], middle.ends[1])) > 0; }),
      mid_side_nodes.end());
}

void SpaceBuilder::name_sets() {
  const auto ascending = [](Face face) {
    std::sort(face.begin(), face.end());
    return face;
  };
  std::map<std::pair<int, Face>, GlobalMesh::Side> sides;  // by block and vertices
  for (std::size_t b = 0; b < simplices_.cells().size(); ++b)
    for (std::size_t e = 0; e < simplices_.cells()[b].size(); ++e)
      for (int s = 0; s < num_sides(CellShape::tet4); ++s) {
        const std::vector<int> at = side_nodes(CellShape::tet4, s);
        const auto& t = simplices_.cells()[b][e];
        const int block = static_cast<int>(b);
        sides[{block, ascending({t[at[0]], t[at[1]], t[at[2]]})}] = {block, static_cast<long long>(e), s};
      }
  for (const auto& [name, unused] : mesh_.side_sets()) made_.side_sets[name];
  for (const Side& side : this->sides())
    for (const std::string& name : plan_.names(side.patch, side.block))
      made_.side_sets[name].push_back(sides.at({side.block, ascending(side.corners)}));
  std::map<int, long long> new_node;  // of old nodes that stay
  for (std::size_t v = 0; v < surface_.mesh.vertices.size(); ++v)
    new_node[surface_.mesh.vertices[v].node] = simplices_.node(static_cast<int>(v));
  for (const RemeshedBoundary::MidSideNode& middle : surface_.mid_side_nodes)
    new_node[middle.node] = simplices_.middle(middle.ends[0], middle.ends[1]);
  for (const auto& [name, nodes] : mesh_.node_sets()) {
    std::vector<long long>& to = made_.node_sets[name];
    for (int node : nodes) to.push_back(new_node.at(node));
    std::sort(to.begin(), to.end());
  }
}

void SpaceBuilder::keep_surfaces(RemeshedMesh& result) const {
  for (const RemeshedSurface::Face& face : surface_.mesh.faces) {
    FaceOfPatch kept{{}, face.patch};
    for (int k = 0; k < 3; ++k) kept.corners[k] = simplices_.node(face.vertices[k]);
    std::sort(kept.corners.begin(), kept.corners.end());
    result.faces.push_back(kept);
  }
  for (std::size_t v = 0; v < surface_.mesh.vertices.size(); ++v)
    result.sizes.push_back({simplices_.node(static_cast<int>(v)), surface_.mesh.vertices[v].relative});
  for (std::size_t p = 0; p < surface_.mesh.curves.size(); ++p) {
    const MeshPath& old = plan_.boundary().paths()[p];
    MeshPath path{{}, old.stride, old.sets, old.outer};
    const auto& curve = surface_.mesh.curves[p];
    for (std::size_t k = 0; k < curve.size(); ++k) {
      if (k > 0 && path.stride == 2)
        path.nodes.push_back(static_cast<int>(simplices_.middle(curve[k - 1].vertex, curve[k].vertex)));
      path.nodes.push_back(static_cast<int>(simplices_.node(curve[k].vertex)));
    }
    result.paths.push_back(std::move(path));
  }
}

}  // namespace

RemeshedMesh remeshed_in_space(const Remesher& plan, const RemeshedBoundary& surface, const State& state,
                               double factor) {
  RemeshedMesh made = SpaceBuilder(plan, surface, factor).build();
  made.focus = plan.boundary().focus(state);
  return made;
}

}  // namespace mudline
