#include "materials/small_strain.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace mudline {

void SmallStrainStiffness::parameters(Parameters& p) {
  p.required("ratio", ratio_, "-", open(1, 100),
             "G_0/G_ur: shear modulus at very small strain, after rest or a reversal, over that of the law");
  p.required("reference strain", reference_strain_, "-", open(0, 0.1),
             "gamma_0.7: shear strain of first loading at which the secant modulus is 0.722 G_0");
  p.add("curvature", curvature_, "-", closed(0.5, 1),
        "a in G/G_0 = 1/(1 + 0.385 (gamma/gamma_0.7)^a): 1 Hardin and Drnevich, 0.919 Darendeli");
  p.add("bricks", bricks_, "-", closed(4, most),
        "how finely the curve is followed; each adds six numbers to the state of a point");
  acts_ = !p.documenting();
  if (acts_ && !p.varies("ratio") && !p.varies("reference strain") && !p.varies("curvature")) prepare();
}

/// The corners are those of a polygon whose secant modulus is within 1 +- d of the curve. With x = 0.385
/// (gamma/gamma_0.7)^a = tan^2(t) equal steps of t give sides of equal error, d = step^2/2 for a = 1. The first side
/// has the slope G_0, so that its end lies at x = d.
void SmallStrainStiffness::prepare() {
  const double a = curvature_;
  const double end = ratio_ * (1.0 - a) / 2.0;  // x where the tangent is G_ur: (1 + x)^2 = ratio (1 + (1 - a) x)
  const double last = end - 1.0 + std::sqrt(end * end - 2.0 * end + ratio_);
  const double whole = std::atan(std::sqrt(last));
  double error = 0.0, step = 0.0;
  for (int n = 0; n < 50; ++n) {
    const double before = error;
    step = (whole - std::atan(std::sqrt(error))) / (bricks_ - 1);
    error = 0.5 * step * step;
    if (error == before) break;
  }
  double x[most], height[most], slope = ratio_;
  for (int i = 0; i < bricks_; ++i) {
    const double tangent = std::tan(whole - (bricks_ - 1 - i) * step);
    x[i] = tangent * tangent;
    length_[i] = reference_strain_ * std::pow(x[i] / 0.385, 1.0 / a);
    height[i] = ratio_ * length_[i] * (1.0 + error) / (1.0 + x[i]);
  }
  for (int i = 0; i < bricks_; ++i) {
    const double next = i + 1 < bricks_ ? (height[i + 1] - height[i]) / (length_[i + 1] - length_[i]) : 1.0;
    weight_[i] = slope - next;
    slope = next;
  }
}

std::vector<StateVariable> SmallStrainStiffness::state() const {
  std::vector<StateVariable> all;
  for (int i = 1; i <= bricks_; ++i) {
    all.push_back({"small-strain string " + std::to_string(i), 6, "-"});
    all.back().hidden = true;
  }
  all.push_back({"shear stiffness ratio", 1, "-", Transfer::value, 1.0, 100.0});
  return all;
}

void SmallStrainStiffness::start(double* state) const {
  std::fill_n(state, 6 * bricks_, 0.0);
  state[6 * bricks_] = ratio_;
}

}  // namespace mudline
