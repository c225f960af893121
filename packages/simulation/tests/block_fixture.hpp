#pragma once

#include <algorithm>
#include <cmath>

#include "integrator/stepper.hpp"
#include "model_fixture.hpp"

namespace mudline::testing {

inline std::string precise(double value) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.17g", value);
  return buffer;
}

inline std::string elastic_skeleton() {
  return list("skeleton",
              text("type", "linear elastic") + number("Young's modulus", 1e7) + number("Poisson's ratio", 0.3));
}

inline std::string cam_clay_skeleton() {
  return list("skeleton", text("type", "modified cam clay") + number("critical stress ratio", 1.2) +
                              number("compression slope", 0.15) + number("swelling slope", 0.03) +
                              number("Poisson's ratio", 0.3));
}

/// Conditions on the box's four sides.
inline std::string on_all_sides(const std::string& what, const std::string& body) {
  std::string all;
  for (const char* side : {"left", "right", "bottom", "top"}) all += list(what + " " + side, text("set", side) + body);
  return all;
}
inline std::string move_all_sides(const std::string& x, const std::string& y) {
  return on_all_sides("move", text("type", "displacement") + text("x", x) + text("y", y));
}
inline std::string pressure_on_all_sides(const std::string& p) {
  return on_all_sides("wet", text("type", "pore pressure") + text("value", p));
}

/// A block of soil with a distorted mesh, 1.5 m x 1 m, void ratio 0.8, under a quasi-static stage of backward Euler
/// steps.
class Block {
 public:
  Block(const std::string& cell, const std::string& geometry, const std::string& skeleton,
        const std::string& conditions, const std::string& physics = "",
        const std::string& fluid = number("bulk modulus", 5e7), const std::function<void(Registries&)>& more = {})
      : fixture_(list("deck", mesh(cell, geometry) + list("materials", list("soil", soil(skeleton, fluid))) +
                                  list("physics", list("ground", text("type", "biot") + physics)) +
                                  list("boundary conditions", conditions) + list("stages", list("only", steps()))),
                 more) {
    model().activate(stage(), true);
    model().system().refresh_history();
  }
  Model& model() { return *fixture_.model; }
  const Stage& stage() { return *model().stages().front(); }
  StepRequest request(double dt) {
    return {dt, stage().scheme(0), [this](double t0, double t1, const State& old, Constraints& to) {
              model().prescribe(stage(), t0, t1, old, to);
            }};
  }
  /// One step, not accepted yet.
  StepReport step(double dt, const StepTolerances& tolerances = StepTolerances()) {
    // with a new Jacobian in each iteration the last one goes far below the tolerance, and tests can be strict
    NewtonOptions tangents;
    tangents.reuse_jacobian = false;
    return Stepper(model().system()).attempt(request(dt), tolerances, tangents);
  }
  /// Effective stress xx yy zz yz xz xy and void ratio at the points.
  PointView stress(const State& state) { return state.arrays[model().soil()->blocks.front().stress]; }
  PointView void_ratio(const State& state) { return state.arrays[model().soil()->blocks.front().void_ratio]; }
  /// Largest difference between points over the largest stress.
  double stress_spread(const State& state) {
    const PointView s = stress(state);
    double spread = 0, size = 0;
    for (std::size_t i = 0; i < s.extent(0); ++i)
      for (int c = 0; c < 6; ++c) {
        spread = std::max(spread, std::abs(s(i, c) - s(0, c)));
        size = std::max(size, std::abs(s(i, c)));
      }
    return spread / size;
  }

 private:
  static std::string mesh(const std::string& cell, const std::string& geometry) {
    return list("mesh", text("type", "box") + text("geometry", geometry) + text("cell", cell) +
                            par("cells", "Array(double)", "{3, 3}") + par("lower", "Array(double)", "{0.5, 0.0}") +
                            par("upper", "Array(double)", "{2.0, 1.0}") + number("distortion", 0.25));
  }
  static std::string soil(const std::string& skeleton, const std::string& fluid) {
    return number("void ratio", 0.8) + skeleton + list("fluid", text("type", "water") + fluid) +
           list("permeability", text("type", "constant") + number("hydraulic conductivity", 1e-4));
  }
  static std::string steps() {
    return text("type", "quasi-static") + number("duration", 100.0) + list("time step", number("initial", 1.0));
  }
  ModelFixture fixture_;
};

}  // namespace mudline::testing
