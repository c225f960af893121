#include "simulation/excess_pressure.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/over_ranks.hpp"
#include "integrator/overlap.hpp"

namespace mudline {

ExcessPressure::ExcessPressure(const Model& model)
    : model_(model),
      initial_("initial pore pressure", model.space().dofs()->num_overlap_dofs()),
      fluid_density_(fluid_density()) {}

NodalView ExcessPressure::values() const {
  const State& state = model_.store().committed();
  const int field = model_.space().find("pore pressure");
  NodalView excess("excess", state.value.extent(0));
  const NodalView deeper = deeper_by();
  for (int node = 0; node < model_.mesh().num_nodes(); ++node) {
    const int dof = model_.space().node_dof(field)(node);
    if (dof >= 0) excess(dof) = state.value(dof) - initial_(dof) - deeper(dof);
  }
  return excess;
}

ExcessPressure::AtPlace ExcessPressure::highest() const {
  const int field = model_.space().find("pore pressure");
  if (field < 0) return {};
  const NodalView excess = values();
  const Mesh& mesh = model_.mesh();
  const auto& dofs = model_.space().node_dof(field);
  AtPlace own;
  for (int node = 0; node < mesh.num_nodes(); ++node)
    if (const int dof = dofs(node); dof >= 0 && std::abs(excess(dof)) > std::abs(own.pressure))
      own = {excess(dof), place_of(model_.store().committed().coordinates, node)};
  const Comm& comm = *mesh.comm();
  const double largest = max_over_ranks(comm, std::abs(own.pressure));
  // the first rank tells where several have it
  if (comm.getRank() != first_rank(comm, std::abs(own.pressure) == largest)) own = {};
  const std::vector<double> sum =
      sum_over_ranks(comm, std::vector<double>{own.pressure, own.place[0], own.place[1], own.place[2]});
  return {sum[0], {sum[1], sum[2], sum[3]}};
}

void ExcessPressure::take_start() {
  if (!kept_) Kokkos::deep_copy(initial_, model_.store().committed().value);
}

void ExcessPressure::keep_reference(const NodalView& at_present_places) {
  take_reference(at_present_places);
  kept_ = true;
}

NodalView ExcessPressure::reference() const {
  const NodalView result = deeper_by();
  for (std::size_t dof = 0; dof < result.extent(0); ++dof) result(dof) += initial_(dof);
  return result;
}

void ExcessPressure::take_reference(const NodalView& at_present_places) {
  const NodalView deeper = deeper_by();
  for (std::size_t dof = 0; dof < deeper.extent(0); ++dof) initial_(dof) = at_present_places(dof) - deeper(dof);
}

NodalView ExcessPressure::fluid_density() const {
  const Soil* soil = model_.soil().get();
  const DofMap& dofs = *model_.space().dofs();
  NodalView sum("sum", dofs.num_overlap_dofs()), elements("elements", dofs.num_overlap_dofs());
  if (soil == nullptr || soil->pressure < 0) return sum;
  const auto& table = model_.space().node_dof(soil->pressure);
  for (const SoilBlock& b : soil->blocks)
    for (int e = 0; e < b.elements; ++e)
      for (int c = 0; c < num_corners(b.shape); ++c) {
        sum(table(b.nodes(e, c))) += soil->any_of(b).fluid->density();
        elements(table(b.nodes(e, c))) += 1;
      }
  const NodalView density = sum_overlap(dofs, sum), around = sum_overlap(dofs, elements);
  for (std::size_t i = 0; i < density.extent(0); ++i) density(i) /= std::max(1.0, around(i));
  return density;
}

NodalView ExcessPressure::deeper_by() const {
  const State& state = model_.store().committed();
  NodalView result("deeper by", state.value.extent(0));
  const int field = model_.space().find("pore pressure");
  if (field < 0 || !model_.soil()) return result;
  const auto gravity = model_.soil()->water_gravity(state.time);
  const auto& start = model_.mesh().coordinates();
  for (int node = 0; node < model_.mesh().num_nodes(); ++node) {
    const int dof = model_.space().node_dof(field)(node);
    if (dof < 0) continue;
    double deeper = 0;
    for (int i = 0; i < model_.mesh().dimension(); ++i)
      deeper += gravity[i] * (state.coordinates(node, i) - start(node, i));
    result(dof) = fluid_density_(dof) * deeper;
  }
  return result;
}

}  // namespace mudline
