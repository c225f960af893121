#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ale/layer_remap.hpp"
#include "ale/nodal_remap.hpp"

namespace mudline {

/// Transfer of the state of axisymmetric soil to a mesh in space, around the z axis. Points get the recovered fields of
/// the section at their radius and height, turned into their direction; nodes get its scalar fields. Regions of the
/// same name correspond, and both soils have the same materials in the same order.
class AxialTransfer {
 public:
  /// The soil of one of the two models, in a state.
  struct Side {
    const Soil& soil;
    const State& state;
  };
  /// How the new mesh fits the old one, over all ranks.
  struct Fit {
    double points = 0, outside = 0;  // numbers of quadrature points of the new mesh, and of those outside the old soil
    double in_sides = 0;             // [-] the largest distance of these from the old soil, in sides of the cell there
    Point where{};                   // [m] the place of that point
    double turn = 0;                 // [-] the new volume over the old one, of the whole circumference
    double grains = 0;               // [-] by which the new grains exceed that share of the old ones, over it
    bool restored = false;           // the dry density was scaled, and they do not
  };
  static constexpr double most_sides = 1;  // a point farther outside is refused

  /// InputError, on every rank alike, where a region has no counterpart or reaches beyond it. Collective.
  AxialTransfer(const Side& from, const Side& to);
  AxialTransfer(const AxialTransfer&) = delete;
  AxialTransfer& operator=(const AxialTransfer&) = delete;

  /// Sets the soil's arrays at points in the committed state of the new model. Where its volume is a half, a quarter or
  /// another whole part of the old one, to a thousandth, one factor on the dry density keeps the grains. InputError
  /// where the state of a law cannot be turned. Collective.
  void transfer_points(const StateStore& old_store, StateStore& store);
  /// Values of a scalar field, by overlap dof of the new space, from those of a field of the old one. Collective.
  void transfer_field(int old_field, const ConstNodalView& old, int field, const NodalView& now) const;

  const Fit& fit() const { return fit_; }

 private:
  /// A place in one of the old blocks.
  struct Found {
    MeshPlace place;
    int block = 0;           // index in the old soil
    double outside = 1e300;  // [-] distance from the cell, in its sides
  };
  std::vector<int> counterparts(const SoilBlock& block) const;
  /// Finds a place in the soil that corresponds to a new block; `guess`: that of the place before, changed.
  Found find(int block, const Point& in_space, Found& guess) const;
  void check_laws() const;
  /// Finds the places of all points.
  void find_points();
  void measure_fit();
  /// All point data of an old block at the points of a new one, by their indices, by row of its ghosted mesh.
  std::vector<double> fields_at(int old, std::size_t k, const SoilTable& table, const StateStore& old_store) const;
  /// Points that stand where old ones do take the values of these, which are in balance.
  void take_same_points(const PointTransfer& transfer, const std::vector<Found>& found) const;
  /// Writes a row of such fields to a point of the new model.
  void write_point(const SoilBlock& old_block, const SoilBlock& block, const Point& place, const double* values,
                   const SoilTable& table, int row, State& to) const;
  void keep_grains(State& to);

  Side from_, to_;
  const GhostedMesh old_mesh_, mesh_;
  const Positions x_old_, x_;
  const PointLocator locator_;
  std::vector<std::vector<int>> counterparts_;  // (new block) old blocks of its region
  std::vector<std::vector<Found>> found_;       // (new block, row) of this rank's points
  std::unique_ptr<const NodalRemap> nodal_;
  Fit fit_;
};

}  // namespace mudline
