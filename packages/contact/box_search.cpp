#include "contact/box_search.hpp"

#include <algorithm>

namespace mudline {

namespace {

constexpr BoxSearch::Corners empty{Point{1e300, 1e300, 1e300}, Point{-1e300, -1e300, -1e300}};

void enclose(const Point& x, BoxSearch::Corners& box) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    box[0][i] = std::min(box[0][i], x[i]);
    box[1][i] = std::max(box[1][i], x[i]);
  }
}

}  // namespace

BoxSearch::Corners side_box(const int* node, int count, const ConstCoordinateView& x) {
  BoxSearch::Corners box = empty;
  for (int a = 0; a < count; ++a) enclose(place_of(x, node[a]), box);
  return box;
}

void BoxSearch::sort(const std::vector<Corners>& boxes) {
  boxes_.clear();
  Corners whole = empty;
  for (std::size_t s = 0; s < boxes.size(); ++s) {
    boxes_.push_back({boxes[s][0], boxes[s][1], static_cast<int>(s)});
    for (const Point& corner : boxes[s]) enclose(corner, whole);
  }
  const auto& [low, high] = whole;
  along_ = 0;
  for (int i = 1; i < 3; ++i)
    if (high[i] - low[i] > high[along_] - low[along_]) along_ = i;
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
    for (std::size_t i = 0; i < low.size(); ++i)
      apart = apart || box->low[i] > high[i] + distance || box->high[i] < low[i] - distance;
    if (!apart) result.push_back(box->number);
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace mudline
