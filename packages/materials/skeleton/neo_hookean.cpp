#include "materials/skeleton/neo_hookean.hpp"

#include <cmath>
#include <sstream>

namespace mudline {

std::string NeoHookean::initialise(const InitialPoint& point, double* state) const {
  const ElasticModuli m = moduli(nullptr, 0.0, nullptr);
  const double lambda = m.bulk - 2.0 / 3.0 * m.shear;
  // Sets b - 1 from the stress at the volume ratio J; the J sought satisfies det b = J^2.
  const auto excess = [&](double j) {
    for (int i = 0; i < 6; ++i) state[i] = (j * point.stress[i] - (i < 3 ? lambda * std::log(j) : 0.0)) / m.shear;
    return sym6::determinant_excess(state) - (j * j - 1.0);
  };
  double j = 1.0;
  bool found = false;
  for (int n = 0; n < 60; ++n) {
    const double f = excess(j), h = 1e-6 * j, slope = (excess(j + h) - excess(j - h)) / (2 * h);
    double step = -f / slope;
    step = std::fmax(-0.5 * j, std::fmin(0.5 * j, step));
    found = std::abs(step) < 1e-15 * j || f == 0.0;
    if (f != 0.0) j += step;
    if (found) break;
  }
  const double rest = excess(j);
  if (std::abs(rest) < 1e-9 * j * j && state[0] > -1.0 && (1.0 + state[0]) * (1.0 + state[1]) > state[5] * state[5])
    return "";
  std::ostringstream reason;
  reason << "no deformation of this neo-Hookean solid carries the initial stress, mean "
         << sym6::mean_pressure(point.stress.data()) << " Pa (compression positive), with a Young's modulus of "
         << young << " Pa";
  return reason.str();
}

template class PointwiseSkeleton<AutomaticTangent<NeoHookean>>;

}  // namespace mudline
