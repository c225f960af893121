#pragma once

#include <stdexcept>

#include "contact/laws/friction.hpp"
#include "contact/laws/normal_law.hpp"

namespace mudline {

/// A strength that is linear in the state of the soil: a coefficient for each quantity, 0: not read.
class ReadingFriction : public Friction {
 public:
  void parameters(Parameters& p) {
    p.add("per normal", normal, "-", non_negative(), "test");
    p.add("per pore pressure", pore, "-", non_negative(), "test");
    p.add("per degree", degree, "Pa", non_negative(), "test");
    p.add("per mean stress", mean, "-", non_negative(), "test");
    p.add("per strength", strength_share, "-", non_negative(), "test");
    p.add("per slip", slip, "Pa/m", non_negative(), "test");
    interface_parameters(p);
  }
  SoilQuantities reads() const override { return {pore != 0, degree != 0, mean != 0, strength_share != 0}; }
  bool reads_slip() const override { return slip != 0; }
  ShearStrength strength(const FrictionPoint& at) const override {
    double value = normal * at.normal;
    if (pore != 0) value += pore * at.soil.pore_pressure;
    if (degree != 0) value += degree * at.soil.temperature;
    if (mean != 0) value += mean * at.soil.mean_stress;
    if (strength_share != 0) value += strength_share * at.soil.undrained_strength;
    if (slip != 0) value += slip * at.slip;
    return {value, normal, 0, pore};
  }
  double normal = 0, pore = 0, degree = 0, mean = 0, strength_share = 0, slip = 0;
};

/// A law that throws when it is evaluated in a step.
class ThrowingFriction : public Friction {
 public:
  void parameters(Parameters& p) { interface_parameters(p); }
  ShearStrength strength(const FrictionPoint& at) const override {
    if (at.time > 0) throw std::runtime_error("no strength");
    return {at.normal, 1};
  }
};

/// A pressure that grows with the pore pressure.
class ReadingNormalLaw : public NormalLaw {
 public:
  void parameters(Parameters& p) { p.add("per pore pressure", pore, "-", non_negative(), "test"); }
  SoilQuantities reads() const override { return {pore != 0}; }
  NormalPressure at(double penetration, double stiffness, const TouchingSoil& soil) const override {
    return {stiffness * penetration + pore * soil.pore_pressure, stiffness, pore};
  }
  double pore = 0;
};

}  // namespace mudline
