#include "discretisation/cells/cell.hpp"

namespace mudline {

namespace {

const CellFrame& line_frame() {
  static const CellFrame segment{1, 0, {{-1}, {1}}, {{{0, 1}}}, {}, 1, 1};
  return segment;
}

void evaluate(const Cell& own, const double* xi, double* N, double* dN) {
  evaluate_line(static_cast<int>(own.nodes.size()), xi[0], N, dN);
}

}  // namespace

Cell line2() { return line_frame().linear("line2", CellShape::line2, {}, evaluate); }
Cell line3() { return line_frame().quadratic("line3", CellShape::line2, {}, false, evaluate); }

}  // namespace mudline
