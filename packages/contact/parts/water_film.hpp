#pragma once

#include <string>
#include <vector>

#include "contact/parts/film_law.hpp"
#include "core/function.hpp"
#include "core/parameters.hpp"
#include "framework/state.hpp"
#include "framework/term.hpp"

namespace mudline {

/// Water film between the slave and what it touches: the deck entries, the sides that have a film, and the state array
/// "<prefix>film" with a row per point: vapour [m] of its thickness, volumes of water and vapour [m3], and the force of
/// its pressure on the soil [N].
class WaterFilm {
 public:
  void parameters(Parameters& p);
  /// InputError where the deck has entries of a film and there is none.
  static void refuse(const Section& section);
  void declare_state(StateStore& store, const std::string& prefix, std::shared_ptr<const SurfacePoints> at, int axes);

  /// Sets which sides have a film in the coming step: flags by side.
  void cover(std::vector<char> flags) { covered_ = std::move(flags); }
  /// Film of a side in a step. `weight`: of the pore water behind the side [N/m3].
  SideFilm of_side(const StepView& view, std::size_t side, const Point& weight) const;
  /// Adds the film's data to those of a point; `place`: of the point at the start of the step [m].
  void start(const StepView& view, int row, const Point& place, PointHistory& point) const;
  /// Writes a point of a contact with a film.
  void write(const State& trial, int row, const ContactPoint& point) const;

  /// Water and vapour [m3], force on the soil [N]: this rank's sums.
  struct Sums {
    double water = 0, vapour = 0;
    Point force{};
  };
  Sums sums(const State& state) const;

 private:
  double viscosity_ = 1e-3, aperture_ = 1e-6;
  Function cavitation_ = Function(-100e3);
  std::vector<char> covered_;
  int rows_ = -1, axes_ = 2;
};

}  // namespace mudline
