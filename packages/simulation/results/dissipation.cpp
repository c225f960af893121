#include "simulation/results/dissipation.hpp"

#include <cmath>

namespace mudline {

namespace {

struct Share {
  const char* name;  // behind that of the pressure
  double left;
};

constexpr Share shares[] = {{" half dissipated after", 0.5}, {" nine tenths dissipated after", 0.1}};

/// The time since the stage's begin at which the pressure was `level`, between the last two steps.
double crossing(const RunView& run, double before, double now, double level) {
  const double t = run.state.time - run.stage_start, t_before = t - run.dt;
  const double part = before > now ? (before - level) / (before - now) : 1.0;
  if (t_before <= 1e-9 * t) return part * t;
  return t_before * std::pow(t / t_before, part);
}

}  // namespace

void follow_dissipation(const RunView& run, const std::string& of, const std::string& pressure, double now,
                        double highest, ResultTable& to) {
  const std::string& stage = run.stage.name;
  const std::string end = pressure + " at the end", peak = "highest " + pressure;
  const Result* const last = to.find(stage, of, end);
  const double before = last != nullptr ? std::abs(last->value) : std::abs(highest);
  const Result* const highest_before = to.find(stage, of, peak);
  const bool grown = highest_before == nullptr || std::abs(highest) > std::abs(highest_before->value);
  if (grown) to.set(stage, of, peak, "Pa", highest);
  to.set(stage, of, end, "Pa", now);
  for (const Share& share : shares) {
    if (grown) to.remove(stage, of, pressure + share.name);
    const double level = share.left * std::abs(highest);
    if (std::abs(now) <= level && level > 0 && to.find(stage, of, pressure + share.name) == nullptr)
      to.set(stage, of, pressure + share.name, "s", crossing(run, before, std::abs(now), level));
  }
}

void forget_dissipation(const RunView& run, const std::string& of, const std::string& pressure, ResultTable& from) {
  for (const std::string& name : {pressure + " at the end", "highest " + pressure})
    from.remove(run.stage.name, of, name);
  for (const Share& share : shares) from.remove(run.stage.name, of, pressure + share.name);
}

}  // namespace mudline
