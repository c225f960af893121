#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <unordered_map>

#include "core/errors.hpp"
#include "core/pi.hpp"
#include "discretisation/mesh_topology.hpp"

namespace mudline {

namespace {

using Place = std::array<double, 2>;

/// Sides that lie nearer to each other than this share of the smaller of their elements (the side, or the depth behind
/// it) form a seam; what lies over another element by more than this share of its own depth overlaps it.
constexpr double closeness = 0.02;

double distance(const Place& a, const Place& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

struct Box {
  double low[2] = {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  double high[2] = {-std::numeric_limits<double>::max(), -std::numeric_limits<double>::max()};
  void add(const double* x) {
    for (int i = 0; i < 2; ++i) {
      low[i] = std::min(low[i], x[i]);
      high[i] = std::max(high[i], x[i]);
    }
  }
  void widen(double by) {
    for (int i = 0; i < 2; ++i) {
      low[i] -= by;
      high[i] += by;
    }
  }
  bool meets(const Box& other) const {
    return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] && other.low[1] <= high[1];
  }
};

/// Boxes in a grid of about as many cells as there are boxes, to find those near another box.
class BoxGrid {
 public:
  explicit BoxGrid(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
    Box all;
    for (const Box& box : boxes_) {
      all.add(box.low);
      all.add(box.high);
    }
    cells_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(boxes_.size()))));
    for (int i = 0; i < 2; ++i) {
      low_[i] = all.low[i];
      size_[i] = std::max((all.high[i] - all.low[i]) / cells_, std::numeric_limits<double>::min());
    }
    lists_.resize(static_cast<std::size_t>(cells_) * cells_);
    for (std::size_t b = 0; b < boxes_.size(); ++b)
      for_each_cell(boxes_[b], [&](std::vector<int>& list) { list.push_back(static_cast<int>(b)); });
  }
  /// Calls f(number) for the boxes that meet one, sometimes more than once.
  template <class F>
  void near(const Box& box, F&& f) {
    for_each_cell(box, [&](const std::vector<int>& list) {
      for (int b : list)
        if (boxes_[b].meets(box)) f(b);
    });
  }

 private:
  template <class F>
  void for_each_cell(const Box& box, F&& f) {
    const auto cell = [&](double x, int i) {
      return static_cast<int>(std::min(std::max((x - low_[i]) / size_[i], 0.0), cells_ - 1.0));
    };
    for (int i = cell(box.low[0], 0); i <= cell(box.high[0], 0); ++i)
      for (int j = cell(box.low[1], 1); j <= cell(box.high[1], 1); ++j)
        f(lists_[static_cast<std::size_t>(i) * cells_ + j]);
  }

  std::vector<Box> boxes_;
  int cells_;
  double low_[2], size_[2];
  std::vector<std::vector<int>> lists_;
};

/// The boundary of a whole mesh, with the sets of its sides.
class Seams {
 public:
  explicit Seams(const GlobalMesh& mesh);
  /// What lies beside each other; `cracks` are let pass.
  void check_joints(const std::vector<std::string>& cracks);
  void check_overlap();
  void check_holes() const;

 private:
  struct Side {
    ElementSide at;
    std::vector<Place> curve;  // points along it, evenly in the parameter
    std::set<std::string> sets;
    double length;  // of its chord [m]
    double size;    // that, or the depth of its element behind it where it is less [m]
  };
  const Place& start(const Side& s) const { return mesh_.coordinates[s.at.nodes[0]]; }
  const Place& end(const Side& s) const { return mesh_.coordinates[s.at.nodes[1]]; }
  Box box(const Side& side) const;
  bool lies_along(const Side& shorter, const Side& longer) const;
  bool may_touch(const std::set<std::string>& a, const std::set<std::string>& b) const;
  bool meant(const Side& a, const Side& b, const std::vector<std::string>& cracks);
  [[noreturn]] void refuse(const Side& shorter, const Side& longer) const;
  std::size_t next_of(std::size_t side) const;

