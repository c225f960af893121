#include "ale/quality.hpp"

namespace mudline {

double scaled_jacobian(const GhostedMesh::Element& element, const Positions& x) {
  return ElementMap(element.shape, [&](int a) { return x[element.nodes[a]].data(); }).scaled_jacobian();
}

double lowest_quality(const GhostedMesh& mesh, const Positions& x, Point* worst) {
  double here = 1e300;
  int element = -1;
  const auto& elements = mesh.elements();
  for (std::size_t b = 0; b < mesh.mesh().blocks().size(); ++b)
    for (int e : mesh.own_elements(static_cast<int>(b))) {
      const double quality = scaled_jacobian(elements[e], x);
      if (quality >= here) continue;
      here = quality;
      element = e;
    }
  const double lowest = mesh.smallest(here);
  if (worst) {
    // Where several elements are equally bad, the one with the lowest first node counts.
    const bool mine = element >= 0 && here == lowest;
    const double node = mine ? static_cast<double>(mesh.node_id(elements[element].nodes[0])) : 1e300;
    const bool first = mesh.smallest(node) == node && mine;
    for (int d = 0; d < place_size; ++d) (*worst)[d] = mesh.smallest(first ? x[elements[element].nodes[0]][d] : 1e300);
  }
  return lowest;
}

}  // namespace mudline
