#pragma once

#include "contact/laws/touching_soil.hpp"
#include "core/registry.hpp"

namespace mudline {

/// What presses at a point that lies in the body.
struct NormalPressure {
  double value;           // [Pa]
  double slope;           // [Pa/m] d value / d penetration
  double pore_slope = 0;  // [-] d value / d pore pressure of the soil
};

/// Pressure over penetration: type of a contact's "normal law". Pure; several threads may ask it at once.
class NormalLaw {
 public:
  virtual ~NormalLaw() = default;
  /// At a penetration [m], 0 or more, for a contact of this stiffness [Pa/m], its penalty.
  virtual NormalPressure at(double penetration, double stiffness, const TouchingSoil& soil) const = 0;
  /// What it reads of the soil; what it does not ask for may be no number.
  virtual SoilQuantities reads() const { return {}; }
  /// Whether it is stiffness times penetration, on which multipliers and the shares of impacts stand.
  virtual bool linear() const { return false; }
};

/// stiffness x penetration.
class LinearNormalLaw : public NormalLaw {
 public:
  void parameters(Parameters&) {}
  NormalPressure at(double penetration, double stiffness, const TouchingSoil&) const override {
    return {stiffness * penetration, stiffness};
  }
  bool linear() const override { return true; }
};

inline const LinearNormalLaw linear_normal_law{};

/// The slope grows from 0 to the stiffness over a small depth: contact opens and closes without a kink, at which
/// Newton's method goes back and forth. Deeper it is the linear law, half that depth further in.
class SmoothedNormalLaw : public NormalLaw {
 public:
  void parameters(Parameters& p);
  NormalPressure at(double penetration, double stiffness, const TouchingSoil&) const override {
    if (penetration >= depth_) return {stiffness * (penetration - 0.5 * depth_), stiffness};
    return {0.5 * stiffness * penetration * penetration / depth_, stiffness * penetration / depth_};
  }

 private:
  double depth_ = 0;  // [m]
};

/// Penetration [m] at which the law gives a pressure [Pa], 0 or more, that it grows to; infinite where it does not
/// reach it.
double penetration_under(const NormalLaw& law, double pressure, double stiffness, const TouchingSoil& soil);

/// "linear", "smoothed"; a plain list.
void register_normal_laws(Registry<NormalLaw>& registry);

}  // namespace mudline
