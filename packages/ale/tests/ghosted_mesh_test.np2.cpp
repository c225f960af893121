// What two ranks make of a mesh in two parts is what one rank makes of the whole, to the last bit.
#include "ale/ghosted_mesh.hpp"

#include <gtest/gtest.h>

#include <Teuchos_DefaultSerialComm.hpp>

#include "ale/conservation.hpp"
#include "ale/interior_motion.hpp"
#include "ale/nodal_remap.hpp"
#include "ale/remap.hpp"
#include "ale/vertex_colours.hpp"
#include "ale_mesh.hpp"

namespace mudline {
namespace {

using testing::box;
using testing::points_of;

constexpr int n = 12;

/// A box, by this rank alone or by all together.
struct Part {
  Part(CellShape shape, bool alone, int layers)
      : mesh(box(shape, n, 0.2, 1.0,
                 alone ? Teuchos::RCP<const Teuchos::Comm<int>>(Teuchos::rcp(new Teuchos::SerialComm<int>()))
                       : Tpetra::getDefaultComm())),
        ghosted(*mesh, layers),
        start(ghosted.gather(mesh->coordinates())),
        paths(find_paths(ghosted, start, {}, 0.5)),
        corners(ghosted),
        movable(ghosted.num_nodes(), 0),
        block(points_of(*mesh)),
        patches(ghosted, block) {
    block.made_of = {0};
    for (int node = 0; node < ghosted.num_nodes(); ++node) movable[node] = ghosted.is_vertex(node);
    for (const MeshPath& path : paths)
      for (int node : path.nodes) movable[node] = 0;
    corners.add_tangents(start, start);
  }
  Positions moved(const InteriorMotion& motion) const {
    Positions x = start;
    for (const MeshPath& path : paths)
      for (int node : path.nodes) x[node][1] *= 1 - 0.05 * std::sin(3 * start[node][0]) * start[node][1];
    corners.add_tangents(x, x);
    motion.move({ghosted, corners, start, start, movable, vertex_colours(ghosted, movable), 0.3}, x);
    x.resize(ghosted.num_nodes());
    return x;
  }
  std::unique_ptr<Mesh> mesh;
  GhostedMesh ghosted;
  Positions start;
  std::vector<MeshPath> paths;
  CornerSimplices corners;
  std::vector<char> movable;
  SoilBlock block;
  RecoveryPatches patches;
};

struct Both {
  explicit Both(CellShape shape, int layers = 2) : whole(shape, true, GhostedMesh::whole), part(shape, false, layers) {}
  /// The number in the whole mesh.
  int in_whole(int node) const { return static_cast<int>(part.ghosted.node_id(node)); }
  Part whole, part;
};

TEST(GhostedMesh, HasItsPartsAndWhatIsAroundThem) {
  for (CellShape shape : {CellShape::tri6, CellShape::quad9})
    for (int layers : {1, 2, GhostedMesh::whole}) {
      const Both both(shape, layers);
      const GhostedMesh &mesh = both.part.ghosted, &whole = both.whole.ghosted;
      const bool all = layers == GhostedMesh::whole;
      EXPECT_EQ(mesh.elements().size() == whole.elements().size(), all);
      EXPECT_EQ(mesh.sum(static_cast<double>(mesh.owned_nodes().size())), whole.num_nodes());
      std::vector<int> around(whole.num_nodes(), 0), around_here(mesh.num_nodes(), 0);
      for (const auto& element : whole.elements())
        for (int a = 0; a < num_nodes(shape); ++a) ++around[element.nodes[a]];
      for (const auto& element : mesh.elements())
        for (int a = 0; a < num_nodes(shape); ++a) ++around_here[element.nodes[a]];
      for (int node = 0; node < mesh.num_nodes(); ++node) {
        EXPECT_EQ(mesh.is_vertex(node), whole.is_vertex(both.in_whole(node)));
        EXPECT_EQ(both.part.start[node], both.whole.start[both.in_whole(node)]);
        if (node > 0) {
          EXPECT_GT(mesh.node_id(node), mesh.node_id(node - 1));
        }
        if (mesh.is_complete(node)) {
          EXPECT_EQ(around_here[node], around[both.in_whole(node)]);
        }
        if (mesh.owns(node)) {
          EXPECT_TRUE(mesh.is_complete(node));
        }
      }
      int outer = 0, unknown = 0;
      for (const auto& element : mesh.elements())
        for (int s = 0; s < num_sides(shape); ++s) {
          outer += element.neighbours[s] == GhostedMesh::outside;
          unknown += element.neighbours[s] == GhostedMesh::unknown;
        }
      EXPECT_EQ(unknown == 0, all);
      EXPECT_LE(outer, 4 * n);
      EXPECT_EQ(mesh.boundary().size(), 4u * n);
      EXPECT_EQ(mesh.sum(static_cast<double>(mesh.side_sets().at("top").size())) >= n, true);
      ASSERT_EQ(both.part.paths.size(), both.whole.paths.size());
      for (std::size_t p = 0; p < both.part.paths.size(); ++p) {
        ASSERT_EQ(both.part.paths[p].nodes.size(), both.whole.paths[p].nodes.size());
        EXPECT_EQ(both.part.paths[p].sets, both.whole.paths[p].sets);
        for (std::size_t i = 0; i < both.part.paths[p].nodes.size(); ++i)
          EXPECT_EQ(both.in_whole(both.part.paths[p].nodes[i]), both.whole.paths[p].nodes[i]);
      }
    }
}

TEST(GhostedMesh, OwnersFillWhatTheOthersHave) {
  const Both both(CellShape::tri6);
  const GhostedMesh& mesh = both.part.ghosted;
  std::vector<double> values(2 * mesh.num_nodes(), -1.0), rows(mesh.block_elements(0).size() * 6, -1.0);
  for (int node : mesh.owned_nodes())
    for (int c = 0; c < 2; ++c) values[2 * node + c] = 10.0 * mesh.node_id(node) + c;
  mesh.fill(values, 2);
  for (int node = 0; node < mesh.num_nodes(); ++node)
    for (int c = 0; c < 2; ++c) EXPECT_EQ(values[2 * node + c], 10.0 * mesh.node_id(node) + c);
  const auto first_node = [&](int e) { return static_cast<double>(mesh.node_id(mesh.elements()[e].nodes[0])); };
  for (int e : mesh.own_elements(0))
    for (int i = 0; i < 6; ++i) rows[6 * mesh.first_row(e, 1) + i] = first_node(e) + 0.1 * i;
  mesh.fill_points(0, 3, 2, rows);
  for (int e : mesh.block_elements(0))
    for (int i = 0; i < 6; ++i) EXPECT_EQ(rows[6 * mesh.first_row(e, 1) + i], first_node(e) + 0.1 * i);
}

TEST(GhostedMesh, TheInteriorMovesAsOnOneRank) {
  for (CellShape shape : {CellShape::tri6, CellShape::quad9}) {
    const Both both(shape);
    const auto check = [&](const InteriorMotion& motion, double tolerance) {
      const Positions here = both.part.moved(motion), there = both.whole.moved(motion);
      double off = 0, way = 0;
      for (int node = 0; node < both.part.ghosted.num_nodes(); ++node)
        for (int d = 0; d < place_size; ++d) {
          off = std::max(off, std::abs(here[node][d] - there[both.in_whole(node)][d]));
          if (both.part.movable[node]) way = std::max(way, std::abs(here[node][d] - both.part.start[node][d]));
        }
      EXPECT_LE(off, tolerance);
      EXPECT_GT(both.part.ghosted.largest(way), 1e-3);
    };
    check(OptimisationMotion(), 0);
    check(ElasticMotion(), 1e-9);  // sums over ranks round differently
  }
}

TEST(GhostedMesh, PointsAndNodesAreCarriedAsOnOneRank) {
  for (CellShape shape : {CellShape::tri6, CellShape::quad9}) {
    const Both both(shape, 4);
    ASSERT_FALSE(both.part.ghosted.any(both.part.patches.cut()));
    struct Carried {
      std::vector<double> points, nodes;
      double lost;
    };
    const auto carried = [](const Part& part) {
      const Positions to = part.moved(OptimisationMotion());
      const auto field = [](double x, double y) { return 1 + 0.4 * std::sin(5 * x) * std::cos(4 * y); };
      std::vector<double> old(part.ghosted.block_elements(0).size() * part.block.points), nodal;
      for (int e : part.ghosted.block_elements(0))
        for (int q = 0; q < part.block.points; ++q) {
          const auto at = Recovery::position(part.ghosted.elements()[e], part.block, q, part.start);
          old[part.ghosted.first_row(e, part.block.points) + q] = field(at[0], at[1]);
        }
      for (int node = 0; node < part.ghosted.num_nodes(); ++node)
        nodal.push_back(field(part.start[node][0], part.start[node][1]));
      Carried result{old, {}, 0};
      const std::vector<StateVariable> variables{{"void ratio", 1, "-"}};
      const PointTransfer transfer{{part.ghosted, part.block, part.start},
                                   {part.ghosted, part.block, to},
                                   part.patches,
                                   variables,
                                   1,
                                   old,
                                   result.points};
      ConvectionRemap().transfer(transfer);
      Soil soil;
      soil.geometry = Geometry::plane_strain;
      std::vector<double> transported = result.points;
      result.lost = restore_grains(transfer, soil, 0, -1)[0].lost();
      result.points = transported;
      result.nodes = NodalRemap(part.ghosted, part.paths, part.start, to).apply(nodal, 1, Support::all_nodes);
      return result;
    };
    const Carried here = carried(both.part), there = carried(both.whole);
    EXPECT_GT(std::abs(there.lost), 1e-9);
    EXPECT_NEAR(here.lost / there.lost, 1, 1e-6);
    for (int node = 0; node < both.part.ghosted.num_nodes(); ++node)
      EXPECT_EQ(here.nodes[node], there.nodes[both.in_whole(node)]);
    const auto& ids = both.part.mesh->blocks()[0].global_ids;
    for (std::size_t e = 0; e < ids.size(); ++e)
      for (int q = 0; q < both.part.block.points; ++q)
        EXPECT_EQ(
            here.points[both.part.ghosted.first_row(both.part.ghosted.own_elements(0)[e], both.part.block.points) + q],
            there.points[static_cast<int>(ids[e]) * both.part.block.points + q]);
  }
}

/// Another mesh of the same box, and what of `part` lies where this rank has elements of it.
struct Renewed {
  Renewed(const Part& part, bool alone)
      : mesh(box(CellShape::tri6, 9, 0.2, 1.0, part.mesh->comm())),
        to(*mesh, alone ? GhostedMesh::whole : 2),
        x_to(to.gather(mesh->coordinates())),
        wanted{part.mesh->coordinates(), boxes()},
        from(*part.mesh, alone ? GhostedMesh::whole : 4, &wanted),
        x_from(from.gather(part.mesh->coordinates())),
        old_block(points_of(*part.mesh)),
        block(points_of(*mesh)) {}
  std::vector<Bounds> boxes() const {
    std::vector<Bounds> result;
    for (int e : to.own_elements(0)) {
      result.push_back(Bounds::nothing());
      enclose(result.back(), to.elements()[e], x_to);
    }
    return result;
  }
  std::vector<double> nodes() const {
    std::vector<double> old;
    for (const Point& at : x_from) old.push_back(field(at));
    const auto paths = [](const GhostedMesh& mesh, const Positions& x) { return find_paths(mesh, x, {}, 0.5); };
    return NodalRemap({from, paths(from, x_from), {}, x_from}, {to, paths(to, x_to), {}, x_to})
        .apply(old, 1, Support::all_nodes);
  }
  std::vector<double> points() const {
    std::vector<double> old(from.block_elements(0).size() * old_block.points),
        now(to.block_elements(0).size() * block.points);
    for (int e : from.block_elements(0))
      for (int q = 0; q < old_block.points; ++q)
        old[from.first_row(e, old_block.points) + q] =
            field(Recovery::position(from.elements()[e], old_block, q, x_from));
    const RecoveryPatches patches(from, old_block);
    const std::vector<StateVariable> variables{{"void ratio", 1, "-"}};
    RecoveryRemap().transfer({{from, old_block, x_from}, {to, block, x_to}, patches, variables, 1, old, now});
    return now;
  }
  static double field(const Point& x) { return 1 + 0.4 * std::sin(5 * x[0]) * std::cos(4 * x[1]); }
  std::unique_ptr<Mesh> mesh;
  GhostedMesh to;
  Positions x_to;
  GhostedMesh::Wanted wanted;
  GhostedMesh from;
  Positions x_from;
  SoilBlock old_block, block;
};

TEST(GhostedMesh, GoesOverToAnotherMeshAsOnOneRank) {
  const Both both(CellShape::tri6, 4);
  const Renewed here(both.part, false), there(both.whole, true);
  const int few = static_cast<int>(here.from.elements().size()), all = static_cast<int>(there.from.elements().size());
  EXPECT_LE(few, all);
  EXPECT_GT(few, all / 2);
  const std::vector<double> nodes = here.nodes(), all_nodes = there.nodes(), points = here.points(),
                            all_points = there.points();
  for (int node = 0; node < here.to.num_nodes(); ++node)
    EXPECT_NEAR(nodes[node], all_nodes[here.to.node_id(node)], 1e-14);
  const auto& ids = here.mesh->blocks()[0].global_ids;
  for (std::size_t e = 0; e < ids.size(); ++e)
    for (int q = 0; q < here.block.points; ++q)
      EXPECT_NEAR(points[here.to.first_row(here.to.own_elements(0)[e], here.block.points) + q],
                  all_points[static_cast<int>(ids[e]) * here.block.points + q], 1e-14);
}

}  // namespace
}  // namespace mudline
