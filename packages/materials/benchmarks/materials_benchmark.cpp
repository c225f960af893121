// Cost of one material point in the host loop, gather and scatter included (items per second are points per second).
#include <benchmark/benchmark.h>

#include "materials/skeleton/hypoplasticity.hpp"
#include "materials/skeleton/linear_elastic.hpp"
#include "materials/skeleton/modified_cam_clay.hpp"
#include "materials/skeleton/mohr_coulomb.hpp"
#include "materials/skeleton/tresca.hpp"
#include "materials/skeleton/von_mises.hpp"

namespace {

using namespace mudline;

struct Batch {
  int points;
  PointView old_stress, strain, e, stress, tangent, old_state, state;
  Kokkos::View<int*> failed;

  /// Points at p' = 50 to 150 kPa, each sheared by `size` in another direction.
  Batch(const Skeleton& law, double ocr, double size, int n)
      : points(n),
        old_stress("old_stress", n, 6),
        strain("strain", n, 6),
        e("e", n, 1),
        stress("stress", n, 6),
        tangent("tangent", n, 36),
        old_state("old_state", n, law.state_size()),
        state("state", n, law.state_size()),
        failed("failed", n) {
    for (int i = 0; i < points; ++i) {
      const double p = 50e3 + 100e3 * i / points, turn = 0.1 * i;
      InitialPoint start{{}, {-0.8 * p, -1.4 * p, -0.8 * p, 0.0, 0.0, 0.1 * p}, 1.0, ocr};
      law.initialise(start, old_state.data() + i * old_state.extent(1));
      for (int c = 0; c < 6; ++c) old_stress(i, c) = start.stress[c];
      e(i, 0) = start.void_ratio;
      strain(i, 0) = size * (0.2 + 0.1 * std::cos(turn));
      strain(i, 1) = -size;
      strain(i, 5) = size * std::sin(turn);
    }
  }
  SkeletonWorkset workset(bool want_tangent) const {
    return {points, 0.0, 0.0, want_tangent, old_stress, strain, e, old_state, stress, state, tangent, failed};
  }
};

void run(benchmark::State& bench, const Skeleton& law, double ocr, double strain, bool want_tangent, int points = 512) {
  const Batch batch(law, ocr, strain, points);
  const SkeletonWorkset workset = batch.workset(want_tangent);
  for (auto _ : bench)
    if (law.evaluate(workset) != 0) bench.SkipWithError("points failed");
  bench.SetItemsProcessed(bench.iterations() * points);
  bench.counters["ns_per_point"] =
      benchmark::Counter(1e-9 * points, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

ModifiedCamClay clay(bool lode) {
  ModifiedCamClay law;
  law.ratio = 1.2;
  law.compression = 0.15;
  law.swelling = 0.03;
  law.poisson = 0.3;
  law.lode = lode ? ModifiedCamClay::Lode::sheng : ModifiedCamClay::Lode::none;
  return law;
}

void linear_elastic(benchmark::State& bench) {
  run(bench, PointwiseSkeleton<LinearElastic>(), 1.0, 1e-4, bench.range(0) != 0);
}
BENCHMARK(linear_elastic)->ArgName("tangent")->Arg(0)->Arg(1);

void cam_clay_elastic(benchmark::State& bench) {
  run(bench, PointwiseSkeleton<ModifiedCamClay>(clay(false)), 20.0, 1e-4, bench.range(0) != 0);
}
BENCHMARK(cam_clay_elastic)->ArgName("tangent")->Arg(0)->Arg(1);

/// range(1) is the strain increment in units of 1e-5.
void cam_clay_plastic(benchmark::State& bench) {
  run(bench, PointwiseSkeleton<ModifiedCamClay>(clay(false)), 1.0, 1e-5 * bench.range(1), bench.range(0) != 0);
}
BENCHMARK(cam_clay_plastic)->ArgNames({"tangent", "strain"})->ArgsProduct({{0, 1}, {1, 10, 100, 1000}});

/// Mean number of substeps, rejected ones included, of the points of a batch.
double substeps(const ModifiedCamClay& law, const Batch& batch) {
  long sum = 0;
  for (int i = 0; i < batch.points; ++i) {
    const double* h = &batch.old_state(i, 0);
    const ModifiedCamClayModel<SixComponents> model(law, {}, law.specific_volume(batch.e(i, 0), h), h[0]);
    const auto count = [&](auto path) {
      for (int c = 0; c < 6; ++c) path.stress[c] = batch.old_stress(i, c);
      for (int c = 0; c < 2; ++c) path.h[c] = h[c];
      path.integrate();
      sum += path.substeps;
    };
    if (law.integration.method == IntegrationOptions::Method::implicit)
      count(ImplicitReturn<double, ModifiedCamClayModel<SixComponents>>(model, law.integration, &batch.strain(i, 0)));
    else
      count(Substepping<double, ModifiedCamClayModel<SixComponents>>(model, law.integration, &batch.strain(i, 0)));
  }
  return static_cast<double>(sum) / batch.points;
}

/// A mesh of 10^5 normally consolidated points, which does not fit in a cache; range(0): integration; range(1): strain
/// in 1e-5.
void cam_clay_mesh(benchmark::State& bench) {
  ModifiedCamClay law = clay(false);
  law.integration.method = static_cast<IntegrationOptions::Method>(bench.range(0));
  const PointwiseSkeleton<ModifiedCamClay> skeleton(law);
  const double strain = 1e-5 * bench.range(1);
  run(bench, skeleton, 1.0, strain, true, 100000);
  bench.counters["substeps"] = substeps(law, Batch(skeleton, 1.0, strain, 100000));
}
BENCHMARK(cam_clay_mesh)->ArgNames({"method", "strain"})->ArgsProduct({{0, 1, 2}, {1, 10, 100, 1000}});

void cam_clay_lode_plastic(benchmark::State& bench) {
  run(bench, PointwiseSkeleton<ModifiedCamClay>(clay(true)), 1.0, 1e-5 * bench.range(1), bench.range(0) != 0);
}
BENCHMARK(cam_clay_lode_plastic)->ArgNames({"tangent", "strain"})->ArgsProduct({{0, 1}, {10, 100}});

void cam_clay_implicit_plastic(benchmark::State& bench) {
  ModifiedCamClay law = clay(false);
  law.integration.method = IntegrationOptions::Method::implicit;
  run(bench, PointwiseSkeleton<ModifiedCamClay>(law), 1.0, 1e-5 * bench.range(1), bench.range(0) != 0);
}
BENCHMARK(cam_clay_implicit_plastic)->ArgNames({"tangent", "strain"})->ArgsProduct({{0, 1}, {10, 100, 1000}});

/// Laws with constant elasticity: elastic with a high strength, otherwise at least half of the points yield at a strain
/// of 1e-2.
PointwiseSkeleton<AutomaticTangent<MohrCoulomb>> sand(bool elastic) {
  MohrCoulomb law;
  law.cohesion.value = elastic ? 1e6 : 5e3;
  law.friction = 25.0;
  law.dilation = 5.0;
  return PointwiseSkeleton<AutomaticTangent<MohrCoulomb>>(law);
}
PointwiseSkeleton<AutomaticTangent<Tresca>> undrained(bool elastic) {
  Tresca law;
  law.strength.value = elastic ? 1e6 : 60e3;
  law.shear_modulus = 10e6;
  law.rate = Tresca::Rate::logarithmic;
  law.sensitivity = 3.0;
  return PointwiseSkeleton<AutomaticTangent<Tresca>>(law);
}
PointwiseSkeleton<AutomaticTangent<VonMises>> metal() {
  VonMises law;
  law.yield_stress = 80e3;
  return PointwiseSkeleton<AutomaticTangent<VonMises>>(law);
}

void mohr_coulomb_elastic(benchmark::State& bench) { run(bench, sand(true), 1.0, 1e-4, bench.range(0) != 0); }
BENCHMARK(mohr_coulomb_elastic)->ArgName("tangent")->Arg(0)->Arg(1);
void mohr_coulomb_plastic(benchmark::State& bench) {
  run(bench, sand(false), 1.0, 1e-5 * bench.range(1), bench.range(0) != 0);
}
BENCHMARK(mohr_coulomb_plastic)->ArgNames({"tangent", "strain"})->ArgsProduct({{0, 1}, {100, 1000}});
void tresca_elastic(benchmark::State& bench) { run(bench, undrained(true), 1.0, 1e-4, bench.range(0) != 0); }
BENCHMARK(tresca_elastic)->ArgName("tangent")->Arg(0)->Arg(1);
void tresca_plastic(benchmark::State& bench) {
  run(bench, undrained(false), 1.0, 1e-5 * bench.range(1), bench.range(0) != 0);
}
BENCHMARK(tresca_plastic)->ArgNames({"tangent", "strain"})->ArgsProduct({{0, 1}, {100, 1000}});
void von_mises_plastic(benchmark::State& bench) {
  run(bench, metal(), 1.0, 1e-5 * bench.range(1), bench.range(0) != 0);
}
BENCHMARK(von_mises_plastic)->ArgNames({"tangent", "strain"})->ArgsProduct({{0, 1}, {100, 1000}});

/// A sand at about its critical void ratio, from rest: the intergranular strain starts from zero. range(2): with it.
void hypoplastic(benchmark::State& bench) {
  Hypoplasticity law;
  law.friction = 33.0;
  law.hardness = 1e9;
  law.compression_exponent = 0.25;
  law.densest = 0.6;
  law.critical = 1.0;
  law.loosest = 1.2;
  law.peak_exponent = 0.25;
  law.stiffness_exponent = 1.5;
  if (bench.range(2) != 0) {
    law.range = 1e-4;
    law.reversal = 5.0;
    law.turn = 2.0;
    law.evolution_exponent = 0.5;
    law.decay_exponent = 6.0;
  }
  run(bench, PointwiseSkeleton<AutomaticTangent<Hypoplasticity>>(law), 1.0, 1e-5 * bench.range(1), bench.range(0) != 0);
}
BENCHMARK(hypoplastic)
    ->ArgNames({"tangent", "strain", "intergranular"})
    ->ArgsProduct({{0, 1}, {1, 10, 100, 1000}, {0, 1}});

}  // namespace

int main(int argc, char** argv) {
  Kokkos::ScopeGuard scope(argc, argv);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
