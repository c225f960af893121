#include "ale/axial_transfer.hpp"

#include <algorithm>
#include <cmath>

#include "ale/axial_section.hpp"
#include "ale/conservation.hpp"
#include "ale/point_rules.hpp"
#include "algebra/over_ranks.hpp"
#include "core/text.hpp"
#include "core/told.hpp"
#include "discretisation/agree.hpp"
#include "discretisation/element_map.hpp"
#include "discretisation/mesh_topology.hpp"
#include "physics/inventory.hpp"

namespace mudline {

namespace {

const std::string& region_of(const Soil& soil, const SoilBlock& block) {
  return soil.space->mesh().blocks()[block.block].region;
}

/// How far a place lies outside its cell, in sides of it [-].
double sides_outside(CellShape shape, const double* xi) {
  return outside_cell(shape, xi) / (is_simplex(shape) ? 1 : 2);
}

}  // namespace

AxialTransfer::AxialTransfer(const Side& from, const Side& to)
    : from_(from),
      to_(to),
      old_mesh_(from.soil.space->mesh(), GhostedMesh::whole),
      mesh_(to.soil.space->mesh(), 1),
      x_old_(old_mesh_.gather(from.state.coordinates)),
      x_(mesh_.gather(to.state.coordinates)),
      locator_(old_mesh_, x_old_) {
  const Comm& comm = *to.soil.space->mesh().comm();
  agree(comm, [&] {
    for (const SoilBlock& block : to_.soil.blocks) counterparts_.push_back(counterparts(block));
    check_laws();
  });
  find_points();
  measure_fit();
  agree(comm, [&] {
    if (fit_.in_sides <= most_sides) return;
    throw InputError("the mesh reaches beyond the soil of the result at " + place_text(fit_.where, 3) +
                     ", by more than a side of the result's cells" + told(fit_.outside, "; %.0f of its ") +
                     told(fit_.points, "%.0f points do"));
  });
  std::vector<std::pair<int, MeshPlace>> places;  // of this rank's nodes
  std::vector<char> done(mesh_.num_nodes(), 0);
  for (std::size_t k = 0; k < to_.soil.blocks.size(); ++k) {
    Found guess;
    for (int e : mesh_.own_elements(to_.soil.blocks[k].block)) {
      const auto& element = mesh_.elements()[e];
      for (int a = 0; a < num_nodes(element.shape); ++a) {
        const int node = element.nodes[a];
        if (done[node] || !mesh_.owns(node)) continue;
        done[node] = 1;
        places.emplace_back(node, find(static_cast<int>(k), x_[node], guess).place);
      }
    }
  }
  nodal_ = std::make_unique<const NodalRemap>(old_mesh_, mesh_, places);
}

std::vector<int> AxialTransfer::counterparts(const SoilBlock& block) const {
  std::vector<int> result;
  std::vector<std::string> regions;
  for (std::size_t k = 0; k < from_.soil.blocks.size(); ++k) {
    const std::string& region = region_of(from_.soil, from_.soil.blocks[k]);
    if (region == region_of(to_.soil, block)) result.push_back(static_cast<int>(k));
    if (std::find(regions.begin(), regions.end(), region) == regions.end()) regions.push_back(region);
  }
  if (result.empty())
    throw InputError("the mesh has a region '" + region_of(to_.soil, block) +
                     "', the result has none of that name; its regions: " + join(regions));
  return result;
}

void AxialTransfer::check_laws() const {
  for (const auto& material : to_.soil.materials)
    for (const StateVariable& variable : material->skeleton->state_variables())
      if (variable.in_fixed_axes)
        throw InputError("the law of material '" + material->name + "' keeps '" + variable.name +
                         "' along fixed axes, which cannot be turned into space");
}

AxialTransfer::Found AxialTransfer::find(int block, const Point& in_space, Found& guess) const {
  const Point at = AxialSection::place(in_space);
  Found best;
  for (int k : counterparts_[block]) {
    const bool near = guess.place.element >= 0 && guess.block == k;
    const std::vector<int>& elements = old_mesh_.block_elements(from_.soil.blocks[k].block);
    if (elements.empty()) continue;
    const MeshPlace place = locator_.find(at, near ? guess.place.element : elements.front());
    if (place.element < 0) continue;
    const double outside = sides_outside(old_mesh_.elements()[place.element].shape, place.xi);
    if (outside < best.outside) best = {place, k, outside};
    if (outside <= 0) break;
  }
  if (best.place.element >= 0) guess = best;
  return best;
}

void AxialTransfer::find_points() {
  for (std::size_t k = 0; k < to_.soil.blocks.size(); ++k) {
    const SoilBlock& block = to_.soil.blocks[k];
    std::vector<Found>& found = found_.emplace_back();
    Found guess;
    for (int e : mesh_.own_elements(block.block))
      for (int q = 0; q < block.points; ++q)
        found.push_back(find(static_cast<int>(k), Recovery::position(mesh_.elements()[e], block, q, x_), guess));
  }
}

void AxialTransfer::measure_fit() {
  double points = 0, outside = 0, in_sides = 0;
  Point where{};
  for (std::size_t k = 0; k < to_.soil.blocks.size(); ++k) {
    const SoilBlock& block = to_.soil.blocks[k];
    for (std::size_t row = 0; row < found_[k].size(); ++row) {
      const double beyond = found_[k][row].outside;
      ++points;
      outside += beyond > 1e-6;
      if (beyond <= in_sides) continue;
      in_sides = beyond;
      const int e = mesh_.own_elements(block.block)[row / block.points];
      where = Recovery::position(mesh_.elements()[e], block, static_cast<int>(row % block.points), x_);
    }
  }
  fit_.points = mesh_.sum(points);
  fit_.outside = mesh_.sum(outside);
  fit_.in_sides = mesh_.largest(in_sides);
  const Comm& comm = *to_.soil.space->mesh().comm();
  const int first = first_rank(comm, in_sides == fit_.in_sides);
  for (int d = 0; d < 3; ++d) fit_.where[d] = mesh_.sum(comm.getRank() == first ? where[d] : 0.0);
  fit_.turn = soil_volume(mesh_, to_.soil, x_) / soil_volume(old_mesh_, from_.soil, x_old_);
}

std::vector<double> AxialTransfer::fields_at(int old_index, std::size_t k, const SoilTable& table,
                                             const StateStore& old_store) const {
  const SoilBlock &old_block = from_.soil.blocks[old_index], &block = to_.soil.blocks[k];
  const BlockPoints before{old_mesh_, old_block, x_old_}, after{mesh_, block, x_, true};
  const std::vector<double> old =
      old_mesh_.gather_points(old_block.block, old_block.points, SoilTable::rows(old_store, from_.state, old_block));
  std::vector<double> now(mesh_.block_elements(block.block).size() * block.points * table.columns, 0.0);
  const RecoveryPatches patches(old_mesh_, old_block);
  const PointTransfer transfer{before, after, patches, table.variables, table.columns, old, now};
  const RecoveryRemap remap;
  if (old_block.made_of.size() > 1) {
    const LayerChanges layers = LayerRemap(from_.soil, remap).transfer(transfer, table);
    if (const std::string problem = broadcast(*to_.soil.space->mesh().comm(), layers.problem); !problem.empty())
      throw InputError(problem);
  } else {
    remap.transfer(transfer);
  }
  PointRules(table.variables).take_nearest(transfer);
  take_same_points(transfer, found_[k]);
  return now;
}

void AxialTransfer::take_same_points(const PointTransfer& t, const std::vector<Found>& found) const {
  constexpr double same = 0.02;  // [-] distance between points at the same place, over the size of the cell
  const SoilBlock &old_block = t.before.block, &block = t.after.block;
  const std::vector<int>& own = mesh_.own_elements(block.block);
  for (int e = 0; e < block.elements; ++e)
    for (int q = 0; q < block.points; ++q) {
      const int there = found[e * block.points + q].place.element;
      if (old_mesh_.elements()[there].block != old_block.block) continue;
      const Point place = t.after.place(own[e], q);
      Bounds box = Bounds::nothing();
      enclose(box, old_mesh_.elements()[there], x_old_);
      const double near = same * std::min(box.high[0] - box.low[0], box.high[1] - box.low[1]);
      const std::size_t row = mesh_.first_row(own[e], block.points) + q,
                        first = old_mesh_.first_row(there, old_block.points);
      for (int k = 0; k < old_block.points; ++k)
        if (distance(place, t.before.place(there, k)) < near)
          std::copy_n(&t.old[(first + k) * t.columns], t.columns, &t.now[row * t.columns]);
    }
}

void AxialTransfer::transfer_points(const StateStore& old_store, StateStore& store) {
  State& to = store.committed();
  for (std::size_t k = 0; k < to_.soil.blocks.size(); ++k) {
    const SoilBlock& block = to_.soil.blocks[k];
    const std::vector<int>& own = mesh_.own_elements(block.block);
    for (int old : counterparts_[k]) {
      const SoilBlock& old_block = from_.soil.blocks[old];
      const SoilTable table = SoilTable::of(old_store, old_block);
      const std::vector<double> fields = fields_at(old, k, table, old_store);
      for (int e = 0; e < block.elements; ++e)
        for (int q = 0; q < block.points; ++q) {
          if (found_[k][e * block.points + q].block != old) continue;
          const Point place = Recovery::position(mesh_.elements()[own[e]], block, q, x_);
          const std::size_t row = mesh_.first_row(own[e], block.points) + q;
          write_point(old_block, block, place, &fields[row * table.columns], table, e * block.points + q, to);
        }
    }
  }
  keep_grains(to);
}

void AxialTransfer::write_point(const SoilBlock& old_block, const SoilBlock& block, const Point& place,
                                const double* values, const SoilTable& table, int row, State& to) const {
  const AxialSection section(place);
  section.tensor(values + table.stress, &to.arrays[block.stress](row, 0));
  std::copy_n(values + table.void_ratio, 2, &to.arrays[block.void_ratio](row, 0));
  const int material =
      old_block.origin >= 0 ? static_cast<int>(std::lround(values[table.origin])) : block.made_of.front();
  const double* from = values + table.law;
  double* law = to.arrays[block.law].data() + row * to.arrays[block.law].extent(1);
  for (const StateVariable& variable : to_.soil.materials[material]->skeleton->state_variables()) {
    if (variable.components == 6)
      section.tensor(from, law);
    else
      std::copy_n(from, variable.components, law);
    from += variable.components;
    law += variable.components;
  }
  if (block.permeability >= 0) section.tensor(values + table.permeability, &to.arrays[block.permeability](row, 0));
  if (block.conductivity >= 0)
    std::copy_n(values + table.conductivity, to.arrays[block.conductivity].extent(1),
                &to.arrays[block.conductivity](row, 0));
  if (block.origin < 0) return;
  to.arrays[block.origin](row, 0) = material;
  const Point start = section.vector({values[table.origin + 1], values[table.origin + 2], 0});
  for (int d = 0; d < 3; ++d) to.arrays[block.origin](row, 1 + d) = start[d];
}

void AxialTransfer::keep_grains(State& to) {
  const double before = take_inventory(from_.soil, from_.state).solid, now = take_inventory(to_.soil, to).solid;
  const double parts = std::round(1 / fit_.turn);
  const bool whole_part = parts >= 1 && std::abs(fit_.turn * parts - 1) < 1e-3;
  fit_.grains = now / (before * (whole_part ? 1 / parts : fit_.turn)) - 1;
  if (!whole_part) return;
  for (const SoilBlock& block : to_.soil.blocks)
    for (int row = 0; row < block.elements * block.points; ++row) {
      double& ratio = to.arrays[block.void_ratio](row, 0);
      ratio = (1 + ratio) * (1 + fit_.grains) - 1;
    }
  fit_.restored = true;
}

void AxialTransfer::transfer_field(int old_field, const ConstNodalView& old, int field, const NodalView& now) const {
  const Space &from = *from_.soil.space, &to = *to_.soil.space;
  mesh_.scatter(to, field,
                nodal_->apply(old_mesh_.gather(from, old_field, old), 1, from.field(old_field).support, true), now);
}

}  // namespace mudline
