#include "contact/box_search.hpp"

#include <algorithm>

namespace mudline {

void BoxSearch::sort(const std::vector<Corners>& boxes) {
  boxes_.clear();
  PlanePoint low{1e300, 1e300}, high{-1e300, -1e300};
  for (std::size_t s = 0; s < boxes.size(); ++s) {
    boxes_.push_back({boxes[s][0], boxes[s][1], static_cast<int>(s)});
    for (int i = 0; i < 2; ++i) {
      low[i] = std::min(low[i], boxes[s][0][i]);
      high[i] = std::max(high[i], boxes[s][1][i]);
    }
  }
  along_ = high[0] - low[0] >= high[1] - low[1] ? 0 : 1;
  std::sort(boxes_.begin(), boxes_.end(), [this](const Box& a, const Box& b) {
    return a.low[along_] != b.low[along_] ? a.low[along_] < b.low[along_] : a.number < b.number;
  });
  longest_ = 0;
  for (const Box& box : boxes_) longest_ = std::max(longest_, box.high[along_] - box.low[along_]);
}

std::vector<int> BoxSearch::near(const Corners& around, double distance) const {
  const auto& [low, high] = around;
  std::vector<int> result;
  const double from = low[along_] - distance - longest_, to = high[along_] + distance;
  auto box = std::lower_bound(boxes_.begin(), boxes_.end(), from,
                              [this](const Box& b, double v) { return b.low[along_] < v; });
  for (; box != boxes_.end() && box->low[along_] <= to; ++box) {
    bool apart = false;
    for (int i = 0; i < 2; ++i) apart = apart || box->low[i] > high[i] + distance || box->high[i] < low[i] - distance;
    if (!apart) result.push_back(box->number);
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace mudline
