// A plugin with every fault that a plugin may have; the environment variable PLUGIN_FAULT chooses one. Without it:
// linear elastic soil, water, and a prescribed displacement. Compiled by the category `plugins` with the program's own
// options.
#include <fcntl.h>
#include <mpi.h>
#include <unistd.h>

#include <cfenv>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "materials/pointwise.hpp"
#include "physics/conditions/prescribed.hpp"
#include "simulation/plugin.hpp"
#include "tensor/sym6.hpp"

namespace {

using namespace mudline;

bool fault(const char* name) {
  const char* chosen = std::getenv("PLUGIN_FAULT");
  return chosen != nullptr && std::strcmp(chosen, name) == 0;
}

bool second_rank() {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
    if (const char* rank = std::getenv(name)) return std::strcmp(rank, "1") == 0;
  return false;
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

int recursion(volatile int* depth) {
  volatile int here[1000] = {*depth};
  return recursion(here) + here[0];
}

/// Faults that end the program, at the place that PLUGIN_FAULT names.
void end(const std::string& where) {
  const auto is = [&](const char* how) { return fault((where + " " + how).c_str()); };
  if (is("throws a number")) throw 1;
  if (is("throws a text")) throw "text";
  if (is("throws lines")) throw std::runtime_error("first line\nlast line\n");
  if (is("exits")) std::exit(0);
  if (is("aborts")) std::abort();
  if (is("traps")) __builtin_trap();
  if (is("writes nowhere")) *reinterpret_cast<volatile int*>(8) = 1;
  volatile int zero = 0;
  if (is("divides by zero")) zero = 7 / zero;
  if (is("recurses without end")) recursion(&zero);
  if (is("calls _exit")) _exit(0);
  if (is("calls _Exit")) std::_Exit(0);
  if (is("calls quick_exit")) std::quick_exit(0);
  if (is("aborts MPI with 0")) MPI_Abort(MPI_COMM_WORLD, 0);
  if (is("changes the folder") && chdir("/") != 0) return;
  if (is("rounds upward")) std::fesetround(FE_UPWARD);
  if (is("closes standard output")) close(STDOUT_FILENO);
  if (is("closes all files"))
    for (int i = 3; i < 63; ++i) close(i);
  if (is("puts a file in the place of another"))
    for (int i = 3, other = open("/dev/null", O_RDWR); i < 63; ++i)
      if (fcntl(i, F_GETFD) >= 0 && i != other) dup2(other, i);
  if (is("throws on the second rank") && second_rank()) throw std::runtime_error("only here");
  if (is("exits on the second rank") && second_rank()) std::exit(0);
  if (is("writes nowhere on the second rank") && second_rank()) *reinterpret_cast<volatile int*>(8) = 1;
}

struct AtLoading {
  AtLoading() { end("loading"); }
} at_loading;

struct FaultyLaw {
  double bulk = 2e6, shear = 1e6;  // [Pa]

  FaultyLaw() { end("constructor"); }
  void parameters(Parameters& p) {
    end("parameters");
    p.required("bulk modulus", bulk, "Pa", positive(), "of the soil");
    if (fault("parameters declares a name twice")) p.add("bulk modulus", shear, "Pa", positive(), "of the soil");
  }
  void check(const Section&) const { end("check"); }
  static std::vector<StateVariable> state() {
    const int components = fault("state of three components") ? 3 : 1;
    return {{"first", components, "-"}, {fault("state of one name") ? "first" : "second", 1, "-"}};
  }
  std::string initialise(const InitialPoint&, double* state) const {
    end("initialise");
    state[0] = fault("initialise gives NaN") ? nan : 0.0;
    state[1] = 0;
    return fault("initialise refuses") ? "no such soil" : "";
  }
  double k0(double) const { return fault("K0 is NaN") ? nan : 0.5; }
  KOKKOS_INLINE_FUNCTION ElasticModuli moduli(const double*, double, const double*) const {
    end("moduli");
    if (fault("moduli are NaN")) return {nan, nan};
    if (fault("moduli are zero")) return {0.0, 0.0};
    if (fault("moduli are negative")) return {-bulk, shear};
    return {bulk, shear};
  }
  KOKKOS_INLINE_FUNCTION bool operator()(const SkeletonPoint& in, const double* old, double* state,
                                         SkeletonResponse& out) const {
    end("update");
    sym6::isotropic(bulk, shear, in.strain, out.stress);
    for (int i = 0; i < 6; ++i) out.stress[i] += in.stress[i];
    if (in.want_tangent) sym6::isotropic_stiffness(bulk, shear, out.tangent);
    for (int i = 0; i < 2; ++i) state[i] = old[i];
    if (fault("update gives a NaN stress")) out.stress[1] = nan;
    if (fault("update gives an infinite stress")) out.stress[1] = 1 / (0.0 * out.stress[1]);
    if (fault("update gives a NaN state")) state[1] = nan;
    if (fault("update gives a NaN tangent")) out.tangent[7] = nan;
    return !fault("update refuses");
  }
};

class FaultyFluid : public Fluid {
 public:
  void parameters(Parameters&) { end("fluid"); }
  double density() const override { return fault("fluid of NaN density") ? nan : 1000; }
  double bulk_modulus() const override { return fault("fluid of negative bulk modulus") ? -1e9 : 2e9; }
  double unit_weight() const override { return 9810; }
};

class FaultyPermeability : public Permeability {
 public:
  void parameters(Parameters&) {}
  Value conductivity(double, double) const override {
    end("conductivity");
    return {fault("conductivity is negative") ? -1e-3 : 1e-3, 0};
  }
};

class FaultyTerm : public Term {
 public:
  std::string name() const override { return "faulty term"; }
  int residual(const StepView&, const ResidualView& f) override {
    end("residual");
    if (fault("residual gives NaN")) f.add(0, nan);
    return 0;
  }
  void jacobian(const StepView&, Assembler&, double) override { end("jacobian"); }
};

class FaultyCondition : public DisplacementCondition {
 public:
  ~FaultyCondition() override { end("destructor"); }
  void bind(const ConditionContext& context, const Section& section) override {
    end("bind");
    DisplacementCondition::bind(context, section);
  }
  void prescribe(double t_old, double t_end, const State& committed, Constraints& to) const override {
    end("prescribe");
    DisplacementCondition::prescribe(t_old, t_end, committed, to);
    if (fault("prescribe gives NaN") && t_end > 0.6)
      for (std::size_t i = 0; i < to.mask.extent(0); ++i)
        if (to.mask(i)) to.value(i) = nan;
  }
  Term* term() override { return &term_; }

 private:
  FaultyTerm term_;
};

}  // namespace

extern "C" const char* mudline_plugin_abi() {
  end("signature");
  return fault("signature is null") ? nullptr : fault("signature is another") ? "interface 0" : MUDLINE_ABI;
}

extern "C" void mudline_plugin_register(Registries& registries) {
  end("registration");
  registries.skeletons.add<PointwiseSkeleton<FaultyLaw>>("faulty", "");
  if (fault("registration of one name twice")) registries.skeletons.add<PointwiseSkeleton<FaultyLaw>>("faulty", "");
  registries.fluids.add<FaultyFluid>("faulty", "");
  registries.permeabilities.add<FaultyPermeability>("faulty", "");
  registries.conditions.add<FaultyCondition>("faulty", "");
}
