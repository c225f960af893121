// Time per element for the residual, the Jacobian, and both in turn as in a Newton iteration, of the u-p model with all
// terms of a dynamic step: linear elastic and Modified Cam Clay on Taylor-Hood pairs in axial symmetry and in space.
// Run: assembly_benchmark
#include <benchmark/benchmark.h>

#include <random>

#include "simulation/benchmarks/saturated_box.hpp"

namespace {

using namespace mudline;
using namespace mudline::testing;

std::string deck(const std::string& cell, bool clay) {
  const std::string elastic = list(
      "skeleton", text("type", "linear elastic") + number("Young's modulus", 1e7) + number("Poisson's ratio", 0.3));
  const bool space = cell == "tet10" || cell == "hex27";
  return saturated_box(cell, space ? "{8, 8, 8}" : "{30, 20}", space ? "{0.8, 0.8, 0.8}" : "{3.0, 2.0}",
                       clay ? cam_clay() : elastic);
}

enum class What { residual, jacobian, both };
constexpr const char* names[] = {"residual", "jacobian", "both"};

void assemble(benchmark::State& state, const std::string& cell, bool clay, What what) {
  ModelFixture fixture(deck(cell, clay));
  Model& model = *fixture.model;
  StepSystem& system = model.system();
  const Stage& stage = *model.stages().front();
  model.activate(stage, true);
  StepRequest request;
  request.dt = 1e-3;
  request.scheme = stage.scheme(0);
  request.prescribe = [&](double a, double b, const State& committed, Constraints& to) {
    model.prescribe(stage, a, b, committed, to);
  };
  Vector x = system.begin(request, StepTolerances()), f(system.map());
  {
    // strain increments of about 1e-3: most clay points yield
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    auto data = x.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (int i = 0; i < model.space().dofs()->num_owned_dofs(); ++i)
      if (!system.constraints().mask(i))
        data(i, 0) += uniform(random) * (model.space().dofs()->field_of(i) == 0 ? 2e-5 : 100.0);
  }
  if (!system.residual(x, f)) state.SkipWithError("the residual failed");
  // two states in turn, because the system keeps its results for the last one
  Vector places[2] = {Vector(x, Teuchos::Copy), Vector(x, Teuchos::Copy)};
  places[1].scale(1 + 1e-12);
  int turn = 0;
  if (what == What::residual) system.observe(0.5);  // as converged, so that nothing is prepared for a matrix
  for (auto _ : state) {
    turn = 1 - turn;
    if (what != What::jacobian) system.residual(places[turn], f);
    if (what != What::residual) system.jacobian(places[turn]);
  }
  state.counters["us per element"] =
      benchmark::Counter(static_cast<double>(model.mesh().num_global_elements()) * 1e-6,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}  // namespace

int main(int argc, char** argv) {
  Tpetra::ScopeGuard scope(&argc, &argv);
  benchmark::Initialize(&argc, argv);
  for (const std::string cell : {"tri6", "quad9", "tet10", "hex27"})
    for (bool clay : {false, true})
      for (const What what : {What::residual, What::jacobian, What::both})
        benchmark::RegisterBenchmark(
            (cell + (clay ? "/cam clay/" : "/elastic/") + names[static_cast<int>(what)]).c_str(),
            [=](benchmark::State& state) { assemble(state, cell, clay, what); })
            ->Unit(benchmark::kMillisecond);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
