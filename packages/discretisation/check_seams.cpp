#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "core/errors.hpp"
#include "core/told.hpp"
#include "discretisation/box_grid.hpp"
#include "discretisation/seam_sides.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

double distance(const Point& a, const Point& b) {
  return std::sqrt((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]) + (b[2] - a[2]) * (b[2] - a[2]));
}

/// Checks where the boundary of a whole mesh touches itself.
class Seams {
 public:
  explicit Seams(const GlobalMesh& mesh);
  /// Refuses sides that lie beside each other, except contacts and `cracks`.
  void check_joints(const std::vector<std::string>& cracks);
  void check_overlap();
  void check_voids() const { check_holes(mesh_, sides_); }

 private:
  const Point& corner(const SeamSide& s, int c) const { return mesh_.coordinates[s.at.nodes[c]]; }
  Bounds box(const SeamSide& side) const;
  /// The corners of one side that are nodes of another.
  std::vector<int> common(const SeamSide& a, const SeamSide& b) const;
  bool lies_along(const SeamSide& smaller, const SeamSide& larger) const;
  bool twins(const SeamSide& a, const SeamSide& b) const;
  bool may_touch(const std::set<std::string>& a, const std::set<std::string>& b) const;
  bool is_declared(const SeamSide& a, const SeamSide& b, const std::vector<std::string>& cracks);
  [[noreturn]] void refuse(const SeamSide& smaller, const SeamSide& larger) const;
  void look_into(const SeamSide& side, const Point& x, int e);
  std::string text(const Point& x) const { return place_text(x, mesh_.dimension()); }
  /// "side from (0, 0) to (1, 0)", in space "face at (0, 0, 0)".
  std::string name_of(const SeamSide& side) const;

  const GlobalMesh& mesh_;
  std::vector<SeamSide> sides_;
  std::vector<std::pair<int, long long>> elements_;
  std::map<std::pair<int, long long>, std::set<std::string>> element_sets_;  // sets of an element's boundary sides
  std::set<std::string> cracked_;                                            // sets in which a crack was found
};

Seams::Seams(const GlobalMesh& mesh) : mesh_(mesh), sides_(seam_sides(mesh)) {
  for (const SeamSide& side : sides_)
    if (!side.sets.empty())
      element_sets_[{side.at.place.block, side.at.place.element}].insert(side.sets.begin(), side.sets.end());
}

Bounds Seams::box(const SeamSide& side) const {
  Bounds result = Bounds::nothing();
  for (const Point& x : side.points) result.enclose(x);
  for (int i = 0; i < 3; ++i) {
    result.low[i] -= seam_closeness * side.size;
    result.high[i] += seam_closeness * side.size;
  }
  return result;
}

std::vector<int> Seams::common(const SeamSide& a, const SeamSide& b) const {
  std::vector<int> result;
  const auto &first = b.at.nodes.begin(), last = b.at.nodes.begin() + b.corners;
  for (int c = 0; c < a.corners; ++c)
    if (std::find(first, last, a.at.nodes[c]) != last) result.push_back(c);
  return result;
}

/// Two sides form a seam where their normals are opposite and they are close along some length or area, not only where
/// their ends or edges meet.
bool Seams::lies_along(const SeamSide& smaller, const SeamSide& larger) const {
  double along = 0;
  for (int i = 0; i < 3; ++i) along += smaller.normal[i] * larger.normal[i];
  if (along > -0.9 * smaller.measure * larger.measure) return false;
  const GlobalMesh::Side& place = smaller.at.place;
  const ElementMap map = element_map(mesh_, place.block, place.element);
  const double size = std::min(smaller.size, larger.size);
  const std::vector<int> joined = smaller.corners > 2 ? common(smaller, larger) : std::vector<int>{};
  int close = 0;
  for (const auto& sample : side_samples(side_shape(map.shape(), place.side), false)) {
    const Point x = map.at(on_side(map.shape(), place.side, sample).data());
    // close to the common edge of two faces that open like a book, the distance says nothing
    if (joined.size() == 2 &&
        distance_to_piece(x, corner(smaller, joined[0]), corner(smaller, joined[1])) < 0.2 * smaller.size)
      continue;
    close += distance_to(larger, x) < seam_closeness * size;
  }
  return close >= 2;
}

bool Seams::may_touch(const std::set<std::string>& a, const std::set<std::string>& b) const {
  const auto unknown = [&](const std::string& set) { return mesh_.side_sets.count(set) == 0; };
  return std::any_of(mesh_.contacts.pairs.begin(), mesh_.contacts.pairs.end(), [&](const auto& pair) {
    // a misspelt set may be one of these; the contact itself refuses unknown sets and the same set twice
    if (unknown(pair.first) || unknown(pair.second) || pair.first == pair.second) return true;
    return (a.count(pair.first) && b.count(pair.second)) || (a.count(pair.second) && b.count(pair.first));
  });
}

/// Whether two sides have their corners at the same places.
bool Seams::twins(const SeamSide& a, const SeamSide& b) const {
  const double near = seam_closeness * std::min(a.size, b.size);
  for (int c = 0; c < a.corners; ++c) {
    double nearest = std::numeric_limits<double>::max();
    for (int d = 0; d < b.corners; ++d) nearest = std::min(nearest, distance(corner(a, c), corner(b, d)));
    if (nearest >= near) return false;
  }
  return a.corners == b.corners;
}

/// Whether the deck declares two sides beside each other as surfaces in contact, or as the faces of a crack, whose
/// corners are at the same places.
bool Seams::is_declared(const SeamSide& a, const SeamSide& b, const std::vector<std::string>& cracks) {
  if (may_touch(a.sets, b.sets)) return true;
  const bool allowed = twins(a, b) || common(a, b).empty();
  bool named = false;
  for (const std::string& crack : cracks) {
    if (!(a.sets.count(crack) || b.sets.count(crack)) || !allowed) continue;
    cracked_.insert(crack);
    named = true;
  }
  return named;
}

