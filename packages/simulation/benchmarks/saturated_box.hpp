#pragma once

#include "simulation/tests/model_fixture.hpp"

namespace mudline::testing {

inline std::string cam_clay() {
  return list("skeleton", text("type", "modified cam clay") + number("critical stress ratio", 1.0) +
                              number("compression slope", 0.2) + number("swelling slope", 0.04) +
                              number("Poisson's ratio", 0.3));
}

/// Deck of a box of saturated soil under a uniform stress of 100 kPa, on a fixed base, in a dynamic stage. `cells`,
/// `upper`: two numbers, in axial symmetry, or three; `more`: further sections.
inline std::string saturated_box(const std::string& cell, const std::string& cells, const std::string& upper,
                                 const std::string& skeleton, const std::string& more = "") {
  const bool space = std::count(cells.begin(), cells.end(), ',') == 2;
  const std::string mesh = text("type", "box") + text("geometry", space ? "three-dimensional" : "axisymmetric") +
                           text("cell", cell) + par("cells", "Array(double)", cells) +
                           par("upper", "Array(double)", upper);
  const std::string permeability =
      list("permeability", text("type", "constant") + number("hydraulic conductivity", 1e-8));
  const std::string start =
      list("initial state", text("type", "uniform") + number("effective stress xx", 1e5) +
                                number("effective stress yy", 1e5) + number("effective stress zz", 1e5));
  return list("deck", list("mesh", mesh) +
                          list("materials", list("soil", number("void ratio", 1.3) + skeleton +
                                                             list("fluid", text("type", "water")) + permeability)) +
                          list("physics", list("ground", text("type", "biot") + start)) + more +
                          list("boundary conditions", list("base", text("type", "fixed") + text("set", "bottom"))) +
                          list("stages", list("shake", text("type", "dynamic") + number("duration", 1.0) +
                                                           list("time step", number("initial", 1e-3)))));
}

}  // namespace mudline::testing
