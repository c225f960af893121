// What the chord control keeps in a checkpoint.
#include "integrator/chord.hpp"

#include <gtest/gtest.h>

namespace mudline {
namespace {

TEST(Chord, MemoryComesBackFromTheEndOfWhatFollowsIt) {
  ChordControl chord;
  chord.start_step({0.5, 1, 0});
  chord.renewed();
  std::vector<double> memory{7, 8};  // the linear solver's
  chord.save(memory);
  ChordControl again;
  again.restore(memory);
  EXPECT_EQ(memory, (std::vector<double>{7, 8}));
  EXPECT_TRUE(again.belongs_to({0.5, 1, 0}));
}

TEST(Chord, IncompleteMemoryIsRefused) {
  std::vector<double> complete;
  ChordControl chord;
  chord.start_step({0.5, 1, 0});
  chord.save(complete);
  for (std::size_t left = 0; left < complete.size(); ++left) {
    std::vector<double> memory(complete.end() - left, complete.end());
    EXPECT_THROW(ChordControl().restore(memory), std::logic_error) << left;
  }
  for (const double size : {-1.0, 1e300, std::nan("")}) {
    std::vector<double> memory = complete;
    memory.back() = size;
    EXPECT_THROW(ChordControl().restore(memory), std::logic_error) << size;
  }
}

}  // namespace
}  // namespace mudline
