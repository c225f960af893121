#include <cmath>

#include "core/text.hpp"
#include "materials/point/point_test.hpp"

namespace mudline {

namespace {

enum class Measure { logarithmic, engineering };

/// Successive targets of one quantity: loading, unloading, reloading. Compression positive.
class Targets {
 public:
  void strain(Parameters& p, const std::string& name, const std::string& doc) {
    name_ = name;
    p.add(name, strains_, "-", any(),
          doc + "; several are reached one after the other (loading, unloading, reloading)");
  }
  void stress(Parameters& p, const std::string& name, const std::string& doc) {
    stress_name_ = name;
    p.add(name, stresses_, "Pa", any(), doc + "; give this or '" + name_ + "'");
    p.add("stress rate", stress_rate_, "Pa/s", positive(),
          "speed of '" + name + "', which gives the time of an increment");
  }
  void measure(Parameters& p) {
    p.choice("strain measure", measure_, {{"logarithmic", Measure::logarithmic}, {"engineering", Measure::engineering}},
             "what '" + name_ + "' means: ln of the ratio of lengths (volumes), or change over initial value");
  }
  void pace(Parameters& p) {
    p.add("strain rate", rate_, "1/s", positive(),
          "speed of the (logarithmic) strain, which gives the time of an increment");
    p.add("steps", steps_, "-", closed(1, 1000000), "increments between two targets");
    p.add("cycles", cycles_, "-", closed(1, 100000), "the targets are gone through so many times");
  }
  void check(const Section& section) const {
    if (section.has_parameter(name_) == section.has_parameter(stress_name_))
      section.fail("exactly one of '" + name_ + "' and '" + stress_name_ + "' must be given");
    if (strains_.empty() && stresses_.empty())
      section.fail("at least one target is needed", section.has_parameter(name_) ? name_ : stress_name_);
    for (const char* idle : {"strain rate", "strain measure"})
      if (by_stress() && section.has_parameter(idle))
        section.fail("plays no role where '" + stress_name_ + "' drives the test; remove it", idle);
    if (!by_stress() && section.has_parameter("stress rate"))
      section.fail("plays no role where '" + name_ + "' drives the test; remove it", "stress rate");
    if (cycles_ > 1 && strains_.size() + stresses_.size() == 1)
      section.fail("one target has no way back; cycles need two targets or more", "cycles");
    for (std::size_t i = 0; i < strains_.size(); ++i) {
      if (measure_ == Measure::engineering && strains_[i] >= 1.0)
        section.fail(
            "an engineering strain of " + number_text(strains_[i]) + " leaves nothing of the soil; allowed: below 1",
            name_);
      if (strains_[i] == (i == 0 ? 0.0 : strains_[i - 1]) || (i == 0 && cycles_ > 1 && strains_[0] == strains_.back()))
        section.fail(
            "target " + std::to_string(i + 1) + ", " + number_text(strains_[i]) + ", is where the soil is already",
            name_);
    }
  }
  bool by_stress() const { return !stresses_.empty(); }
  int steps() const { return steps_; }

  struct Part {
    double change, target, duration;  // compression positive: strain change or stress target
  };
  std::vector<Part> strain_parts() const {
    std::vector<Part> parts;
    double before = 0.0;
    for (int cycle = 0; cycle < cycles_; ++cycle)
      for (const double given : strains_) {
        const double target = measure_ == Measure::engineering ? -std::log1p(-given) : given;
        parts.push_back({target - before, target, std::abs(target - before) / rate_});
        before = target;
      }
    return parts;
  }
  std::vector<Part> stress_parts(double before) const {
    std::vector<Part> parts;
    for (int cycle = 0; cycle < cycles_; ++cycle)
      for (const double target : stresses_) {
        parts.push_back({target - before, target, std::abs(target - before) / stress_rate_});
        before = target;
      }
    return parts;
  }

 private:
  std::string name_, stress_name_;
  std::vector<double> strains_, stresses_;
  double rate_ = 1e-5, stress_rate_ = 100.0;  // [1/s], [Pa/s]
  int steps_ = 200, cycles_ = 1;
  Measure measure_ = Measure::logarithmic;
};

/// A test with one driving quantity.
class TargetTest : public PointTest {
 public:
  void check(const Section& section) override { targets_.check(section); }

