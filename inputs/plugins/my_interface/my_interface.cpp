// Friction that weakens with the path slid, from a peak to a residual coefficient:
//     strength = (residual + (peak - residual) exp(-slip / length)) <normal>.
#include <cmath>

#include "contact/laws/friction.hpp"
#include "simulation/plugin.hpp"

namespace {

// Trivially copyable, so that kernels can take it along, to a device too.
struct WeakeningInterface {
  double peak = 0, residual = 0, length = 1;

  void parameters(mudline::Parameters& p) {
    p.required("peak coefficient", peak, "-", mudline::non_negative(),
               "Friction coefficient of a point that has not slid");
    p.required("residual coefficient", residual, "-", mudline::non_negative(), "Friction coefficient after a long way");
    p.required("weakening length", length, "m", mudline::positive(),
               "Path over which the strength falls by a factor of e");
  }
  void check(const mudline::Section& section) const {
    if (residual > peak) section.fail("must not be above the peak coefficient", "residual coefficient");
  }
  static constexpr bool reads_slip = true;
  // Pure. `at.slip` is the path at the start of the step: within a step the coefficient is constant, the slope exact.
  KOKKOS_FUNCTION mudline::ShearStrength operator()(const mudline::FrictionPoint& at) const {
    const double coefficient = residual + (peak - residual) * std::exp(-at.slip / length);
    if (at.normal <= 0) return {0, 0};
    return {coefficient * at.normal, coefficient};
  }
};

}  // namespace

MUDLINE_PLUGIN(registries) {
  registries.frictions.add<mudline::PointwiseFriction<WeakeningInterface>>(
      "weakening interface", "Friction coefficient that falls with the path slid");
}
