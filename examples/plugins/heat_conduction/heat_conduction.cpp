// A second physics: the field "temperature" and its balance  C dT/dt = div(lambda grad T).
//
// It stands alone, or in a deck beside "biot" or "solid": then all fields are unknowns of one monolithic system, and
// heat is carried along with the deforming ground. Integrals are on the configuration at the start of the step, so that
// the balance does not depend on the unknown displacements.
#include <memory>

#include "physics/element.hpp"
#include "physics/physics.hpp"
#include "simulation/plugin.hpp"

namespace {

using namespace mudline;

struct HeatParameters {
  double conductivity = 0, capacity = 0, initial = 0;
};

/// Elements of one block with what their kernels need.
struct HeatBlock {
  CellShape shape;
  int elements, group = -1;
  ShapeTable table;
  Kokkos::View<int**, Kokkos::LayoutRight> nodes;
  ElementDofs dofs;
};

/// One part of the balance: int N C Tdot dv (storage) or int grad N . lambda grad T dv (conduction).
class HeatTerm : public Term {
 public:
  enum class Part { storage, conduction };
  HeatTerm(const Space& space, HeatParameters values, Part part)
      : values_(values),
        part_(part),
        field_(space.find("temperature")),
        axisymmetric_(space.mesh().geometry() == Geometry::axisymmetric) {
    const auto& blocks = space.mesh().blocks();
    for (int b = 0; b < static_cast<int>(blocks.size()); ++b)
      blocks_.push_back({blocks[b].shape, blocks[b].num_elements, -1,
                         tabulate(blocks[b].shape, cell_quadrature(blocks[b].shape, 4)), blocks[b].nodes,
                         space.element_dofs(b, {field_})});
  }
  std::string name() const override { return part_ == Part::storage ? "heat storage" : "heat conduction"; }

  void sparsity(Assembler& assembler) override {
    for (HeatBlock& block : blocks_) block.group = assembler.add_group(block.dofs);
  }

  int residual(const StepView& view, const ResidualView& f) override {
    if (!view.flow) return 0;  // a geostatic stage takes no time
    const ConstNodalView& field = part_ == Part::storage ? view.rate : view.value;
    return for_each_element(view, [&](const HeatBlock& block, int e, auto& matrix) {
      constexpr int N = std::extent_v<std::remove_reference_t<decltype(matrix)>>;
      double value[N], r[N];
      gather<N>(block.dofs, e, 0, field, value);
      for (int a = 0; a < N; ++a) {
        r[a] = 0;
        for (int b = 0; b < N; ++b) r[a] += matrix[a][b] * value[b];
      }
      scatter_vector<N>(block.dofs, e, 0, r, f);
    });
  }

  void jacobian(const StepView& view, Assembler& assembler, double weight) override {
    if (!view.flow) return;
    const Sensitivity& s = view.sensitivity[field_];
    const double factor = weight * (part_ == Part::storage ? s.rate : s.value);
    for_each_element(view, [&](const HeatBlock& block, int e, auto& matrix) {
      constexpr int N = std::extent_v<std::remove_reference_t<decltype(matrix)>>;
      scatter_matrix<N, N>(assembler.scatter(block.group), e, 0, 0, matrix, factor);
    });
  }

 private:
  /// Calls f(block, element, element matrix); returns the number of elements that are turned inside out.
  template <class F>
  int for_each_element(const StepView& view, F&& f) const {
    int failures = 0;
    for (const HeatBlock& block : blocks_)
      dispatch_pair(block.shape, false, [&](auto pair) {
        constexpr int N = decltype(pair)::NU;
        for (int e = 0; e < block.elements; ++e) {
          double x[N][2], matrix[N][N] = {{0}};
          gather<N>(block.nodes, e, view.x_old, x);
          bool ok = true;
          for (int q = 0; q < block.table.points; ++q) {
            PointGeometry<N> at;
            at.compute(x, &block.table.dN(q, 0, 0), &block.table.N(q, 0), axisymmetric_);
            ok = ok && at.ok;
            const double dv = at.volume(block.table.weights(q));
            for (int a = 0; a < N; ++a)
              for (int b = 0; b < N; ++b)
                matrix[a][b] += dv * (part_ == Part::storage
                                          ? values_.capacity * block.table.N(q, a) * block.table.N(q, b)
                                          : values_.conductivity * (at.g[a][0] * at.g[b][0] + at.g[a][1] * at.g[b][1]));
          }
          if (ok)
            f(block, e, matrix);
          else
            ++failures;
        }
      });
    return failures;
  }

  HeatParameters values_;
  Part part_;
  int field_;
  bool axisymmetric_;
  std::vector<HeatBlock> blocks_;
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
    for (auto part : {HeatTerm::Part::storage, HeatTerm::Part::conduction})
      context.terms.push_back(std::make_unique<HeatTerm>(context.space, values_, part));
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
