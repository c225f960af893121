#include "contact/slave_points.hpp"

namespace mudline {

SlavePoints::SlavePoints(const Mesh& mesh, const std::string& side_set, SideRule::At kind, int quadrature_degree)
    : ContactSurface(mesh, side_set),
      places_(std::make_shared<SurfacePoints>(mesh, side_set, kind, quadrature_degree)) {
  for (CellShape shape : shapes()) rules_.emplace(shape, ContactRule(kind, shape, quadrature_degree));
  first_row_.assign(1, 0);
  for (const SurfaceSide& side : sides()) first_row_.push_back(first_row_.back() + rule(side).points);
}

std::vector<double> SlavePoints::nodal_mean(const std::function<double(int row)>& quantity,
                                            const std::function<double(int row)>& share) const {
  std::vector<double> weighted(mesh().num_nodes(), 0.0), weights(weighted);
  for (std::size_t s = 0; s < sides().size(); ++s) {
    const SurfaceSide& side = sides()[s];
    for (int a = 0; a < side.count; ++a)
      for (int row = first_row(s); row < end_row(s); ++row) {
        const double near = share(row) * nearness(rule(side), row - first_row(s), a);
        weighted[side.node[a]] += near * quantity(row);
        weights[side.node[a]] += near;
      }
  }
  return mean(std::move(weighted), std::move(weights));
}

}  // namespace mudline
