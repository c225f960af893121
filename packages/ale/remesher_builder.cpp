// The new mesh itself in the plane: vertices along the paths, regions between them, triangles in these, and names.
#include "ale/remesher_builder.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "ale/simplex_mesh.hpp"
#include "ale/size_around.hpp"
#include "discretisation/triangulation.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

using Place = Vec<double, 2>;

double twice_area(const std::vector<int>& loop, const std::vector<Place>& x) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Place &a = x[loop[i]], &b = x[loop[(i + 1) % loop.size()]];
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return sum;
}

bool inside(const Place& point, const std::vector<int>& loop, const std::vector<Place>& x) {
  bool result = false;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Place &a = x[loop[i]], &b = x[loop[(i + 1) % loop.size()]];
    if ((a[1] > point[1]) != (b[1] > point[1]) && point[0] < a[0] + (point[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
      result = !result;
  }
  return result;
}

class PlaneBuilder {
 public:
  PlaneBuilder(const Remesher& plan, const Positions& x, const State& state, const WantedSizes* sizes)
      : plan_(plan),
        paths_(plan.boundary().paths()),
        size_(plan.deck().growth),
        sizes_(sizes),
        simplices_(plan.mesh().mesh().blocks()) {
    for (std::size_t p = 0; p < paths_.size(); ++p) add_path(p, plan.divided(p, x, state, sizes));
  }

  RemeshedMesh build() {
    find_regions();
    const Triangulation made = triangulate(vertices_, regions_, size_inside(), plan_.deck().time_limit);
    for (const Place& place : made.points) simplices_.places.push_back(on_plane(place));
    for (std::size_t r = 0; r < regions_.size(); ++r)
      for (const auto& t : made.triangles[r]) simplices_.add(block_of_[r], {t[0], t[1], t[2], -1});
    mesh_ = simplices_.number();
    name_sets();
    RemeshedMesh result;
    result.mesh = std::move(mesh_);
    result.paths = new_paths();
    result.origins = plan_.boundary().origins();
    return result;
  }

 private:
  struct Directed {
    std::size_t path;
    bool forward;
  };

  std::function<double(double x, double y)> size_inside() const {
    if (!sizes_) return [this](double x, double y) { return size_({x, y, 0}); };
    return [this](double x, double y) { return std::min(size_({x, y, 0}), (*sizes_)({x, y})); };
  }
  void add_path(std::size_t p, const DividedPath& divided);
  std::vector<std::vector<int>> loops(int block) const;
  void find_regions();
  void name_sets();
  std::vector<MeshPath> new_paths() const;

  const Remesher& plan_;
  const std::vector<MeshPath>& paths_;
  SizeAround size_;
  const WantedSizes* sizes_;
  SimplexMesh simplices_;
  std::vector<Place> vertices_;
  std::map<int, int> vertex_of_;          // of fixed old nodes
  std::vector<std::vector<int>> chains_;  // (path) its vertices
  std::vector<OutlinedRegion> regions_;
  std::vector<int> block_of_;  // (region)
  GlobalMesh mesh_;
};

void PlaneBuilder::add_path(std::size_t p, const DividedPath& divided) {
  const std::vector<int>& old = paths_[p].nodes;
  std::vector<int> chain;
  for (std::size_t v = 0; v < divided.vertices.size(); ++v) {
    const bool first = v == 0, last = v + 1 == divided.vertices.size();
    if (first || last) {
      const auto [number, added] =
          vertex_of_.emplace(first ? old.front() : old.back(), static_cast<int>(vertices_.size()));
      chain.push_back(number->second);
      if (!added) continue;
    } else {
      chain.push_back(static_cast<int>(vertices_.size()));
      if (paths_[p].material) vertex_of_[old[v * paths_[p].stride]] = chain.back();
    }
    vertices_.push_back(divided.vertices[v]);
  }
  for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
    const Point a = on_plane(divided.vertices[k]), b = on_plane(divided.vertices[k + 1]);
    size_.add(0.5 * (a + b), distance(a, b));
    if (!divided.mid_side_nodes.empty()) simplices_.bend(chain[k], chain[k + 1], on_plane(divided.mid_side_nodes[k]));
  }
  chains_.push_back(std::move(chain));
}

/// Closed chains of vertices around a block, which is on their left.
std::vector<std::vector<int>> PlaneBuilder::loops(int block) const {
  std::map<int, std::vector<Directed>> from;  // by first vertex
  for (std::size_t p = 0; p < paths_.size(); ++p)
    for (bool forward : {true, false}) {
      if ((forward ? plan_.beside(p).left : plan_.beside(p).right) != block) continue;
      from[forward ? chains_[p].front() : chains_[p].back()].push_back({p, forward});
    }
  std::vector<std::vector<int>> result;
  for (auto& [start, paths] : from)
    while (!paths.empty()) {
      std::vector<int> loop;
      for (int at = start;;) {
        std::vector<Directed>& next = from[at];
        if (next.size() != 1) throw NoTriangulation("parts of a region touch in a point");
        std::vector<int> chain = chains_[next[0].path];
        if (!next[0].forward) std::reverse(chain.begin(), chain.end());
        next.clear();
        loop.insert(loop.end(), chain.begin(), chain.end() - 1);
        if ((at = chain.back()) == start) break;
      }
      result.push_back(std::move(loop));
    }
  return result;
}

void PlaneBuilder::find_regions() {
  const int blocks = static_cast<int>(plan_.mesh().mesh().blocks().size());
  for (int block = 0; block < blocks; ++block) {
    const std::size_t first = regions_.size();
    std::vector<std::vector<int>> holes;
    for (auto& loop : loops(block)) {
      if (twice_area(loop, vertices_) < 0) {
        holes.push_back(std::move(loop));
        continue;
      }
      regions_.push_back({{std::move(loop)}});
      block_of_.push_back(block);
    }
    for (auto& hole : holes) {
      OutlinedRegion* around = nullptr;
      double least = 1e300;
      for (std::size_t r = first; r < regions_.size(); ++r) {
        const double area = twice_area(regions_[r].loops[0], vertices_);
        if (area >= least || !inside(vertices_[hole[0]], regions_[r].loops[0], vertices_)) continue;
        least = area;
        around = &regions_[r];
      }
      if (!around) throw NoTriangulation("its boundary cuts itself");
      around->loops.push_back(std::move(hole));
    }
  }
}

void PlaneBuilder::name_sets() {
  const std::map<SimplexMesh::Ends, GlobalMesh::Side> sides = simplices_.sides();
  for (const auto& [name, unused] : plan_.mesh().side_sets()) mesh_.side_sets[name];
  for (std::size_t p = 0; p < paths_.size(); ++p)
    for (std::size_t k = 0; k + 1 < chains_[p].size(); ++k) {
      const int a = chains_[p][k], b = chains_[p][k + 1];
      for (const std::string& name : plan_.beside(p).left_sets) mesh_.side_sets[name].push_back(sides.at({a, b}));
      for (const std::string& name : plan_.beside(p).right_sets) mesh_.side_sets[name].push_back(sides.at({b, a}));
    }
  for (const auto& [name, nodes] : plan_.mesh().node_sets()) {
    std::vector<long long>& to = mesh_.node_sets[name];
    for (int node : nodes)
      if (plan_.mesh().is_vertex(node)) to.push_back(simplices_.node(vertex_of_.at(node)));
    std::sort(to.begin(), to.end());
  }
}

std::vector<MeshPath> PlaneBuilder::new_paths() const {
  std::vector<MeshPath> result;
  for (std::size_t p = 0; p < paths_.size(); ++p) {
    MeshPath path{{}, paths_[p].stride, paths_[p].sets, paths_[p].outer};
    const std::vector<int>& chain = chains_[p];
    for (std::size_t k = 0; k < chain.size(); ++k) {
      if (k > 0 && path.stride == 2) path.nodes.push_back(static_cast<int>(simplices_.middle(chain[k - 1], chain[k])));
      path.nodes.push_back(static_cast<int>(simplices_.node(chain[k])));
    }
    result.push_back(std::move(path));
  }
  return result;
}

}  // namespace

RemeshedMesh remeshed_in_plane(const Remesher& plan, const Positions& x, const State& state, const WantedSizes* sizes) {
  RemeshedMesh made = PlaneBuilder(plan, x, state, sizes).build();
  made.focus = plan.boundary().focus(state);
  return made;
}

}  // namespace mudline
