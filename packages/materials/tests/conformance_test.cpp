// Conformance checks (materials/conformance) of every registered skeleton law, and of laws with faults that the checks
// must find.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "materials/conformance/conformance.hpp"
#include "materials/pointwise.hpp"
#include "materials/register_materials.hpp"
#include "tensor/sym6.hpp"

namespace mudline {
namespace {

std::vector<Teuchos::ParameterList> frictional_variants(Teuchos::ParameterList base) {
  base.set("cohesion", 15e3);
  base.set("friction angle [deg]", 28.0);
  Teuchos::ParameterList dilating(base), associated(base), brittle(base), euler(base), fifth_order(base);
  dilating.set("dilation angle [deg]", 8.0);
  associated.set("dilation angle [deg]", 28.0);
  brittle.set("tensile strength", 1e3);
  // At a sharp tip explicit substeps are stiff and their number is sensitive; with more cohesion fewer points come near
  // it.
  for (auto* list : {&euler, &fifth_order}) {
    list->set("cohesion", 300e3);
    list->set("apex rounding", 0.25);
    list->set("stress tolerance", 1e-6);
  }
  euler.set("integration", "modified euler");
  euler.set("maximum substeps", 5000);
  fifth_order.set("dilation angle [deg]", 8.0);
  fifth_order.set("integration", "runge-kutta-dormand-prince");
  fifth_order.set("maximum substeps", 5000);
  return {base, dilating, associated, brittle, euler, fifth_order};
}

std::vector<Teuchos::ParameterList> mohr_coulomb_variants(const Teuchos::ParameterList& elastic) {
  auto all = frictional_variants(elastic);
  all.push_back(all.front());
  all.back().set("stiffness exponent", 0.5);
  return all;
}

std::vector<Teuchos::ParameterList> cone_variants(const Teuchos::ParameterList& elastic) {
  auto all = frictional_variants(elastic);
  Teuchos::ParameterList direct(elastic);
  direct.set("match", "direct");
  direct.set("cone slope", 0.5);
  direct.set("cone intercept", 12e3);
  direct.set("dilation slope", 0.2);
  all[1].set("match", "compression");
  all[2].set("match", "extension");
  all.push_back(direct);
  return all;
}

std::vector<Teuchos::ParameterList> tresca_variants() {
  Teuchos::ParameterList base;
  base.set("undrained strength", 40e3);
  base.set("shear modulus", 6e6);
  base.set("Poisson's ratio", 0.45);
  Teuchos::ParameterList rated(base), power(base), euler(base), fifth_order(base);
  rated.remove("shear modulus");
  rated.set("rigidity index", 150.0);
  rated.set("rate law", "logarithmic");
  rated.set("sensitivity", 4.0);
  power.set("rate law", "power");
  euler.set("integration", "modified euler");
  euler.set("sensitivity", 3.0);
  fifth_order.set("integration", "runge-kutta-dormand-prince");
  fifth_order.set("stress tolerance", 1e-6);
  return {base, rated, power, euler, fifth_order};
}

std::vector<Teuchos::ParameterList> von_mises_variants(Teuchos::ParameterList base) {
  base.set("yield stress", 80e3);
  Teuchos::ParameterList hardening(base), euler(base);
  hardening.set("hardening modulus", 2e5);
  hardening.set("saturation stress", 3e4);
  hardening.set("saturation rate", 40.0);
  euler = hardening;
  euler.set("integration", "modified euler");
  return {base, hardening, euler};
}

/// A sand without and with intergranular strain, and with a pressure shift. The stress jumps by less than the tolerance
/// where the number of explicit substeps changes, which a difference across it takes for a slope: of some ten thousand
/// differences a few are such. With these tolerances none is beyond the limit.
std::vector<Teuchos::ParameterList> hypoplastic_variants() {
  Teuchos::ParameterList base;
  base.set("critical friction angle [deg]", 33.0).set("granular hardness", 1e9).set("compression exponent", 0.25);
  base.set("densest void ratio", 0.55).set("critical void ratio", 0.95).set("loosest void ratio", 1.05);
  base.set("peak exponent", 0.25).set("stiffness exponent", 1.5);
  Teuchos::ParameterList plain(base), intergranular(base), shifted(base);
  plain.set("stress tolerance", 1e-8);
  intergranular.set("intergranular strain range", 1e-4).set("reversal stiffness ratio", 5.0);
  intergranular.set("turn stiffness ratio", 2.0).set("intergranular strain exponent", 0.5);
  intergranular.set("stiffness decay exponent", 6.0).set("stress tolerance", 1e-7);
  shifted.set("pressure shift", 500.0);
  return {plain, intergranular, shifted};
}

/// A natural clay with a fabric, with creep, with fabric and bonding by either integration, and with all parts. The
/// tolerances are those of hypoplastic_variants().
std::vector<Teuchos::ParameterList> s_clay1s_variants(Teuchos::ParameterList base) {
  base.set("Poisson's ratio", 0.2);
  Teuchos::ParameterList fabric(base), creep(base), all(base), plastic(base), implicit(base);
  for (auto* list : {&fabric, &all, &plastic, &implicit}) list->set("fabric rotation rate", 30.0);
  fabric.set("fabric axis", "y").set("stress tolerance", 1e-9);
  for (auto* list : {&all, &plastic, &implicit})
    list->set("initial bonding", 5.0).set("bond degradation rate", 8.0).set("bond shear weight", 0.3);
  for (auto* list : {&creep, &all})
    list->set("creep slope", 0.006).set("stress tolerance", list == &all ? 3e-8 : 1e-7).set("maximum substeps", 10000);
  for (auto* list : {&all, &plastic, &implicit}) list->set("lode dependence", "sheng");
  plastic.set("stress tolerance", 1e-6);
  implicit.set("integration", "implicit");
  Teuchos::ParameterList energy(implicit), creep_energy(creep);
  for (auto* list : {&energy, &creep_energy}) {
    list->remove("Poisson's ratio");
    list->set("shear modulus ratio", 50.0);
  }
  return {fabric, creep, plastic, implicit, all, energy, creep_energy};
}

/// Deck entries of the variants under which a type is tested.
std::map<std::string, std::vector<Teuchos::ParameterList>> variants() {
  Teuchos::ParameterList elastic, clay;
  elastic.set("Young's modulus", 2e7);
  elastic.set("Poisson's ratio", 0.3);
  clay.set("critical stress ratio", 1.1);
  clay.set("compression slope", 0.18);
  clay.set("swelling slope", 0.03);
  Teuchos::ParameterList plain(clay), sheng(clay), constant_shear(clay);
  plain.set("Poisson's ratio", 0.25);
  sheng.set("Poisson's ratio", 0.25);
  sheng.set("lode dependence", "sheng");
  constant_shear.set("shear modulus", 4e6);
  constant_shear.set("specific volume", "initial");
  Teuchos::ParameterList implicit(sheng), fifth_order(plain);
  implicit.set("integration", "implicit");
  Teuchos::ParameterList casm(plain), casm_sheng(sheng), casm_constant(constant_shear), casm_implicit(implicit);
  casm.set("spacing ratio", 2.3).set("stress state coefficient", 4.5);
  casm_sheng.set("spacing ratio", 2.7).set("stress state coefficient", 3.0);
  for (auto* list : {&casm_constant, &casm_implicit}) list->set("spacing ratio", 2.7);
  fifth_order.set("integration", "runge-kutta-dormand-prince");
  Teuchos::ParameterList energy(clay), energy_implicit(clay), energy_casm(clay);
  for (auto* list : {&energy, &energy_implicit, &energy_casm}) list->set("shear modulus ratio", 40.0);
  energy_implicit.set("lode dependence", "sheng").set("integration", "implicit");
  energy_casm.set("specific volume", "initial").set("spacing ratio", 2.7);
  return {{"linear elastic", {elastic}},
          {"modified cam clay",
           {plain, sheng, constant_shear, implicit, fifth_order, casm, casm_sheng, casm_constant, casm_implicit, energy,
            energy_implicit, energy_casm}},
          {"neo-hookean", {elastic}},
          {"mohr-coulomb", mohr_coulomb_variants(elastic)},
          {"drucker-prager", cone_variants(elastic)},
          {"tresca", tresca_variants()},
          {"von mises", von_mises_variants(elastic)},
          {"hypoplasticity", hypoplastic_variants()},
          {"s-clay1s", s_clay1s_variants(clay)}};
}

EntryDoc documentation_of(const Registry<Skeleton>& skeletons, const std::string& type) {
  for (const EntryDoc& entry : skeletons.document())
    if (entry.name == type) return entry;
  return {};
}

Registry<Skeleton> laws() {
  Registry<Skeleton> skeletons("skeleton");
  Registry<Fluid> fluids("fluid");
  Registry<Permeability> permeabilities("permeability");
  register_materials(skeletons, fluids, permeabilities);
  return skeletons;
}

/// A quarter of the points that authors of laws get: the faults below are all found by them. may_fail: points may
/// report failure.
ConformanceLimits quarter(bool may_fail = false) {
  ConformanceLimits limits;
  for (int* points : {&limits.tangent_points, &limits.rotation_points, &limits.random_points}) *points /= 4;
  limits.may_fail = may_fail;
  return limits;
}

void expect_conformance(const Registry<Skeleton>& skeletons, const std::string& type, Teuchos::ParameterList list) {
  list.set("type", type);
  const auto law =
      skeletons.create(Section(list, std::make_shared<Sources>(), std::make_shared<FunctionLibrary>(), ""));
  std::ostringstream text;
  list.print(text, 0, false, false);
  SCOPED_TRACE(text.str());
  for (const ConformanceCheck& check : check_conformance(*law, documentation_of(skeletons, type), quarter()))
    EXPECT_TRUE(check.passed) << check.name << ": " << check.figures;
}

TEST(SkeletonConformance, EveryLawOfTheRegistry) {
  const Registry<Skeleton> skeletons = laws();
  auto all = variants();
  for (const std::string& type : skeletons.names()) {
    if (type == "umat") continue;  // its law comes from a library: tests/umat
    ASSERT_TRUE(all.count(type)) << "give '" << type << "' a variant in this test";
    for (const Teuchos::ParameterList& list : all[type]) expect_conformance(skeletons, type, list);
  }
}

/// One variant of each law that has a section "small-strain stiffness". The range of the strings is that of the strain
/// increments.
TEST(SkeletonConformance, WithSmallStrainStiffness) {
  const Registry<Skeleton> skeletons = laws();
  auto all = variants();
  int tested = 0;
  for (const EntryDoc& entry : skeletons.document()) {
    if (entry.sections.empty()) continue;
    Teuchos::ParameterList list = all.at(entry.name).front();
    if (entry.name == "s-clay1s") {  // the number of its substeps is sensitive at these strains
      list.remove("stress tolerance");
      list.set("integration", "implicit");
    }
    list.sublist("small-strain stiffness").set("ratio", 5.0).set("reference strain", 1e-3);
    expect_conformance(skeletons, entry.name, list);
    ++tested;
  }
  EXPECT_EQ(tested, 7);
}

// Laws with one fault each: the suite must name it, and nothing else.

/// Linear elastic, with hooks for faults.
struct Faulty {
  enum Fault { none, wrong_tangent, tangent_changes_stress, anisotropic, not_a_number, drifting, refusing, failing };
  Fault fault = none;

