#include "contact/point_rows.hpp"

#include "framework/surface_points.hpp"

namespace mudline {

namespace {

using Columns = std::vector<StateVariable>;

void add_components(Columns& to, const std::string& name, int components, const std::string& unit,
                    Transfer transfer = Transfer::value) {
  for (int i = 0; i < components; ++i)
    to.push_back({components == 1 ? name : name + " " + axis_names[i], 1, unit, transfer});
}

}  // namespace

void PointRows::declare_state(StateStore& store, const std::string& prefix,
                              const std::shared_ptr<const SurfacePoints>& at, int axes,
                              const std::vector<StateVariable>& more, bool friction, bool multipliers) {
  axes_ = axes;
  shears_ = axes == 2 ? 1 : 3;
  more_ = area_column(axes) + 1;
  Columns points = {{"gap", 1, "m"}, {"pressure", 1, "Pa"}, {"active", 1, "-", Transfer::nearest}};
  add_components(points, "force", axes_, "N", Transfer::total);
  points.push_back({"area", 1, "m2", Transfer::total});
  points.insert(points.end(), more.begin(), more.end());
  points_ = store.declare(ArrayInfo::on_surface(prefix + "points", points, at).then_evaluated().not_shown());
  if (multipliers) {
    Columns columns = {{"normal", 1, "Pa", Transfer::value, 0.0}};
    add_components(columns, "shear", shears_, "Pa");
    multipliers_ = store.declare(ArrayInfo::on_surface(prefix + "multipliers", columns, at).not_shown());
  }
  if (!friction) return;
  Columns columns;
  add_components(columns, "shear", shears_, "Pa");
  columns.insert(columns.end(),
                 {{"slip", 1, "m"}, {"dissipated", 1, "J", Transfer::total}, {"slides", 1, "-", Transfer::nearest}});
  add_components(columns, "force", axes_, "N", Transfer::total);
  frictions_ = store.declare(ArrayInfo::on_surface(prefix + "friction", columns, at).then_evaluated().not_shown());
}

Point PointRows::vector(const PointView& rows, int row, int first, int components) {
  Point result{};
  for (int i = 0; i < components; ++i) result[i] = rows(row, first + i);
  return result;
}

void PointRows::put(const PointView& rows, int row, int first, int components, const Point& values) {
  for (int i = 0; i < components; ++i) rows(row, first + i) = values[i];
}

void PointRows::write(const State& trial, int row, const ContactPoint& point) const {
  const PointView& rows = trial.arrays[points_];
  rows(row, 0) = point.gap;
  rows(row, pressure_column) = point.pressure;
  rows(row, 2) = point.active;
  put(rows, row, 3, axes_, point.force);
  rows(row, area_column(axes_)) = point.area;
  if (frictions_ < 0) return;
  const PointView& frictions = trial.arrays[frictions_];
  put(frictions, row, 0, shears_, point.shear.shear);
  frictions(row, slip_column(shears_)) = point.shear.slip;
  frictions(row, shears_ + 1) = point.shear.dissipated;
  frictions(row, shears_ + 2) = point.shear.slides;
  put(frictions, row, force_column(shears_), axes_, point.friction);
}

ShearState PointRows::shear(const State& state, int row) const {
  if (frictions_ < 0) return {};
  const PointView& rows = state.arrays[frictions_];
  return {vector(rows, row, 0, shears_), rows(row, slip_column(shears_)), rows(row, shears_ + 1),
          rows(row, shears_ + 2) > 0};
}

bool PointRows::sticks(const State& state, int row) const {
  return frictions_ >= 0 && active(state, row) && state.arrays[frictions_](row, shears_ + 2) == 0;
}

Point PointRows::friction(const State& state, int row) const {
  return frictions_ < 0 ? Point{} : vector(state.arrays[frictions_], row, force_column(shears_), axes_);
}

}  // namespace mudline
