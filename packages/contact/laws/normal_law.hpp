#pragma once

#include "contact/laws/touching_soil.hpp"
#include "core/registry.hpp"

namespace mudline {

/// Normal pressure at a point that lies in the body.
struct NormalPressure {
  double value;           // [Pa]
  double slope;           // [Pa/m] d value / d penetration
  double pore_slope = 0;  // [-] d value / d pore pressure of the soil
};

/// Pressure over penetration: type of a contact's "normal law". A law is pure: several threads may call it at once.
class NormalLaw {
 public:
  virtual ~NormalLaw() = default;
  /// Pressure at a penetration [m], 0 or more; `stiffness`: the contact's penalty [Pa/m].
  virtual NormalPressure at(double penetration, double stiffness, const TouchingSoil& soil) const = 0;
  /// Quantities of the touching soil that the law reads. A quantity that it does not read may be NaN.
  virtual SoilQuantities reads() const { return {}; }
  /// Whether the pressure is stiffness times penetration, as multipliers and the shares of impacts need.
  virtual bool linear() const { return false; }
};

/// The pressure is stiffness times penetration.
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
/// Newton's method oscillates. Deeper, the law is the linear one shifted by half that depth.
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

/// Penetration [m] at which a law that grows with it gives a pressure [Pa], 0 or more; infinite where the law does not
/// reach that pressure.
double penetration_under(const NormalLaw& law, double pressure, double stiffness, const TouchingSoil& soil);

/// Registers "linear" and "smoothed".
void register_normal_laws(Registry<NormalLaw>& registry);

}  // namespace mudline
