#include "simulation/results/result_lines.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/told.hpp"
#include "simulation/results/dissipation.hpp"
#include "simulation/results/safety.hpp"

namespace mudline {

namespace {

/// The results of one thing in one stage, as a line.
class Line {
 public:
  Line(const ResultTable& all, std::string stage, std::string of)
      : all_(all), stage_(std::move(stage)), of_(std::move(of)) {}

  std::string text() {
    add_depth();
    for (const char* force : forces_) add_force(force);
    add_excess("excess pore pressure");
    add_excess(wall_pressure);
    add_safety();
    add_rest();
    return parts_.empty() ? "" : head() + of_ + ": " + parts_;
  }

 private:
  std::string head() const {
    if (stage_.empty()) return "";
    const Result* const duration = all_.find(stage_, "stage", "duration");
    return stage_ + (duration != nullptr ? " (" + value(*duration) + ")" : "") + ", ";
  }
  /// A result that the line tells; null where there is none.
  const Result* take(const std::string& quantity) {
    taken_.push_back(quantity);
    return all_.find(stage_, of_, quantity);
  }
  static std::string value(const Result& result) { return readable(result.value, result.unit); }
  void add(const std::string& part) { parts_ += (parts_.empty() ? "" : "; ") + part; }

  void add_depth() {
    take("height of the mudline");
    take("depth of the tip at the start");
    take(modelled_share);
    if (const Result* const depth = take("depth of the tip"))
      add("tip " + readable(std::abs(depth->value), "m") + (depth->value < 0 ? " above" : " below") + " the mudline");
    const Result* const speed = take("speed");
    if (speed != nullptr && std::abs(speed->value) >= slowest_) add("moves at " + value(*speed));
  }

  /// A force at the end of the stage, with its parts, and its extremes where these are larger.
  void add_force(const std::string& name) {
    const std::string parts = name == "resistance" ? parts_of_resistance() : "";
    const Result* const force = take(name);
    std::string extremes = force == nullptr ? "" : extreme(*force, "highest", 1) + extreme(*force, "lowest", -1);
    if (const Result* const ratio = name == "resistance" ? take("set-up ratio") : nullptr)
      extremes += ", at its highest " + told(ratio->value, "%.3g") + " times that before the rest";
    if (force != nullptr && size_of(name) > small_ * largest_force())
      add(name + " " + value(*force) + parts + extremes);
  }
  /// The largest magnitude of a force in the stage [N].
  double size_of(const std::string& force) const {
    double size = 0;
    for (const char* extreme : {"highest ", "lowest "})
      if (const Result* const found = all_.find(stage_, of_, extreme + force))
        size = std::max(size, std::abs(found->value));
    return size;
  }
  double largest_force() const {
    double largest = 0;
    for (const char* force : forces_) largest = std::max(largest, size_of(force));
    return largest;
  }
  std::string parts_of_resistance() {
    const Result *const tip = take("tip resistance"), *const shaft = take("shaft resistance"),
                        *const mean = take("resistance over its section");
    std::string text = all_.find("", of_, modelled_share) != nullptr ? " of the half, per metre" : "";
    if (tip != nullptr && shaft != nullptr && shaft->value != 0)
      text += " (tip " + value(*tip) + ", shaft " + value(*shaft) + ")";
    if (mean != nullptr) text += ", " + value(*mean) + " over its section";
    return text;
  }
  /// ", at most 9.5 kN at 0.63 m": where it is larger than the force at the end, in the direction of the sign.
  std::string extreme(const Result& force, const std::string& which, int sign) {
    const std::string name = which + " " + force.quantity;
    const Result *const found = take(name), *const depth = take("depth at the " + name),
                        *const time = take("time of the " + name);
    const double near = 0.005 * std::abs(force.value);
    if (found == nullptr || rested(all_, stage_, of_) || sign * found->value <= std::abs(force.value) + near) return "";
    return (sign > 0 ? ", at most " : ", at least ") + value(*found) +
           (depth != nullptr ? " at " + value(*depth) : "") + (time != nullptr ? " after " + value(*time) : "");
  }

