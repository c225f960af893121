#include "algebra/blas_kernels.hpp"

#include <gtest/gtest.h>

namespace mudline {
namespace {

bool right() { return true; }
bool wrong() { return false; }

TEST(BlasKernels, OldOnesGiveWayOnAProcessorWithAvx2) {
  for (const char* old : {"Prescott", "Nehalem", "Sandybridge", "Barcelona", "Piledriver"})
    EXPECT_EQ(better_kernels(old, true, right), "Haswell") << old;
}

TEST(BlasKernels, OldOnesStayOnAnOldProcessor) { EXPECT_EQ(better_kernels("Prescott", false, right), ""); }

TEST(BlasKernels, ThoseThatSuitStay) {
  for (const char* name : {"Haswell", "Zen", "Excavator", "SkylakeX", "SapphireRapids", "a later one"})
    EXPECT_EQ(better_kernels(name, true, right), "") << name;
}

TEST(BlasKernels, ThoseBeyondAvx2StayOnlyWhereTheirResultsAreRight) {
  EXPECT_EQ(better_kernels("SkylakeX", true, wrong), "Haswell");
  EXPECT_EQ(better_kernels("Haswell", true, wrong), "");  // there is nothing to fall back to
}

TEST(BlasKernels, AnotherBlasIsLeftAlone) { EXPECT_EQ(better_kernels("", true, right), ""); }

TEST(BlasKernels, ThisProcessComputesRight) { EXPECT_TRUE(dense_products_are_right()); }

}  // namespace
}  // namespace mudline
