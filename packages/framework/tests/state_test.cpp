// The step is a transaction: the trial state is dropped or becomes the committed one.
#include "framework/state.hpp"

#include <gtest/gtest.h>

#include "discretisation/tests/mesh_fixture.hpp"
#include "framework/surface_points.hpp"

namespace mudline {
namespace {

struct Store {
  std::unique_ptr<Mesh> mesh = mesh_test::make(mesh_test::box("quad4", 2, 1));
  Space space{*mesh, {{"displacement", "m", "N", vector_components, Support::all_nodes, 2}}};
  StateStore store{space};
  int array;

  Store() {
    array =
        store.declare(ArrayInfo::at_points("soil/stress", {{"stress", 6, "Pa"}, {"void ratio", 1, "-"}}, *mesh, 0, 4));
    store.allocate_history(1);
  }

  /// Writes a number to everything that a state holds.
  static void fill(State& state, double number) {
    state.time = number;
    state.increment.number = static_cast<int>(number);
    for (const NodalView& view : {state.value, state.rate, state.acceleration, state.history_forces[0]})
      Kokkos::deep_copy(view, number);
    Kokkos::deep_copy(state.coordinates, number);
    Kokkos::deep_copy(state.arrays[0], number);
  }
  static bool holds(const State& state, double number) {
    bool all = state.time == number && state.increment.number == static_cast<int>(number);
    for (const NodalView& view : {state.value, state.rate, state.acceleration, state.history_forces[0]})
      for (std::size_t i = 0; i < view.extent(0); ++i) all = all && view(i) == number;
    for (std::size_t i = 0; i < state.coordinates.extent(0); ++i)
      for (std::size_t j = 0; j < state.coordinates.extent(1); ++j) all = all && state.coordinates(i, j) == number;
    for (std::size_t i = 0; i < state.arrays[0].extent(0); ++i)
      for (std::size_t j = 0; j < state.arrays[0].extent(1); ++j) all = all && state.arrays[0](i, j) == number;
    return all;
  }
};

TEST(StateStore, StartsAtRestOnTheMesh) {
  const Store s;
  for (const State* state : {&s.store.committed(), &s.store.trial()}) {
    EXPECT_EQ(state->value.extent(0), 12u);
    for (int node = 0; node < s.mesh->num_nodes(); ++node)
      EXPECT_EQ(place_of(state->coordinates, node), s.mesh->place(node));
    for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(state->value(i), 0);
  }
}

TEST(StateStore, DeclaredArraysAreInBothStates) {
  Store s;
  EXPECT_EQ(s.store.find("soil/stress"), s.array);
  EXPECT_EQ(s.store.find("soil/strain"), -1);
  EXPECT_EQ(s.store.info(s.array).points_per_element, 4);
  for (const State* state : {&s.store.committed(), &s.store.trial()}) {
    EXPECT_EQ(state->arrays[s.array].extent(0), 8u);
    EXPECT_EQ(state->arrays[s.array].extent(1), 7u);
  }
  EXPECT_THROW(s.store.declare(ArrayInfo::of_model("soil/stress", {{"value", 1, "-"}})), std::logic_error);
}

TEST(StateStore, ADescriptionThatContradictsItselfIsRefused) {
  Store s;
  const auto with = [](Transfer rule, int components = 1) {
    return std::vector<StateVariable>{{"v", components, "-", rule}};
  };
  const auto surface = std::make_shared<SurfacePoints>(*s.mesh, "top", SurfacePoints::At::gauss, 2);
  const auto refused = [&](ArrayInfo info) {
    const std::string problem = info.problem();
    EXPECT_THROW(s.store.declare(std::move(info)), std::logic_error);
    return problem;
  };
  EXPECT_NE(refused(ArrayInfo::of_model("a", with(Transfer::total))).find("declare it as a sum"), std::string::npos);
  EXPECT_NE(refused(ArrayInfo::of_model("a", with(Transfer::nearest))).find("no places"), std::string::npos);
  EXPECT_NE(refused(ArrayInfo::of_sum("a", with(Transfer::nearest))).find("no places"), std::string::npos);
  EXPECT_NE(refused(ArrayInfo::at_nodes("a", with(Transfer::mass), *s.mesh)).find("void ratios"), std::string::npos);
  EXPECT_NE(refused(ArrayInfo::on_surface("a", with(Transfer::mass), surface)).find("void ratios"), std::string::npos);
  EXPECT_NE(refused(ArrayInfo::at_points("a", with(Transfer::mass, 6), *s.mesh, 0, 4)).find("void ratios"),
            std::string::npos);
  EXPECT_NE(refused(ArrayInfo::of_sum("a", with(Transfer::value)).then_evaluated()).find("evaluated"),
            std::string::npos);
  EXPECT_NE(refused(ArrayInfo::of_model("a", with(Transfer::value, 0))).find("components"), std::string::npos);
  EXPECT_NE(refused(ArrayInfo::of_model("", with(Transfer::value))).find("name"), std::string::npos);
  for (const Transfer rule : {Transfer::value, Transfer::total, Transfer::nearest}) {
    const std::string n = std::to_string(static_cast<int>(rule));
    s.store.declare(ArrayInfo::at_nodes("nodes" + n, with(rule), *s.mesh, "top"));
    s.store.declare(ArrayInfo::on_surface("surface" + n, with(rule), surface));
    s.store.declare(ArrayInfo::at_points("points" + n, with(rule), *s.mesh, 0, 4));
  }
  EXPECT_EQ(s.store.info(s.store.find("nodes0")).rows, 3);
  EXPECT_EQ(s.store.info(s.store.find("surface0")).rows, 4);
}

TEST(StateStore, ArraysThatAreEvaluatedAfterATransferAreTakenOver) {
  Store s;
  const int kept = s.store.declare(ArrayInfo::at_nodes("kept", {{"v", 1, "-"}}, *s.mesh)),
            taken = s.store.declare(ArrayInfo::at_nodes("taken", {{"v", 1, "-"}}, *s.mesh).then_evaluated());
  for (int handle : {kept, taken}) Kokkos::deep_copy(s.store.trial().arrays[handle], 2.0);
  s.store.take_evaluated();
  EXPECT_EQ(s.store.committed().arrays[kept](0, 0), 0);
  EXPECT_EQ(s.store.committed().arrays[taken](0, 0), 2);
}

TEST(StateStore, ARejectedStepLeavesNothing) {
  Store s;
  Store::fill(s.store.committed(), 1);
  s.store.begin();
  EXPECT_TRUE(Store::holds(s.store.trial(), 1));
  Store::fill(s.store.trial(), 2);
  EXPECT_TRUE(Store::holds(s.store.committed(), 1));
  s.store.begin();
  EXPECT_TRUE(Store::holds(s.store.trial(), 1));
}

TEST(StateStore, AnAcceptedStepIsCommitted) {
  Store s;
  Store::fill(s.store.committed(), 1);
  s.store.begin();
  Store::fill(s.store.trial(), 2);
  s.store.accept();
  EXPECT_TRUE(Store::holds(s.store.committed(), 2));
  s.store.begin();
  Store::fill(s.store.trial(), 3);
  EXPECT_TRUE(Store::holds(s.store.committed(), 2));
}

TEST(StateStore, AnAcceptedStepCanBeTakenBack) {
  Store s;
  Store::fill(s.store.committed(), 1);
  s.store.keep();
  s.store.begin();
  Store::fill(s.store.trial(), 2);
  s.store.accept();
  Store::fill(s.store.committed(), 3);  // what happens after acceptance
  s.store.restore();
  EXPECT_TRUE(Store::holds(s.store.committed(), 1));
  Store::fill(s.store.committed(), 4);
  s.store.keep();  // the room of the first copy serves again
  Store::fill(s.store.committed(), 5);
  s.store.restore();
  EXPECT_TRUE(Store::holds(s.store.committed(), 4));
}

}  // namespace
}  // namespace mudline
