#include "ale/quality.hpp"

namespace mudline {

double scaled_jacobian(const WholeMesh::Element& element, const Positions& x) {
  return ElementMap(element.shape, [&](int a) { return x[element.nodes[a]].data(); }).scaled_jacobian();
}

double lowest_quality(const WholeMesh& mesh, const Positions& x, int* worst) {
  double lowest = 1e300;
  const auto& elements = mesh.elements();
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const double quality = scaled_jacobian(elements[e], x);
    if (quality >= lowest) continue;
    lowest = quality;
    if (worst) *worst = static_cast<int>(e);
  }
  return lowest;
}

}  // namespace mudline
