// The new mesh itself: vertices along the paths, regions between them, triangles in these, numbers and names.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "ale/mesh_renewal.hpp"
#include "core/text.hpp"
#include "discretisation/element_map.hpp"
#include "discretisation/space_filling_curve.hpp"
#include "discretisation/triangulation.hpp"

namespace mudline {

namespace {

using Place = std::array<double, 2>;
using Ends = std::pair<int, int>;

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

/// A length that every side of the boundary asks for beside it, and more with the distance.
class SizeAround {
 public:
  SizeAround(double growth) : growth_(growth) {}
  void add(const Place& a, const Place& b) {
    sides_.push_back({0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), std::hypot(b[0] - a[0], b[1] - a[1])});
  }
  double operator()(double x, double y) const {
    double size = 1e300;
    for (const auto& side : sides_) {
      const double off = std::max(0.0, std::hypot(x - side[0], y - side[1]) - 0.5 * side[2]);
      size = std::min(size, side[2] + growth_ * off);
    }
    return size;
  }

 private:
  double growth_;
  std::vector<std::array<double, 3>> sides_;
};

class Builder {
 public:
  Builder(const MeshRenewal& plan, const Positions& x, const State& state, const WantedSizes* sizes)
      : plan_(plan), paths_(plan.boundary().paths()), size_(plan.deck().growth), sizes_(sizes) {
    for (std::size_t p = 0; p < paths_.size(); ++p) add_path(p, plan.divided(p, x, state, sizes));
    for (const MeshPath& path : paths_) quadratic_ = quadratic_ || path.stride == 2;
  }

  RenewedMesh build() {
    find_regions();
    triangulation_ = triangulate(vertices_, regions_, size_inside(), plan_.deck().time_limit);
    sort_elements();
    number();
    name_sets();
    RenewedMesh result;
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
    if (!sizes_) return size_;
    return [this](double x, double y) { return std::min(size_(x, y), (*sizes_)({x, y})); };
  }
  void add_path(std::size_t p, const DividedPath& divided);
  std::vector<std::vector<int>> loops(int block) const;
  void find_regions();
  void sort_elements();
  void number();
  long long node_of(int vertex, const Place& at);
  long long middle_of(int a, int b);
  void name_sets();
  std::vector<MeshPath> new_paths() const;

  const MeshRenewal& plan_;
  const std::vector<MeshPath>& paths_;
  SizeAround size_;
  const WantedSizes* sizes_;
  bool quadratic_ = false;
  std::vector<Place> vertices_;
  std::map<int, int> vertex_of_;          // of old nodes that stay
  std::vector<std::vector<int>> chains_;  // (path) its vertices
  std::map<Ends, Place> curved_;          // middles of sides on paths, by their vertices in ascending order
  std::vector<OutlinedRegion> regions_;
  std::vector<int> block_of_;  // (region)
  Triangulation triangulation_;
  std::vector<std::vector<std::array<int, 3>>> elements_;  // (block)
  std::map<int, long long> node_numbers_;                  // of vertices
  std::map<Ends, long long> middle_numbers_;
  GlobalMesh mesh_;
};

Ends ascending(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

void Builder::add_path(std::size_t p, const DividedPath& divided) {
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
      if (plan_.kept(p)) vertex_of_[old[v * paths_[p].stride]] = chain.back();
    }
    vertices_.push_back(divided.vertices[v]);
  }
  for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
    size_.add(divided.vertices[k], divided.vertices[k + 1]);
    if (!divided.middles.empty()) curved_[ascending(chain[k], chain[k + 1])] = divided.middles[k];
  }
  chains_.push_back(std::move(chain));
}

