#include "contact/contact_surface.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

namespace mudline {

namespace {

/// Area of an element over the length of a side, times 2 for a triangle: its height above the side. Corners only.
double height_above(const Mesh& mesh, const ElementBlock& block, const SurfaceSide& side) {
  const int corners = num_corners(block.shape);
  const auto& x = mesh.coordinates();
  double twice_area = 0;
  for (int i = 0; i < corners; ++i) {
    const int a = block.nodes(side.element, i), b = block.nodes(side.element, (i + 1) % corners);
    twice_area += x(a, 0) * x(b, 1) - x(b, 0) * x(a, 1);
  }
  const double length = std::hypot(x(side.node[1], 0) - x(side.node[0], 0), x(side.node[1], 1) - x(side.node[0], 1));
  return (corners == 3 ? 1.0 : 0.5) * twice_area / length;
}

double chord(const ConstCoordinateView& x, const SurfaceSide& side) {
  return std::hypot(x(side.node[1], 0) - x(side.node[0], 0), x(side.node[1], 1) - x(side.node[0], 1));
}

}  // namespace

ContactSurface::ContactSurface(const Space& space, const std::string& side_set, bool pressures,
                               const BodyUnknowns& body)
    : mesh_(space.mesh()), exchange_(mesh_), body_unknowns_(body.count) {
  int rows[2] = {0, 0};
  for (const Side& side : mesh_.side_sets().at(side_set)) {
    const ElementBlock& block = mesh_.blocks()[side.block];
    SurfaceSide here{side.block, side.element, 0, {-1, -1, -1}, 0, 0};
    for (int local : side_nodes(block.shape, side.side)) here.node[here.count++] = block.nodes(side.element, local);
    here.row = rows[here.count - 2]++;
    here.height = height_above(mesh_, block, here);
    sides_.push_back(here);
  }
  const int displacement = space.find("displacement");
  const int pressure = pressures ? space.find("pore pressure") : -1;
  for (int count = 2; count <= 3; ++count) {
    int more = 0;
    if (pressure >= 0) more = space.field(pressure).support == Support::vertices ? 2 : count;
    Kokkos::View<int**, Kokkos::LayoutRight> table("contact dofs", rows[count - 2], 2 * count + more + body.count);
    for (const SurfaceSide& side : sides_) {
      if (side.count != count) continue;
      int* to = space.write_dofs(displacement, side.node, count, &table(side.row, 0));
      to = space.write_dofs(pressure, side.node, more, to);
      std::copy_n(body.dof, body.count, to);
    }
    dofs_[count - 2] = table;
  }
  const long long local = static_cast<long long>(sides_.size());
  Teuchos::reduceAll(*mesh_.comm(), Teuchos::REDUCE_SUM, local, Teuchos::outArg(num_global_sides_));
}

std::vector<long long> ContactSurface::row_ids(const std::function<int(std::size_t side)>& rows) const {
  constexpr long long most_rows = 64;
  std::vector<long long> ids;
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    // an element has one side that begins at this node
    const long long element = mesh_.blocks()[sides_[s].block].global_ids[sides_[s].element];
    const long long side = element * mesh_.num_global_nodes() + mesh_.node_ids()[sides_[s].node[0]];
    for (int row = 0; row < rows(s); ++row) ids.push_back(side * most_rows + row);
  }
  return ids;
}

double ContactSurface::shortest(const ConstCoordinateView& x) const {
  double local = 1e300, global = 0;
  for (const SurfaceSide& side : sides_) local = std::min(local, chord(x, side));
  Teuchos::reduceAll(*mesh_.comm(), Teuchos::REDUCE_MIN, local, Teuchos::outArg(global));
  return global;
}

double ContactSurface::longest(const ConstCoordinateView& x) const {
  double local = 0, global = 0;
  for (const SurfaceSide& side : sides_) local = std::max(local, chord(x, side));
  Teuchos::reduceAll(*mesh_.comm(), Teuchos::REDUCE_MAX, local, Teuchos::outArg(global));
  return global;
}

std::vector<double> ContactSurface::mean(std::vector<double> weighted, std::vector<double> weights) const {
  exchange_.sum_shared(weighted);
  exchange_.sum_shared(weights);
  for (std::size_t node = 0; node < weighted.size(); ++node)
    weighted[node] = weights[node] > 0 ? weighted[node] / weights[node] : 0.0;
  return weighted;
}

int declare_rows(StateStore& store, const std::string& name, std::vector<StateVariable> variables,
                 std::vector<long long> ids, bool shares) {
  ArrayInfo info{name, std::move(variables)};
  const int rows = shares ? 1 : static_cast<int>(ids.size());
  info.ids = std::move(ids);
  info.shares = shares;
  return store.declare(std::move(info), rows);
}

}  // namespace mudline
