#include "materials/conformance/conformance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "materials/conformance/sampler.hpp"
#include "tensor/sym6.hpp"

namespace mudline {

namespace {

constexpr double dt = 1.0;  // [s] of every increment; a rate-dependent law needs a time

template <class... Values>
std::string text(const char* format, Values... values) {
  char line[200];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

double norm(const Six& a) {
  double sum = 0.0;
  for (const double x : a) sum += x * x;
  return std::sqrt(sum);
}

MaterialPoint start(const Skeleton& law, const InitialPoint& point) { return MaterialPoint(law, point); }

PointMotion straining(const Six& strain) {
  PointMotion motion;
  motion.strain = strain;
  return motion;
}

/// Whether the law is for plane strain and axisymmetry only: it fails at any out-of-plane shear (a UMAT of four
/// components).
bool only_in_plane(const Skeleton& law) {
  Sampler sample(law, 7, false);
  int in_plane = 0, full = 0;
  for (int n = 0; n < 20; ++n) {
    Six strain = sample.increment(1e-8, 1e-7);
    InitialPoint point = sample.point();
    point.stress[3] = point.stress[4] = 0.0;
    const MaterialPoint at = start(law, point);
    full += at.evaluate(straining(strain), dt, false).ok ? 1 : 0;
    strain[3] = strain[4] = 0.0;
    in_plane += at.evaluate(straining(strain), dt, false).ok ? 1 : 0;
  }
  return full == 0 && in_plane > 0;
}

class Suite {
 public:
  Suite(const Skeleton& law, const ConformanceLimits& limits)
      : law_(law), limits_(limits), in_plane_(only_in_plane(law)) {}

  ConformanceCheck starts() const {
    Sampler sample = sampler(8);
    for (int n = 0; n < 100; ++n) sample.point();
    return {"starts", sample.refused() == 0,
            text("%d of 100 random points refused", sample.refused()) +
                (sample.refused() > 0 ? " (" + sample.refusal() + ")"
                                      : std::string(in_plane_ ? ", shear in the plane only" : ""))};
  }

  /// Repeated evaluation gives the same bits, with and without tangent; inputs are unchanged; the count of failures
  /// agrees with the flags.
  ConformanceCheck purity() const {
    Sampler sample = sampler(1);
    const int points = 500;
    int again = 0, plain = 0, touched = 0, miscounted = 0;
    for (int n = 0; n < points; ++n) {
      const MaterialPoint point = start(law_, sample.point());
      const PointMotion motion = straining(sample.increment(1e-6, 2e-2));
      const PointTrial a = point.evaluate(motion, dt, true), b = point.evaluate(motion, dt, true),
                       c = point.evaluate(motion, dt, false);
      again += a.stress == b.stress && a.state == b.state && a.tangent == b.tangent ? 0 : 1;
      plain += a.stress == c.stress && a.state == c.state ? 0 : 1;
      touched += a.old_untouched && c.old_untouched ? 0 : 1;
      miscounted += a.flags_agree && c.flags_agree ? 0 : 1;
    }
    return {
        "purity", again + plain + touched + miscounted == 0,
        text(
            "of %d points %d differ when repeated, %d without tangent, %d change their old state, %d miscount failures",
            points, again, plain, touched, miscounted)};
  }

  ConformanceCheck tangent() const {
    Sampler sample = sampler(2);
    std::vector<double> errors;
    for (int n = 0; n < limits_.tangent_points; ++n) {
      const MaterialPoint point = start(law_, sample.point());
      const double error = tangent_error(point, sample.increment(1e-5, 1e-2));
      if (error >= 0.0) errors.push_back(error);
    }
    const std::size_t n = errors.size();
    if (n == 0) return {"tangent", false, "every point failed"};
    std::sort(errors.begin(), errors.end());
    const double median = errors[n / 2], most = errors[n * 99 / 100], worst = errors[n - 1];
    const bool enough = limits_.may_fail || n == static_cast<std::size_t>(limits_.tangent_points);
    return {
        "tangent",
        enough && median < limits_.tangent_median && most < limits_.tangent_99 && worst < limits_.tangent_worst,
        text("against differences: median %.1e, 99 %% %.1e, worst %.1e (allowed %.0e, %.0e, %.0e; %d points)", median,
             most, worst, limits_.tangent_median, limits_.tangent_99, limits_.tangent_worst, static_cast<int>(n))};
  }

  /// Turned stress, strain and state tensors give turned output, after an increment that forms these tensors.
  ConformanceCheck isotropy() const {
    Sampler sample = sampler(3);
    double worst = 0.0;
    int failed = 0;
    for (int n = 0; n < limits_.rotation_points; ++n) {
      MaterialPoint point = start(law_, sample.point());
      const PointMotion before = straining(sample.increment(1e-5, 1e-2));
      const PointTrial formed = point.evaluate(before, dt, false);
      if (formed.ok) point.commit(before, dt, formed);
      const Six strain = sample.increment(1e-5, 1e-2);
      const auto r = sample.rotation();
      Six tensor = strain, turned_strain;
      for (int c = 3; c < 6; ++c) tensor[c] *= 0.5;
      sym6::rotate(r.data(), tensor.data(), turned_strain.data());
      for (int c = 3; c < 6; ++c) turned_strain[c] *= 2.0;
      if (in_plane_) turned_strain[3] = turned_strain[4] = 0.0;
      const PointTrial a = point.evaluate(straining(strain), dt, false),
                       b = point.turned(r).evaluate(straining(turned_strain), dt, false);
      if (a.ok != b.ok || (!a.ok && !limits_.may_fail)) ++failed;
      if (!a.ok || !b.ok) continue;
      Six expected;
      sym6::rotate(r.data(), a.stress.data(), expected.data());
      for (int c = 0; c < 6; ++c) worst = std::max(worst, std::abs(b.stress[c] - expected[c]) / norm(a.stress));
      worst = std::max(worst, state_error(r, a.state, b.state));
    }
    return {"isotropy", failed == 0 && worst < limits_.rotation,
            text("rotated input, largest difference %.1e (allowed %.0e), %d of %d points failed", worst,
                 limits_.rotation, failed, limits_.rotation_points)};
  }

  /// No strain in zero time changes nothing. The increment before also has zero time, or a viscous law would relax.
  ConformanceCheck idleness() const {
    Sampler sample = sampler(6);
    double worst = 0.0;
    int failed = 0;
    for (int n = 0; n < 200; ++n) {
      MaterialPoint point = start(law_, sample.point());
      const PointMotion motion = straining(sample.increment(1e-4, 1e-2));
      const PointTrial moved = point.evaluate(motion, 0.0, false);
      if (!moved.ok && limits_.may_fail) continue;
      if (moved.ok) point.commit(motion, 0.0, moved);
      const PointTrial still = point.evaluate({}, 0.0, false);
      if (!moved.ok || !still.ok) {
        ++failed;
        continue;
      }
      for (int c = 0; c < 6; ++c)
        worst = std::max(worst, std::abs(still.stress[c] - point.stress()[c]) / norm(point.stress()));
      for (std::size_t c = 0; c < still.state.size(); ++c) {
        const double change = std::abs(still.state[c] - point.state()[c]);
        if (change > 0.0) worst = std::max(worst, change / std::abs(point.state()[c]));
      }
    }
    return {"idleness", failed == 0 && worst < limits_.idle,
            text("no strain changes stress and state by %.1e (allowed %.0e), %d of 200 points failed", worst,
                 limits_.idle, failed)};
  }

  ConformanceCheck finite_numbers() const {
    Sampler sample = sampler(4);
    int failed = 0, undefined = 0, absurd_points = 0;
    for (int n = 0; n < limits_.random_points; ++n) {
      const MaterialPoint point = start(law_, sample.point());
      const bool absurd = n % 100 == 0;  // such an increment may fail, but must be reported as failed
      absurd_points += absurd ? 1 : 0;
      const PointTrial trial = point.evaluate(straining(sample.increment(1e-8, absurd ? 1e3 : 5e-2)), dt, true);
      failed += !trial.ok && !absurd ? 1 : 0;
      double sum = 0.0;
      for (const double x : trial.stress) sum += x;
      for (const double x : trial.tangent) sum += x;
      for (const double x : trial.state) sum += x;
      undefined += std::isfinite(sum) ? 0 : 1;
    }
    return {"finite numbers", undefined == 0 && (limits_.may_fail || failed == 0),
            text("%d of %d random increments give NaN or infinity; %d of %d up to 5 %% strain fail", undefined,
                 limits_.random_points, failed, limits_.random_points - absurd_points)};
  }

  ConformanceCheck state_and_moduli() const {
    Sampler sample = sampler(5);
    std::string fault;
    for (int n = 0; n < 100; ++n) {
      if (!fault.empty()) break;
      const InitialPoint point = sample.point();
      const MaterialPoint at = start(law_, point);
      int slot = 0;
      for (const StateVariable& variable : law_.state_variables()) {
        if (variable.name.empty() || variable.unit.empty()) fault = "a state variable has no name or no unit";
        for (int c = 0; c < variable.components; ++c, ++slot)
          if (!(at.state()[slot] >= variable.low && at.state()[slot] <= variable.high))
            fault = "'" + variable.name +
                    text("' starts at %g, outside [%g, %g]", at.state()[slot], variable.low, variable.high);
      }
      const ElasticModuli m = law_.moduli(point.stress.data(), point.void_ratio, at.state().data());
      if (!(m.bulk > 0.0 && m.shear > 0.0 && std::isfinite(m.bulk) && std::isfinite(m.shear)))
        fault = text("the moduli %g and %g Pa are not positive", m.bulk, m.shear);
    }
    return {"state", fault.empty(),
            fault.empty() ? text("%d variables with name, unit and a start within bounds; moduli positive",
                                 static_cast<int>(law_.state_variables().size()))
                          : fault};
  }

 private:
  Sampler sampler(unsigned seed) const { return Sampler(law_, seed, in_plane_); }

  /// Largest error of the tangent, relative to its largest entry; negative where the law fails.
  double tangent_error(const MaterialPoint& point, const Six& increment) const {
    const PointTrial at = point.evaluate(straining(increment), dt, true);
    if (!at.ok) return -1.0;
    double error = 0.0, size = 0.0;
    const double step = std::max(1e-9, 1e-5 * norm(increment));
    for (int j = 0; j < 6; ++j) {
      if (in_plane_ && (j == 3 || j == 4)) continue;
      Six shifted = increment;
      shifted[j] = increment[j] + step;
      const PointTrial high = point.evaluate(straining(shifted), dt, false);
      shifted[j] = increment[j] - step;
      const PointTrial low = point.evaluate(straining(shifted), dt, false);
      if (!high.ok || !low.ok) return -1.0;
      for (int i = 0; i < 6; ++i) {
        error = std::max(error, std::abs(at.tangent[6 * i + j] - (high.stress[i] - low.stress[i]) / (2 * step)));
        size = std::max(size, std::abs(at.tangent[6 * i + j]));
      }
    }
    return size > 0.0 ? error / size : error;
  }

  double state_error(const std::array<double, 9>& r, const std::vector<double>& a, const std::vector<double>& b) const {
    double worst = 0.0;
    int slot = 0;
    for (const StateVariable& variable : law_.state_variables()) {
      std::vector<double> expected(a.begin() + slot, a.begin() + slot + variable.components);
      double size = 1.0;
      for (const double x : expected) size = std::max(size, std::abs(x));
      if (variable.components == 6) sym6::rotate(r.data(), &a[slot], expected.data());
      if (!variable.in_fixed_axes)
        for (int c = 0; c < variable.components; ++c)
          worst = std::max(worst, std::abs(b[slot + c] - expected[c]) / size);
      slot += variable.components;
    }
    return worst;
  }

  const Skeleton& law_;
  const ConformanceLimits& limits_;
  bool in_plane_;
};

ConformanceCheck documented(const EntryDoc& entry) {
  std::vector<std::string> bare;
  for (const ParameterDoc& p : entry.parameters)
    if (p.name != "type" && (p.doc.empty() || (p.unit.empty() && p.type.find("double") != std::string::npos)))
      bare.push_back(p.name);
  const bool good = bare.empty() && !entry.summary.empty();
  return {"documentation", good,
          good           ? text("%d parameters with unit and meaning", static_cast<int>(entry.parameters.size()))
          : bare.empty() ? std::string("the type has no summary")
                         : "without unit or meaning: " + join(bare)};
}

}  // namespace

std::vector<ConformanceCheck> check_conformance(const Skeleton& law, const EntryDoc& documentation,
                                                const ConformanceLimits& limits) {
  const Suite suite(law, limits);
  std::vector<ConformanceCheck> checks{suite.starts()};
  if (checks.front().passed)  // otherwise the checks below are meaningless
    checks.insert(checks.end(), {suite.purity(), suite.tangent(), suite.isotropy(), suite.idleness(),
                                 suite.finite_numbers(), suite.state_and_moduli()});
  checks.push_back(documented(documentation));
  return checks;
}

}  // namespace mudline
