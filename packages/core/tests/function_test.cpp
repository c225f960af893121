#include "core/function.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "input_error.hpp"

namespace mudline {
namespace {

const Point origin{0.0, 0.0, 0.0};
const double pi = std::acos(-1.0);

TEST(Function, DefaultIsZero) {
  const Function f;
  EXPECT_TRUE(f.is_zero());
  EXPECT_TRUE(f.steady());
  EXPECT_EQ(f(3.0, origin), 0.0);
  EXPECT_EQ(f.text(), "0");
}

TEST(Function, ConstantKeepsItsValue) {
  const Function f = 2.5;
  EXPECT_EQ(f(1.0, origin), 2.5);
  EXPECT_TRUE(f.is_constant());
  EXPECT_FALSE(f.is_zero());
  EXPECT_EQ(f.text(), "2.5");
}

TEST(Function, WithinARangeItNamesThePlaceOfAnotherValue) {
  const Point place{0.5, -2.0, 0.0};
  const Function depth = make_expression("2*y").within(non_negative(), "deck.xml:3: K0: ", 2);
  EXPECT_EQ(depth(0.0, {0.0, 3.0, 0.0}), 6.0);
  EXPECT_EQ(input_error([&] { depth(0.0, place); }),
            "deck.xml:3: K0: the value of '2*y' is -4 at (0.5, -2); allowed: [0, inf)");
  const Function root = make_expression("sqrt(t-1)").within(any(), "deck.xml:4: load: ", 2);
  EXPECT_EQ(root(5.0, place), 2.0);
  EXPECT_EQ(input_error([&] { root(0.5, place); }),
            "deck.xml:4: load: the value of 'sqrt(t-1)' is not finite at t = 0.5 s; allowed: finite numbers");
  const Function both = make_expression("t/z", 3).within(any(), "deck.xml:5: load: ", 3);
  EXPECT_EQ(input_error([&] { both(0.5, place); }),
            "deck.xml:5: load: the value of 't/z' is not finite at t = 0.5 s, (0.5, -2, 0); allowed: finite numbers");
  EXPECT_FALSE(std::isfinite(make_expression("sqrt(t-1)")(0.5, place)));  // without a range any value is returned
}

TEST(Expression, KnowsTimePositionAndPi) {
  const Function f = make_expression("10*sin(pi*t) + x - 2*y");
  EXPECT_NEAR(f(0.5, {3.0, 4.0, 0.0}), 10.0 + 3.0 - 8.0, 1e-12);
  EXPECT_FALSE(f.steady());
  EXPECT_FALSE(f.is_constant());
}

TEST(Expression, AxisymmetricNamesAreAliases) {
  EXPECT_EQ(make_expression("r + 10*z")(0.0, {3.0, 4.0, 0.0}), 43.0);
  EXPECT_EQ(make_expression("x + 10*y")(0.0, {3.0, 4.0, 0.0}), 43.0);
}

TEST(Expression, SteadyWithoutTime) {
  EXPECT_TRUE(make_expression("x*y").steady());
  EXPECT_FALSE(make_expression("x*t").steady());
}

TEST(Expression, WithoutVariablesIsConstant) {
  const Function f = make_expression("2*pi");
  EXPECT_TRUE(f.is_constant());
  EXPECT_NEAR(f(0.0, origin), 2.0 * pi, 1e-15);
  EXPECT_EQ(f.text(), "2*pi");
}

TEST(Expression, ConditionsAndPowers) {
  const Function f = make_expression("t >= 1 ? 2^3 : -1");
  EXPECT_EQ(f(0.0, origin), -1.0);
  EXPECT_EQ(f(1.0, origin), 8.0);
  EXPECT_EQ(make_expression("t == 1 ? 5 : 6")(1.0, origin), 5.0);
}

TEST(Expression, CopiesShareTheDefinition) {
  const Function f = make_expression("2*t");
  const Function g = f;
  EXPECT_EQ(g(2.0, origin), 4.0);
  EXPECT_EQ(f(3.0, origin), 6.0);
}

TEST(Expression, IsCorrectFromSeveralThreads) {
  const Function f = make_expression("t + 1000*x");
  std::vector<int> wrong(2, 0);
  const auto work = [&](int id) {
    for (int i = 0; i < 5000; ++i)
      if (f(i, {double(id), 0.0, 0.0}) != i + 1000.0 * id) ++wrong[id];
  };
  std::thread first(work, 0), second(work, 1);
  first.join();
  second.join();
  EXPECT_EQ(wrong, (std::vector<int>{0, 0}));
}

TEST(Expression, ErrorsNameTheReason) {
  EXPECT_EQ(input_error([] { make_expression("  "); }), "the expression is empty");
  EXPECT_EQ(input_error([] { make_expression("10*sinn(t)"); }),
            "invalid expression '10*sinn(t)': unexpected token 'sinn' found at position 3 (did you mean 'sin'?)");
  EXPECT_EQ(input_error([] { make_expression("10*(t"); }), "invalid expression '10*(t': missing parenthesis");
  EXPECT_EQ(input_error([] { make_expression("10*"); }),
            "invalid expression '10*': unexpected end of expression at position 4");
  EXPECT_EQ(input_error([] { make_expression("2*velocity"); }),
            "invalid expression '2*velocity': unexpected token 'velocity' found at position 2; variables: t, x, y "
            "(axisymmetric: t, r, z); those of the deck stand in braces, {D}");
  EXPECT_EQ(input_error([] { make_expression("x = 3"); }),
            "invalid expression 'x = 3': an assignment with '=' is not possible; compare with '=='");
  EXPECT_EQ(input_error([] { make_expression("t, x"); }),
            "invalid expression 't, x': it gives several values separated by ','");
  EXPECT_EQ(input_error([] { make_expression("1/0"); }), "invalid expression '1/0': its value is not finite");
}

TEST(Table, LinearBetweenAndConstantOutside) {
  const Function f = make_table({1.0, 2.0, 4.0}, {10.0, 20.0, 0.0}, Interpolation::linear);
  for (const auto& [time, value] : std::vector<std::pair<double, double>>{
           {0.0, 10.0}, {1.0, 10.0}, {1.5, 15.0}, {2.0, 20.0}, {3.0, 10.0}, {4.0, 0.0}, {9.0, 0.0}})
    EXPECT_DOUBLE_EQ(f(time, origin), value) << "t = " << time;
  EXPECT_FALSE(f.steady());
}

TEST(Table, SmoothHasZeroSlopeAtEveryPoint) {
  const Function f = make_table({0.0, 1.0, 3.0}, {0.0, 2.0, 1.0}, Interpolation::smooth);
  EXPECT_DOUBLE_EQ(f(0.5, origin), 1.0);
  EXPECT_DOUBLE_EQ(f(0.25, origin), 2.0 * 0.15625);
  EXPECT_EQ(f(1.0, origin), 2.0);
  EXPECT_DOUBLE_EQ(f(2.0, origin), 1.5);
  for (const double knot : {0.0, 1.0, 3.0}) {
    const double h = 1e-5;
    EXPECT_NEAR((f(knot + h, origin) - f(knot - h, origin)) / (2.0 * h), 0.0, 1e-4);
  }
}

TEST(Table, SmoothIsMonotoneBetweenPoints) {
  const Function f = make_table({0.0, 1.0}, {0.0, 1.0}, Interpolation::smooth);
  for (int i = 0; i < 100; ++i) EXPECT_LE(f(i / 100.0, origin), f((i + 1) / 100.0, origin));
}

TEST(Table, OnePointOrEqualValuesAreSteady) {
  EXPECT_EQ(make_table({1.0}, {7.0}, Interpolation::linear)(0.0, origin), 7.0);
  EXPECT_TRUE(make_table({1.0}, {7.0}, Interpolation::linear).steady());
  EXPECT_TRUE(make_table({0.0, 1.0}, {7.0, 7.0}, Interpolation::smooth).steady());
}

TEST(Table, PassesNaNOn) {
  EXPECT_TRUE(std::isnan(make_table({0.0, 1.0}, {1.0, 2.0}, Interpolation::linear)(std::nan(""), origin)));
}

TEST(Table, ErrorsNameTheReason) {
  const auto error = [](const std::vector<double>& times, const std::vector<double>& values) {
    return input_error([&] { make_table(times, values, Interpolation::linear); });
  };
  EXPECT_EQ(error({}, {}), "a table needs at least one time");
  EXPECT_EQ(error({0.0, 1.0}, {0.0}), "'times' and 'values' must be of the same length, given 2 and 1");
  EXPECT_EQ(error({0.0, 1.0, 1.0}, {0.0, 1.0, 2.0}), "'times' must increase strictly, but 1 follows 1");
  EXPECT_EQ(error({0.0, 1.0}, {0.0, std::nan("")}), "entry 2 of the table is not finite");
}

TEST(FunctionLibrary, ResolvesNumbersNamesAndExpressions) {
  FunctionLibrary library;
  library.add("ramp", make_table({0.0, 1.0}, {0.0, 5.0}, Interpolation::linear));
  EXPECT_TRUE(library.contains("ramp"));
  EXPECT_EQ(library.names(), std::vector<std::string>{"ramp"});
  EXPECT_EQ(library.resolve("3.5")(0.0, origin), 3.5);
  EXPECT_TRUE(library.resolve("0").is_zero());
  EXPECT_EQ(library.resolve(" ramp ")(0.5, origin), 2.5);
  EXPECT_EQ(library.resolve("ramp").text(), "ramp");
  EXPECT_EQ(library.resolve("2*t")(4.0, origin), 8.0);
  EXPECT_THROW(library.add("ramp", Function(1.0)), std::logic_error);
}

TEST(FunctionLibrary, SuggestsTheNearestName) {
  FunctionLibrary library;
  library.add("ramp", Function(1.0));
  EXPECT_EQ(input_error([&] { library.resolve("rmap"); }), "there is no function 'rmap' (did you mean 'ramp'?)");
  EXPECT_EQ(
      input_error([&] { library.resolve("load"); }),
      "invalid expression 'load': unexpected token 'load' found at position 0; variables: t, x, y (axisymmetric: t, "
      "r, z); those of the deck stand in braces, {D}; functions of the deck: ramp");
  EXPECT_EQ(input_error([&] { library.resolve("inf"); }), "expected a finite number, given 'inf'");
}

}  // namespace
}  // namespace mudline
