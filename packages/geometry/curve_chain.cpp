#include "geometry/curve_chain.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/text.hpp"

namespace mudline {

namespace {

std::string place(const PlanePoint& x) { return "(" + number_text(x[0]) + ", " + number_text(x[1]) + ")"; }

}  // namespace

std::vector<CadCurve> backwards(const std::vector<CadCurve>& chain) {
  std::vector<CadCurve> result;
  for (auto curve = chain.rbegin(); curve != chain.rend(); ++curve) result.push_back(curve->reversed());
  return result;
}

std::vector<CadCurve> chained(const std::vector<CadCurve>& curves, double tolerance, const Section& section,
                              const std::string& entry) {
  const auto meet = [tolerance](const PlanePoint& a, const PlanePoint& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1]) <= tolerance;
  };
  std::vector<CadCurve> chain{curves.front()}, rest(curves.begin() + 1, curves.end());
  // appends the curve that fits at the end, as long as there is one
  const auto extend = [&] {
    while (!rest.empty()) {
      const PlanePoint end = chain.back().end();
      if (meet(end, chain.front().start())) return;  // closed
      std::vector<std::size_t> fitting;
      for (std::size_t i = 0; i < rest.size(); ++i)
        if (meet(rest[i].start(), end) || meet(rest[i].end(), end)) fitting.push_back(i);
      if (fitting.empty()) return;
      if (fitting.size() > 1)
        section.fail("curves " + std::to_string(chain.back().tag) + ", " + std::to_string(rest[fitting[0]].tag) +
                         " and " + std::to_string(rest[fitting[1]].tag) + " meet at " + place(end) +
                         ": a contour does not branch",
                     entry);
      const CadCurve& next = rest[fitting[0]];
      chain.push_back(meet(next.start(), end) ? next : next.reversed());
      rest.erase(rest.begin() + fitting[0]);
    }
  };
  extend();
  if (!rest.empty()) {
    chain = backwards(chain);
    extend();
    chain = backwards(chain);
  }
  if (!rest.empty())
    section.fail("curve " + std::to_string(rest[0].tag) + " from " + place(rest[0].start()) + " to " +
                     place(rest[0].end()) + " does not meet the others, whose ends are " +
                     place(chain.front().start()) + " and " + place(chain.back().end()),
                 entry);
  return chain;
}

}  // namespace mudline
