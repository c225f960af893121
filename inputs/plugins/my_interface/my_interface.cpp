// Friction that weakens with the accumulated slip, from a peak to a residual coefficient:
//     strength = (residual + (peak - residual) exp(-slip / length)) <normal>.
#include <cmath>

#include "contact/laws/friction.hpp"
#include "simulation/plugin.hpp"

namespace {

class WeakeningInterface : public mudline::Friction {
 public:
  void parameters(mudline::Parameters& p) {
    p.required("peak coefficient", peak_, "-", mudline::non_negative(),
               "Friction coefficient of a point that has not slid");
    p.required("residual coefficient", residual_, "-", mudline::non_negative(),
               "Friction coefficient after a long path");
    p.required("weakening length", length_, "m", mudline::positive(),
               "Path over which the strength falls by a factor of e");
    interface_parameters(p);  // the parameters that all laws share
  }
  void check(const mudline::Section& section) const {
    if (residual_ > peak_) section.fail("must not be above the peak coefficient", "residual coefficient");
  }
  bool reads_slip() const override { return true; }
  // A pure function. `at.slip` is the accumulated slip at the start of the step: within a step the coefficient is
  // constant and the slope exact.
  mudline::ShearStrength strength(const mudline::FrictionPoint& at) const override {
    const double coefficient = residual_ + (peak_ - residual_) * std::exp(-at.slip / length_);
    if (at.normal <= 0) return {0, 0};
    return {coefficient * at.normal, coefficient};
  }

 private:
  double peak_ = 0, residual_ = 0, length_ = 1;
};

}  // namespace

MUDLINE_PLUGIN(registries) {
  registries.frictions.add<WeakeningInterface>("weakening interface",
                                               "Friction coefficient that falls with the path slid");
}
