#include <gtest/gtest.h>

#include <Teuchos_CommHelpers.hpp>

#include "contact_model.hpp"
#include "framework/nodal_exchange.hpp"

namespace mudline {
namespace {

TEST(NodalExchange, EveryCopyOfANodeGetsTheSum) {
  const Mesh mesh(Tpetra::getDefaultComm(), Geometry::plane_strain, strip(Cells::quad9, 6, 2, 0, 1, 1, 0));
  const NodalExchange exchange(mesh);
  // every rank contributes its element count at each node; the sum must be that of the whole mesh, known from the
  // position
  std::vector<double> count(mesh.num_nodes(), 0.0);
  const ElementBlock& block = mesh.blocks()[0];
  for (int e = 0; e < block.num_elements; ++e)
    for (int a = 0; a < 9; ++a) count[block.nodes(e, a)] += 1;
  exchange.sum_shared(count);
  for (int node = 0; node < mesh.num_nodes(); ++node) {
    const double column = 12 * mesh.coordinates()(node, 0), row = 4 * (mesh.coordinates()(node, 1) + 1);
    const auto elements = [](double position, int last) {
      const int i = static_cast<int>(std::lround(position));
      return i % 2 == 0 && i > 0 && i < last ? 2 : 1;
    };
    EXPECT_EQ(count[node], elements(column, 12) * elements(row, 4)) << column << " " << row;
  }
}

TEST(SealedVertices, AgreeAcrossRanksWhereverTheMeshIsCut) {
  ContactModel model(Geometry::plane_strain, strip(Cells::tri6, 8, 2, 0, 1, 1, 0),
                     body_xml("b", text_parameter("type", "flat pile") + number_parameter("diameter", 1.5),
                              text_parameter("type", "prescribed velocity") + number_parameter("velocity y", -0.01)),
                     contact_parameters("surface quadrature", 1e6));
  const auto values = model.step(1);
  EXPECT_NEAR(values.at("contact/c/reaction y").value, 1e6 * 0.01 * 0.75, 1e-5);
  EXPECT_NEAR(values.at("contact/c/work").value, 0.5 * 1e6 * 0.01 * 0.01 * 0.75, 1e-6);
  EXPECT_EQ(values.at("contact/c/active points").value, 6 * 3);
  model.begin(1);
  const int p = model.space.find("pore pressure");
  const std::vector<double> free = released(model, "surface");
  const auto pressure = model.contact->nodal_pressure(model.store.committed());
  for (int node = 0; node < model.mesh.num_nodes(); ++node) {
    const double x = model.mesh.coordinates()(node, 0), y = model.mesh.coordinates()(node, 1);
    const bool surface = y == 0;
    const int dof = model.space.node_dof(p)(node);
    if (dof >= 0 && surface) {
      EXPECT_EQ(std::count(free.begin(), free.end(), x), x < 0.74 ? 1 : 0) << x;
    }
    if (surface && x < 0.74) {
      EXPECT_NEAR(pressure[node], 1e4, 1e-6) << x;
    }
  }
  // both ranks hold a part of the mesh, so that the cut is met
  const int here = model.mesh.blocks()[0].num_elements;
  int fewest = 0;
  Teuchos::reduceAll(*model.mesh.comm(), Teuchos::REDUCE_MIN, here, Teuchos::outArg(fewest));
  EXPECT_GT(fewest, 0);
}

TEST(SealedVertices, InitialOverlapIsToldAlikeOnEveryRank) {
  std::string message;
  try {
    ContactModel(Geometry::plane_strain, strip(Cells::quad4, 8, 2, 0, 1, 1, 0),
                 body_xml("b", text_parameter("type", "sphere") + number_parameter("diameter", 0.6),
                          text_parameter("type", "prescribed velocity"), "0.9, -0.25"),
                 contact_parameters("nodes", 1e6));
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_NE(message.find("overlaps the surface by 0.2441 m at (0.875, 0)"), std::string::npos) << message;
}

}  // namespace
}  // namespace mudline
