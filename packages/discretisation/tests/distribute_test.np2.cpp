#include <gtest/gtest.h>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <set>

#include "discretisation/agree.hpp"
#include "discretisation/tests/mesh_fixture.hpp"

namespace mudline {
namespace {

using namespace mesh_test;

long long sum(long long value) {
  long long total = 0;
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, 1, &value, &total);
  return total;
}

double sum(double value) {
  double total = 0;
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, 1, &value, &total);
  return total;
}

/// Sums each entry over the ranks; there is one entry per global number.
std::vector<int> sum(std::vector<int> values) {
  std::vector<int> total(values.size());
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, static_cast<int>(values.size()), values.data(), total.data());
  return total;
}

const char* layered() {
  return "<Parameter name=\"layer tops\" type=\"Array(double)\" value=\"{0.5}\"/>"
         "<Parameter name=\"layer regions\" type=\"Array(string)\" value=\"{sand, clay}\"/>"
         "<Parameter name=\"distortion\" type=\"double\" value=\"0.2\"/>";
}

/// The whole mesh as its source generates it.
GlobalMesh whole(const std::string& entries) {
  Registry<MeshSource> sources("mesh source");
  register_mesh_sources(sources);
  return sources.create(mesh_section(entries))->generate();
}

class Distribution : public testing::TestWithParam<const char*> {
 protected:
  std::string entries_ = box(GetParam(), 10, 6, layered());
  std::unique_ptr<Mesh> mesh_ = make(entries_);
  GlobalMesh whole_ = whole(entries_);
};

TEST_P(Distribution, EveryElementIsSomewhereOnceAndKeepsItsNodes) {
  std::vector<int> count(mesh_->num_global_elements(), 0);
  std::vector<const long long*> nodes;
  for (const auto& block : whole_.blocks)
    for (std::size_t first = 0; first < block.nodes.size(); first += num_nodes(block.shape))
      nodes.push_back(block.nodes.data() + first);
  ASSERT_EQ(static_cast<long long>(nodes.size()), mesh_->num_global_elements());
  int mine = 0;
  for (const ElementBlock& block : mesh_->blocks()) {
    ASSERT_EQ(static_cast<int>(block.global_ids.size()), block.num_elements);
    mine += block.num_elements;
    for (int e = 0; e < block.num_elements; ++e) {
      ++count[block.global_ids[e]];
      for (int a = 0; a < num_nodes(block.shape); ++a)
        EXPECT_EQ(mesh_->node_ids()[block.nodes(e, a)], nodes[block.global_ids[e]][a]);
    }
  }
  for (int c : sum(count)) EXPECT_EQ(c, 1);
  const double share = static_cast<double>(mesh_->num_global_elements()) / world()->getSize();
  EXPECT_NEAR(mine, share, 0.2 * share);
}

TEST_P(Distribution, EveryNodeHasOneOwnerAndGhostsAreNeeded) {
  ASSERT_EQ(mesh_->num_global_nodes(), static_cast<long long>(whole_.coordinates.size()));
  std::vector<int> owners(mesh_->num_global_nodes(), 0), used(mesh_->num_nodes(), 0);
  for (int n = 0; n < mesh_->num_owned_nodes(); ++n) ++owners[mesh_->node_ids()[n]];
  for (int c : sum(owners)) EXPECT_EQ(c, 1);
  for (const ElementBlock& block : mesh_->blocks())
    for (int e = 0; e < block.num_elements; ++e)
      for (int a = 0; a < num_nodes(block.shape); ++a) used[block.nodes(e, a)] = 1;
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0) << "each rank has the nodes of its elements only";
  const std::set<long long> unique(mesh_->node_ids().begin(), mesh_->node_ids().end());
  EXPECT_EQ(unique.size(), mesh_->node_ids().size());
  EXPECT_LT(mesh_->num_nodes(), mesh_->num_global_nodes());
}

TEST_P(Distribution, CoordinatesAndVerticesAreThoseOfTheSource) {
  std::vector<int> vertex(mesh_->num_global_nodes(), 0);
  for (const auto& block : whole_.blocks)
    for (std::size_t i = 0; i < block.nodes.size(); ++i)
      if (static_cast<int>(i % num_nodes(block.shape)) < num_corners(block.shape)) vertex[block.nodes[i]] = 1;
  for (int n = 0; n < mesh_->num_nodes(); ++n) {
    const long long id = mesh_->node_ids()[n];
    EXPECT_EQ(mesh_->coordinates()(n, 0), whole_.coordinates[id][0]);
    EXPECT_EQ(mesh_->coordinates()(n, 1), whole_.coordinates[id][1]);
    EXPECT_EQ(static_cast<int>(mesh_->is_vertex()[n]), vertex[id]);
  }
}

