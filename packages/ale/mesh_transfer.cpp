#include "ale/mesh_transfer.hpp"

#include <cmath>
#include <map>
#include <optional>

#include "ale/ale.hpp"
#include "ale/conservation.hpp"
#include "ale/point_rules.hpp"
#include "ale/surface_transfer.hpp"
#include "algebra/over_ranks.hpp"
#include "discretisation/agree.hpp"
#include "framework/surface_points.hpp"

namespace mudline {

namespace {

/// Boxes around this rank's own elements, a few neighbours in each.
std::vector<Bounds> boxes(const GhostedMesh& mesh, const Positions& x) {
  constexpr std::size_t together = 16;
  std::vector<Bounds> result;
  for (std::size_t block = 0; block < mesh.mesh().blocks().size(); ++block) {
    const std::vector<int>& own = mesh.own_elements(static_cast<int>(block));
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (k % together == 0) result.push_back(Bounds::nothing());
      enclose(result.back(), mesh.elements()[own[k]], x);
    }
  }
  return result;
}

/// Paths and faces of `ale` in the node numbers of `mesh`, another view of its mesh.
NodalRemap::Bounded bounded(const Ale& ale, const GhostedMesh& mesh, const Positions& x) {
  NodalRemap::Bounded result{mesh, ale.paths(), ale.surfaces().faces, x};
  const auto number = [&](int& node) { node = mesh.local_node(ale.mesh().node_id(node)); };
  for (MeshPath& path : result.paths)
    for (int& node : path.nodes) number(node);
  for (SurfaceFace& face : result.faces)
    for (int a = 0; a < num_nodes(face.shape); ++a) number(face.nodes[a]);
  return result;
}

std::unique_ptr<const GhostedMesh> near_to(const Ale& from, const State& before, const std::vector<Bounds>& boxes) {
  const GhostedMesh::Wanted near{before.coordinates, boxes};
  return std::make_unique<const GhostedMesh>(from.mesh().mesh(), from.mesh().layers(), &near);
}

}  // namespace

MeshTransfer::MeshTransfer(const Ale& ale, const Positions& before, const Positions& after)
    : old_ale_(ale),
      ale_(ale),
      to_(ale.mesh()),
      x_to_(after),
      from_(ale.mesh()),
      x_from_(before),
      nodal_(to_, ale.paths(), x_from_, x_to_, &ale.surface_motion()) {}

MeshTransfer::MeshTransfer(const Ale& from, const State& before, const Ale& to, const State& after)
    : old_ale_(from),
      ale_(to),
      to_(to.mesh()),
      x_to_(to_.gather(after.coordinates)),
      near_(near_to(from, before, boxes(to_, x_to_))),
      from_(*near_),
      x_from_(from_.gather(before.coordinates)),
      nodal_(bounded(from, from_, x_from_), {to_, to.paths(), to.surfaces().faces, x_to_}) {}

void MeshTransfer::transfer(const StateStore& old_store, const State& old, const StateStore& store, const State& now,
                            MeshReceipt& receipt) const {
  const Soil& soil = ale_.soil();
  MeshReceipt here;  // the shares of the parts of a motion add up
  for (std::size_t k = 0; k < soil.blocks.size(); ++k) transfer_block(k, old_store, old, store, now, here);
  receipt.changed += here.changed;
  receipt.started += here.started;
  if (receipt.started_where.empty()) receipt.started_where = here.started_where;
  if (receipt.veto.empty()) receipt.veto = here.veto;
  receipt.restored_solid += here.restored_solid;
  receipt.restored_grains.resize(soil.materials.size(), 0.0);
  receipt.unresolved_grains.resize(soil.materials.size(), 0.0);
  receipt.unresolved_volume += here.unresolved_volume;
  for (std::size_t k = 0; k < here.restored_grains.size(); ++k) {
    receipt.restored_grains[k] += here.restored_grains[k];
    receipt.unresolved_grains[k] += here.unresolved_grains[k];
  }
  if (!receipt.veto.empty()) return;
  for (int f = 0; f < ale_.space().num_fields(); ++f) {
    if (ale_.space().field(f).support == Support::apart) continue;
    // Beside a body the displacement jumps: the soil on its wall came from the ground surface.
    transfer_field(f, old.value, now.value, f == soil.displacement);
    transfer_field(f, old.rate, now.rate);
    transfer_field(f, old.acceleration, now.acceleration);
    if (!moved()) transfer_field(f, old.predictor, now.predictor);
  }
  transfer_node_arrays(old_store, old, store, now);
  if (!moved()) transfer_surfaces(old_store, old, store, now);
}

