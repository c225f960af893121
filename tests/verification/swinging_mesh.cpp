// Plugin: the mesh motion "swinging" is `elastic` with a swing of every vertex inside about its place. It has no use
// but to show what the remap does to a solution, which must not notice.
#include "simulation/plugin.hpp"

#include <algorithm>
#include <cmath>

#include "ale/interior_motion.hpp"
#include "core/pi.hpp"
#include "tensor/vec.hpp"

using namespace mudline;

namespace {

class SwingingMotion : public ElasticMotion {
 public:
  void parameters(Parameters& p) {
    ElasticMotion::parameters(p);
    p.add("amplitude", amplitude_, "-", closed(0, 0.25),
          "of the swing, as a share of the smallest side at the vertex in the source's mesh");
    p.required("period", period_, "s", positive(), "of the swing");
  }

  void move(const InteriorMesh& mesh, Positions& x) const override {
    ElasticMotion::move(mesh, x);
    const double turn = 2 * pi;
    for (int node : mesh.mesh.owned_nodes()) {
      if (!mesh.movable[node]) continue;
      double side = 1e300;
      for (int t : mesh.corners.at_node[node])
        for (int k : mesh.corners.simplices[t])
          if (k != node) side = std::min(side, distance(mesh.source[k], mesh.source[node]));
      const double id = static_cast<double>(mesh.mesh.node_id(node));
      const double swing = amplitude_ * side * std::sin(turn * mesh.time / period_), direction = 2.4 * id;
      const double up = mesh.corners.dimension() == 2 ? 0.0 : std::sin(1.1 * id), across = std::sqrt(1 - up * up);
      x[node][0] += swing * across * std::cos(direction);
      x[node][1] += swing * across * std::sin(direction);
      x[node][2] += swing * up;
    }
    mesh.mesh.fill(x);
  }

 private:
  double amplitude_ = 0.1, period_ = 1;
};

}  // namespace

MUDLINE_PLUGIN(registries) {
  registries.interior_motions.add<SwingingMotion>("swinging", "elastic, and a swing of every vertex inside");
}
