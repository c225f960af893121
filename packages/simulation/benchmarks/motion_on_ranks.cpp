// Time and memory of mesh motion and remap on several ranks: the vertices inside a box of Modified Cam Clay are pulled
// off their places, and the motion brings them back, again and again. With a third argument the box is then remeshed.
// Run: mpirun -n RANKS motion_on_ranks [CELLS [plane|space [remeshing]]]
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_Time.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "simulation/benchmarks/saturated_box.hpp"
#include "simulation/model_remeshing.hpp"

namespace {

using namespace mudline;
using namespace mudline::testing;

std::string deck(int cells, bool space) {
  const std::string n = std::to_string(cells);
  return saturated_box(space ? "tet10" : "tri6", space ? "{" + n + ", " + n + ", " + n + "}" : "{" + n + ", " + n + "}",
                       space ? "{1.0, 1.0, 1.0}" : "{1.0, 1.0}", cam_clay(),
                       list("mesh motion", list("remeshing", number("time limit", 600))));
}

/// Memory of this process [MB] by its name in /proc/self/status; VmHWM is the peak since `forget_peak`.
double memory(const std::string& what) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.rfind(what + ":", 0) == 0) return std::atof(line.c_str() + what.size() + 1) * 1024 / 1e6;
  return 0;
}
double resident() { return memory("VmRSS"); }
double peak() { return memory("VmHWM"); }
void forget_peak() { std::ofstream("/proc/self/clear_refs") << 5; }

double largest(const Teuchos::Comm<int>& comm, double mine) {
  double most = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 1, &mine, &most);
  return most;
}

/// Remeshes the region on rank 0 and transfers the state. Measures the time of the transfer, and the peak of its memory
/// beyond the two models on any rank but the first.
void remesh(ModelFixture& fixture) {
  Model& model = *fixture.model;
  const Teuchos::Comm<int>& comm = *model.mesh().comm();
  const Stage& stage = *model.stages().front();
  model.activate(stage, true);
  const Remeshing made = model.ale()->remesh(1, model.store().committed(), nullptr);
  if (!made.veto.empty()) {
    std::printf("refused: %s\n", made.veto.c_str());
    return;
  }
  const double alone = resident();
  Model next(model.mesh().comm(), *fixture.root, fixture.registries, MeshOrigin{"", made.mesh});
  const double both = resident();
  forget_peak();
  comm.barrier();
  const double start = Teuchos::Time::wallTime();
  const MeshReceipt receipt = transfer_from(model, stage, next).receipt;
  comm.barrier();
  const double wall = Teuchos::Time::wallTime() - start, first = comm.getRank() == 0 && comm.getSize() > 1 ? 0.0 : 1.0;
  const double most_alone = largest(comm, first * alone), most_both = largest(comm, first * both),
               most = largest(comm, first * peak());
  if (comm.getRank() == 0)
    std::printf("| remeshed: %lld | %d | %.3f | %.0f, %.0f, %.0f |%s\n", next.mesh().num_global_elements(),
                comm.getSize(), wall, most_alone, most_both, most, receipt.moved ? "" : receipt.veto.c_str());
}

void run(int cells, bool space, bool anew, int rounds) {
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
  const double most = largest(comm, resident());
  if (comm.getRank() == 0)
    std::printf("| %lld | %d | %.3f | %.0f | %.12f |\n", mesh.num_global_elements(), comm.getSize(), wall / rounds,
                most, lowest);
  if (anew) remesh(fixture);
}

}  // namespace

int main(int argc, char** argv) {
  Tpetra::ScopeGuard guard(&argc, &argv);
  const int cells = argc > 1 ? std::atoi(argv[1]) : 100;
  run(cells, argc > 2 && std::string(argv[2]) == "space", argc > 3, 5);
}
