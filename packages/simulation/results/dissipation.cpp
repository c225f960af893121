#include "simulation/results/dissipation.hpp"

#include <cmath>
#include <utility>

namespace mudline {

namespace {

struct Share {
  const char* name;  // behind that of the pressure
  double left;
};

constexpr Share shares[] = {{" half dissipated after", 0.5}, {" nine tenths dissipated after", 0.1}};
constexpr const char *highest = "highest ", *at_the_end = " at the end";

/// The time since the stage's begin at which the pressure was `level`, in the last step.
double crossing(double time, double dt, double before, double now, double level) {
  const double time_before = time - dt;
  const double part = before > now ? (before - level) / (before - now) : 1.0;
  if (time_before <= 1e-9 * time) return part * time;
  return time_before * std::pow(time / time_before, part);
}

}  // namespace

bool rested(const ResultTable& results, const std::string& stage, const std::string& body) {
  return results.find(stage, body, std::string(wall_pressure) + at_the_end) != nullptr;
}

Dissipation::Dissipation(std::string stage, std::string of, std::string pressure, ResultTable& to)
    : stage_(std::move(stage)), of_(std::move(of)), pressure_(std::move(pressure)), to_(to) {}

bool Dissipation::follow(double time, double dt, double now, double other) {
  const double most = std::abs(other) > std::abs(now) ? other : now;
  const Result* const last = to_.find(stage_, of_, pressure_ + at_the_end);
  const double before = std::abs(last != nullptr ? last->value : most);
  const Result* const so_far = to_.find(stage_, of_, highest + pressure_);
  const bool grown = so_far == nullptr || std::abs(most) > std::abs(so_far->value);
  const double peak = std::abs(grown ? most : so_far->value);
  if (grown) to_.set(stage_, of_, highest + pressure_, "Pa", most);
  to_.set(stage_, of_, pressure_ + at_the_end, "Pa", now);
  for (const Share& share : shares) {
    const std::string name = pressure_ + share.name;
    if (grown) to_.remove(stage_, of_, name);
    const double level = share.left * peak;
    if (level > 0 && std::abs(now) <= level && to_.find(stage_, of_, name) == nullptr)
      to_.set(stage_, of_, name, "s", crossing(time, dt, before, std::abs(now), level));
  }
  return grown;
}

void Dissipation::forget() {
  for (const std::string& name : {pressure_ + at_the_end, highest + pressure_}) to_.remove(stage_, of_, name);
  for (const Share& share : shares) to_.remove(stage_, of_, pressure_ + share.name);
}

}  // namespace mudline
