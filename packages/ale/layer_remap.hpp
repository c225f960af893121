#pragma once

#include <string>
#include <vector>

#include "ale/conservation.hpp"
#include "ale/remap.hpp"

namespace mudline {

/// The table of a block's point data on the way to the other mesh, with the columns that say what they are.
struct SoilTable {
  int columns;
  int stress, void_ratio, law, origin;   // first columns; origin: number of the material, then the place at the start
  std::vector<StateVariable> variables;  // split of the columns for the widest law
};

/// What became of the points' materials.
struct LayerChanges {
  int changed = 0;      // points of this rank that have another material than before, where the mesh moved
  int started = 0;      // points whose law starts anew, because no soil of their material was near
  std::string where;    // one of them, and its material; empty: there is none
  std::string problem;  // why a law cannot start; empty: none
  LayerRatios ratios;
  std::vector<char> was, is;  // (row of gather_points) number of the material before and after
};

/// Carries the point data of layered soil over, by a remap that serves any field. The place where the soil was at the
/// start is remapped as any field; it is smooth, and which material stands where follows from it, so that layers stay
/// sharp. All else jumps at interfaces: for each material the fields of its own points are continued beyond them, and
/// its points take what is remapped from those alone. A point that changes its material so takes over stress, void
/// ratio and law from the soil around it that has come to it; where there is none, the law starts from the stress and
/// void ratio that the point has.
class LayerRemap {
 public:
  LayerRemap(const Soil& soil, const Remap& remap) : soil_(soil), remap_(remap) {}
  /// `transfer`: of all columns, its variables those of the widest law. Of this rank's own elements. Collective.
  LayerChanges transfer(const PointTransfer& transfer, const SoilTable& table) const;

 private:
  std::vector<StateVariable> variables_of(int material, const SoilTable& table) const;
  /// Remaps the places of the start, writes them, and the materials that follow, and returns those.
  std::vector<char> transfer_origin(const PointTransfer& transfer, const SoilTable& table) const;
  /// What the points would be if all were of one material.
  struct Version {
    std::vector<double> now;         // table on the new mesh
    std::vector<double> void_ratio;  // (row) on the old one
    std::vector<char> near;          // (row) whether soil of the material was there or beside it
  };
  Version version_of(int material, const PointTransfer& transfer, const SoilTable& table,
                     const std::vector<char>& was) const;
  /// "" or why the law of a material cannot start at a row.
  std::string start(const PointTransfer& transfer, const SoilTable& table, int material, int row) const;

  const Soil& soil_;
  const Remap& remap_;
};

/// Continues the values of some rows of a block's table to the rows around them, by planes fitted to the rows at a
/// vertex: linear fields exactly. Distances are measured by the extent of the elements around the vertex, so that flat
/// elements are continued along their short side as round ones are. `known`: (row) 1 for those that have values; rows
/// that get one are given the number of the ring of elements around that they are in, from 2 on; 0 stays where there is
/// none. Collective.
void continue_rows(const PointTransfer& transfer, std::vector<double>& table, std::vector<char>& known);

}  // namespace mudline
