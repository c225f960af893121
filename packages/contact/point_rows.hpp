#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contact/point_data.hpp"
#include "framework/state.hpp"

namespace mudline {

/// State of the points of a contact, a row per point, in up to three arrays: "<prefix>points" (gap, pressure, active,
/// force on the slave, area, and what the kind of target adds), with friction "<prefix>friction" (shear stress, path
/// slid, heat, sliding, force of friction), and with multipliers "<prefix>multipliers" (those of normal and shear
/// stress with which the other arrays were evaluated). Forces have as many components as the model has axes; a shear
/// stress has one in the plane and three in space.
class PointRows {
 public:
  /// `more`: further columns of the points, which a target needs.
  void declare_state(StateStore& store, const std::string& prefix, const std::shared_ptr<const SurfacePoints>& at,
                     int axes, const std::vector<StateVariable>& more, bool friction, bool multipliers);

  // Columns of the arrays of points and of friction, with so many axes, and components of a shear stress.
  static constexpr int pressure_column = 1;
  static constexpr int area_column(int axes) { return 3 + axes; }
  static constexpr int slip_column(int shears) { return shears; }
  static constexpr int force_column(int shears) { return shears + 3; }

  void write(const State& trial, int row, const ContactPoint& point) const;

  double gap(const State& state, int row) const { return state.arrays[points_](row, 0); }
  double pressure(const State& state, int row) const { return state.arrays[points_](row, pressure_column); }
  bool active(const State& state, int row) const { return state.arrays[points_](row, 2) > 0; }
  Point force(const State& state, int row) const { return vector(state.arrays[points_], row, 3, axes_); }
  double area(const State& state, int row) const { return state.arrays[points_](row, area_column(axes_)); }
  /// Further columns of a row, in the order in which they were declared.
  double* more(const State& state, int row) const { return &state.arrays[points_](row, more_); }

  /// Friction history of a point; all 0 without friction.
  ShearState shear(const State& state, int row) const;
  bool sticks(const State& state, int row) const;
  Point friction(const State& state, int row) const;

  double& normal_multiplier(const State& state, int row) const { return state.arrays[multipliers_](row, 0); }
  Point shear_multiplier(const State& state, int row) const {
    return vector(state.arrays[multipliers_], row, 1, shears_);
  }
  void set_shear_multiplier(const State& state, int row, const Point& stress) const {
    put(state.arrays[multipliers_], row, 1, shears_, stress);
  }

  /// Handle of the array of the points.
  int points() const { return points_; }
  /// Components of a shear stress, the first columns of the array of friction.
  int shears() const { return shears_; }

 private:
  static Point vector(const PointView& rows, int row, int first, int components);
  static void put(const PointView& rows, int row, int first, int components, const Point& values);
  int axes_ = 2, shears_ = 1, more_ = 6;
  int points_ = -1, frictions_ = -1, multipliers_ = -1;
};

}  // namespace mudline