 protected:
  std::vector<PointLeg> legs() const override {
    std::vector<PointLeg> legs;
    const auto add = [&](const Targets::Part& part, bool by_stress) {
      PointLeg leg;
      leg.stress = initial_stress();
      leg.duration = part.duration;
      leg.steps = targets_.steps();
      fill(leg, by_stress ? -part.target : -part.change, by_stress);
      legs.push_back(leg);
    };
    if (targets_.by_stress())
      for (const auto& part : targets_.stress_parts(start_of_stress())) add(part, true);
    else
      for (const auto& part : targets_.strain_parts()) add(part, false);
    return legs;
  }
  /// Fills the driven components of a leg; `drive` is a strain change or a stress [Pa], tension positive.
  virtual void fill(PointLeg& leg, double drive, bool by_stress) const = 0;
  /// Driving stress at the start [Pa], compression positive.
  virtual double start_of_stress() const { return -initial_stress()[1]; }

  Targets targets_;
};

class Oedometer : public TargetTest {
 protected:
  void own_parameters(Parameters& p) override {
    targets_.strain(p, "axial strain", "vertical strain");
    targets_.stress(p, "axial stress", "vertical effective stress");
    targets_.measure(p);
    targets_.pace(p);
  }
  void fill(PointLeg& leg, double drive, bool by_stress) const override {
    leg.stress_controlled[1] = by_stress;
    leg.strain[1] = leg.stress[1] = drive;
  }
};

class IsotropicCompression : public TargetTest {
 protected:
  void own_parameters(Parameters& p) override {
    targets_.strain(p, "volumetric strain", "volumetric strain, a third in each direction");
    targets_.stress(p, "mean stress", "mean effective stress, the same in each direction");
    targets_.measure(p);
    targets_.pace(p);
  }
  void fill(PointLeg& leg, double drive, bool by_stress) const override {
    for (int c = 0; c < 3; ++c) {
      leg.stress_controlled[c] = by_stress;
      leg.strain[c] = drive / 3.0;
      leg.stress[c] = drive;
    }
  }
  double start_of_stress() const override {
    return -(initial_stress()[0] + initial_stress()[1] + initial_stress()[2]) / 3.0;
  }
};

constexpr const char* difference_doc = "axial minus lateral stress, negative in extension";

/// Difference of the stresses along y and in the other `lateral` directions, tension positive.
double stress_difference(const Six& stress, const std::vector<int>& lateral) {
  double mean = 0.0;
  for (const int c : lateral) mean += stress[c] / static_cast<double>(lateral.size());
  return stress[1] - mean;
}

/// Axial loading along y by strain or stress difference, with constant `lateral` effective stresses (drained) or
/// constant volume (undrained).
void load_axially(PointLeg& leg, const std::vector<int>& lateral, bool drained, double drive, bool by_stress) {
  leg.stress_controlled[1] = by_stress;
  leg.strain[1] = drive;
  leg.stress[1] = drained ? leg.stress[1] - stress_difference(leg.stress, lateral) + drive : drive;
  if (!drained) leg.tie.driver = 1;
  for (const int c : lateral) {
    leg.stress_controlled[c] = drained;
    if (!drained) leg.tie.follow[c] = -1.0 / static_cast<double>(lateral.size());
  }
}

/// Triaxial test with the axis y; the sign of strain or stress difference distinguishes compression and extension.
template <bool Drained>
class Triaxial : public TargetTest {
 protected:
  void own_parameters(Parameters& p) override {
    targets_.strain(p, "axial strain", "strain along y, negative in extension");
    targets_.stress(p, "stress difference", difference_doc);
    targets_.measure(p);
    targets_.pace(p);
  }
  void fill(PointLeg& leg, double drive, bool by_stress) const override {
    load_axially(leg, {0, 2}, Drained, drive, by_stress);
  }
  double start_of_stress() const override { return -stress_difference(initial_stress(), {0, 2}); }
  int constant_total_stress() const override { return Drained ? -1 : 0; }
};

enum class Drainage { drained, undrained };

void declare(Parameters& p, Drainage& drainage, const std::string& doc) {
  p.choice("drainage", drainage, {{"drained", Drainage::drained}, {"undrained", Drainage::undrained}}, doc);
}

class PlaneStrain : public TargetTest {
 protected:
  void own_parameters(Parameters& p) override {
    declare(p, drainage_, "lateral effective stress xx kept, or volume kept; no strain along z in both");
    targets_.strain(p, "axial strain", "strain along y, negative in extension");
    targets_.stress(p, "stress difference", difference_doc);
    targets_.measure(p);
    targets_.pace(p);
  }
  void fill(PointLeg& leg, double drive, bool by_stress) const override {
    load_axially(leg, {0}, drainage_ == Drainage::drained, drive, by_stress);
  }
  double start_of_stress() const override { return -stress_difference(initial_stress(), {0}); }
  int constant_total_stress() const override { return drainage_ == Drainage::drained ? -1 : 0; }

