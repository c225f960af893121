#pragma once

#include <functional>

#include "contact/contact_laws.hpp"
#include "contact/parts/initial_gap.hpp"
#include "contact/point_rows.hpp"
#include "contact/slave_points.hpp"
#include "contact/target.hpp"

namespace mudline {

/// The state in which a contact of points first acts: its small gaps close, and points may start pressed by the
/// stress of the soil behind them.
struct InSituContact {
  const ContactContext& context;
  const ContactLaws& laws;
  const SlavePoints& surface;
  const Target& target;
  const InitialGap& gaps;
  const PointRows& rows;
  const State& committed;
  const PointView& penalties;  // [Pa/m] (side, 0)
  bool augmented, film;        // multipliers carry the pressure; water stands between the surfaces
  /// Writes the row of a point that touches.
  using Write = std::function<void(int row, const TargetPlace& place, const ContactPoint& point)>;

  /// Closes the gaps of a side's points, sets their pressures, and counts them.
  void touch(std::size_t side, FirstTouch& found, const Write& write) const;

 private:
  /// A point of a side that may touch.
  struct Place {
    std::size_t side;
    int point;
    Point at, outward;  // [m]; direction out of the slave
  };
  void press(const Place& place, double area, const TargetPlace& there, ContactPoint& point, FirstTouch& found,
             const Write& write) const;
  /// Traction [Pa] with which a point starts, on the slave: that which its row holds from a result in the plane, or
  /// that which the slave's stress balances on the surface with this outward normal. `normal`: of the target.
  Point traction(const Place& place, const Point& outward, const Point& normal) const;
  /// Shear stress [Pa] of that traction on the target's surface.
  Point shear(const Place& place, const Point& normal) const;
  /// Penetration [m] at which a point has this pressure [Pa].
  double penetration(const Place& place, double pressure) const;
  double pore_pressure(const Place& place) const;
  int row(const Place& place) const { return surface.first_row(place.side) + place.point; }
};

}  // namespace mudline
