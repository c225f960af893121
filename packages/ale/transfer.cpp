// Remeshing of the region: when it is due, and the transfer of the soil's state from the old mesh.
#include <algorithm>
#include <cmath>
#include <limits>

#include "ale/ale.hpp"
#include "ale/conservation.hpp"
#include "ale/quality.hpp"
#include "core/child_process.hpp"
#include "discretisation/agree.hpp"
#include "discretisation/triangulation.hpp"

namespace mudline {

bool Ale::remeshing_due(int step, int tried, const State& committed) const {
  if (!remesher_ || step - std::max(remeshed_after_, tried) < remesher_->deck().least_steps) return false;
  if (quality(committed) < remesher_->deck().quality_below) return true;
  return remesher_->largest_side(mesh_.gather(committed.coordinates), committed) > remesher_->deck().side_above;
}

bool Ale::looks_at_error(int step, int tried) const {
  const int since = step - std::max(remeshed_after_, tried);
  return remesher_ && remesher_->adaptive() && since > 0 && since % remesher_->deck().least_steps == 0;
}

std::unique_ptr<const WantedSizes> Ale::wanted_sizes(const std::vector<double>& by_element,
                                                     const State& committed) const {
  const RemeshingParameters& deck = remesher_->deck();
  const bool first = mesh_.mesh().comm()->getRank() == 0;
  GhostedMesh::Wanted near{committed.coordinates, {}};
  if (first) near.boxes.push_back({{-1e300, -1e300, -1e300}, {1e300, 1e300, 1e300}});
  auto mesh = std::make_shared<const GhostedMesh>(mesh_.mesh(), 1, &near);
  std::vector<double> all(mesh->elements().size(), deck.largest_size);
  std::size_t at = 0;
  for (const SoilBlock& b : soil_.blocks) {
    const PointView rows("wanted sizes", b.elements, 1);
    for (int e = 0; e < b.elements; ++e) rows(e, 0) = by_element[at + e];
    at += b.elements;
    const std::vector<double> block = mesh->gather_points(b.block, 1, rows);
    for (int e : mesh->block_elements(b.block)) all[e] = block[mesh->first_row(e, 1)];
  }
  const Positions x = mesh->gather(committed.coordinates);
  if (!first) return nullptr;
  return std::make_unique<const WantedSizes>(std::move(mesh), x, all,
                                             WantedSizes::Bounds{deck.smallest_size, deck.largest_size, deck.growth});
}

bool Ale::too_coarse(const WantedSizes* sizes) const {
  return mesh_.any(sizes != nullptr && sizes->largest_ratio() > remesher_->deck().side_above);
}

Remeshing Ale::remesh(int step, const State& committed, const WantedSizes* sizes) const {
  const Teuchos::Comm<int>& comm = *mesh_.mesh().comm();
  const Positions x = mesh_.gather(committed.coordinates);
  // Where the present mesh is poor, the new one must be better.
  const double quality = lowest_quality(mesh_, x);
  RemeshedMesh made;
  Remeshing result;
  if (comm.getRank() == 0) {
    try {
      const double least = quality < remesher_->deck().quality_below ? quality : 0.0;
      made = remesher_->make(x, committed, std::max(least, deck_.lowest_quality), sizes);
      made.number = remeshings_ + 1;
      made.step = step;
    } catch (const ChildLost& child) {
      result.lost = std::string("Gmsh ") + child.what() +
                    (child.timed_out ? "; 'mesh motion/remeshing/time limit' gives it more time" : "");
    } catch (const std::bad_alloc&) {
      result.lost = "there is not enough memory to mesh the region";
    } catch (const std::exception& failure) {
      result.veto = std::string("the region cannot be meshed: ") + failure.what();
    }
  }
  result.veto = broadcast(comm, result.veto);
  result.lost = broadcast(comm, result.lost);
  if (result.veto.empty() && result.lost.empty())
    result.mesh = std::make_shared<const RemeshedMesh>(broadcast(comm, std::move(made)));
  return result;
}

namespace {

/// Restores the rest of the pore water's compression `before` [m3] by adding one pressure wherever the pressure is
/// free: it is spread over the whole soil, where a factor would have to be large.
void shift_pressures(const Soil& soil, const GhostedMesh& mesh, const std::vector<double>& held, double before,
                     State& to) {
  if (soil.pressure < 0) return;
  const std::vector<double> transferred = mesh.gather(*soil.space, soil.pressure, to.value);
  const auto compression = [&](double shift) {
    std::vector<double> shifted = transferred;
    for (std::size_t node = 0; node < shifted.size(); ++node)
      if (held[node] == 0) shifted[node] += shift;
    mesh.scatter(*soil.space, soil.pressure, shifted, to.value);
    return take_inventory(soil, to).compression;
  };
  const double now = compression(0), slope = compression(1) - now;  // the compression is linear in the pressures
  compression(slope > 0 ? (before - now) / slope : 0.0);
}

}  // namespace

void Ale::keep_momentum(const Inventory& before, const Constraints& constraints, State& to) const {
  const int u = soil_.displacement, dim = mesh_.dimension();
  const std::vector<double> held = prescribed(u, constraints);
  std::vector<double> v = mesh_.gather(space_, u, to.rate);
  const auto inventory = [&](const std::vector<double>& velocity) {
    mesh_.scatter(space_, u, velocity, to.rate);
    return take_inventory(soil_, to);
  };
  const auto on_free = [&](const std::vector<double>& base, int d, double shift) {
    std::vector<double> result = base;
    for (std::size_t i = d; i < result.size(); i += dim)
      if (held[i] == 0) result[i] += shift;
    return result;
  };
  const std::vector<double> zero(v.size(), 0.0);
  double mass[place_size] = {};  // of the soil that moves with the free nodes [kg]
  for (int d = 0; d < dim; ++d) mass[d] = inventory(on_free(zero, d, 1)).momentum[d];
  std::vector<double> fixed = v;  // the prescribed velocities, 0 elsewhere
  for (std::size_t i = 0; i < v.size(); ++i)
    if (held[i] == 0) fixed[i] = 0;
  for (int round = 0; round < 2; ++round) {  // the second one removes the rounding of the first
    const Inventory now = inventory(v);
    for (int d = 0; d < dim; ++d)
      if (mass[d] > 0) v = on_free(v, d, (before.momentum[d] - now.momentum[d]) / mass[d]);
  }
  const Inventory now = inventory(v);
  if (now.kinetic <= before.kinetic) return;
  // v = mean + deviation, where the deviation has no momentum: reducing it lowers the energy and keeps the momentum.
  std::vector<double> mean = fixed;
  const Inventory at_fixed = inventory(fixed);
  for (int d = 0; d < dim; ++d)
    if (mass[d] > 0) mean = on_free(mean, d, (now.momentum[d] - at_fixed.momentum[d]) / mass[d]);
  std::vector<double> deviation = v;
  for (std::size_t i = 0; i < v.size(); ++i) deviation[i] -= mean[i];
  const double constant = inventory(mean).kinetic, square = inventory(deviation).kinetic,
               linear = now.kinetic - constant - square, excess = constant - before.kinetic;
  const double root = linear * linear - 4 * square * excess;
  double share = square > 0 ? -0.5 * linear / square : 1;  // the share with the least energy
  if (square > 0 && root >= 0) share = 0.5 * (-linear + std::sqrt(root)) / square;
  share = std::clamp(share, 0.0, 1.0);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = mean[i] + share * deviation[i];
  inventory(v);
}

void Ale::match_volume(const Ale& from, const State& before, const Constraints& constraints, State& to) const {
  if (!deck_.conserve) return;
  Positions x = mesh_.gather(to.coordinates);
  keep_volume(soil_volume(from.mesh_, from.soil_, from.mesh_.gather(before.coordinates)), to, constraints, x);
  mesh_.scatter(x, to.coordinates);
}

MeshReceipt Ale::transfer_from(const Ale& from, const StateStore& old_store, const MeshTransfer& transfer,
                               const Constraints& constraints, StateStore& store) const {
  MeshReceipt receipt;
  const State& old_state = old_store.committed();
  State& to = store.committed();
  receipt.quality_before = lowest_quality(from.mesh_, from.mesh_.gather(old_state.coordinates));
  receipt.quality = lowest_quality(mesh_, mesh_.gather(to.coordinates));
  receipt.before = take_inventory(from.soil_, old_state);
  transfer.transfer(old_store, old_state, store, to, receipt);
  if (!receipt.veto.empty()) return receipt;
  if (deck_.conserve) {
    keep_compression(receipt.before.compression, constraints, to);
    shift_pressures(soil_, mesh_, prescribed(std::max(soil_.pressure, 0), constraints), receipt.before.compression, to);
    keep_momentum(receipt.before, constraints, to);
  }
  take_stock(to, receipt);
  receipt.veto = lost_mass(receipt);
  if (receipt.veto.empty() && !(receipt.quality > 0)) receipt.veto = "the new mesh folds elements";
  receipt.moved = receipt.veto.empty();
  return receipt;
}

}  // namespace mudline
