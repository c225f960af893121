#include "contact/body/point_rows.hpp"

#include "contact/contact_surface.hpp"

namespace mudline {

namespace {

using Columns = std::vector<StateVariable>;

void add_components(Columns& to, const std::string& name, int components, const std::string& unit) {
  const char* axes[] = {" x", " y", " z"};
  for (int i = 0; i < components; ++i) to.push_back({components == 1 ? name : name + axes[i], 1, unit});
}

}  // namespace

void PointRows::declare_state(StateStore& store, const std::string& prefix, const std::vector<long long>& ids, int axes,
                              bool friction, bool multipliers) {
  axes_ = axes;
  shears_ = axes == 2 ? 1 : 3;
  area_ = 3 + axes;
  Columns points = {{"gap", 1, "m"}, {"pressure", 1, "Pa"}, {"active", 1, "-"}};
  add_components(points, "force", axes_, "N");
  points.insert(points.end(), {{"area", 1, "m2"}, {"height", 1, "m"}});
  add_components(points, "moment", shears_, "N m");
  points_ = declare_rows(store, prefix + "points", points, ids);
  if (multipliers) {
    Columns columns = {{"normal", 1, "Pa"}};
    add_components(columns, "shear", shears_, "Pa");
    multipliers_ = declare_rows(store, prefix + "multipliers", columns, ids);
  }
  if (!friction) return;
  Columns columns;
  add_components(columns, "shear", shears_, "Pa");
  columns.insert(columns.end(), {{"slip", 1, "m"}, {"dissipated", 1, "J"}, {"slides", 1, "-"}});
  add_components(columns, "force", axes_, "N");
  frictions_ = declare_rows(store, prefix + "friction", columns, ids);
}

Point PointRows::vector(const PointView& rows, int row, int first, int components) {
  Point result{};
  for (int i = 0; i < components; ++i) result[i] = rows(row, first + i);
  return result;
}

PointRows::Writer PointRows::writer(const State& trial) const {
  return {trial.arrays[points_], frictions_ < 0 ? PointView() : trial.arrays[frictions_], axes_, shears_, area_};
}

void PointRows::copy(const State& from, const State& to) const {
  Kokkos::deep_copy(to.arrays[points_], from.arrays[points_]);
  if (frictions_ >= 0) Kokkos::deep_copy(to.arrays[frictions_], from.arrays[frictions_]);
}

PointForce PointRows::total(const State& state, int row) const {
  const PointView& rows = state.arrays[points_];
  const Point moment = vector(rows, row, area_ + 2, shears_);
  return {vector(rows, row, 3, axes_), axes_ == 2 ? Point{0, 0, moment[0]} : moment};
}

ShearState PointRows::shear(const State& state, int row) const {
  if (frictions_ < 0) return {};
  const PointView& rows = state.arrays[frictions_];
  return {vector(rows, row, 0, shears_), rows(row, shears_), rows(row, shears_ + 1), rows(row, shears_ + 2) > 0};
}

bool PointRows::sticks(const State& state, int row) const {
  return frictions_ >= 0 && active(state, row) && state.arrays[frictions_](row, shears_ + 2) == 0;
}

Point PointRows::friction(const State& state, int row) const {
  return frictions_ < 0 ? Point{} : vector(state.arrays[frictions_], row, shears_ + 3, axes_);
}

void PointRows::set_shear_multiplier(const State& state, int row, const Point& stress) const {
  Writer::put(state.arrays[multipliers_], row, 1, shears_, stress);
}

}  // namespace mudline
