#pragma once

#include <string>
#include <vector>

#include "ale/conservation.hpp"
#include "ale/remap.hpp"

namespace mudline {

/// Column layout of a block's point data during a transfer.
struct SoilTable {
  int columns = 0;
  // first columns; -1: there are none. Origin: number of the material, then the place at the start
  int stress = -1, void_ratio = -1, law = -1, origin = -1, conductivity = -1, permeability = -1;
  std::vector<StateVariable> variables = {};  // variables that the columns hold, for the widest law

  /// All point data of a block, in the order of their handles.
  static SoilTable of(const StateStore& store, const SoilBlock& block);
  /// The values of a state, by row of this rank's points.
  static PointView rows(const StateStore& store, const State& state, const SoilBlock& block);
};

/// Changes of the points' materials by a transfer.
struct LayerChanges {
  int changed = 0;      // points of this rank that have another material than before, where the mesh moved
  int started = 0;      // points whose law starts anew, because no soil of their material was near
  std::string where;    // one of them, and its material; empty: there is none
  std::string problem;  // why a law cannot start; empty: none
  LayerRatios ratios;
  std::vector<char> was, is;  // (row of gather_points) number of the material before and after
};

/// Transfers the point data of layered soil with any remap. The place where the soil was at the start is a smooth field
/// and is remapped like any other; it determines the material of a point, so that layers stay sharp. All other fields
/// jump at interfaces: for each material the fields of its own points are continued beyond the interfaces, and its new
/// points get values from these alone. A point that changes its material thus gets stress, void ratio and law from soil
/// of that material nearby; where there is none, the law starts from the stress and void ratio that the point has.
class LayerRemap {
 public:
  LayerRemap(const Soil& soil, const Remap& remap) : soil_(soil), remap_(remap) {}
  /// Transfers the points of this rank's own elements. `transfer`: all columns, its variables those of the widest law.
  /// Collective.
  LayerChanges transfer(const PointTransfer& transfer, const SoilTable& table) const;

 private:
  std::vector<StateVariable> variables_of(int material, const SoilTable& table) const;
  /// Remaps the places at the start; writes them and the materials that follow from them; returns the materials (row).
  std::vector<char> transfer_origin(const PointTransfer& transfer, const SoilTable& table) const;
  /// The block's point data if all points were of one material.
  struct Version {
    std::vector<double> now;         // table on the new mesh
    std::vector<double> void_ratio;  // (row) on the old one
    std::vector<char> near;          // (row) whether soil of the material was there or beside it
  };
  Version version_of(int material, const PointTransfer& transfer, const SoilTable& table,
                     const std::vector<char>& was) const;
  /// Starts the law of a material at a row; returns why it cannot, "" where it can.
  std::string start(const PointTransfer& transfer, const SoilTable& table, int material, int row) const;

  const Soil& soil_;
  const Remap& remap_;
};

/// Continues the values of some rows of a block's table to the rows around them, by linear functions fitted to the rows
/// at a vertex: exact for linear fields. Distances are scaled by the extent of the elements around the vertex in each
/// direction, so that flat elements are continued like equilateral ones. `known`: (row) 1 for rows that have values;
/// rows that get values are set to the number of their ring of elements, from 2 on; 0 stays where a row gets none.
/// Collective.
void continue_rows(const PointTransfer& transfer, std::vector<double>& table, std::vector<char>& known);

}  // namespace mudline
