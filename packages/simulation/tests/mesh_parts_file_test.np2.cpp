#include "simulation/output/mesh_parts_file.hpp"

#include <Teuchos_CommHelpers.hpp>

#include "discretisation/agree.hpp"
#include "discretisation/distribute.hpp"
#include "discretisation/tests/mesh_fixture.hpp"
#include "simulation/tests/output_fixture.hpp"

namespace mudline {
namespace {

using mesh_test::box;
using mesh_test::box3;
using mesh_test::mesh_section;
using mesh_test::parameter;
using mesh_test::world;
using output_test::content;
using output_test::Folder;

MeshRecipe recipe(const std::string& entries, const ContactSets& contacts = {}) {
  Registry<MeshSource> sources("mesh source");
  register_mesh_sources(sources);
  return {sources, mesh_section(entries), contacts};
}

/// Splits a mesh on rank 0, as the command does.
void split(const MeshRecipe& recipe, int ranks, const std::string& path) {
  agree(*world(), [&] {
    if (world()->getRank() == 0) write_mesh_parts(recipe, ranks, path);
  });
}

std::string refusal(const MeshRecipe& recipe, const std::string& path) {
  return input_error([&] { read_mesh_parts(world(), recipe, path); });
}

void expect_equal(const Mesh& one, const Mesh& other) {
  EXPECT_EQ(one.geometry(), other.geometry());
  EXPECT_EQ(one.num_global_nodes(), other.num_global_nodes());
  EXPECT_EQ(one.num_global_elements(), other.num_global_elements());
  EXPECT_EQ(one.num_owned_nodes(), other.num_owned_nodes());
  ASSERT_EQ(one.node_ids(), other.node_ids());
  EXPECT_EQ(one.is_vertex(), other.is_vertex());
  for (int node = 0; node < one.num_nodes(); ++node) EXPECT_EQ(one.place(node), other.place(node));
  ASSERT_EQ(one.blocks().size(), other.blocks().size());
  for (std::size_t b = 0; b < one.blocks().size(); ++b) {
    const ElementBlock &block = one.blocks()[b], &same = other.blocks()[b];
    EXPECT_EQ(block.region, same.region);
    EXPECT_EQ(block.shape, same.shape);
    ASSERT_EQ(block.global_ids, same.global_ids);
    for (int e = 0; e < block.num_elements; ++e)
      for (int a = 0; a < num_nodes(block.shape); ++a) EXPECT_EQ(block.nodes(e, a), same.nodes(e, a));
  }
  EXPECT_EQ(one.regions(), other.regions());
  EXPECT_EQ(one.set_names(), other.set_names());
  EXPECT_EQ(one.node_sets(), other.node_sets());
  for (const std::string& set : one.set_names()) EXPECT_EQ(one.nodes_of_set(set), other.nodes_of_set(set));
  for (const auto& [name, sides] : one.side_sets()) {
    const auto& same = other.side_sets().at(name);
    ASSERT_EQ(sides.size(), same.size());
    for (std::size_t i = 0; i < sides.size(); ++i) {
      EXPECT_EQ(sides[i].block, same[i].block);
      EXPECT_EQ(sides[i].element, same[i].element);
      EXPECT_EQ(sides[i].side, same[i].side);
    }
  }
  for (const auto& [region, bounds] : one.region_bounds()) {
    EXPECT_EQ(bounds.low, other.region_bounds().at(region).low);
    EXPECT_EQ(bounds.high, other.region_bounds().at(region).high);
  }
  EXPECT_EQ(one.bounds().low, other.bounds().low);
  EXPECT_EQ(one.bounds().high, other.bounds().high);
}

std::string layers() {
  return parameter("layer tops", "Array(double)", "{0.5}") +
         parameter("layer regions", "Array(string)", "{sand/silt, clay}") + parameter("distortion", "double", "0.2");
}

TEST(MeshPartsFile, GivesEachRankThePartThatItWouldBeSent) {
  Folder folder;
  const ContactSets contacts{{{"top", "right"}}, {"top"}};
  for (const std::string& entries : {box("tri6", 10, 6, layers()), box3("tet10", 4, 2, 3), box("quad9", 3, 4)}) {
    const MeshRecipe how = recipe(entries, contacts);
    split(how, 2, folder / "parts.h5");
    expect_equal(*make_mesh(world(), how), *read_mesh_parts(world(), how, folder / "parts.h5"));
  }
}

#ifdef MUDLINE_HAVE_GMSH
TEST(MeshPartsFile, KnowsTheFileOfTheMeshByItsContent) {
  Folder folder;
  const std::string geometry = folder / "square.geo";
  const auto write = [&](const std::string& text) {
    if (world()->getRank() == 0) std::ofstream(geometry) << text;
    world()->barrier();
  };
  const std::string square =
      "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 1, 1}; Physical Surface(\"soil\") = {1};"
      "Physical Curve(\"side/by side\") = {4}; Physical Point(\"corner\") = {1}; MeshSize{:} = 0.3;\n";
  write(square);
  const MeshRecipe how = recipe(mesh_test::gmsh(geometry));
  split(how, 2, folder / "parts.h5");
  expect_equal(*make_mesh(world(), how), *read_mesh_parts(world(), how, folder / "parts.h5"));
  write(square + "// changed\n");
  EXPECT_CONTAINS(refusal(how, folder / "parts.h5"), "the file that it is read from has changed since; run `mudline");
}
#endif

TEST(MeshPartsFile, RefusesOtherRanksAndOtherMeshes) {
  Folder folder;
  const std::string path = folder / "parts.h5";
  const MeshRecipe how = recipe(box("quad9", 8, 4));
  EXPECT_EQ(refusal(how, path), path + ": there is no such file of mesh parts; `mudline split` writes one");
  split(how, 3, path);
  EXPECT_EQ(refusal(how, path), path +
                                    ": the mesh was split for 3 ranks, but the run has 2; start it on 3, or run "
                                    "`mudline split` again with --ranks 2");
  split(how, 2, path);
  EXPECT_EQ(refusal(recipe(box("quad9", 8, 5)), path),
            path + ": the parts are those of another mesh: mesh/cells: {8, 5}, was {8, 4}; run `mudline split` again");
  EXPECT_CONTAINS(refusal(recipe(box("quad9", 8, 4), {{{"top", "left"}}, {}}), path), "surfaces in contact: top with");
  EXPECT_CONTAINS(refusal(recipe(box("quad9", 8, 4), {{}, {"top"}}), path), "surfaces in contact: top");
}

/// An error that one rank alone sees is thrown on both: a bit of rank 1's coordinates has changed, or the file is cut
/// short.
TEST(MeshPartsFile, RefusesWhatIsDamaged) {
  Folder folder;
  const std::string path = folder / "parts.h5";
  const MeshRecipe how = recipe(box("quad9", 8, 4));
  split(how, 2, path);
  const std::string whole = content(path);
  const auto replace = [&](const std::string& text) {
    world()->barrier();
    if (world()->getRank() == 0) std::ofstream(path, std::ios::binary) << text;
    world()->barrier();
  };
  // coordinates of a node that lies in the second part only
  const auto mesh = read_mesh_parts(world(), how, path);
  double at[2] = {mesh->place(mesh->num_owned_nodes() / 2)[0], mesh->place(mesh->num_owned_nodes() / 2)[1]};
  Teuchos::broadcast(*world(), 1, 2, at);
  std::string flipped = whole;
  const std::size_t place = whole.find(std::string(reinterpret_cast<const char*>(at), sizeof at));
  ASSERT_NE(place, std::string::npos);
  flipped[place + 2] ^= 4;
  replace(flipped);
  EXPECT_EQ(refusal(how, path), path + ": 'part 1' is damaged: its checksum does not fit its content");
  replace(whole.substr(0, whole.size() / 2));
  EXPECT_CONTAINS(refusal(how, path), path + ": the mesh parts cannot be read: cannot open");
  replace("no HDF5");
  EXPECT_CONTAINS(refusal(how, path), path + ": the mesh parts cannot be read: cannot open");
  replace(whole);
  EXPECT_NO_THROW(read_mesh_parts(world(), how, path));
}

/// A side in contact costs as much as two elements, so the rank that has more of them has fewer elements.
TEST(MeshPartsFile, PartsAreBalancedByTheWorkOfContactToo) {
  const int ranks = 4;
  const GlobalMesh mesh = recipe(box("quad9", 24, 12), {{}, {"left"}}).make();
  const std::vector<int> rank_of = partition_elements(mesh, ranks);
  std::vector<int> elements(ranks, 0), sides(ranks, 0);
  for (int rank : rank_of) ++elements[rank];
  for (const auto& side : mesh.side_sets.at("left")) ++sides[rank_of[side.element]];
  for (int rank = 0; rank < ranks; ++rank)
    EXPECT_NEAR(elements[rank] + 2 * sides[rank], (24 * 12 + 2 * 12) / ranks, 0.05 * (24 * 12 + 2 * 12) / ranks);
  EXPECT_GT(*std::max_element(elements.begin(), elements.end()) - *std::min_element(elements.begin(), elements.end()),
            10);
}

}  // namespace
}  // namespace mudline
