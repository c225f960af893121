#include "contact/box_search.hpp"

#include <algorithm>

namespace mudline {

Bounds side_box(const int* node, int count, const ConstCoordinateView& x) {
  Bounds box = Bounds::nothing();
  for (int a = 0; a < count; ++a) box.enclose(place_of(x, node[a]));
  return box;
}

void BoxSearch::sort(const std::vector<Bounds>& boxes) {
  boxes_.clear();
  Bounds whole = Bounds::nothing();
  for (std::size_t s = 0; s < boxes.size(); ++s) {
    boxes_.push_back({boxes[s], static_cast<int>(s)});
    whole.enclose(boxes[s].low);
    whole.enclose(boxes[s].high);
  }
  const auto& [low, high] = whole;
  along_ = 0;
  for (int i = 1; i < 3; ++i)
    if (high[i] - low[i] > high[along_] - low[along_]) along_ = i;
  std::sort(boxes_.begin(), boxes_.end(), [this](const Box& a, const Box& b) {
    return a.at.low[along_] != b.at.low[along_] ? a.at.low[along_] < b.at.low[along_] : a.number < b.number;
  });
  longest_ = 0;
  for (const Box& box : boxes_) longest_ = std::max(longest_, box.at.high[along_] - box.at.low[along_]);
}

std::vector<int> BoxSearch::near(const Bounds& around, double distance) const {
  const auto& [low, high] = around;
  std::vector<int> result;
  const double from = low[along_] - distance - longest_, to = high[along_] + distance;
  auto box = std::lower_bound(boxes_.begin(), boxes_.end(), from,
                              [this](const Box& b, double v) { return b.at.low[along_] < v; });
  for (; box != boxes_.end() && box->at.low[along_] <= to; ++box) {
    bool apart = false;
    for (std::size_t i = 0; i < 3; ++i)
      apart = apart || box->at.low[i] > high[i] + distance || box->at.high[i] < low[i] - distance;
    if (!apart) result.push_back(box->number);
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace mudline
