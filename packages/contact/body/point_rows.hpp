#pragma once

#include <string>
#include <vector>

#include "contact/body/penalty_side.hpp"
#include "framework/state.hpp"

namespace mudline {

/// State of the points of a contact with a body, a row per point, in three arrays: "<prefix>points" (gap, pressure,
/// active, force on the soil, area, height above the body's reference point, moment about its centre), with friction
/// "<prefix>friction" (shear stress, path slid, heat, sliding, force of friction), and with multipliers
/// "<prefix>multipliers" (those of normal and shear stress with which the other arrays were evaluated). Forces have as
/// many components as the model has axes; shear stress and moment have one in the plane and three in space.
class PointRows {
 public:
  void declare_state(StateStore& store, const std::string& prefix, const std::vector<long long>& ids, int axes,
                     bool friction, bool multipliers);

  /// Writes points in kernels.
  struct Writer {
    PointView points, frictions;  // the latter may be empty
    int axes, shears, area;
    KOKKOS_INLINE_FUNCTION void write(int row, const ContactPoint& point) const {
      points(row, 0) = point.gap;
      points(row, 1) = point.pressure;
      points(row, 2) = point.active;
      put(points, row, 3, axes, point.total.force);
      points(row, area) = point.area;
      points(row, area + 1) = point.height;
      const Point& moment = point.total.moment;
      put(points, row, area + 2, shears, axes == 2 ? Point{moment[2], 0, 0} : moment);
      if (frictions.data() == nullptr) return;
      put(frictions, row, 0, shears, point.shear.shear);
      frictions(row, shears) = point.shear.slip;
      frictions(row, shears + 1) = point.shear.dissipated;
      frictions(row, shears + 2) = point.shear.slides;
      put(frictions, row, shears + 3, axes, point.friction);
    }
    KOKKOS_INLINE_FUNCTION static void put(const PointView& rows, int row, int first, int components,
                                           const Point& values) {
      for (int i = 0; i < components; ++i) rows(row, first + i) = values[i];
    }
  };
  Writer writer(const State& trial) const;
  /// Copies the points from one state to another, without their multipliers.
  void copy(const State& from, const State& to) const;

  double gap(const State& state, int row) const { return state.arrays[points_](row, 0); }
  double pressure(const State& state, int row) const { return state.arrays[points_](row, 1); }
  bool active(const State& state, int row) const { return state.arrays[points_](row, 2) > 0; }
  double area(const State& state, int row) const { return state.arrays[points_](row, area_); }
  double height(const State& state, int row) const { return state.arrays[points_](row, area_ + 1); }
  PointForce total(const State& state, int row) const;

  /// Friction history of a point; all 0 without friction.
  ShearState shear(const State& state, int row) const;
  bool sticks(const State& state, int row) const;
  Point friction(const State& state, int row) const;

  double& normal_multiplier(const State& state, int row) const { return state.arrays[multipliers_](row, 0); }
  Point shear_multiplier(const State& state, int row) const {
    return vector(state.arrays[multipliers_], row, 1, shears_);
  }
  void set_shear_multiplier(const State& state, int row, const Point& stress) const;

  /// Handles of the arrays; -1: there is none.
  int points() const { return points_; }
  int frictions() const { return frictions_; }
  int multipliers() const { return multipliers_; }
  /// Components of a shear stress, the first columns of the array of friction.
  int shears() const { return shears_; }
  /// Column of the path slid.
  int slip_column() const { return shears_; }

 private:
  static Point vector(const PointView& rows, int row, int first, int components);
  int axes_ = 2, shears_ = 1, area_ = 5;
  int points_ = -1, frictions_ = -1, multipliers_ = -1;
};

}  // namespace mudline
