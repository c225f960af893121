#include "contact/nodes/node_chain.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace mudline {

std::vector<NodeChain> node_chains(const std::vector<MasterSurface::MasterSide>& sides) {
  std::map<int, int> from, to;  // side that starts, that ends at a node
  std::set<int> crowded;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (!from.emplace(sides[s].node[0], static_cast<int>(s)).second) crowded.insert(sides[s].node[0]);
    if (!to.emplace(sides[s].node[1], static_cast<int>(s)).second) crowded.insert(sides[s].node[1]);
  }
  std::vector<char> used(sides.size(), 0);
  const auto follow = [&](int s) {
    NodeChain chain;
    chain.nodes.push_back(sides[s].node[0]);
    while (true) {
      used[s] = 1;
      if (sides[s].count == 3) chain.nodes.push_back(sides[s].node[2]);
      const int end = sides[s].node[1];
      chain.nodes.push_back(end);
      const auto next = from.find(end);
      if (crowded.count(end) || next == from.end() || used[next->second]) break;
      s = next->second;
    }
    if (chain.nodes.size() > 2 && chain.nodes.front() == chain.nodes.back() && !crowded.count(chain.nodes.front())) {
      chain.nodes.pop_back();
      chain.closed = true;
    }
    return chain;
  };
  std::vector<NodeChain> result;
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (!to.count(sides[s].node[0]) || crowded.count(sides[s].node[0])) result.push_back(follow(static_cast<int>(s)));
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (!used[s]) result.push_back(follow(static_cast<int>(s)));
  return result;
}

std::vector<NodeChain> cut_at_corners(const std::vector<NodeChain>& chains, double angle,
                                      const ConstCoordinateView& x) {
  const auto turns = [&](int before, int at, int after) {
    const double a[2] = {x(at, 0) - x(before, 0), x(at, 1) - x(before, 1)},
                 b[2] = {x(after, 0) - x(at, 0), x(after, 1) - x(at, 1)};
    return std::abs(std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])) > angle;
  };
  std::vector<NodeChain> result;
  for (NodeChain chain : chains) {
    const int n = static_cast<int>(chain.nodes.size());
    if (chain.closed) {  // starts at a corner, if it has one
      int corner = -1;
      for (int i = 0; i < n; ++i)
        if (turns(chain.nodes[(i + n - 1) % n], chain.nodes[i], chain.nodes[(i + 1) % n])) {
          corner = i;
          break;
        }
      if (corner < 0) {
        result.push_back(chain);
        continue;
      }
      std::rotate(chain.nodes.begin(), chain.nodes.begin() + corner, chain.nodes.end());
      chain.nodes.push_back(chain.nodes.front());
      chain.closed = false;
    }
    NodeChain part{{chain.nodes.front()}, false};
    for (std::size_t i = 1; i < chain.nodes.size(); ++i) {
      part.nodes.push_back(chain.nodes[i]);
      if (i + 1 == chain.nodes.size() || !turns(chain.nodes[i - 1], chain.nodes[i], chain.nodes[i + 1])) continue;
      result.push_back(part);
      part.nodes = {chain.nodes[i]};
    }
    result.push_back(part);
  }
  return result;
}

}  // namespace mudline