 private:
  Drainage drainage_ = Drainage::drained;
};

class SimpleShear : public TargetTest {
 protected:
  void own_parameters(Parameters& p) override {
    declare(p, drainage_, "vertical effective stress kept, or volume (height) kept");
    targets_.strain(p, "shear strain", "horizontal displacement of the upper face over the initial height");
    targets_.stress(p, "shear stress", "shear stress xy on the horizontal faces");
    targets_.pace(p);
  }
  void fill(PointLeg& leg, double drive, bool by_stress) const override {
    leg.sliding = true;
    leg.strain[5] = leg.stress[5] = drive;
    leg.stress_controlled[5] = by_stress;
    leg.stress_controlled[1] = drainage_ == Drainage::drained;
  }
  double start_of_stress() const override { return -initial_stress()[5]; }
  int constant_total_stress() const override { return drainage_ == Drainage::drained ? -1 : 1; }

 private:
  Drainage drainage_ = Drainage::undrained;
};

/// Test with six functions of time, each a strain or a stress.
class PathTest : public PointTest {
 public:
  void check(const Section& section) override {
    bool moves = false;
    for (int c = 0; c < 6; ++c) {
      if (by_strain_[c] && by_stress_[c])
        section.fail("contradictory: give '" + strain_name(c) + "' or '" + stress_name(c) + "', not both",
                     stress_name(c));
      moves = moves || by_strain_[c] || by_stress_[c];
    }
    if (!moves) section.fail("a path needs at least one strain or stress, such as '" + strain_name(1) + "'");
  }

 protected:
  void own_parameters(Parameters& p) override {
    p.required("duration", duration_, "s", positive(), "the functions are followed from t = 0 to this time");
    p.add("steps", steps_, "-", closed(1, 1000000), "equal increments of time");
    for (int c = 0; c < 6; ++c) {
      p.add(strain_name(c), strain_[c], "-",
            "logarithmic strain over time along fixed axes; a component without strain or stress is held");
      p.add(stress_name(c), stress_[c], "Pa", "effective stress over time");
      by_strain_[c] = p.given(strain_name(c));
      by_stress_[c] = p.given(stress_name(c));
    }
  }
  std::vector<PointLeg> legs() const override {
    std::vector<PointLeg> legs(steps_);
    for (int i = 0; i < steps_; ++i) {
      const double from = duration_ * i / steps_, to = duration_ * (i + 1) / steps_;
      legs[i].duration = duration_ / steps_;
      legs[i].stress_controlled = by_stress_;
      for (int c = 0; c < 6; ++c) {
        legs[i].strain[c] = strain_[c](from, {}) - strain_[c](to, {});
        legs[i].stress[c] = -stress_[c](to, {});
      }
    }
    return legs;
  }

 private:
  static std::string component(int c) { return std::string("xxyyzzyzxzxy").substr(2 * c, 2); }
  static std::string strain_name(int c) { return (c < 3 ? "strain " : "shear strain ") + component(c); }
  static std::string stress_name(int c) { return (c < 3 ? "effective stress " : "shear stress ") + component(c); }

  double duration_ = 1.0;  // [s]
  int steps_ = 200;
  std::array<Function, 6> strain_, stress_;
  std::array<bool, 6> by_strain_{}, by_stress_{};
};

}  // namespace

void register_point_tests(Registry<PointTest>& tests) {
  tests.add<Oedometer>("oedometer", "Vertical compression without lateral strain, by strain or by stress");
  tests.add<IsotropicCompression>("isotropic compression",
                                  "Compression alike in all directions, by strain or by stress");
  tests.add<Triaxial<true>>("triaxial drained",
                            "Axial loading, by strain or by stress, at constant lateral effective stress");
  tests.add<Triaxial<false>>(
      "triaxial undrained",
      "Axial loading, by strain or by stress, at constant volume and constant lateral total stress");
  tests.add<PlaneStrain>("plane strain", "Biaxial test: axial loading without strain in the third direction");
  tests.add<SimpleShear>("simple shear",
                         "Shear between rigid plates, by angle or by stress, at constant vertical stress or volume");
  tests.add<PathTest>("path", "Any mixture of strains and stresses as functions of time");
}

}  // namespace mudline
