#include <cmath>
#include <limits>
#include <unordered_map>

#include "core/errors.hpp"
#include "core/pi.hpp"
#include "core/told.hpp"
#include "discretisation/disjoint_sets.hpp"
#include "discretisation/seam_sides.hpp"
#include "tensor/mat.hpp"

namespace mudline {

namespace {

void refuse(const Bounds& all, int dimension) {
  Point centre;
  for (int i = 0; i < 3; ++i) centre[i] = 0.5 * (all.low[i] + all.high[i]);
  const std::string edge = dimension == 2 ? "edge is" : "faces are";
  throw InputError("the mesh has a hole around " + place_text(centre, dimension) + " whose " + edge +
                   " in no side set: elements are missing, or name the " + edge.substr(0, edge.find(' ')) +
                   " of a hole that is meant");
}

/// The boundaries of a plane mesh as loops of sides.
class Loops {
 public:
  explicit Loops(const std::vector<SeamSide>& sides) : sides_(sides) {
    for (std::size_t s = 0; s < sides.size(); ++s) from_[sides[s].at.nodes[0]].push_back(s);
  }
  void check() const;

 private:
  std::size_t next_of(std::size_t side) const;
  const std::vector<SeamSide>& sides_;
  std::unordered_map<long long, std::vector<std::size_t>> from_;  // sides by their first node
};

/// The next side of the boundary around the same void: at a node where several voids meet, the first side met when
/// turning through the void.
std::size_t Loops::next_of(std::size_t s) const {
  const std::vector<std::size_t>& ways = from_.at(sides_[s].at.nodes[1]);
  if (ways.size() == 1) return ways[0];
  const auto angle = [&](const Point& from, const Point& to) { return std::atan2(to[1] - from[1], to[0] - from[0]); };
  const std::vector<Point>& here = sides_[s].points;
  const double back = angle(here.back(), here[here.size() - 2]);
  std::size_t best = ways[0];
  double least = std::numeric_limits<double>::max();
  for (std::size_t way : ways) {
    double turn = std::fmod(angle(sides_[way].points[0], sides_[way].points[1]) - back + 4 * pi, 2 * pi);
    if (turn < 1e-9) turn = 2 * pi;
    if (turn >= least) continue;
    least = turn;
    best = way;
  }
  return best;
}

void Loops::check() const {
  std::vector<char> seen(sides_.size(), 0);
  for (std::size_t first = 0; first < sides_.size(); ++first) {
    double area = 0;
    bool named = false;
    Bounds all = Bounds::nothing();
    for (std::size_t s = first; !seen[s]; s = next_of(s)) {
      seen[s] = 1;
      named = named || !sides_[s].sets.empty();
      const std::vector<Point>& x = sides_[s].points;
      for (std::size_t k = 0; k + 1 < x.size(); ++k) {
        area += 0.5 * (x[k][0] * x[k + 1][1] - x[k + 1][0] * x[k][1]);
        all.enclose(x[k]);
      }
    }
    if (!named && area <= -1e-9 * all.extent() * all.extent()) refuse(all, 2);
  }
}

/// The boundaries of a mesh in space as surfaces of faces; two faces are connected by an edge that only they share.
class Surfaces {
 public:
  explicit Surfaces(const std::vector<SeamSide>& sides);
  void check() const;

 private:
  struct Surface {
    double volume = 0;  // [m3] positive around soil, negative around a void
    bool named = false, closed = true;
    Bounds all = Bounds::nothing();
  };
  template <class F>
  void for_each_edge(F&& f) const;

  const std::vector<SeamSide>& sides_;
  std::vector<int> leader_;
};

/// Calls f(face, edge from node to node).
template <class F>
void Surfaces::for_each_edge(F&& f) const {
  for (std::size_t s = 0; s < sides_.size(); ++s)
    for (int c = 0; c < sides_[s].corners; ++c) {
      const long long ends[2] = {sides_[s].at.nodes[c], sides_[s].at.nodes[(c + 1) % sides_[s].corners]};
      f(static_cast<int>(s), ends);
    }
}

Surfaces::Surfaces(const std::vector<SeamSide>& sides) : sides_(sides) {
  DisjointSets joined(sides.size());
  std::unordered_map<SideKey, std::vector<int>, SideKeyHash> faces;  // faces at each edge
  for_each_edge([&](int face, const long long* ends) { faces[sorted_key(ends, 2)].push_back(face); });
  for (const auto& [edge, at] : faces)
    if (at.size() == 2) joined.join(at[0], at[1]);
  leader_ = joined.leaders();
}

void Surfaces::check() const {
  std::map<int, Surface> surfaces;
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    const std::vector<Point>& x = sides_[s].points;
    Surface& surface = surfaces[leader_[s]];
    const Point& origin = sides_[leader_[s]].points[0];
    surface.named = surface.named || !sides_[s].sets.empty();
    for (const Point& point : x) surface.all.enclose(point);
    for (const auto& piece : sides_[s].pieces) {
      Mat<double, 3> v;
      for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i) v[k][i] = x[piece[k]][i] - origin[i];
      surface.volume += determinant(v) / 6;
    }
  }
  std::unordered_map<SideKey, std::map<int, int>, SideKeyHash> ways;  // by edge and surface
  for_each_edge(
      [&](int face, const long long* ends) { ways[sorted_key(ends, 2)][leader_[face]] += ends[0] < ends[1] ? 1 : -1; });
  for (const auto& [edge, at] : ways)
    for (const auto& [surface, sum] : at)
      if (sum != 0) surfaces[surface].closed = false;
  for (const auto& [leader, surface] : surfaces) {
    const double extent = surface.all.extent();
    if (!surface.named && surface.closed && surface.volume <= -1e-9 * extent * extent * extent) refuse(surface.all, 3);
  }
}

}  // namespace

void check_holes(const GlobalMesh& mesh, const std::vector<SeamSide>& sides) {
  if (mesh.dimension() == 2)
    Loops(sides).check();
  else
    Surfaces(sides).check();
}

}  // namespace mudline
