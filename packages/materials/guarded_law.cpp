#include "materials/guarded_law.hpp"

#include <cmath>
#include <set>

#include "core/foreign_library.hpp"
#include "core/guarded.hpp"
#include "core/text.hpp"
#include "core/told.hpp"

namespace mudline {

namespace {

bool finite(const double* values, std::size_t count) {
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += 0.0 * values[i];  // NaN where one is not finite
  return sum == 0.0;
}

/// "" or the quantity that is not finite in the result for one point.
std::string not_finite(const SkeletonWorkset& w, int i) {
  const std::size_t n = w.state.extent(1);
  if (!finite(w.stress.data() + 6 * i, 6)) return "it returns a stress that is not finite";
  if (!finite(w.state.data() + n * i, n)) return "it returns a state that is not finite";
  if (w.want_tangent && !finite(w.tangent.data() + 36 * i, 36)) return "it returns a tangent that is not finite";
  return "";
}

void show_old_state(const SkeletonWorkset& w, int i) {
  for (int c = 0; c < 6; ++c) w.stress(i, c) = w.stress_old(i, c);
  for (std::size_t c = 0; c < w.state.extent(1); ++c) w.state(i, c) = w.state_old(i, c);
  if (w.want_tangent)
    for (int c = 0; c < 36; ++c) w.tangent(i, c) = 0.0;
}

}  // namespace

std::string state_problem(const Skeleton& law) {
  std::set<std::string> names;
  for (const StateVariable& v : law.state_variables()) {
    if (v.name.empty()) return "a state variable of the law has no name";
    if (!names.insert(v.name).second) return "two state variables of the law are called '" + v.name + "'";
    if (v.components != 1 && v.components != 6)
      return "the state variable '" + v.name + "' of the law has " + std::to_string(v.components) +
             " components; allowed: 1, or 6 of a tensor";
  }
  return "";
}

std::string guarded_k0(const Skeleton& law, const InitialPoint& point, double& k0) {
  try {
    k0 = law.k0(point);
  } catch (...) {
    return "the K0 of its law throws: " + fault_thrown();
  }
  return std::isfinite(k0) ? "" : "the K0 of its law is not finite; give 'K0'";
}

std::string guarded_stress(const Skeleton& law, InitialPoint& point) {
  try {
    const std::string problem = law.find_stress(point);
    if (!problem.empty()) return last_line(problem);
  } catch (...) {
    return "the initial stress of its law throws: " + fault_thrown();
  }
  return finite(point.stress.data(), 6) ? "" : "the initial stress of its law is not finite";
}

std::string start_guarded(const Skeleton& law, const InitialPoint& point, double* state) {
  ElasticModuli m{};
  try {
    const std::string reason = law.initialise(point, state);
    if (!reason.empty()) return last_line(reason);
    if (!finite(state, law.state_size())) return "its law starts with a state that is not finite";
    m = law.moduli(point.stress.data(), point.void_ratio, state);
  } catch (...) {
    return "its law throws: " + fault_thrown();
  }
  if (m.bulk > 0 && m.shear > 0 && std::isfinite(m.bulk) && std::isfinite(m.shear)) return "";
  return "its law gives a bulk modulus of " + number_text(m.bulk) + " Pa and a shear modulus of " +
         number_text(m.shear) + " Pa; both must be positive and finite";
}

int evaluate_guarded(const Skeleton& law, const SkeletonWorkset& w, LawFailure& first) {
  int failures = 0;
  const OpenDescriptors before;
  try {
    failures = law.evaluate(w);
    check_foreign_code(&before);  // before the ranks wait for each other, by files that may be gone
  } catch (...) {
    first = {0, "it throws: " + fault_thrown(), false};
    for (int i = 0; i < w.points; ++i) {
      w.failed(i) = 1;
      show_old_state(w, i);
    }
    return w.points;
  }
  for (int i = 0; i < w.points; ++i) {
    const bool refused = w.failed(i) != 0;
    std::string reason = refused ? "it refuses the increment" : not_finite(w, i);
    if (reason.empty()) continue;
    if (!refused) {
      w.failed(i) = 1;
      ++failures;
      show_old_state(w, i);
    }
    if (first.point < 0) first = {i, std::move(reason), refused};
  }
  return failures;
}

std::string increment_text(const double* stress, const double* strain) {
  std::string text;
  for (const double* six : {stress, strain}) {
    text += six == stress ? "effective stress xx yy zz yz xz xy =" : " Pa, strain increment";
    for (int c = 0; c < 6; ++c) text += told(six[c], " %.4g");
  }
  return text;
}

}  // namespace mudline
