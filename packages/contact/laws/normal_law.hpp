#pragma once

#include "contact/laws/pointwise_law.hpp"
#include "contact/laws/touching_soil.hpp"
#include "core/registry.hpp"

namespace mudline {

/// What presses at a point that lies in the body.
struct NormalPressure {
  double value;           // [Pa]
  double slope;           // [Pa/m] d value / d penetration
  double pore_slope = 0;  // [-] d value / d pore pressure of the soil
};

/// What a normal law is asked at many points at once.
struct NormalPoint {
  double penetration = 0, stiffness = 0;  // [m], [Pa/m]
  TouchingSoil soil;
};

/// Pressure over penetration: type of a contact's "normal law". Pure.
class NormalLaw {
 public:
  virtual ~NormalLaw() = default;
  /// At a penetration [m], 0 or more, for a contact of this stiffness [Pa/m], its penalty.
  virtual NormalPressure at(double penetration, double stiffness, const TouchingSoil& soil) const = 0;
  /// The same at many points: on the host, one after the other, unless the law says otherwise.
  virtual void pressures(const LawList<NormalPoint, NormalPressure>& list) const {
    ask_on_host([this](const NormalPoint& p) { return at(p.penetration, p.stiffness, p.soil); }, list);
  }
  /// What it reads of the soil; what it does not ask for may be no number.
  virtual SoilQuantities reads() const { return {}; }
  /// Whether it is stiffness times penetration, on which multipliers, active sets and the shares of impacts stand.
  virtual bool linear() const { return false; }
};

/// stiffness x penetration.
struct LinearPressure {
  KOKKOS_FUNCTION NormalPressure operator()(const NormalPoint& at) const {
    return {at.stiffness * at.penetration, at.stiffness};
  }
};
class LinearNormalLaw : public NormalLaw {
 public:
  void parameters(Parameters&) {}
  NormalPressure at(double penetration, double stiffness, const TouchingSoil& soil) const override {
    return LinearPressure{}({penetration, stiffness, soil});
  }
  void pressures(const LawList<NormalPoint, NormalPressure>& list) const override {
    ask_in_kernel(LinearPressure{}, list);
  }
  bool linear() const override { return true; }
};

inline const LinearNormalLaw linear_normal_law{};

/// The slope grows from 0 to the stiffness over a small depth: contact opens and closes without a kink, at which
/// Newton's method goes back and forth. Deeper it is the linear law, half that depth further in.
struct SmoothedPressure {
  double depth = 0;  // [m]
  KOKKOS_FUNCTION NormalPressure operator()(const NormalPoint& at) const {
    if (at.penetration >= depth) return {at.stiffness * (at.penetration - 0.5 * depth), at.stiffness};
    return {0.5 * at.stiffness * at.penetration * at.penetration / depth, at.stiffness * at.penetration / depth};
  }
};
class SmoothedNormalLaw : public NormalLaw {
 public:
  void parameters(Parameters& p);
  NormalPressure at(double penetration, double stiffness, const TouchingSoil& soil) const override {
    return law_({penetration, stiffness, soil});
  }
  void pressures(const LawList<NormalPoint, NormalPressure>& list) const override { ask_in_kernel(law_, list); }

 private:
  SmoothedPressure law_;
};

/// Penetration [m] at which the law gives a pressure [Pa], 0 or more, that it grows to; infinite where it does not
/// reach it.
double penetration_under(const NormalLaw& law, double pressure, double stiffness, const TouchingSoil& soil);

/// "linear", "smoothed"; a plain list.
void register_normal_laws(Registry<NormalLaw>& registry);

}  // namespace mudline
