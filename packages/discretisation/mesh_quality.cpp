#include "discretisation/mesh_quality.hpp"

#include <Teuchos_CommHelpers.hpp>

#include "algebra/over_ranks.hpp"
#include "discretisation/element_map.hpp"

namespace mudline {

MeshQuality mesh_quality(const Mesh& mesh, const Kokkos::View<const double**, Kokkos::LayoutRight>& x) {
  MeshQuality result;
  result.lowest = 1e300;
  std::vector<long long> local(2, 0);  // poor, folded
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
  result.lowest = min_over_ranks(comm, own);
  const int worst = first_rank(comm, own == result.lowest || comm.getRank() == comm.getSize() - 1);
  Teuchos::broadcast(comm, worst, 3, result.place.data());
  const std::vector<long long> total = sum_over_ranks(comm, local);
  result.poor = total[0];
  result.folded = total[1];
  return result;
}

}  // namespace mudline
