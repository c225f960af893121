// A solute in the pore water of a saturated soil: it flows with the water and diffuses in it.
//
//     n R (c_{n+1} - c_n) + dt (w . grad c - div(D grad c)) = 0
//
// c: mass per volume of water [kg/m3], n: porosity, R: retardation, w: Darcy's discharge, D: effective diffusivity. The
// materials of the regions give the properties, the physics of the pore water gives the discharge.
#include <memory>

#include "framework/loop_term.hpp"
#include "framework/physics.hpp"
#include "physics/biot/darcy.hpp"
#include "simulation/plugin.hpp"

namespace {

using namespace mudline;

/// The section "solute" of a material.
class SoluteProperties : public Properties {
 public:
  void parameters(Parameters& p) {
    p.required("diffusivity", diffusivity, "m2/s", positive(), "effective, of the soil as a whole");
    p.add("retardation", retardation, "-", closed(1, 1e6), "what is there over what is in the water");
  }
  double diffusivity = 0, retardation = 1;
};

constexpr int concentration = 1;  // index among the scalar fields; the first is the pore pressure

/// The storage term at the end of the step, with the water content between those of the step's start and end.
struct Stored : PointLaw {
  static constexpr int fields = 2;
  static constexpr bool storages = true, rates = false;
  Darcy darcy;
  ByMaterial<double> retardation;
  double dt, theta;
  template <class C, int S, class T>
  void operator()(int row, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    const double e = darcy.void_ratio(row, 0);
    const T water = (1 - theta) * darcy.porosity(row, at) + theta * e / (1 + e) / at.volume_ratio;
    out.storage[0] = 0.0;
    out.storage[concentration] = retardation(row) / dt * water * at.change[concentration];
  }
};

/// The transport terms, at the time level of the balances.
struct Convected : PointLaw {
  static constexpr int fields = 2;
  static constexpr bool storages = true, fluxes = true, gradients = true, rates = false;
  Darcy darcy;
  ByMaterial<double> diffusivity;
  template <class C, int S, class T>
  void operator()(int row, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    T minus_flow[C::dim];
    darcy.minus_discharge(row, at, minus_flow);
    out.storage[0] = out.storage[concentration] = 0.0;
    for (int i = 0; i < C::dim; ++i) {
      out.storage[concentration] -= minus_flow[i] * at.gradient[concentration][i];
      out.flux[0][i] = 0.0;
      out.flux[concentration][i] = diffusivity(row) * at.gradient[concentration][i];
    }
  }
};

class Solute : public Physics {
 public:
  void parameters(Parameters&) {}
  std::vector<Field> fields() const override { return {{"concentration", "kg/m3", "kg/s", 1, Support::vertices, 1}}; }

  void build(PhysicsContext& context, const Section& section) override {
    const auto soil = context.shared.find<Soil>();
    if (!soil || soil->pressure < 0)
      section.fail("there is no pore water: name a physics of saturated soil before this one", "type");
    const int field = context.space.find("concentration");
    const auto blocks = std::make_shared<std::vector<FieldBlock>>();
    std::vector<std::shared_ptr<const SoluteProperties>> values;  // by material number
    for (const auto& material : soil->materials)
      values.push_back(material->require<SoluteProperties>("solute", context.materials_section));
    for (const SoilBlock& b : soil->blocks) {
      blocks->emplace_back(context.space, b.block, soil->displacement, std::vector<int>{soil->pressure, field}, 4);
      if (blocks->back().points != b.points)
        section.fail("the soil must keep its 'quadrature degree' of 4, at whose points the water flows", "type");
    }
    const auto laws = [=](const StepView& view, auto&& add) {
      if (!view.flow) return;  // a geostatic stage takes no time
      for (std::size_t i = 0; i < blocks->size(); ++i) {
        const FieldBlock& b = (*blocks)[i];
        const SoilBlock& of = soil->blocks[i];
        const State& old = *view.committed;
        const LoopLevel end = end_level(view, b), balance = loop_level(view, view.balance, b);
        const ByMaterial<double> retardation(*soil, of, old, [&](int k) { return values[k]->retardation; });
        const ByMaterial<double> diffusivity(*soil, of, old, [&](int k) { return values[k]->diffusivity; });
        add(b, end, Stored{{}, Darcy(*soil, of, view, b, end), retardation, view.dt, view.sensitivity[field].value});
        add(b, balance, Convected{{}, Darcy(*soil, of, view, b, balance), diffusivity});
      }
    };
    context.terms.push_back(loop_term("solute", Role::balance, soil->geometry, laws, blocks));
  }
};

}  // namespace

MUDLINE_PLUGIN(registries) {
  registries.properties.add<SoluteProperties>("solute", "diffusion and retardation, for physics 'solute'");
  registries.physics.add<Solute>("solute", "a solute that the pore water carries and that diffuses in it");
}
