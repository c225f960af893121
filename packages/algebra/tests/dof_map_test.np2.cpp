#include "algebra/dof_map.hpp"

#include <gtest/gtest.h>
#include <Tpetra_Core.hpp>

namespace mudline {
namespace {

TEST(DofMapTwoRanks, GhostsFollowTheOwnersNumbering) {
  const auto comm = Tpetra::getDefaultComm();
  const bool first = comm->getRank() == 0;
  std::vector<FieldLayout> fields;
  if (first)
    fields = {{"displacement", 2, {10, 12, 14}, 2}, {"pore pressure", 1, {10}, 1}};
  else
    fields = {{"displacement", 2, {14, 16, 12}, 2}, {"pore pressure", 1, {16, 10}, 1}};
  const DofMap dofs(comm, fields);
  ASSERT_EQ(dofs.num_owned_dofs(), 5);
  ASSERT_EQ(dofs.owned()->getGlobalNumElements(), 10u);
  if (first) {
    EXPECT_EQ(dofs.dof(0, 2), 5);
    EXPECT_EQ(dofs.overlap()->getGlobalElement(5), 5);  // node 14 is the other rank's first
    EXPECT_EQ(dofs.overlap()->getGlobalElement(6), 6);
  } else {
    EXPECT_EQ(dofs.overlap()->getGlobalElement(dofs.dof(0, 2)), 2);
    EXPECT_EQ(dofs.overlap()->getGlobalElement(dofs.dof(1, 1)), 4);
    EXPECT_EQ(dofs.field_of(dofs.dof(1, 1)), 1);
    EXPECT_EQ(dofs.field_map(1)->getGlobalElement(0), 9);
  }
  Vector owned(dofs.owned()), overlap(dofs.overlap());
  for (int i = 0; i < 5; ++i) owned.replaceLocalValue(i, static_cast<double>(dofs.owned()->getGlobalElement(i)));
  overlap.doImport(owned, *dofs.import(), Tpetra::INSERT);
  const auto values = overlap.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (int i = 0; i < dofs.num_overlap_dofs(); ++i) EXPECT_EQ(values(i, 0), dofs.overlap()->getGlobalElement(i));
}

TEST(DofMapTwoRanks, ARankMayHaveNothing) {
  const auto comm = Tpetra::getDefaultComm();
  std::vector<FieldLayout> fields{{"displacement", 2, {}, 0}};
  if (comm->getRank() == 1) fields = {{"displacement", 2, {4, 2}, 2}};
  const DofMap dofs(comm, fields);
  EXPECT_EQ(dofs.owned()->getGlobalNumElements(), 4u);
  EXPECT_EQ(dofs.num_owned_dofs(), comm->getRank() == 1 ? 4 : 0);
}

TEST(DofMapTwoRanks, AnUnownedNodeIsRefusedOnEveryRank) {
  const auto comm = Tpetra::getDefaultComm();
  std::vector<FieldLayout> fields{{"displacement", 2, {comm->getRank()}, 1}};
  if (comm->getRank() == 1) fields[0].node_ids.push_back(99);
  EXPECT_THROW(DofMap(comm, fields), std::logic_error);
}

}  // namespace
}  // namespace mudline
