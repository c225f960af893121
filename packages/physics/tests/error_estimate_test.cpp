// Fields that elements represent exactly have no error; for smooth fields the estimate is compared with the known
// error.
#include "physics/error_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "soil_model.hpp"
#include "tensor/mat.hpp"

namespace mudline {
namespace {

struct Case {
  const char *cell, *geometry;
  int dimension() const { return std::string(geometry) == "three-dimensional" ? 3 : 2; }
};

std::string box_of(const Case& c, int n) {
  const std::string cells = std::to_string(n), third = c.dimension() == 3 ? ", " : "";
  const bool space = c.dimension() == 3;
  return text_parameter("geometry", c.geometry) + text_parameter("cell", c.cell) +
         integers_parameter("cells", cells + ", " + cells + (space ? ", " + cells : "")) +
         array_parameter("lower", space ? "1, 0, 0" : "1, 0") + array_parameter("upper", space ? "2, 1, 1" : "2, 1");
}

bool linear(const Case& c) { return std::string(c.cell) == "quad4"; }

/// A soil whose stress, velocity and pore pressure are functions of position, with its error estimate.
struct Estimated {
  Estimated(const Case& c, int n)
      : dimension(c.dimension()),
        model("", linear(c) ? text_parameter("pressure", "equal order") : "", box_of(c, n)),
        estimator(*model.soil, *model.store) {
    for (SoilBlock& b : model.soil->blocks) EXPECT_GE(b.stress, 0);
  }
  State& state() { return model.store->committed(); }
  /// Moves vertices in the interior; mid-side nodes stay in the middle.
  void distort(double by) {
    const Mesh& mesh = *model.mesh;
    const CoordinateView x = state().coordinates;
    for (int node = 0; node < mesh.num_nodes(); ++node) {
      double bubble = by;
      for (int i = 0; i < dimension; ++i) bubble *= std::sin(std::acos(-1.0) * (x(node, i) - (i == 0 ? 1 : 0)));
      for (int i = 0; i < dimension; ++i) x(node, i) += bubble * std::cos(3.0 * node + i);
    }
    for (const ElementBlock& b : mesh.blocks())
      for (int e = 0; e < b.num_elements; ++e)
        for (int a = num_corners(b.shape); a < num_nodes(b.shape); ++a) {
          const auto around = corners_around(b.shape, a);
          for (int i = 0; i < dimension; ++i) {
            double sum = 0;
            for (int k : around) sum += x(b.nodes(e, k), i) / around.size();
            x(b.nodes(e, a), i) = sum;
          }
        }
  }
  template <class F>
  void set_stress(F&& f) {
    for (const SoilBlock& b : model.soil->blocks)
      for (int e = 0; e < b.elements; ++e)
        for (int q = 0; q < b.points; ++q)
          for (int c = 0; c < 6; ++c)
            state().arrays[b.stress](e * b.points + q, c) = f(b.place(e, q, state().coordinates), c);
  }
  template <class F>
  void set_velocity(F&& f) {
    for (int node = 0; node < model.mesh->num_nodes(); ++node)
      for (int i = 0; i < dimension; ++i)
        state().rate(model.space->node_dof(0)(node) + i) = f(place_of(state().coordinates, node), i);
  }
  template <class F>
  NodalView pressure(F&& f) {
    NodalView p("p", model.space->dofs()->num_overlap_dofs());
    for (int node = 0; node < model.mesh->num_nodes(); ++node)
      if (model.p(node) >= 0) p(model.p(node)) = f(place_of(state().coordinates, node));
    return p;
  }
  int dimension;
  SoilModel model;
  ErrorEstimator estimator;
};

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

TEST(ErrorEstimate, LinearFieldsHaveNone) {
  for (const Case& c :
       {Case{"quad9", "plane strain"}, Case{"tri6", "plane strain"}, Case{"quad4", "plane strain"},
        Case{"tri6", "axisymmetric"}, Case{"hex27", "three-dimensional"}, Case{"tet10", "three-dimensional"},
        Case{"wedge15", "three-dimensional"}, Case{"wedge18", "three-dimensional"}}) {
    SCOPED_TRACE(std::string(c.cell) + ", " + c.geometry);
    Estimated one(c, 4);
    one.distort(0.04);
    one.estimator.start(one.state());
    one.set_stress([](const Point& x, int k) { return 1e4 * (k + 3 - 2 * x[0] + (k - 5) * x[1] + x[2]); });
    one.set_velocity([](const Point& x, int i) { return 2 * x[i] - x[0] + 3 * x[1]; });  // uniform strain rate
    const NodalView p = one.pressure([](const Point& x) { return 1e5 + 3e4 * x[0] - 2e4 * x[1] + 1e4 * x[2]; });
    const ErrorEstimate found = one.estimator.estimate(one.state(), p, 0.05);
    EXPECT_LT(largest(found.stress), 1e-6);                             // relative to 1e5 Pa
    const double rounding = std::string(c.cell) == "wedge18" ? 10 : 1;  // 6.6e-6 Pa there, of 1e5 Pa
    EXPECT_LT(largest(found.pressure), 1e-6 * rounding);
    EXPECT_LT(found.stress_share, 1e-10);
    EXPECT_LT(found.flow_share, 1e-10 * rounding);
    EXPECT_LT(found.power, 1e-6);
  }
}

/// The stress at the start is the reference of its changes, whatever its field.
TEST(ErrorEstimate, StressOfTheStartHasNone) {
  Estimated one({"quad9", "plane strain"}, 3);
  one.set_stress([](const Point& x, int k) { return -1e5 * std::exp(k + x[0] * x[1]); });
  const NodalView p = one.pressure([](const Point&) { return 0.0; });
  const double before = one.estimator.estimate(one.state(), p, 0.05).stress_share;
  EXPECT_GT(before, 1e-4);
  one.estimator.start(one.state());
  const ErrorEstimate found = one.estimator.estimate(one.state(), p, 0.05);
  EXPECT_EQ(found.stress_share, 0);
  EXPECT_EQ(largest(found.stress), 0);
  EXPECT_EQ(found.wanted, found.size);
}

double velocity(const Point& x, int i) {
  return i == 0 ? std::sin(2 * x[0]) * std::exp(x[1]) : std::cos(x[0] + 2 * x[1]);
}
/// Strain rates xx, yy, xy of that velocity.
Vec<double, 3> strain(const Point& x) {
  const double s = std::sin(x[0] + 2 * x[1]);
  return {2 * std::cos(2 * x[0]) * std::exp(x[1]), -2 * s, 0.5 * (std::sin(2 * x[0]) * std::exp(x[1]) - s)};
}

/// Elastic stresses of interpolated displacements: their error is known. Confined modulus 12 MPa, shear modulus 4 MPa.
struct Smooth {
  double estimated, exact, power, pressure_estimated, pressure_exact, flow;
};

Smooth smooth(int n) {
  Estimated one({"quad9", "plane strain"}, n);
  one.estimator.start(one.state());
  one.set_velocity(velocity);
  State& state = one.state();
  double square = 0, pressure_square = 0, gradient_square = 0, change = 0, flow = 0;
  const NodalView p = one.pressure([](const Point& x) { return 1e4 * std::sin(2 * x[0] + x[1]); });
  const SoilBlock& b = one.model.soil->blocks[0];
  const double h = 1.0 / n;  // cells are squares: gradients are those of the reference times 2 / h
  for (int e = 0; e < b.elements; ++e)
    for (int q = 0; q < b.points; ++q) {
      const Point x = b.place(e, q, state.coordinates);
      Mat<double, 2> g = {};
      double value = 0, slope[2] = {};
      for (int a = 0; a < 9; ++a)
        for (int i = 0; i < 2; ++i)
          for (int j = 0; j < 2; ++j)
            g[i][j] += velocity(place_of(state.coordinates, b.nodes(e, a)), i) * b.u.dN(q, a, j) * 2 / h;
      for (int c = 0; c < 4; ++c) {
        const double at = p(b.dofs(e, 18 + c));
        value += at * b.p.N(q, c);
        for (int j = 0; j < 2; ++j) slope[j] += at * b.p.dN(q, c, j) * 2 / h;
      }
      const double dv = b.u.weights(q) * h * h / 4;
      const auto exact = strain(x);
      const double d[3] = {g[0][0], g[1][1], 0.5 * (g[0][1] + g[1][0])};
      const auto energy = [](double xx, double yy, double xy) {
        return 12e6 * (xx * xx + yy * yy) + 2 * 4e6 * xx * yy + 4 * 4e6 * xy * xy;
      };
      square += dv * energy(d[0] - exact[0], d[1] - exact[1], d[2] - exact[2]);
      change += dv * energy(d[0], d[1], d[2]);
      const double phase = 2 * x[0] + x[1];
      pressure_square += dv * std::pow(value - 1e4 * std::sin(phase), 2);
      gradient_square +=
          dv * (std::pow(slope[0] - 2e4 * std::cos(phase), 2) + std::pow(slope[1] - 1e4 * std::cos(phase), 2));
      flow += dv * (slope[0] * slope[0] + slope[1] * slope[1]);
      const double stress[6] = {
          12e6 * d[0] + 4e6 * d[1], 4e6 * d[0] + 12e6 * d[1], 4e6 * (d[0] + d[1]), 0, 0, 8e6 * d[2]};
      for (int c = 0; c < 6; ++c) state.arrays[b.stress](e * b.points + q, c) = stress[c];
    }
  const ErrorEstimate found = one.estimator.estimate(state, p, 0.05);
  const double estimated = found.stress_share / std::sqrt(1 - std::pow(found.stress_share, 2)) * std::sqrt(change);
  const double flown = found.flow_share / std::sqrt(1 - std::pow(found.flow_share, 2)) * std::sqrt(flow);
  double sum = 0;
  for (double error : found.pressure) sum += error * error * h * h;
  return {estimated,      std::sqrt(square),          found.power,
          std::sqrt(sum), std::sqrt(pressure_square), flown / std::sqrt(gradient_square)};
}

/// Effectivity indices tend to one; errors decrease with the order of the fields.
TEST(ErrorEstimate, IsTheErrorOfSmoothFields) {
  const Smooth coarse = smooth(6), fine = smooth(12);
  for (const Smooth& s : {coarse, fine}) {
    EXPECT_NEAR(s.estimated / s.exact, 1, 0.1);
    EXPECT_NEAR(s.power / (s.exact * s.exact), 1, 0.2);  // both belong to one elastic field
    EXPECT_NEAR(s.pressure_estimated / s.pressure_exact, 1, 0.1);
    EXPECT_NEAR(s.flow, 1, 0.1);
  }
  EXPECT_NEAR(std::log2(coarse.estimated / fine.estimated), 2, 0.2);
  EXPECT_NEAR(std::log2(coarse.pressure_estimated / fine.pressure_estimated), 2, 0.2);
}

/// In a box of simplices some vertices have neighbours in few directions only; they take the fits of their neighbours.
TEST(ErrorEstimate, PressureOfQuadraticsInRegularMeshes) {
  for (const Case& c : {Case{"quad9", "plane strain"}, Case{"tri6", "plane strain"}, Case{"quad4", "plane strain"},
                        Case{"hex27", "three-dimensional"}, Case{"tet10", "three-dimensional"},
                        Case{"wedge15", "three-dimensional"}, Case{"wedge18", "three-dimensional"}}) {
    SCOPED_TRACE(std::string(c.cell) + ", " + c.geometry);
    const int n = 4;
    Estimated one(c, n);
    one.distort(1e-9);  // as in a small deformation of stiff soil
    one.estimator.start(one.state());
    one.set_stress([](const Point&, int) { return 0.0; });
    const auto quadratic = [](const Point& x) {
      return 1e4 * (x[0] * x[0] - 2 * x[0] * x[1] + x[2] * (3 * x[1] - x[2]));
    };
    const ErrorEstimate found = one.estimator.estimate(one.state(), one.pressure(quadratic), 0.05);
    // the interpolation error of a quadratic lies below h2 times its second derivatives
    for (double error : found.pressure) EXPECT_LT(error, 1e4 * 6.0 / (n * n));
    EXPECT_GT(*std::min_element(found.pressure.begin(), found.pressure.end()), 1e4 * 0.05 / (n * n));
  }
}

/// The wanted size is that of a mesh with the target's error.
TEST(ErrorEstimate, WantedSizeMeetsItsTarget) {
  const auto estimate = [](int n, double target) {
    Estimated one({"quad9", "plane strain"}, n);
    one.estimator.start(one.state());
    one.set_stress([](const Point&, int) { return 0.0; });
    const SoilBlock& b = one.model.soil->blocks[0];
    for (int e = 0; e < b.elements; ++e)  // every element has the same error, of second order
      for (int q = 0; q < b.points; ++q) {
        const Point x = b.place(e, q, one.state().coordinates),
                    centre = place_of(one.state().coordinates, b.nodes(e, 8));
        one.state().arrays[b.stress](e * b.points + q, 0) =
            1e4 * (1 + std::pow(x[0] - centre[0], 2) - std::pow(0.5 / n, 2) / 3);
      }
    return one.estimator.estimate(one.state(), one.pressure([](const Point&) { return 0.0; }), target);
  };
  const double coarse = estimate(5, 0.05).stress_share, fine = estimate(10, 0.05).stress_share;
  EXPECT_NEAR(coarse / fine, 4, 0.01);
  const ErrorEstimate steered = estimate(5, fine);
  for (std::size_t e = 0; e < steered.wanted.size(); ++e) EXPECT_NEAR(steered.wanted[e], 0.1, 0.005);
}

}  // namespace
}  // namespace mudline
