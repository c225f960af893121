#pragma once

#include "contact/parts/water_film.hpp"

namespace mudline {

/// What becomes of the slave's pore water where it touches: deck entries. A side is closed to the pore water (what
/// conditions prescribe on it is off) while more than half of its points are nearer to the target than the sealing gap
/// in the committed state: lagged by one step, so that Newton sees a fixed set. Leaky: these sides let water
/// through instead, see LeakySurface. Film: water stands between them and the target, see WaterFilm.
class Drainage {
 public:
  enum class Kind { sealed, drained, leaky, film };
  explicit Drainage(Kind usual) : kind_(usual) {}
  void parameters(Parameters& p);
  /// InputError for entries that have no meaning, also for want of a pore pressure.
  void check(const Section& section, bool pore_pressure) const;

  bool closes() const { return kind_ != Kind::drained; }
  bool seals() const { return kind_ == Kind::sealed; }
  bool leaks() const { return kind_ == Kind::leaky; }
  bool has_film() const { return kind_ == Kind::film; }
  double sealing_gap() const { return sealing_gap_; }   // [-] of the side's longest edge
  double conductance() const { return conductance_; }   // [m/(Pa s)]
  const Function& outside() const { return outside_; }  // [Pa] pore pressure beyond the target
  WaterFilm film;

 private:
  Kind kind_;
  double sealing_gap_ = 0.1, conductance_ = 0;
  Function outside_;
};

}  // namespace mudline
