#include "materials/conformance/sampler.hpp"

#include <cmath>

namespace mudline {

Sampler::Sampler(const Skeleton& law, unsigned seed, bool in_plane)
    : law_(law), in_plane_(in_plane), engine_(seed), state_(law.state_size()) {}

InitialPoint Sampler::draw(double deviator) {
  InitialPoint r;
  const double p = std::pow(10.0, uniform(3.0, 6.0)), size = deviator * uniform(0.0, 0.5) * p;
  for (int c = 0; c < 6; ++c) r.stress[c] = size * uniform(-1.0, 1.0) - (c < 3 ? p : 0.0);
  if (in_plane_) r.stress[3] = r.stress[4] = 0.0;
  r.position = {0.0, 0.0, 0.0};
  r.void_ratio = uniform(0.4, 2.5);
  r.overconsolidation_ratio = uniform(0.0, 1.0) < 0.4 ? 1.0 : uniform(1.0, 6.0);
  return r;
}

InitialPoint Sampler::point() {
  for (;;) {
    InitialPoint r;
    for (double deviator = 1.0; deviator > 1e-3; deviator *= 0.5)
      for (int n = 0; n < 20; ++n) {  // a law may want the void ratio in a narrow range
        r = draw(deviator);
        refusal_ = law_.initialise(r, state_.data());
        if (refusal_.empty()) return r;
      }
    if (++refused_ > 100) return r;  // the caller looks at refused()
  }
}

Six Sampler::increment(double smallest, double largest) {
  const double size = smallest * std::pow(largest / smallest, uniform(0.0, 1.0));
  Six r;
  for (double& c : r) c = size * uniform(-1.0, 1.0);
  if (in_plane_) r[3] = r[4] = 0.0;
  return r;
}

std::array<double, 9> Sampler::rotation() {
  double q[4], norm = 0.0;
  for (double& x : q) {
    x = std::normal_distribution<double>()(engine_);
    norm += x * x;
  }
  if (in_plane_) norm = q[0] * q[0] + q[3] * q[3];
  for (double& x : q) x /= std::sqrt(norm);
  const double w = q[0], x = in_plane_ ? 0.0 : q[1], y = in_plane_ ? 0.0 : q[2], z = q[3];
  return {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
          2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
          2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
}

}  // namespace mudline
