#include "ale/nodal_remap.hpp"

#include <algorithm>
#include <cmath>

#include "ale/point_locator.hpp"

namespace mudline {

namespace {

/// Place on a side, in [-1, 1], nearest to x, and its distance.
std::pair<double, double> nearest_on_side(const int (&nodes)[3], const Positions& positions,
                                          const std::array<double, 2>& x) {
  const int count = nodes[2] >= 0 ? 3 : 2;
  const auto offset = [&](double xi, double(&r)[2], double(&t)[2]) {
    double N[3], dN[3];
    evaluate_line(count, xi, N, dN);
    for (int d = 0; d < place_size; ++d) {
      r[d] = x[d];
      t[d] = 0;
      for (int a = 0; a < count; ++a) {
        r[d] -= N[a] * positions[nodes[a]][d];
        t[d] += dN[a] * positions[nodes[a]][d];
      }
    }
  };
  double xi = 0, r[2], t[2];
  for (int k = 0; k < 20; ++k) {  // Gauss-Newton: the foot is near the curve
    offset(xi, r, t);
    const double step = (r[0] * t[0] + r[1] * t[1]) / (t[0] * t[0] + t[1] * t[1]);
    xi = std::clamp(xi + step, -1.0, 1.0);
    if (std::abs(step) < 1e-14) break;
  }
  offset(xi, r, t);
  return {xi, std::hypot(r[0], r[1])};
}

}  // namespace

NodalRemap::NodalRemap(const WholeMesh& mesh, const std::vector<MeshPath>& paths, const Positions& x_old,
                       const Positions& x_new)
    : mesh_(mesh), places_(x_old.size()) {
  const PointLocator locator(mesh, x_old);
  for (int node = 0; node < mesh.num_nodes(); ++node) {
    if (x_new[node] == x_old[node]) continue;
    const MeshPlace place = locator.find(x_new[node], mesh.element_of(node));
    places_[node].element = place.element;
    std::copy(place.xi, place.xi + 2, places_[node].xi);
  }
  for (const MeshPath& path : paths)
    for (int i = 1; i + 1 < static_cast<int>(path.nodes.size()); ++i) {
      Place& place = places_[path.nodes[i]];
      if (place.element < 0) continue;
      double least = 1e300;
      // a node slides less than one side
      const int first = std::max(0, (i / path.stride - 2) * path.stride),
                last = static_cast<int>(path.nodes.size()) - 1;
      for (int k = first; k + path.stride <= std::min(last, i + 3 * path.stride); k += path.stride) {
        const int nodes[3] = {path.nodes[k], path.nodes[k + path.stride], path.stride == 2 ? path.nodes[k + 1] : -1};
        const auto [xi, distance] = nearest_on_side(nodes, x_old, x_new[path.nodes[i]]);
        if (distance >= least) continue;
        least = distance;
        std::copy(nodes, nodes + 3, place.side_nodes);
        place.along = xi;
      }
    }
}

std::vector<double> NodalRemap::apply(const std::vector<double>& old, int components, Support support,
                                      bool limited) const {
  std::vector<double> now = old;
  double N[9], dN[18];
  for (int node = 0; node < mesh_.num_nodes(); ++node) {
    const Place& place = places_[node];
    if (place.element < 0 || (support == Support::vertices && !mesh_.is_vertex(node))) continue;
    const auto& element = mesh_.elements()[place.element];
    int count;
    const int* from;
    if (place.side_nodes[0] >= 0) {
      count = support == Support::all_nodes && place.side_nodes[2] >= 0 ? 3 : 2;
      evaluate_line(count, place.along, N, dN);
      from = place.side_nodes;
    } else {
      const CellShape shape = support == Support::vertices ? linear_partner(element.shape) : element.shape;
      count = num_nodes(shape);
      evaluate_shape(shape, place.xi, N, dN);
      from = element.nodes.data();
    }
    for (int c = 0; c < components; ++c) {
      double sum = 0, least = 1e300, most = -1e300;
      for (int a = 0; a < count; ++a) {
        const double value = old[components * from[a] + c];
        sum += N[a] * value;
        least = std::min(least, value);
        most = std::max(most, value);
      }
      now[components * node + c] = limited ? std::clamp(sum, least, most) : sum;
    }
  }
  return now;
}

}  // namespace mudline
