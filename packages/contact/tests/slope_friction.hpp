#pragma once

#include "contact/laws/friction.hpp"

namespace mudline {

/// Shear strength that grows with the pressure and falls with the speed.
class Slope : public Friction {
 public:
  explicit Slope(double coefficient) : coefficient_(coefficient) {}
  ShearStrength strength(const FrictionPoint& at) const override {
    const double factor = coefficient_ * (1 - 10 * at.rate);
    return {factor * at.normal, factor, -10 * coefficient_ * at.normal};
  }

 private:
  double coefficient_;
};

}  // namespace mudline
