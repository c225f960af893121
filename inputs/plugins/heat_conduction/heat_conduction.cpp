// A second physics: the field "temperature" and its balance  C dT/dt = div(lambda grad T).
//
// It stands alone, or in a deck beside "biot" or "solid": then all fields are unknowns of one monolithic system, and
// heat moves with the deforming ground. Integrals are on the configuration at the start of the step, so that
// the balance does not depend on the unknown displacements.
#include <memory>

#include "framework/loop_term.hpp"
#include "framework/physics.hpp"
#include "simulation/plugin.hpp"

namespace {

using namespace mudline;

struct HeatParameters {
  double conductivity = 0, capacity = 0, initial = 0;
};

/// The balance at a point: the storage is C dT/dt, the flux -lambda grad T.
struct Heat : PointLaw {
  static constexpr int fields = 1;
  static constexpr bool storages = true, fluxes = true, gradients = true, motion = false;
  HeatParameters values;

  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION void operator()(int, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    out.storage[0] = values.capacity * at.rate[0];
    for (int i = 0; i < C::dim; ++i) out.flux[0][i] = values.conductivity * at.gradient[0][i];
  }
};

class HeatConduction : public Physics {
 public:
  void parameters(Parameters& p) {
    p.required("conductivity", values_.conductivity, "W/(m K)", positive(), "of the ground as a whole");
    p.required("heat capacity", values_.capacity, "J/(m3 K)", positive(), "per volume of ground");
    p.add("initial temperature", values_.initial, "K", any(), "everywhere, at the start");
  }
  std::vector<Field> fields() const override { return {{"temperature", "K", "W", 1, Support::all_nodes, 1}}; }
  void build(PhysicsContext& context, const Section&) override {
    space_ = &context.space;
    const auto blocks = std::make_shared<std::vector<FieldBlock>>();
    const int count = static_cast<int>(context.space.mesh().blocks().size());
    for (int b = 0; b < count; ++b)
      blocks->emplace_back(context.space, b, -1, std::vector<int>{context.space.find("temperature")}, 4);
    const auto laws = [law = Heat{{}, values_}, blocks](const StepView& view, auto&& add) {
      if (!view.flow) return;  // a geostatic stage takes no time
      const Level start{view.time_old, view.x_old, 0.0};
      for (const FieldBlock& block : *blocks) add(block, loop_level(view, start, block), law);
    };
    context.terms.push_back(loop_term("heat", Role::balance, context.space.mesh().geometry(), laws, blocks));
  }
  void initialise(StateStore& store, const Section&) override {
    const auto& dof = space_->node_dof(space_->find("temperature"));
    for (int node = 0; node < space_->mesh().num_nodes(); ++node)
      if (dof(node) >= 0) store.committed().value(dof(node)) = values_.initial;
  }

 private:
  HeatParameters values_;
  const Space* space_ = nullptr;
};

}  // namespace

MUDLINE_PLUGIN(registries) {
  registries.physics.add<HeatConduction>("heat conduction",
                                         "temperature: storage and conduction of heat in the ground");
}