  void add_excess(const std::string& name) {
    const Result *const highest = take("highest " + name), *const end = take(name + " at the end");
    const std::string place = place_of("highest " + name);
    const Result *const time = take("highest " + name + " after"), *const half = take(name + " half dissipated after"),
                        *const most = take(name + " nine tenths dissipated after");
    if (highest == nullptr || highest->value == 0) return;
    std::string text = name + " at most " + value(*highest) + place;
    if (time != nullptr) text += " after " + value(*time);
    if (end != nullptr) text += ", " + value(*end) + " at the end";
    if (half != nullptr) text += ", half dissipated after " + value(*half);
    if (most != nullptr) text += ", nine tenths after " + value(*most);
    add(text);
  }
  std::string place_of(const std::string& quantity) {
    std::string place;
    std::vector<double> at;
    double farthest = 0;
    for (const char* axis : {"x", "y", "z"})
      if (const Result* const one = take(quantity + " at " + axis)) {
        at.push_back(one->value);
        farthest = std::max(farthest, std::abs(one->value));
      }
    constexpr double rounding = 1e-12;  // of the largest coordinate
    for (const double x : at)
      place += (place.empty() ? "" : ", ") + told(std::abs(x) > rounding * farthest ? x : 0.0, "%.4g");
    return place.empty() ? "" : " at (" + place + ")";
  }

  /// A factor of safety with its bracket, in more digits than others.
  void add_safety() {
    const Result *const found = take(factor_of_safety), *const lost = take(factor_without_equilibrium);
    if (const Result* const reached = take(factor_with_equilibrium))
      add("factor of safety above " + told(reached->value, "%.5g"));
    if (found == nullptr || lost == nullptr) return;
    add("factor of safety " + told(found->value, "%.5g") + "; no equilibrium at " + told(lost->value, "%.5g"));
  }

  /// What observers of plugins have set.
  void add_rest() {
    for (const Result& result : all_.all())
      if (result.stage == stage_ && result.of == of_ &&
          std::find(taken_.begin(), taken_.end(), result.quantity) == taken_.end())
        add(result.quantity + " " + value(result));
  }

  static constexpr const char* forces_[] = {"resistance", "force x",    "force y",
                                            "reaction x", "reaction y", "reaction z"};
  static constexpr double slowest_ = 1e-3;  // [m/s]
  static constexpr double small_ = 0.02;    // share of the largest force
  const ResultTable& all_;
  std::string stage_, of_, parts_;
  std::vector<std::string> taken_;
};

/// Stages and what has results in them, those of the whole run last.
std::vector<std::pair<std::string, std::string>> heads(const ResultTable& results) {
  const auto& all = results.all();
  const bool bodies =
      std::any_of(all.begin(), all.end(), [](const Result& result) { return result.quantity == "depth of the tip"; });
  std::vector<std::pair<std::string, std::string>> found;
  for (const bool whole : {false, true})
    for (const Result& result : all) {
      const std::pair<std::string, std::string> head(result.stage, result.of);
      // beside a body's wall the soil elsewhere is of less interest
      if (result.stage.empty() != whole || result.of == "stage" || (result.of == "soil" && bodies != whole)) continue;
      if (std::find(found.begin(), found.end(), head) == found.end()) found.push_back(head);
    }
  return found;
}

}  // namespace

std::vector<std::string> result_lines(const ResultTable& results, std::size_t most) {
  std::vector<std::string> lines;
  for (const auto& [stage, of] : heads(results))
    if (const std::string line = Line(results, stage, of).text(); !line.empty()) lines.push_back(line);
  if (lines.size() <= most) return lines;
  const auto left_out = static_cast<std::ptrdiff_t>(lines.size() - most + 1);
  lines.erase(lines.begin(), lines.begin() + left_out);
  lines.insert(lines.begin(), "(" + std::to_string(left_out) + " lines of earlier stages are left out)");
  return lines;
}

}  // namespace mudline