void MeshTransfer::transfer_field(int field, const ConstNodalView& old, const NodalView& now, bool limited) const {
  const Field& what = ale_.space().field(field);
  to_.scatter(ale_.space(), field,
              nodal_.apply(from_.gather(old_ale_.space(), field, old), what.components, what.support, limited), now);
}

void MeshTransfer::conserve_grains(const PointTransfer& transfer, const SoilTable& table, const LayerRatios& ratios,
                                   MeshReceipt& receipt) const {
  const Soil& soil = ale_.soil();
  const std::vector<Grains> grains = restore_grains(transfer, soil, table.void_ratio, table.origin, ratios);
  receipt.restored_grains.resize(soil.materials.size(), 0.0);
  receipt.unresolved_grains.resize(soil.materials.size(), 0.0);
  double worst = 0;
  for (std::size_t k = 0; k < grains.size(); ++k) {
    const int material = transfer.after.block.made_of[k];
    receipt.restored_grains[material] += soil.materials[material]->grain_density * grains[k].missing;
    receipt.unresolved_grains[material] += soil.materials[material]->grain_density * grains[k].unresolved;
    receipt.unresolved_volume += grains[k].unresolved;
    if (std::abs(grains[k].lost()) > std::abs(worst)) worst = grains[k].lost();
  }
  if (std::abs(worst) > std::abs(receipt.restored_solid)) receipt.restored_solid = worst;
}

void MeshTransfer::transfer_block(std::size_t k, const StateStore& old_store, const State& old_state,
                                  const StateStore& store, const State& to, MeshReceipt& receipt) const {
  const Soil& soil = ale_.soil();
  const SoilBlock &b_old = old_ale_.soil().blocks[k], &b = soil.blocks[k];
  const BlockPoints before{from_, b_old, x_from_}, after{to_, b, x_to_};
  std::optional<RecoveryPatches> of_old;
  if (!moved()) of_old.emplace(from_, b_old);
  const RecoveryPatches& patches = moved() ? ale_.patches(k) : *of_old;
  const Remap& remap = moved() ? ale_.remap() : recovery_;
  // all of the block's point data in one table: points are located and patches fitted once
  SoilTable columns = SoilTable::of(store, b);
  const PointRules rules(columns.variables);
  std::vector<double> old =
      before.mesh.gather_points(b_old.block, b_old.points, SoilTable::rows(old_store, old_state, b_old));
  rules.to_densities(before, soil.geometry, old, columns.variables);
  std::vector<double> now = old;
  if (!moved()) now.assign(after.mesh.block_elements(b.block).size() * b.points * columns.columns, 0.0);
  const PointTransfer transfer{before, after, patches, columns.variables, columns.columns, old, now};
  LayerRatios ratios;
  if (b.made_of.size() > 1) {
    LayerChanges layers = LayerRemap(soil, remap).transfer(transfer, columns);
    receipt.changed += static_cast<int>(to_.sum(layers.changed));
    receipt.started += static_cast<int>(to_.sum(layers.started));
    const std::string problem = broadcast(*to_.mesh().comm(), layers.problem),
                      where = broadcast(*to_.mesh().comm(), layers.where);
    if (receipt.started_where.empty()) receipt.started_where = where;
    if (receipt.veto.empty()) receipt.veto = problem;
    ratios = std::move(layers.ratios);
  } else {
    remap.transfer(transfer);
  }
  rules.take_nearest(transfer);
  rules.to_totals(transfer, soil.geometry);
  if (ale_.conserves()) {
    conserve_grains(transfer, columns, ratios, receipt);
    for (int column : rules.of(Transfer::mass))
      if (column != columns.void_ratio) restore_grains(transfer, soil, column, columns.origin);
  }
  const std::vector<int>& own = after.mesh.own_elements(b.block);
  int column = 0;
  for (int handle = 0; handle < store.num_arrays(); ++handle) {
    if (store.info(handle).block != b.block) continue;
    const PointView& rows = to.arrays[handle];
    for (std::size_t c = 0; c < rows.extent(1); ++c, ++column)
      for (int e = 0; e < b.elements; ++e)
        for (int q = 0; q < b.points; ++q)
          rows(e * b.points + q, c) =
              now[static_cast<std::size_t>(after.mesh.first_row(own[e], b.points) + q) * columns.columns + column];
  }
  if (b.origin >= 0)
    for (int row = 0; row < b.elements * b.points; ++row)  // the material's number, whose remap left rounding errors
      to.arrays[b.origin](row, 0) = std::round(to.arrays[b.origin](row, 0));
}

