#include "algebra/dof_map.hpp"

#include <gtest/gtest.h>
#include <Tpetra_Core.hpp>

namespace mudline {
namespace {

TEST(DofMap, FieldAfterFieldComponentsAdjacent) {
  const DofMap dofs(Tpetra::getDefaultComm(), {{"displacement", 2, {7, 3, 11}, 3}, {"pore pressure", 1, {3, 11}, 2}});
  EXPECT_EQ(dofs.num_owned_dofs(), 8);
  EXPECT_EQ(dofs.num_overlap_dofs(), 8);
  EXPECT_EQ(dofs.dof(0, 1), 2);
  EXPECT_EQ(dofs.dof(1, 0), 6);
  EXPECT_EQ(dofs.owned_begin(1), 6);
  EXPECT_EQ(dofs.owned_end(1), 8);
  EXPECT_EQ(dofs.field_of(5), 0);
  EXPECT_EQ(dofs.field_of(6), 1);
  EXPECT_EQ(dofs.find("pore pressure"), 1);
  EXPECT_EQ(dofs.find("temperature"), -1);
  EXPECT_EQ(dofs.field_map(1)->getGlobalElement(0), 6);
}

TEST(DofMap, AFieldMayBeEmpty) {
  const DofMap dofs(Tpetra::getDefaultComm(), {{"displacement", 2, {0}, 1}, {"body", 3, {}, 0}});
  EXPECT_EQ(dofs.num_owned_dofs(), 2);
  EXPECT_EQ(dofs.owned_begin(1), dofs.owned_end(1));
}

TEST(DofMap, AnUnownedNodeIsRefused) {
  EXPECT_THROW(DofMap(Tpetra::getDefaultComm(), {{"displacement", 2, {0, 5}, 1}}), std::logic_error);
}

}  // namespace
}  // namespace mudline