  const GlobalMesh& mesh_;
  std::vector<Side> sides_;
  std::map<std::pair<int, long long>, std::set<std::string>> element_sets_;  // of an element's boundary sides
  std::unordered_map<long long, std::vector<std::size_t>> from_;             // sides by their first node
  std::set<std::string> cracked_;                                            // sets in which a crack was found
};

Seams::Seams(const GlobalMesh& mesh) : mesh_(mesh) {
  std::map<std::array<long long, 3>, std::set<std::string>> sets;
  for (const auto& [name, sides] : mesh.side_sets)
    for (const auto& side : sides) sets[{side.block, side.element, side.side}].insert(name);
  for (ElementSide& at : boundary_sides(mesh)) {
    Side side{std::move(at), {}, {}, 0, 0};
    const GlobalMesh::Side& place = side.at.place;
    const ElementMap map = element_map(mesh, place.block, place.element);
    const int pieces = side.at.nodes.size() > 2 ? 8 : 1;
    for (int k = 0; k <= pieces; ++k)
      side.curve.push_back(map.at(on_side(map.shape(), place.side, -1 + 2.0 * k / pieces).data()));
    side.length = distance(start(side), end(side));
    const bool triangle = num_corners(map.shape()) == 3;
    const double middle[2] = {triangle ? 1.0 / 3 : 0.0, triangle ? 1.0 / 3 : 0.0};
    const double depth = map.determinant(middle) * (triangle ? 1.0 : 4.0) / side.length;
    side.size = std::min(side.length, depth);
    const auto found = sets.find({place.block, place.element, place.side});
    if (found != sets.end()) {
      side.sets = found->second;
      element_sets_[{place.block, place.element}].insert(side.sets.begin(), side.sets.end());
    }
    from_[side.at.nodes[0]].push_back(sides_.size());
    sides_.push_back(std::move(side));
  }
}

Box Seams::box(const Side& side) const {
  Box result;
  for (const Place& x : side.curve) result.add(x.data());
  result.widen(closeness * side.size);
  return result;
}

double distance_to_piece(const Place& x, const Place& a, const Place& b) {
  const double d[2] = {b[0] - a[0], b[1] - a[1]}, square = d[0] * d[0] + d[1] * d[1];
  double t = square > 0 ? ((x[0] - a[0]) * d[0] + (x[1] - a[1]) * d[1]) / square : 0.0;
  t = std::min(std::max(t, 0.0), 1.0);
  return distance(x, {a[0] + t * d[0], a[1] + t * d[1]});
}

/// Neighbours on a seam run in opposite directions, side by side on some length and not only where their ends meet.
bool Seams::lies_along(const Side& shorter, const Side& longer) const {
  double along = 0;
  for (int i = 0; i < 2; ++i) along += (end(shorter)[i] - start(shorter)[i]) * (end(longer)[i] - start(longer)[i]);
  if (along > -0.9 * shorter.length * longer.length) return false;
  const GlobalMesh::Side& place = shorter.at.place;
  const ElementMap map = element_map(mesh_, place.block, place.element);
  int close = 0;
  for (double t : {-0.8, -0.4, 0.0, 0.4, 0.8}) {
    const Place x = map.at(on_side(map.shape(), place.side, t).data());
    double nearest = std::numeric_limits<double>::max();
    for (std::size_t k = 0; k + 1 < longer.curve.size(); ++k)
      nearest = std::min(nearest, distance_to_piece(x, longer.curve[k], longer.curve[k + 1]));
    close += nearest < closeness * std::min(shorter.size, longer.size);
  }
  return close >= 2;
}

