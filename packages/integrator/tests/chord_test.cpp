// Checkpoint data of the chord control, and its prediction of a new Jacobian.
#include "integrator/chord.hpp"

#include <gtest/gtest.h>

namespace mudline {
namespace {

TEST(Chord, MemoryComesBackFromTheEndOfWhatFollowsIt) {
  ChordControl chord;
  chord.start_step({0.5, 1, 0});
  chord.refreshed();
  std::vector<double> memory{7, 8};  // memory of the linear solver
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

/// The control after a step whose first iteration reduced the residual by the factor `contraction`.
ChordControl after_step(double contraction) {
  ChordControl chord;
  chord.enabled = true;
  chord.start_step({1});
  chord.refreshed();
  chord.observe(1e6, 0);
  chord.observe(1e6 * contraction, 1e6);
  chord.start_step({1});
  return chord;
}

TEST(Chord, ExpectsANewJacobianAtTheFirstGuessUnlessTheOldOneServedWell) {
  EXPECT_TRUE(ChordControl().expects_jacobian(true)) << "there is none yet";
  EXPECT_TRUE(after_step(0.5).expects_jacobian(true));
  EXPECT_FALSE(after_step(0.01).expects_jacobian(true));
  EXPECT_TRUE(after_step(0.01).expects_jacobian(false)) << "its factors are not at hand";
  ChordControl forgotten = after_step(0.01);
  forgotten.forget();
  EXPECT_TRUE(forgotten.expects_jacobian(true));
}

TEST(Chord, ExpectsNoNewJacobianNearTheEnd) {
  for (const double contraction : {0.5, 0.2}) {  // too slow for another iteration with the same matrix
    ChordControl chord = after_step(contraction);
    chord.observe(1e4, 0);
    EXPECT_TRUE(chord.expects_jacobian(true)) << contraction;
    chord.observe(1e4 * contraction, 1e4);
    EXPECT_TRUE(chord.expects_jacobian(true)) << contraction;
    chord.observe(1, 1 / contraction);
    for (const bool usable : {false, true}) EXPECT_FALSE(chord.expects_jacobian(usable)) << contraction;
  }
  ChordControl chord = after_step(0.5);
  chord.observe(1e8, 0);
  chord.observe(1e6, 1e8);
  EXPECT_FALSE(chord.expects_jacobian(true)) << "1e4 is left, for which the matrix serves";
  EXPECT_FALSE(chord.may_reuse()) << "but not for 1e6";
}

/// A step whose first iteration takes away all but 1e-3 with the old matrix, and whose second one, with this matrix
/// too, leaves the share `second`.
void take_step(ChordControl& chord, double second) {
  chord.start_step({1});
  chord.observe(1e6, 0);
  chord.observe(1e3, 1e6);
  chord.observe(1e3 * second, 1e3);
}

/// Whether the old matrix would serve in the second iteration of the next step, whose first one takes as much away.
bool serves_in_second(ChordControl& chord) {
  chord.start_step({1});
  chord.observe(1e6, 0);
  const bool expected = !chord.expects_jacobian(true);
  chord.observe(1e3, 1e6);
  EXPECT_EQ(expected, chord.may_reuse()) << "what is expected at the iterate before";
  return chord.may_reuse();
}

TEST(Chord, AChordThatDidBadlyIsNotTriedAgainForSomeSteps) {
  ChordControl chord = after_step(1e-3);
  take_step(chord, 0.01);
  EXPECT_TRUE(serves_in_second(chord));
  take_step(chord, 0.9);
  ChordControl restarted;
  restarted.enabled = true;
  std::vector<double> memory;
  chord.save(memory);
  restarted.restore(memory);
  for (int step = 1; step < 10; ++step) {
    EXPECT_FALSE(serves_in_second(chord)) << step;
    EXPECT_FALSE(serves_in_second(restarted)) << step;
    for (ChordControl* each : {&chord, &restarted}) {
      each->refreshed();
      each->observe(1, 1e3);  // with a new matrix: says nothing of a chord
    }
  }
  EXPECT_TRUE(serves_in_second(chord)) << "ten steps later";
  EXPECT_TRUE(serves_in_second(restarted));
  take_step(chord, 0.9);
  chord.forget();
  chord.refreshed();
  EXPECT_FALSE(serves_in_second(chord)) << "another matrix is no better there";
  chord.forget_all();
  chord.refreshed();
  chord.start_step({1});
  chord.observe(1e6, 0);
  chord.observe(1e3, 1e6);
  EXPECT_TRUE(chord.may_reuse());
}

}  // namespace
}  // namespace mudline
