// Time and memory of mesh motion and remap on several ranks: the vertices inside a box of Modified Cam Clay are pulled
// off their places, and the motion brings them back, again and again.
// Run: mpirun -n RANKS motion_on_ranks [CELLS [plane|space]]
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_Time.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "simulation/tests/model_fixture.hpp"

namespace {

using namespace mudline;
using namespace mudline::testing;

std::string deck(int cells, bool space) {
  const std::string n = std::to_string(cells);
  const std::string box = space ? text("geometry", "three-dimensional") + text("cell", "tet10") +
                                      par("cells", "Array(double)", "{" + n + ", " + n + ", " + n + "}") +
                                      par("upper", "Array(double)", "{1.0, 1.0, 1.0}")
                                : text("geometry", "axisymmetric") + text("cell", "tri6") +
                                      par("cells", "Array(double)", "{" + n + ", " + n + "}") +
                                      par("upper", "Array(double)", "{1.0, 1.0}");
  const std::string skeleton =
      list("skeleton", text("type", "modified cam clay") + number("critical stress ratio", 1.0) +
                           number("compression slope", 0.2) + number("swelling slope", 0.04) +
                           number("Poisson's ratio", 0.3));
  return list(
      "deck",
      list("mesh", text("type", "box") + box) +
          list("materials", list("soil", number("void ratio", 1.3) + skeleton + list("fluid", text("type", "water")) +
                                             list("permeability",
                                                  text("type", "constant") + number("hydraulic conductivity", 1e-8)))) +
          list("physics",
               list("ground", text("type", "biot") +
                                  list("initial state", text("type", "uniform") + number("effective stress xx", 1e5) +
                                                            number("effective stress yy", 1e5) +
                                                            number("effective stress zz", 1e5)))) +
          list("mesh motion", "") +
          list("boundary conditions", list("base", text("type", "fixed") + text("set", "bottom"))) +
          list("stages", list("shake", text("type", "dynamic") + number("duration", 1.0) +
                                           list("time step", number("initial", 1e-3)))));
}

/// [MB] that this process holds.
double resident() {
  std::ifstream file("/proc/self/statm");
  double all = 0, pages = 0;
  file >> all >> pages;
  return pages * 4096 / 1e6;
}

void run(int cells, bool space, int rounds) {
  ModelFixture fixture(deck(cells, space));
  Model& model = *fixture.model;
  const Mesh& mesh = model.mesh();
  const Teuchos::Comm<int>& comm = *mesh.comm();
  State& state = model.store().committed();
  const Constraints constraints(model.space().dofs()->num_overlap_dofs());
  double wall = 0, lowest = 1;
  for (int round = 0; round < rounds; ++round) {
    for (int i = 0; i < mesh.num_nodes(); ++i) {
      const Point x = mesh.place(i);
      double bubble = 0.15 / cells;
      for (int d = 0; d < mesh.dimension(); ++d) bubble *= std::sin(std::acos(-1.0) * x[d]);
      for (int d = 0; d < mesh.dimension(); ++d)
        state.coordinates(i, d) = x[d] + bubble * std::sin(40 * x[(d + 1) % mesh.dimension()] + round + d);
    }
    comm.barrier();
    const double start = Teuchos::Time::wallTime();
    const MeshReceipt receipt = model.ale()->relocate(model.store(), constraints);
    comm.barrier();
    wall += Teuchos::Time::wallTime() - start;
    if (!receipt.moved) {
      std::printf("refused: %s\n", receipt.veto.c_str());
      return;
    }
    lowest = std::min(lowest, receipt.quality);
  }
  const double mine = resident();
  double most = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 1, &mine, &most);
  if (comm.getRank() == 0)
    std::printf("| %lld | %d | %.3f | %.0f | %.12f |\n", mesh.num_global_elements(), comm.getSize(), wall / rounds,
                most, lowest);
}

}  // namespace

int main(int argc, char** argv) {
  Tpetra::ScopeGuard guard(&argc, &argv);
  const int cells = argc > 1 ? std::atoi(argv[1]) : 100;
  run(cells, argc > 2 && std::string(argv[2]) == "space", 5);
}
