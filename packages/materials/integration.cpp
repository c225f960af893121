#include "materials/integration.hpp"

namespace mudline {

void IntegrationOptions::parameters(Parameters& p, const std::string& yield_scale) {
  p.choice("integration", method,
           {{"modified euler", Method::modified_euler},
            {"runge-kutta-dormand-prince", Method::dormand_prince},
            {"implicit", Method::implicit}},
           "Explicit substeps of order 2 or 5 with error control, or one backward Euler return, subdivided only where "
           "its iteration fails");
  p.add("stress tolerance", stress_tolerance, "-", open(0.0, 0.1),
        "Relative error allowed in one explicit substep; not for implicit integration");
  p.add("yield tolerance", yield_tolerance, "-", open(0.0, 1e-3),
        "Distance from the yield surface, relative to " + yield_scale + ", that counts as on it");
  p.add("maximum substeps", maximum_substeps, "-", closed(1, 1e6),
        "More substeps than this in one increment make the point fail, and the step is cut");
}

void IntegrationOptions::check(const Section& section) const {
  if (method == Method::implicit && section.has_parameter("stress tolerance"))
    section.fail(
        "'integration' = implicit has no error control; remove the stress tolerance or choose an explicit method",
        "stress tolerance");
}

}  // namespace mudline
