#include "ale/nodal_remap.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "ale/face_locator.hpp"
#include "tensor/vec.hpp"

namespace mudline {

void NodalRemap::put_on_path(const MeshPath& path, int first, int last, const Positions& x_old, const Point& x,
                             Place& place) const {
  double least = 1e300;
  for (int k = first; k + path.stride <= last; k += path.stride) {
    const CurvedSide side = path.side(k);
    const ClosestOnSide there = closest_on_side(side, x_old, x, least);
    if (there.distance >= least) continue;
    least = there.distance;
    place.side = side;
    place.along = there.place;
  }
}

NodalRemap::NodalRemap(const GhostedMesh& mesh, const std::vector<MeshPath>& paths, const Positions& x_old,
                       const Positions& x_new, const SurfaceMotion* surfaces)
    : mesh_(mesh), to_(mesh), places_(x_old.size()) {
  const PointLocator locator(mesh, x_old);
  for (int node : mesh.owned_nodes()) {
    if (x_new[node] == x_old[node]) {
      places_[node].same = node;
      continue;
    }
    places_[node].inside = locator.find(x_new[node], mesh.element_of(node));
  }
  for (const MeshPath& path : paths)
    for (int i = 1; i + 1 < static_cast<int>(path.nodes.size()); ++i) {
      Place& place = places_[path.nodes[i]];
      if (place.same >= 0 || !mesh.owns(path.nodes[i])) continue;
      // a node slides less than one side
      const int first = std::max(0, (i / path.stride - 2) * path.stride),
                last = static_cast<int>(path.nodes.size()) - 1;
      put_on_path(path, first, std::min(last, i + 3 * path.stride), x_old, x_new[path.nodes[i]], place);
    }
  if (!surfaces) return;
  for (int node : surfaces->nodes()) {
    Place& place = places_[node];
    if (place.same >= 0 || !mesh.owns(node)) continue;
    const SurfacePlace there = surfaces->place(node, x_old, x_new[node]);
    place.side = surfaces->surfaces().faces[there.face];
    place.along = there.xi;
  }
}

NodalRemap::NodalRemap(const Bounded& from, const Bounded& to) : mesh_(from.mesh), to_(to.mesh), places_(to.x.size()) {
  const PointLocator locator(mesh_, from.x);
  std::map<int, int> guess;  // (block) element of the last node found
  for (const auto& element : to_.elements())
    for (int a = 0; a < num_nodes(element.shape); ++a) {
      Place& place = places_[element.nodes[a]];
      if (place.inside.element >= 0 || !to_.owns(element.nodes[a])) continue;
      int& near = guess.emplace(element.block, mesh_.block_elements(element.block).front()).first->second;
      place.inside = locator.find(to.x[element.nodes[a]], near);
      near = place.inside.element;
    }
  put_on_new_faces(from, to);
  for (std::size_t p = 0; p < to.paths.size(); ++p) put_on_new_path(from.paths[p], to.paths[p], from.x, to.x);
}

NodalRemap::NodalRemap(const GhostedMesh& from, const GhostedMesh& to,
                       const std::vector<std::pair<int, MeshPlace>>& places)
    : mesh_(from), to_(to), places_(to.num_nodes()) {
  for (const auto& [node, found] : places) places_[node].inside = found;
}

void NodalRemap::put_on_new_faces(const Bounded& from, const Bounded& to) {
  std::map<Point, int> at;  // old nodes by their place
  for (const SurfaceFace& face : from.faces)
    for (int a = 0; a < num_nodes(face.shape); ++a) at[from.x[face.nodes[a]]] = face.nodes[a];
  const FaceLocator locator(from.faces, from.x);
  std::set<int> done;
  for (const SurfaceFace& face : to.faces)
    for (int a = 0; a < num_nodes(face.shape); ++a) {
      const int node = face.nodes[a];
      if (!to_.owns(node) || !done.insert(node).second) continue;
      Place& place = places_[node];
      const auto same = at.find(to.x[node]);
      if (same != at.end()) place.same = same->second;
      const SurfacePlace there = locator.nearest(face.patch, to.x[node]);
      place.side = from.faces[there.face];
      place.along = there.xi;
    }
}

void NodalRemap::put_on_new_path(const MeshPath& old, const MeshPath& made, const Positions& x_old,
                                 const Positions& x_new) {
  const int last = static_cast<int>(made.nodes.size()) - 1;
  for (int i = 0; i <= last; ++i) {
    Place& place = places_[made.nodes[i]];
    if (!to_.owns(made.nodes[i])) continue;
    if (i == 0 || i == last) {
      place.same = i == 0 ? old.nodes.front() : old.nodes.back();
      continue;
    }
    const bool stays = made.nodes.size() == old.nodes.size() && x_new[made.nodes[i]] == x_old[old.nodes[i]];
    if (stays) place.same = old.nodes[i];
    put_on_path(old, 0, static_cast<int>(old.nodes.size()) - 1, x_old, x_new[made.nodes[i]], place);
  }
}

double NodalRemap::Sources::away(int a) const {
  const Vec<double, 3>& at = reference_node(shape, a);
  double square = 0;
  for (int k = 0; k < dimension(shape); ++k) square += std::pow(xi[k] - at[k], 2);
  return square;
}

NodalRemap::Sources NodalRemap::sources(const Place& place, Support support) const {
  Sources result;
  const CellShape whole = place.side ? place.side->shape : mesh_.elements()[place.inside.element].shape;
  result.shape = support == Support::vertices ? linear_partner(whole) : whole;
  result.xi = place.side ? place.along.data() : place.inside.xi;
  result.count = num_nodes(result.shape);
  result.nodes = place.side ? place.side->nodes.data() : mesh_.elements()[place.inside.element].nodes.data();
  double slopes[81];
  evaluate_shape(result.shape, result.xi, result.weight, slopes);
  return result;
}

std::vector<double> NodalRemap::apply(const std::vector<double>& old, int components, Support support,
                                      bool limited) const {
  std::vector<double> now(places_.size() * components, 0.0);
  for (int node : to_.owned_nodes()) {
    const Place& place = places_[node];
    if (support == Support::vertices && !to_.is_vertex(node)) continue;
    if (place.same >= 0) {
      for (int c = 0; c < components; ++c) now[components * node + c] = old[components * place.same + c];
      continue;
    }
    const Sources from = sources(place, support);
    for (int c = 0; c < components; ++c) {
      double sum = 0, least = 1e300, most = -1e300;
      for (int a = 0; a < from.count; ++a) {
        const double value = old[components * from.nodes[a] + c];
        sum += from.weight[a] * value;
        least = std::min(least, value);
        most = std::max(most, value);
      }
      now[components * node + c] = limited ? std::clamp(sum, least, most) : sum;
    }
  }
  to_.fill(now, components);
  return now;
}

std::vector<double> NodalRemap::of_rows(const std::vector<double>& old, const std::vector<double>& has,
                                        const std::vector<StateVariable>& variables) const {
  const std::size_t columns = old.size() / has.size();
  std::vector<double> now(places_.size() * columns, 0.0);
  const bool moved = &mesh_ == &to_;
  for (int node : to_.owned_nodes()) {
    const Place& place = places_[node];
    Sources from;
    int nearest = place.same;
    bool whole = false;  // all nodes around have rows
    if (place.same < 0) {
      from = sources(place, Support::all_nodes);
      const auto has_row = [&](int a) { return has[from.nodes[a]] != 0; };
      int best = -1, with = 0;
      for (int a = 0; a < from.count; ++a) {
        if (!has_row(a)) continue;
        ++with;
        if (best < 0 || from.away(a) < from.away(best)) best = a;
      }
      nearest = from.nodes[std::max(best, 0)];
      whole = with == from.count;
    }
    std::size_t column = 0;
    for (const StateVariable& variable : variables)
      for (int k = 0; k < variable.components; ++k, ++column) {
        const bool stays = moved && variable.transfer == Transfer::total;
        double value = old[columns * (stays ? node : nearest) + column];
        if (whole && variable.transfer == Transfer::value) {
          value = 0;
          for (int a = 0; a < from.count; ++a) value += from.weight[a] * old[columns * from.nodes[a] + column];
          value = std::clamp(value, variable.low, variable.high);
        }
        now[columns * node + column] = value;
      }
  }
  return now;
}

}  // namespace mudline
