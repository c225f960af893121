#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/registry.hpp"
#include "materials/point/point_control.hpp"

namespace mudline {

/// The soil of a test: data of an entry of the deck's "materials" that a material point needs.
struct PointSoil {
  std::string name;
  std::shared_ptr<const Skeleton> skeleton;
  std::function<double(const Point&)> void_ratio;  // [-] at a place; 0: not given
  bool void_ratio_from_law = false;
  double biot_coefficient = 1.0;  // [-]
};

/// One number of a row of results. Stress and strain tensors are compression positive, shear included.
struct PointValue {
  std::string name, unit;
  double value;
};

/// Part of a test: equal increments towards a target. Signs and order as in SkeletonWorkset.
struct PointLeg {
  std::array<bool, 6> stress_controlled{};
  Six strain{};  // change over the leg, of the strain-controlled components
  Six stress{};  // at the end of the leg, of the stress-controlled ones
  StrainTie tie;
  bool sliding = false;
  double duration = 0.0;  // [s]
  int steps = 1;
};

/// Outcome of a test.
struct PointOutcome {
  bool complete = false;
  int steps = 0, cuts = 0, iterations = 0;
  double time = 0.0;             // [s] reached
  std::vector<PointValue> last;  // results at the end
  std::string failure;           // failure of the law, if it ended the test
};

/// Initial state of a test; the deck's section "initial state" of a test. Compression positive, as in a full run.
struct PointStart {
  double mean = 0.0, vertical = 0.0, k0 = 0.0;  // [Pa], [Pa], [-] 0: not given
  Six stress{};                                 // [Pa]
  bool has_components = false;                  // the start is `stress`
  double ocr = 1.0, void_ratio = 0.0;           // [-]
  Point place{};                                // [m]

  void parameters(Parameters& p);
};

/// One laboratory test on one material point; an entry of the deck's section "tests".
class PointTest {
 public:
  using Row = std::function<void(double time, const std::vector<PointValue>& values)>;

  virtual ~PointTest() = default;
  void parameters(Parameters& p);
  virtual void check(const Section&) {}
  /// Name of the material in the deck; "" for the only one.
  const std::string& material() const { return material_; }
  /// Sets soil and initial point. InputError through `section`, that of the test, where the law cannot start there.
  void begin(const PointSoil& soil, const Section& section);
  /// Runs the test; calls `row` for the start and after every increment.
  PointOutcome run(const Row& row) const;

 protected:
  virtual void own_parameters(Parameters& p) = 0;
  virtual std::vector<PointLeg> legs() const = 0;
  /// Component whose total stress is constant in an undrained test: the excess pore pressure is the decrease of its
  /// effective stress. -1: drained.
  virtual int constant_total_stress() const { return -1; }
  /// [Pa] tension positive
  const Six& initial_stress() const { return initial_.stress; }

 private:
  std::vector<PointValue> values(const PointControl& control) const;

  std::string material_;
  PointStart start_;
  PointSoil soil_;
  InitialPoint initial_{};
};

/// Registers the built-in tests.
void register_point_tests(Registry<PointTest>& tests);

}  // namespace mudline
