#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/registry.hpp"
#include "materials/point/point_control.hpp"

namespace mudline {

/// The soil of a test: what a material point needs of an entry of the deck's "materials".
struct PointSoil {
  std::string name;
  std::shared_ptr<const Skeleton> skeleton;
  double void_ratio = 0.0;  // [-] 0: not given
  bool void_ratio_from_law = false;
  double biot_coefficient = 1.0;  // [-]
};

/// One number of a row of results. Compression positive throughout: the whole stress and strain tensor, shear included.
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

struct PointOutcome {
  bool complete = false;
  int steps = 0, cuts = 0, iterations = 0;
  double time = 0.0;             // [s] reached
  std::vector<PointValue> last;  // row of the end
  std::string failure;           // of the law, where the test is not complete for that
};

/// Where a test starts; the deck's section "initial state" of a test. Compression positive, as in a full run.
struct PointStart {
  double mean = 0.0, vertical = 0.0, k0 = 0.0;  // [Pa], [Pa], [-] 0: not given
  Six stress{};                                 // [Pa]
  bool has_components = false;                  // the start is `stress`
  double ocr = 1.0, void_ratio = 0.0;           // [-]

  void parameters(Parameters& p);
};

/// One laboratory test on one material point; an entry of the deck's section "tests".
class PointTest {
 public:
  using Row = std::function<void(double time, const std::vector<PointValue>& values)>;

  virtual ~PointTest() = default;
  void parameters(Parameters& p);
  virtual void check(const Section&) {}
  /// Which of the deck's materials; "" for the only one.
  const std::string& material() const { return material_; }
  /// Fixes soil and start. InputError where the law cannot start there. `section`: that of the test.
  void begin(const PointSoil& soil, const Section& section);
  /// Goes through the test; `row` gets the start and the end of every increment.
  PointOutcome run(const Row& row) const;

 protected:
  virtual void own_parameters(Parameters& p) = 0;
  virtual std::vector<PointLeg> legs() const = 0;
  /// The component whose total stress stays constant while the water cannot leave: the excess pore pressure is what its
  /// effective stress loses. -1: drained.
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

/// The tests that come with mudline; a plain list.
void register_point_tests(Registry<PointTest>& tests);

}  // namespace mudline
