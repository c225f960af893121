#include "physics/conditions/in_situ_support.hpp"

namespace mudline {

int InSituSupport::residual(const StepView& view, const ResidualView& f) {
  held_.add(view, f);
  return 0;
}

}  // namespace mudline