void MeshTransfer::transfer_node_arrays(const StateStore& old_store, const State& old_state, const StateStore& store,
                                        const State& state) const {
  for (int handle = 0; handle < store.num_arrays(); ++handle) {
    const ArrayInfo& info = store.info(handle);
    if (info.on != ArrayInfo::On::nodes) continue;
    const int old_handle = old_store.find(info.name), columns = info.columns();
    const std::vector<int>& nodes = old_store.info(old_handle).nodes;
    const PointView &old = old_state.arrays[old_handle], &now = state.arrays[handle];
    std::vector<double> values(static_cast<std::size_t>(from_.mesh().num_nodes()) * columns, 0.0),
        has(from_.mesh().num_nodes(), 0.0);
    for (std::size_t row = 0; row < nodes.size(); ++row) {
      has[nodes[row]] = 1;
      for (int c = 0; c < columns; ++c) values[static_cast<std::size_t>(nodes[row]) * columns + c] = old(row, c);
    }
    const std::vector<double> made =
        nodal_.of_rows(from_.gather_nodes(values, columns), from_.gather_nodes(has, 1), info.variables);
    for (std::size_t row = 0; row < info.nodes.size(); ++row)
      for (int c = 0; c < columns; ++c)
        now(row, c) = made[static_cast<std::size_t>(to_.number_of(info.nodes[row])) * columns + c];
  }
}

void MeshTransfer::transfer_surfaces(const StateStore& old_store, const State& old, const StateStore& store,
                                     const State& now) const {
  std::map<const SurfacePoints*, SurfaceTransfer> surfaces;  // arrays of one contact share their points
  for (int handle = 0; handle < store.num_arrays(); ++handle) {
    const ArrayInfo& info = store.info(handle);
    if (info.on != ArrayInfo::On::surface) continue;
    const int before = old_store.find(info.name);
    const SurfaceTransfer::Side old_side{*old_store.info(before).surface, old.coordinates},
        side{*info.surface, now.coordinates};
    const SurfaceTransfer& surface = surfaces.try_emplace(info.surface.get(), old_ale_, old_side, side).first->second;
    surface.transfer(info.variables, old.arrays[before], now.arrays[handle]);
  }
}

std::string MeshTransfer::copy_without_places(const StateStore& from, StateStore& to, const Comm& comm) {
  for (int handle = 0; handle < to.num_arrays(); ++handle) {
    const ArrayInfo& info = to.info(handle);
    const bool is_sum = info.on == ArrayInfo::On::sum;
    if (!is_sum && info.on != ArrayInfo::On::model) continue;
    const PointView &old = from.committed().arrays[from.find(info.name)], &now = to.committed().arrays[handle];
    if (old.extent(0) != now.extent(0) || old.extent(1) != now.extent(1)) return info.name;
    std::vector<double> values(old.data(), old.data() + old.size());
    if (is_sum) {
      values = sum_over_ranks(comm, values);
      if (comm.getRank() > 0) std::fill(values.begin(), values.end(), 0.0);
    }
    std::copy(values.begin(), values.end(), now.data());
  }
  return "";
}

void MeshTransfer::follow_surfaces(const StateStore& store, const ConstCoordinateView& x_old, const State& state) {
  for (int handle = 0; handle < store.num_arrays(); ++handle) {
    const ArrayInfo& info = store.info(handle);
    if (info.on == ArrayInfo::On::surface)
      info.surface->follow(info.variables, x_old, state.coordinates, state.arrays[handle]);
  }
}

}  // namespace mudline
