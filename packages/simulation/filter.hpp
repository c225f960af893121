#pragma once

#include <array>
#include <vector>

#include "simulation/filter_settings.hpp"
#include "simulation/model.hpp"

namespace mudline {

/// A filter of a body in the plane or in axisymmetry: the mean pore pressure over that part of its surface which soil
/// touches, weighted by area, and an estimate of its error. It keeps nothing from step to step.
class Filter {
 public:
  struct Value {
    double pressure = 0, excess = 0;  // [Pa] 0 where no soil touches the filter
    double error = 0;                 // [Pa] of both, see roughen()
    double covered = 0;               // [-] share of the filter's area that soil touches
  };

  /// Precondition: the model is one of the plane and has the body.
  Filter(const Model& model, FilterSettings settings);
  /// InputError where the model cannot have such a filter; `entry` of the section: its position.
  static void check(const Model& model, const FilterSettings& settings, const Section& section,
                    const std::string& entry = "position");
  const FilterSettings& settings() const { return settings_; }
  /// Their values, in order; the wall of a body is gathered once for all of its filters. `excess`: excess pore pressure
  /// by overlap dof. Collective.
  static std::vector<Value> values(const std::vector<Filter>& filters, const State& state, const NodalView& excess);

 private:
  /// A side that touches: at its two ends, then in its middle.
  struct WallSide {
    std::array<long long, 2> ends;  // global ids of its vertices
    std::array<Point, 3> at;        // [m]
    std::array<double, 3> height;   // [m] above the body's reference point
    std::array<double, 3> pressure, excess;
    std::array<double, 2> roughness{};  // [Pa] at the vertices
    double length() const { return mudline::length(at[1] - at[0]); }
  };
  /// Integrals over the filter's part of a side.
  struct Sums {
    double area = 0, pressure = 0, excess = 0, squared_roughness = 0;
  };
  /// The sides of all ranks that touch the body, in the order of their vertices' ids. Collective.
  std::vector<WallSide> touching(const State& state, const NodalView& excess) const;
  /// Sets the roughness at the vertices of sides: how far the pressure at a vertex lies from the straight line along
  /// the wall through it and both of its neighbours (by least squares); at an end of the wall that of the neighbour.
  /// Of a side that has no neighbours nothing is known: half the difference of its pressures.
  static void roughen(std::vector<WallSide>& sides);
  void add(const WallSide& side, Sums& to) const;
  Value value(const std::vector<WallSide>& wall) const;
  /// Area [m2] of the body's contour between the heights of the filter.
  double own_area() const;

  const Model& model_;
  const FilterSettings settings_;
  const RigidBody& body_;
  double area_;  // [m2] of the whole filter
};

}  // namespace mudline