bool Seams::may_touch(const std::set<std::string>& a, const std::set<std::string>& b) const {
  const auto unknown = [&](const std::string& set) { return mesh_.side_sets.count(set) == 0; };
  return std::any_of(mesh_.pairs.begin(), mesh_.pairs.end(), [&](const auto& pair) {
    // a misspelt set may be one of these; the contact that names it, or one twice, says so
    if (unknown(pair.first) || unknown(pair.second) || pair.first == pair.second) return true;
    return (a.count(pair.first) && b.count(pair.second)) || (a.count(pair.second) && b.count(pair.first));
  });
}

/// Whether the deck names what two sides beside each other are: surfaces in contact, or the faces of a crack, which end
/// at the same places.
bool Seams::meant(const Side& a, const Side& b, const std::vector<std::string>& cracks) {
  if (may_touch(a.sets, b.sets)) return true;
  const double near = closeness * std::min(a.size, b.size);
  const bool twins = distance(start(a), end(b)) < near && distance(end(a), start(b)) < near;
  const bool apart = a.at.nodes[0] != b.at.nodes[1] && a.at.nodes[1] != b.at.nodes[0];
  bool named = false;
  for (const std::string& crack : cracks) {
    if (!(a.sets.count(crack) || b.sets.count(crack)) || !(twins || apart)) continue;
    cracked_.insert(crack);
    named = true;
  }
  return named;
}

void Seams::refuse(const Side& shorter, const Side& longer) const {
  const double near = closeness * std::min(shorter.size, longer.size);
  const std::string ways =
      "; join them (in Gmsh by Coherence), or name both surfaces in a contact's 'slave' and 'master', or their side "
      "set "
      "in 'cracks' when they are to part";
  if (distance(start(shorter), end(longer)) < near && distance(end(shorter), start(longer)) < near)
    throw InputError("the mesh has a crack of twin nodes: two elements have a side from " + place_text(start(longer)) +
                     " to " + place_text(end(longer)) + " each" + ways);
  if (shorter.at.nodes[0] == longer.at.nodes[1] || shorter.at.nodes[1] == longer.at.nodes[0]) {
    const bool first = shorter.at.nodes[0] == longer.at.nodes[1];
    throw InputError("the mesh has a hanging node at " + place_text(first ? end(shorter) : start(shorter)) +
                     ": it lies on the side from " + place_text(start(longer)) + " to " + place_text(end(longer)) +
                     " of an element that does not have it");
  }
  throw InputError("two parts of the mesh lie beside each other at " + place_text(middle_of(mesh_, shorter.at)) +
                   " without common nodes" + ways);
}

void Seams::check_joints(const std::vector<std::string>& cracks) {
  std::vector<Box> boxes;
  for (const Side& side : sides_) boxes.push_back(box(side));
  BoxGrid grid(boxes);
  for (std::size_t a = 0; a < sides_.size(); ++a)
    grid.near(boxes[a], [&](int b) {
      if (static_cast<std::size_t>(b) <= a) return;
      const bool first = sides_[a].length <= sides_[b].length;
      const Side &shorter = sides_[first ? a : b], &longer = sides_[first ? b : a];
      if (lies_along(shorter, longer) && !meant(shorter, longer, cracks)) refuse(shorter, longer);
    });
  for (const std::string& crack : cracks) {
    if (mesh_.side_sets.count(crack) == 0) throw InputError("'cracks' names '" + crack + "', which is no side set");
    if (cracked_.count(crack) == 0)
      throw InputError("'cracks' names '" + crack +
                       "', but no side of it lies beside another one without common nodes");
  }
}

