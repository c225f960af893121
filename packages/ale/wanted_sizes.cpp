#include "ale/wanted_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "ale/point_locator.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// Side [m] of the equilateral or square cell of the area of an element's corners.
double side_length(const GhostedMesh::Element& element, const Positions& x) {
  const int corners = num_corners(element.shape);
  double twice = 0;
  for (int a = 0; a < corners; ++a) {
    const auto &p = x[element.nodes[a]], &q = x[element.nodes[(a + 1) % corners]];
    twice += p[0] * q[1] - p[1] * q[0];
  }
  return std::sqrt(0.5 * std::abs(twice) * (corners == 3 ? 4 / std::sqrt(3.0) : 1.0));
}

}  // namespace

WantedSizes::WantedSizes(std::shared_ptr<const GhostedMesh> mesh, const Positions& x,
                         const std::vector<double>& by_element, const Bounds& bounds)
    : mesh_(std::move(mesh)), x_(x), at_vertex_(x.size(), 0.0) {
  std::vector<int> around(x.size(), 0);
  const auto& elements = mesh_->elements();
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (int a = 0; a < num_corners(elements[e].shape); ++a) {
      at_vertex_[elements[e].nodes[a]] += std::log(by_element[e]);
      ++around[elements[e].nodes[a]];
    }
  for (std::size_t node = 0; node < x.size(); ++node)
    if (around[node] > 0)
      at_vertex_[node] = std::clamp(std::exp(at_vertex_[node] / around[node]), bounds.smallest, bounds.largest);
  bound_growth(bounds.growth);
  for (std::size_t block = 0; block < mesh_->mesh().blocks().size(); ++block)
    nearby_.push_back(mesh_->block_elements(static_cast<int>(block)).empty()
                          ? -1
                          : mesh_->block_elements(static_cast<int>(block)).front());
}

/// From the smallest size on, as the shortest ways in a graph.
void WantedSizes::bound_growth(double growth) {
  std::vector<std::vector<int>> beside(x_.size());
  for (const auto& element : mesh_->elements()) {
    const int corners = num_corners(element.shape);
    for (int a = 0; a < corners; ++a)
      for (int b = 0; b < corners; ++b)
        if (a != b) beside[element.nodes[a]].push_back(element.nodes[b]);
  }
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::size_t node = 0; node < x_.size(); ++node)
    if (at_vertex_[node] > 0) queue.emplace(at_vertex_[node], static_cast<int>(node));
  while (!queue.empty()) {
    const auto [size, node] = queue.top();
    queue.pop();
    if (size > at_vertex_[node]) continue;
    for (int other : beside[node]) {
      const double most = size + growth * std::hypot(x_[other][0] - x_[node][0], x_[other][1] - x_[node][1]);
      if (most >= at_vertex_[other]) continue;
      at_vertex_[other] = most;
      queue.emplace(most, other);
    }
  }
}

double WantedSizes::in_block(const Vec<double, 2>& place, std::size_t block, double& outside) const {
  const MeshPlace found = PointLocator(*mesh_, x_).find(on_plane(place), nearby_[block]);
  nearby_[block] = found.element;
  const auto& element = mesh_->elements()[found.element];
  const int corners = num_corners(element.shape);
  double N[9], dN[18], sum = 0, all = 0;
  evaluate_shape(linear_partner(element.shape), found.xi, N, dN);
  outside = 0;
  for (int a = 0; a < corners; ++a) {  // of the place in the element that is nearest, or about so
    outside = std::max(outside, -N[a]);
    sum += std::max(0.0, N[a]) * at_vertex_[element.nodes[a]];
    all += std::max(0.0, N[a]);
  }
  return sum / all;
}

double WantedSizes::operator()(const Vec<double, 2>& place) const {
  double result = 0, least = 1e300;
  for (std::size_t block = 0; block < nearby_.size(); ++block) {
    if (!(least > 0)) break;
    if (nearby_[block] < 0) continue;
    double outside;
    const double size = in_block(place, block, outside);
    if (outside >= least) continue;
    least = outside;
    result = size;
  }
  return result;
}

double WantedSizes::largest_ratio() const {
  double largest = 0;
  for (const auto& element : mesh_->elements()) {
    const int corners = num_corners(element.shape);
    double sum = 0;
    for (int a = 0; a < corners; ++a) sum += at_vertex_[element.nodes[a]];
    largest = std::max(largest, side_length(element, x_) * corners / sum);
  }
  return largest;
}

}  // namespace mudline