TEST_P(Distribution, SetsAreConsistent) {
  EXPECT_EQ(mesh_->set_names(), (std::vector<std::string>{"bottom", "left", "right", "top"}));
  for (const std::string& set : mesh_->set_names()) {
    EXPECT_EQ(sum(static_cast<long long>(mesh_->side_sets().at(set).size())),
              static_cast<long long>(whole_.side_sets.at(set).size()));
    std::set<long long> expected;
    for (const auto& side : whole_.side_sets.at(set)) {
      const auto& block = whole_.blocks[side.block];
      for (int a : side_nodes(block.shape, side.side))
        expected.insert(block.nodes[side.element * num_nodes(block.shape) + a]);
    }
    const auto& nodes = mesh_->nodes_of_set(set);
    EXPECT_TRUE(std::is_sorted(nodes.begin(), nodes.end()));
    for (int n = 0; n < mesh_->num_nodes(); ++n)
      EXPECT_EQ(std::binary_search(nodes.begin(), nodes.end(), n), expected.count(mesh_->node_ids()[n]) != 0);
  }
  EXPECT_NEAR(sum(side_integral(*mesh_, "top")[2]), 2.0, 1e-13);
  EXPECT_NEAR(sum(side_integral(*mesh_, "left")[1]), -1.0, 1e-13);
}

TEST_P(Distribution, FactsOfTheWholeAreKnownEverywhere) {
  EXPECT_EQ(mesh_->regions(), (std::vector<std::string>{"sand", "clay"}));
  ASSERT_EQ(mesh_->blocks().size(), 2u);
  EXPECT_EQ(mesh_->bounds().low, (Point{0, 0, 0}));
  EXPECT_EQ(mesh_->bounds().high, (Point{2, 1, 0}));
  EXPECT_EQ(mesh_->region_bounds().at("sand").low[0], 0);
  EXPECT_EQ(mesh_->region_bounds().at("clay").high[1], 1);
  EXPECT_NEAR(sum(area(*mesh_)), 2.0, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Cells, Distribution, testing::Values("quad9", "tri6", "quad4", "tri3"),
                         [](const auto& info) { return std::string(info.param); });

TEST(DistributionErrors, EveryRankThrowsAlike) {
  for (const std::string& entries :
       {box("quad9", 1, 1),
        box("quad9", 4, 4,
            parameter("layer tops", "Array(double)", "{0.3}") + parameter("layer regions", "Array(string)", "{a, b}")),
        box("quad9", 4, 4,
            parameter("geometry", "string", "axisymmetric") + parameter("lower", "Array(double)", "{-1.0, 0.0}"))}) {
    const std::string mine = input_error([&] { make(entries); });
    EXPECT_CONTAINS(mine, "deck.xml:1: mesh");
    int size = static_cast<int>(mine.size());
    std::string first = mine;
    Teuchos::broadcast(*world(), 0, 1, &size);
    first.resize(size);
    Teuchos::broadcast(*world(), 0, size, first.data());
    EXPECT_EQ(mine, first);
  }
  EXPECT_CONTAINS(input_error([&] { make(box("quad9", 1, 1)); }),
                  "the mesh has 1 elements, fewer than the " + std::to_string(world()->getSize()) + " ranks");
}

TEST(DistributionErrors, FewElementsLeaveNoRankEmpty) {
  for (const char* cell : {"quad4", "tri6"}) {
    const auto mesh = make(box(cell, world()->getSize(), 1));
    EXPECT_GE(mesh->blocks()[0].num_elements, 1);
  }
}

TEST(Agree, AnErrorOnOneRankReachesAll) {
  const int rank = world()->getRank();
  for (int thrower : {0, 1})
    EXPECT_EQ(input_error([&] {
                agree(*world(), [&] {
                  if (rank == thrower) throw InputError("seen by one");
                });
              }),
              "seen by one");
  EXPECT_EQ(input_error([&] { agree(*world(), [&] { throw InputError("rank " + std::to_string(rank)); }); }), "rank 0");
  try {
    agree(*world(), [&] {
      if (rank == 1) throw std::logic_error("misuse");
    });
    FAIL();
  } catch (const std::exception& error) {
    EXPECT_STREQ(error.what(), "misuse");
    EXPECT_EQ(dynamic_cast<const std::logic_error*>(&error) != nullptr, rank == 1);
  }
  EXPECT_NO_THROW(agree(*world(), [] {}));
}

#ifdef MUDLINE_HAVE_GMSH
TEST(DistributionGmsh, PartsMakeTheWholeAndErrorsReachBothRanks) {
  const auto mesh = make(gmsh("cone.geo"));
  EXPECT_NEAR(sum(area(*mesh, "sand")), 3, 1e-9);
  EXPECT_NEAR(sum(side_integral(*mesh, "right")[1]), 2, 1e-9);
  for (int node : mesh->nodes_of_set("tip")) EXPECT_NEAR(mesh->coordinates()(node, 1), 1.5, 1e-12);
  EXPECT_GE(sum(static_cast<long long>(mesh->nodes_of_set("tip").size())), 1);
  EXPECT_CONTAINS(input_error([&] { make(gmsh("no_group.geo")); }), "belong to no physical group");
  EXPECT_CONTAINS(input_error([&] { make(gmsh("syntax_error.geo")); }), "Gmsh, reading");
}
#endif

}  // namespace
}  // namespace mudline
