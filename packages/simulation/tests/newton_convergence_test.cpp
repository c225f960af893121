// Newton's method converges quadratically where the tangent is consistent: elastic soil at finite strain.
#include <gtest/gtest.h>

#include <algorithm>

#include "block_fixture.hpp"

namespace mudline {
namespace {

using namespace mudline::testing;

constexpr double tolerance = 1e-13;

/// Relative residuals of all iterations, the worst field of each.
std::vector<double> history(const std::string& cell, const std::string& geometry) {
  const std::string conditions =
      list("base", text("type", "fixed") + text("set", "bottom")) +
      list("drain", text("type", "pore pressure") + text("set", "top")) +
      list("follow", text("type", "pressure") + text("set", "right") + number("value", 4e5)) +
      list("shear", text("type", "traction") + text("set", "top") + number("x", 5e5) + number("y", -8e5));
  Block block(cell, geometry, elastic_skeleton(), conditions);
  Vector x = block.model().system().begin(block.request(1.0), {tolerance, 1e-12, 1e-13});
  NewtonOptions options;
  options.maximum_iterations = 12;
  const NewtonReport report = newton_solve(block.model().system(), options, x);
  std::vector<double> worst;
  for (const auto& fields : report.history)
    worst.push_back(tolerance * *std::max_element(fields.begin(), fields.end()));
  return worst;
}

TEST(Newton, ConvergesQuadratically) {
  for (const char* cell : {"tri6", "quad9"})
    for (const char* geometry : {"plane strain", "axisymmetric"}) {
      SCOPED_TRACE(std::string(cell) + ", " + geometry);
      const std::vector<double> r = history(cell, geometry);
      int squared = 0;
      for (std::size_t k = 1; k < r.size(); ++k) {
        if (r[k - 1] > 0.1 || r[k - 1] < 1e-8) continue;  // not yet in the quadratic range, or the next one is rounding
        // the factor is the inverse of the size by which residuals are scaled, here the forces of the step
        EXPECT_LT(r[k], std::max(50 * r[k - 1] * r[k - 1], 2 * tolerance)) << "iteration " << k;
        ++squared;
      }
      EXPECT_GE(squared, 3);
    }
}

}  // namespace
}  // namespace mudline
