#include "contact/parts/water_film.hpp"

#include <algorithm>

#include "framework/surface_points.hpp"

namespace mudline {

namespace {

/// [Pa] below cavitation over which all water of a film turns into vapour: half a hundredth of the atmosphere.
constexpr double softness = 500;

constexpr int vapour_column = 0;

}  // namespace

void WaterFilm::parameters(Parameters& p) {
  p.add("film viscosity", viscosity_, "Pa s", positive(), "Film: of its water");
  p.add("residual aperture", aperture_, "m", positive(),
        "Film: its thickness where the surfaces just meet, from their roughness; it vanishes where they press");
  p.add("cavitation pressure", cavitation_, "Pa",
        "Film: pore pressure below which its water turns into vapour, a function of time and place: what is missing to "
        "a vacuum, where pore pressures count from the air's");
}

void WaterFilm::refuse(const Section& section) {
  for (const char* entry : {"film viscosity", "residual aperture", "cavitation pressure"})
    if (section.has_parameter(entry)) section.fail("has a meaning only with 'drainage' = film", entry);
}

void WaterFilm::declare_state(StateStore& store, const std::string& prefix, std::shared_ptr<const SurfacePoints> at,
                              int axes) {
  axes_ = axes;
  std::vector<StateVariable> columns = {
      {"vapour", 1, "m"}, {"water volume", 1, "m3", Transfer::total}, {"vapour volume", 1, "m3", Transfer::total}};
  for (int i = 0; i < axes; ++i) columns.push_back({std::string("force ") + axis_names[i], 1, "N", Transfer::total});
  rows_ = store.declare(ArrayInfo::on_surface(prefix + "film", std::move(columns), std::move(at)).not_shown());
}

SideFilm WaterFilm::of_side(const StepView& view, std::size_t side, const Point& weight) const {
  SideFilm film;
  film.acts = covered_[side];
  film.flows = film.acts && view.flow;
  film.viscosity = viscosity_;
  film.softness = softness;
  film.aperture = aperture_;
  film.weight = weight;
  return film;
}

void WaterFilm::start(const StepView& view, int row, const Point& place, PointHistory& point) const {
  point.cavitation = cavitation_(view.time_end, place);
  point.vapour = std::max(0.0, view.committed->arrays[rows_](row, vapour_column));
}

void WaterFilm::write(const State& trial, int row, const ContactPoint& point) const {
  const PointView& rows = trial.arrays[rows_];
  rows(row, vapour_column) = point.vapour;
  rows(row, 1) = point.water;
  rows(row, 2) = point.vapour * point.area;
  for (int i = 0; i < axes_; ++i) rows(row, 3 + i) = point.film[i];
}

WaterFilm::Sums WaterFilm::sums(const State& state) const {
  const PointView& rows = state.arrays[rows_];
  Sums result;
  for (std::size_t row = 0; row < rows.extent(0); ++row) {
    result.water += rows(row, 1);
    result.vapour += rows(row, 2);
    for (int i = 0; i < axes_; ++i) result.force[i] += rows(row, 3 + i);
  }
  return result;
}

}  // namespace mudline