std::string Seams::name_of(const SeamSide& side) const {
  if (side.corners > 2) return "face at " + text(middle_of(mesh_, side.at));
  return "side from " + text(corner(side, 0)) + " to " + text(corner(side, 1));
}

void Seams::refuse(const SeamSide& smaller, const SeamSide& larger) const {
  const std::string remedies =
      "; join them (in Gmsh by Coherence), or name both surfaces in a contact's 'slave' and 'master', or their side "
      "set "
      "in 'cracks' when they are to part";
  const std::vector<int> joined = common(smaller, larger);
  if (static_cast<int>(joined.size()) == smaller.corners)
    throw InputError("elements do not fit: the " + name_of(smaller) + " of one has all its corners on the " +
                     name_of(larger) + " of another, but not the same shape or mid-side nodes");
  if (twins(smaller, larger))
    throw InputError("the mesh has a crack of twin nodes: two elements have a " + name_of(larger) + " each" + remedies);
  if (joined.empty())
    throw InputError("two parts of the mesh lie beside each other at " + text(middle_of(mesh_, smaller.at)) +
                     " without common nodes" + remedies);
  int hanging = -1;  // the corner nearest to the larger side among those that are not common
  double nearest = std::numeric_limits<double>::max();
  for (int c = 0; c < smaller.corners; ++c) {
    const double here = distance_to(larger, corner(smaller, c));
    if (std::find(joined.begin(), joined.end(), c) != joined.end() || here >= nearest) continue;
    nearest = here;
    hanging = c;
  }
  throw InputError("the mesh has a hanging node at " + text(corner(smaller, hanging)) + ": it lies on the " +
                   name_of(larger) + " of an element that does not have it");
}

void Seams::check_joints(const std::vector<std::string>& cracks) {
  std::vector<Bounds> boxes;
  for (const SeamSide& side : sides_) boxes.push_back(box(side));
  BoxGrid grid(boxes);
  for (std::size_t a = 0; a < sides_.size(); ++a)
    grid.near(boxes[a], [&](int b) {
      if (static_cast<std::size_t>(b) <= a) return;
      const bool first = sides_[a].measure <= sides_[b].measure;
      const SeamSide &smaller = sides_[first ? a : b], &larger = sides_[first ? b : a];
      if (lies_along(smaller, larger) && !is_declared(smaller, larger, cracks)) refuse(smaller, larger);
    });
  for (const std::string& crack : cracks) {
    if (mesh_.side_sets.count(crack) == 0) throw InputError("'cracks' names '" + crack + "', which is no side set");
    if (cracked_.count(crack) == 0)
      throw InputError("'cracks' names '" + crack +
                       "', but no side of it lies beside another one without common nodes");
  }
}

/// Where two sheets of elements overlap, one of them has a boundary: a point just inside of that side lies in two
/// elements.
void Seams::check_overlap() {
  std::vector<Bounds> boxes;
  for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
    const auto& block = mesh_.blocks[b];
    const std::size_t n = num_nodes(block.shape);
    for (std::size_t first = 0; first < block.nodes.size(); first += n) {
      Bounds box = Bounds::nothing();
      for (std::size_t a = 0; a < n; ++a) box.enclose(mesh_.coordinates[block.nodes[first + a]]);
      boxes.push_back(box);
      elements_.emplace_back(static_cast<int>(b), static_cast<long long>(first / n));
    }
  }
  BoxGrid grid(std::move(boxes));
  for (const SeamSide& side : sides_) {
    const ElementMap map = element_map(mesh_, side.at.place.block, side.at.place.element);
    const CellShape shape = map.shape();
    const Vec<double, 3> middle = cell_centre(shape);
    const CellShape face = side_shape(shape, side.at.place.side);
    // the depth of the cell below its side over that of its centre
    const double depth = is_simplex(shape) ? num_corners(shape) : 1 + per_box(shape) / per_box(face);
    for (const auto& sample : side_samples(face, true)) {
      Vec<double, 3> xi = on_side(shape, side.at.place.side, sample);
      for (int i = 0; i < dimension(shape); ++i) xi[i] += seam_closeness * (middle[i] - xi[i]) * depth;
      const Point x = map.at(xi.data());
      grid.near({x, x}, [&](int e) { look_into(side, x, e); });
    }
  }
}

/// Refuses a point just inside of a side that lies in element number e, too.
void Seams::look_into(const SeamSide& side, const Point& x, int e) {
  const std::pair<int, long long> own{side.at.place.block, side.at.place.element};
  if (elements_[e] == own) return;
  double there[3];
  const ElementMap other = element_map(mesh_, elements_[e].first, elements_[e].second);
  if (!other.invert(x.data(), there) || outside_cell(other.shape(), there) > -1e-3) return;
  if (distance(other.at(there), x) > 1e-9 * side.edge) return;  // the inversion did not converge
  const auto sets = element_sets_.find(elements_[e]);
  if (sets != element_sets_.end() && may_touch(side.sets, sets->second)) return;
  throw InputError("the mesh lies over itself at " + text(x) + ": the point is in an element of region '" +
                   mesh_.blocks[own.first].region + "' and in another one of region '" +
                   mesh_.blocks[elements_[e].first].region + "'");
}

}  // namespace

void check_seams(const GlobalMesh& mesh, const std::vector<std::string>& cracks) {
  Seams seams(mesh);
  seams.check_joints(cracks);
  seams.check_overlap();
  seams.check_voids();
}

}  // namespace mudline