/// Two sheets of elements over one another end at a boundary: there, just inside of a side, a point lies in two
/// elements.
void Seams::check_overlap() {
  std::vector<Box> boxes;
  std::vector<std::pair<int, long long>> elements;
  for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
    const auto& block = mesh_.blocks[b];
    const std::size_t n = num_nodes(block.shape);
    for (std::size_t first = 0; first < block.nodes.size(); first += n) {
      Box box;
      for (std::size_t a = 0; a < n; ++a) box.add(mesh_.coordinates[block.nodes[first + a]].data());
      boxes.push_back(box);
      elements.emplace_back(static_cast<int>(b), static_cast<long long>(first / n));
    }
  }
  BoxGrid grid(std::move(boxes));
  for (const Side& side : sides_) {
    const std::pair<int, long long> own{side.at.place.block, side.at.place.element};
    const ElementMap map = element_map(mesh_, own.first, own.second);
    const double middle = num_corners(map.shape()) == 3 ? 1.0 / 3 : 0.0;
    for (double t : {-0.8, 0.0, 0.8}) {
      Place xi = on_side(map.shape(), side.at.place.side, t);
      for (double& c : xi) c += closeness * (middle - c) * (num_corners(map.shape()) == 3 ? 3 : 2);
      const Place x = map.at(xi.data());
      Box point;
      point.add(x.data());
      grid.near(point, [&](int e) {
        if (elements[e] == own) return;
        double there[2];
        const ElementMap other = element_map(mesh_, elements[e].first, elements[e].second);
        if (!other.invert(x, there) || outside_cell(other.shape(), there) > -1e-3) return;
        if (distance(other.at(there), x) > 1e-9 * side.length) return;  // the search did not end
        const auto sets = element_sets_.find(elements[e]);
        if (sets != element_sets_.end() && may_touch(side.sets, sets->second)) return;
        throw InputError("the mesh lies over itself at " + place_text(x) + ": the point is in an element of region '" +
                         mesh_.blocks[own.first].region + "' and in another one of region '" +
                         mesh_.blocks[elements[e].first].region + "'");
      });
    }
  }
}

/// The side with which the boundary goes on around the same void: at a node where several voids meet, the first one met
/// on the way through the void.
std::size_t Seams::next_of(std::size_t s) const {
  const std::vector<std::size_t>& ways = from_.at(sides_[s].at.nodes[1]);
  if (ways.size() == 1) return ways[0];
  const auto angle = [&](const Place& from, const Place& to) { return std::atan2(to[1] - from[1], to[0] - from[0]); };
  const std::vector<Place>& here = sides_[s].curve;
  const double back = angle(here.back(), here[here.size() - 2]);
  std::size_t best = ways[0];
  double least = std::numeric_limits<double>::max();
  for (std::size_t way : ways) {
    double turn = std::fmod(angle(sides_[way].curve[0], sides_[way].curve[1]) - back + 4 * pi, 2 * pi);
    if (turn < 1e-9) turn = 2 * pi;
    if (turn >= least) continue;
    least = turn;
    best = way;
  }
  return best;
}

void Seams::check_holes() const {
  std::vector<char> seen(sides_.size(), 0);
  for (std::size_t first = 0; first < sides_.size(); ++first) {
    double area = 0;
    bool named = false;
    Box all;
    for (std::size_t s = first; !seen[s]; s = next_of(s)) {
      seen[s] = 1;
      named = named || !sides_[s].sets.empty();
      const std::vector<Place>& x = sides_[s].curve;
      for (std::size_t k = 0; k + 1 < x.size(); ++k) {
        area += 0.5 * (x[k][0] * x[k + 1][1] - x[k + 1][0] * x[k][1]);
        all.add(x[k].data());
      }
    }
    const double extent = std::max(all.high[0] - all.low[0], all.high[1] - all.low[1]);
    if (named || area > -1e-9 * extent * extent) continue;
    throw InputError("the mesh has a hole around " +
                     place_text({0.5 * (all.low[0] + all.high[0]), 0.5 * (all.low[1] + all.high[1])}) +
                     " whose edge is in no side set: elements are missing, or name the edge of a hole that is meant");
  }
}

}  // namespace

void check_seams(const GlobalMesh& mesh, const std::vector<std::string>& cracks) {
  Seams seams(mesh);
  seams.check_joints(cracks);
  seams.check_overlap();
  seams.check_holes();
}

}  // namespace mudline