  void parameters(Parameters&) {}
  static std::vector<StateVariable> state() { return {{"count", 1, "-", Transfer::value, 0.0, 1.0}}; }
  std::string initialise(const InitialPoint&, double* state) const {
    state[0] = 0.0;
    return fault == refusing ? "never" : "";
  }
  ElasticModuli moduli(const double*, double, const double*) const { return {2e7, 1e7}; }
  KOKKOS_INLINE_FUNCTION bool operator()(const SkeletonPoint& in, const double* old, double* state,
                                         SkeletonResponse& out) const {
    state[0] = old[0];
    sym6::isotropic(2e7, 1e7, in.strain, out.stress);
    for (int i = 0; i < 6; ++i) out.stress[i] += in.stress[i];
    if (in.want_tangent) sym6::isotropic_stiffness(2e7, fault == wrong_tangent ? 1.01e7 : 1e7, out.tangent);
    if (fault == tangent_changes_stress && in.want_tangent) out.stress[0] *= 1.0 + 1e-15;
    if (fault == anisotropic) {
      out.stress[1] += 1e6 * in.strain[1];
      out.tangent[7] += 1e6;
    }
    if (fault == not_a_number && in.strain[0] > 0.04) out.stress[2] = std::sqrt(-1.0 - in.strain[0]);
    if (fault == drifting)
      for (int i = 0; i < 3; ++i) out.stress[i] -= 1e-6 * sym6::mean_pressure(in.stress);
    return !(fault == failing && in.strain[0] > 0.04);
  }
};

/// Linear elastic, stiffened along a fixed axis by the strain that a state tensor has gathered.
struct FixedAxis : Faulty {
  static std::vector<StateVariable> state() { return {{"strain", 6, "-", Transfer::value, -1.0, 1.0}}; }
  std::string initialise(const InitialPoint&, double* state) const {
    for (int c = 0; c < 6; ++c) state[c] = 0.0;
    return "";
  }
  KOKKOS_INLINE_FUNCTION bool operator()(const SkeletonPoint& in, const double* old, double* state,
                                         SkeletonResponse& out) const {
    for (int c = 0; c < 6; ++c) state[c] = old[c] + (c < 3 ? 1.0 : 0.5) * in.strain[c];
    const double bulk = 2e7 * (1.0 + old[1]);
    sym6::isotropic(bulk, 1e7, in.strain, out.stress);
    for (int i = 0; i < 6; ++i) out.stress[i] += in.stress[i];
    if (in.want_tangent) sym6::isotropic_stiffness(bulk, 1e7, out.tangent);
    return true;
  }
};

template <class Law>
std::string failures(const Law& law, bool may_fail = false) {
  EntryDoc documentation;
  documentation.summary = "a law with a fault";
  std::string names;
  const PointwiseSkeleton<Law> skeleton(law);
  for (const ConformanceCheck& check : check_conformance(skeleton, documentation, quarter(may_fail)))
    if (!check.passed) names += (names.empty() ? "" : ", ") + check.name;
  return names;
}

std::string failures(Faulty::Fault fault, bool may_fail = false) {
  Faulty law;
  law.fault = fault;
  return failures(law, may_fail);
}

TEST(ConformanceSuite, NamesTheFault) {
  EXPECT_EQ(failures(Faulty::none), "");
  EXPECT_EQ(failures(Faulty::wrong_tangent), "tangent");
  EXPECT_EQ(failures(Faulty::tangent_changes_stress), "purity");
  EXPECT_EQ(failures(Faulty::anisotropic), "isotropy");
  EXPECT_EQ(failures(FixedAxis()), "isotropy");
  EXPECT_EQ(failures(Faulty::not_a_number), "finite numbers");
  EXPECT_EQ(failures(Faulty::drifting), "idleness");
  EXPECT_EQ(failures(Faulty::refusing), "starts");
  EXPECT_EQ(failures(Faulty::failing), "finite numbers");
  EXPECT_EQ(failures(Faulty::failing, true), "");
}

TEST(ConformanceSuite, WantsUnitsAndMeanings) {
  EntryDoc documentation;
  documentation.summary = "a law";
  documentation.parameters.push_back({"stiffness", "double", "", "(0, inf)", "1", "what it is", false, {}});
  const auto checks = check_conformance(PointwiseSkeleton<Faulty>(Faulty()), documentation);
  EXPECT_FALSE(checks.back().passed);
  EXPECT_EQ(checks.back().figures, "without unit or meaning: stiffness");
}

}  // namespace
}  // namespace mudline
