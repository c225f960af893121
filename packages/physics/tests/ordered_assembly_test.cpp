// What loops over elements add in batches, row by row, has the bits of what they add at once.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "soil_model.hpp"
#include "tensor/vec.hpp"

namespace mudline {
namespace {

struct Assembled {
  std::vector<double> sum, acting, whole, matrix;
  int failures = 0;
};

Assembled assemble(int batch, const std::string& geometry, bool folded) {
  SoilModel model(section_xml("push", text_parameter("type", "pressure") + text_parameter("set", "top") +
                                          number_parameter("value", 3e4)),
                  array_parameter("gravity", "0, -10"), SoilModel::box(geometry));
  for (SoilBlock& block : model.soil->blocks) block.rows = block.mass.rows = RowLists(block.dofs, batch);
  const auto wave = [](double x, double y) {
    return Vec<double, 2>{1e-2 * std::sin(3 * x + y), 2e-2 * std::cos(x - 2 * y)};
  };
  model.set_motion(model.store->trial().value, wave);
  model.set_motion(model.rate, wave);
  model.set_motion(model.acceleration, wave);
  model.set_pressure(model.value, [](double x, double y) { return 1e4 * std::exp(x - y); });
  model.set_pressure(model.rate, [](double x, double y) { return 1e3 * x * y; });
  for (int node = 0; node < model.mesh->num_nodes(); ++node)
    for (int i = 0; i < 2; ++i)
      model.store->trial().coordinates(node, i) =
          model.x(node, i) + (folded && node == 0 ? 3.0 : 1.0) * wave(model.x(node, 0), model.x(node, 1))[i] +
          (folded && node == 0 ? 2.5 : 0.0);
  model.view.sensitivity.assign(2, {1, 2, 2, 3});
  std::vector<Term*> terms;
  for (const auto& term : model.terms) terms.push_back(term.get());
  terms.push_back(model.named.at("push")->term());
  Assembler assembler(model.space->dofs());
  for (Term* term : terms) term->sparsity(assembler);
  assembler.finalise();
  const int dofs = model.space->dofs()->num_overlap_dofs();
  const NodalView sum("sum", dofs), acting("acting", dofs), whole("whole", dofs);
  assembler.begin(Kokkos::View<char*>("constrained", dofs));
  Assembled result;
  for (Term* term : terms) {
    term->begin(model.view);
    result.failures += term->residual(model.view, ResidualView(sum, acting, whole));
    term->jacobian(model.view, assembler, 0.7);
  }
  assembler.end();
  const auto list = [](const auto& view) { return std::vector<double>(view.data(), view.data() + view.extent(0)); };
  result.sum = list(sum);
  result.acting = list(acting);
  result.whole = list(whole);
  result.matrix = list(assembler.matrix()->getLocalMatrixHost().values);
  return result;
}

TEST(OrderedAssembly, HasTheBitsOfAddingAtOnce) {
  for (const std::string geometry : {"plane strain", "axisymmetric"})
    for (const bool folded : {false, true}) {
      const Assembled at_once = assemble(0, geometry, folded);
      EXPECT_EQ(at_once.failures > 0, folded);
      for (const int batch : {1, 4, 64}) {
        const Assembled ordered = assemble(batch, geometry, folded);
        EXPECT_EQ(ordered.sum, at_once.sum) << geometry << batch;
        EXPECT_EQ(ordered.acting, at_once.acting);
        EXPECT_EQ(ordered.whole, at_once.whole);
        EXPECT_EQ(ordered.matrix, at_once.matrix);
        EXPECT_EQ(ordered.failures, at_once.failures);
      }
      EXPECT_GT(*std::max_element(at_once.acting.begin(), at_once.acting.end()), 0);
    }
}

}  // namespace
}  // namespace mudline