/// Closed chains of vertices around a block, which is on their left.
std::vector<std::vector<int>> Builder::loops(int block) const {
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

void Builder::find_regions() {
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

/// By block, along a space-filling curve, so that neighbours are close in memory.
void Builder::sort_elements() {
  const std::vector<Place>& x = triangulation_.points;
  Bounds box = Bounds::nothing();
  for (const Place& place : x) box.enclose({place[0], place[1], 0});
  elements_.resize(plan_.mesh().mesh().blocks().size());
  std::vector<std::vector<std::pair<std::uint64_t, std::array<int, 3>>>> keyed(elements_.size());
  for (std::size_t r = 0; r < regions_.size(); ++r)
    for (const auto& t : triangulation_.triangles[r]) {
      double at[2];
      for (int d = 0; d < 2; ++d) at[d] = ((x[t[0]][d] + x[t[1]][d] + x[t[2]][d]) / 3 - box.low[d]) / box.extent();
      keyed[block_of_[r]].emplace_back(along_curve(at, 2), t);
    }
  for (std::size_t b = 0; b < keyed.size(); ++b) {
    std::sort(keyed[b].begin(), keyed[b].end());
    for (const auto& item : keyed[b]) elements_[b].push_back(item.second);
  }
}

long long Builder::node_of(int vertex, const Place& at) {
  const auto [number, added] = node_numbers_.emplace(vertex, static_cast<long long>(mesh_.coordinates.size()));
  if (added) mesh_.coordinates.push_back({at[0], at[1], 0});
  return number->second;
}

long long Builder::middle_of(int a, int b) {
  const Ends ends = ascending(a, b);
  const auto [number, added] = middle_numbers_.emplace(ends, static_cast<long long>(mesh_.coordinates.size()));
  if (!added) return number->second;
  const auto curved = curved_.find(ends);
  const std::vector<Place>& x = triangulation_.points;
  const Place at = curved != curved_.end() ? curved->second
                                           : Place{0.5 * (x[ends.first][0] + x[ends.second][0]),
                                                   0.5 * (x[ends.first][1] + x[ends.second][1])};
  mesh_.coordinates.push_back({at[0], at[1], 0});
  return number->second;
}

/// Nodes in the order in which the elements meet them.
void Builder::number() {
  const auto& blocks = plan_.mesh().mesh().blocks();
  for (std::size_t b = 0; b < elements_.size(); ++b) {
    GlobalMesh::Block block{blocks[b].region, blocks[b].shape, {}};
    for (const auto& t : elements_[b]) {
      for (int v : t) block.nodes.push_back(node_of(v, triangulation_.points[v]));
      for (int s = 0; quadratic_ && s < 3; ++s) block.nodes.push_back(middle_of(t[s], t[(s + 1) % 3]));
    }
    mesh_.blocks.push_back(std::move(block));
  }
}

void Builder::name_sets() {
  std::map<Ends, GlobalMesh::Side> sides;  // directed, by vertices
  for (std::size_t b = 0; b < elements_.size(); ++b)
    for (std::size_t e = 0; e < elements_[b].size(); ++e)
      for (int s = 0; s < 3; ++s)
        sides[{elements_[b][e][s], elements_[b][e][(s + 1) % 3]}] = {static_cast<int>(b), static_cast<long long>(e), s};
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
      if (plan_.mesh().is_vertex(node)) to.push_back(node_numbers_.at(vertex_of_.at(node)));
    std::sort(to.begin(), to.end());
  }
}

std::vector<MeshPath> Builder::new_paths() const {
  std::vector<MeshPath> result;
  for (std::size_t p = 0; p < paths_.size(); ++p) {
    MeshPath path{{}, paths_[p].stride, paths_[p].sets, paths_[p].outer};
    const std::vector<int>& chain = chains_[p];
    for (std::size_t k = 0; k < chain.size(); ++k) {
      if (k > 0 && path.stride == 2)
        path.nodes.push_back(static_cast<int>(middle_numbers_.at(ascending(chain[k - 1], chain[k]))));
      path.nodes.push_back(static_cast<int>(node_numbers_.at(chain[k])));
    }
    result.push_back(std::move(path));
  }
  return result;
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

RenewedMesh MeshRenewal::make(const Positions& x, const State& state, double least_quality,
                              const WantedSizes* sizes) const {
  RenewedMesh made = Builder(*this, x, state, sizes).build();
  made.focus = in_plane(boundary_.focus(state));
  const double quality = lowest_quality(made.mesh);
  if (!(quality >= least_quality))
    throw NoTriangulation("its best mesh has a scaled Jacobian of " + number_text(quality));
  return made;
}

}  // namespace mudline
