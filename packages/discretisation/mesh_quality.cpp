#include "discretisation/mesh_quality.hpp"

#include <Teuchos_CommHelpers.hpp>

#include "discretisation/element_map.hpp"

namespace mudline {

MeshQuality mesh_quality(const Mesh& mesh, const Kokkos::View<const double**, Kokkos::LayoutRight>& x) {
  MeshQuality result;
  result.lowest = 1e300;
  long long local[2] = {0, 0}, total[2];
  for (const ElementBlock& block : mesh.blocks())
    for (int e = 0; e < block.num_elements; ++e) {
      const ElementMap map(block.shape, [&](int a) { return &x(block.nodes(e, a), 0); });
      const double quality = map.scaled_jacobian();
      local[0] += quality < MeshQuality::doubtful;
      local[1] += quality <= 0;
      if (quality >= result.lowest) continue;
      result.lowest = quality;
      result.place = map.mean_of_corners();
    }
  const auto& comm = *mesh.comm();
  const double own = result.lowest;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, 1, &own, &result.lowest);
  const int candidate = own == result.lowest ? comm.getRank() : comm.getSize() - 1;
  int worst = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, 1, &candidate, &worst);
  Teuchos::broadcast(comm, worst, 3, result.place.data());
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 2, local, total);
  result.poor = total[0];
  result.folded = total[1];
  return result;
}

}  // namespace mudline
