#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "discretisation/mesh.hpp"

namespace mudline {

/// A uniform grid of about as many cells as there are boxes, to find the boxes near another one.
class BoxGrid {
 public:
  explicit BoxGrid(std::vector<Bounds> boxes) : boxes_(std::move(boxes)) {
    Bounds all = Bounds::nothing();
    for (const Bounds& box : boxes_) {
      all.enclose(box.low);
      all.enclose(box.high);
    }
    int directions = 0;
    for (int i = 0; i < 3; ++i) directions += all.high[i] > all.low[i];
    const double count = std::pow(static_cast<double>(boxes_.size()), 1.0 / std::max(directions, 1));
    std::size_t cells = 1;
    for (int i = 0; i < 3; ++i) {
      cells_[i] = all.high[i] > all.low[i] ? std::max(1, static_cast<int>(count + 1e-9)) : 1;
      low_[i] = all.low[i];
      size_[i] = std::max((all.high[i] - all.low[i]) / cells_[i], std::numeric_limits<double>::min());
      cells *= cells_[i];
    }
    lists_.resize(cells);
    for (std::size_t b = 0; b < boxes_.size(); ++b)
      for_each_cell(boxes_[b], [&](std::vector<int>& list) { list.push_back(static_cast<int>(b)); });
  }

  /// Calls f(number) for every box that meets `box`, for some of them more than once.
  template <class F>
  void near(const Bounds& box, F&& f) {
    for_each_cell(box, [&](const std::vector<int>& list) {
      for (int b : list)
        if (meet(boxes_[b], box)) f(b);
    });
  }

 private:
  static bool meet(const Bounds& a, const Bounds& b) {
    for (int i = 0; i < 3; ++i)
      if (a.low[i] > b.high[i] || b.low[i] > a.high[i]) return false;
    return true;
  }
  int cell(double x, int i) const {
    return static_cast<int>(std::min(std::max((x - low_[i]) / size_[i], 0.0), cells_[i] - 1.0));
  }
  template <class F>
  void for_each_cell(const Bounds& box, F&& f) {
    for (int i = cell(box.low[0], 0); i <= cell(box.high[0], 0); ++i)
      for (int j = cell(box.low[1], 1); j <= cell(box.high[1], 1); ++j)
        for (int k = cell(box.low[2], 2); k <= cell(box.high[2], 2); ++k)
          f(lists_[(static_cast<std::size_t>(i) * cells_[1] + j) * cells_[2] + k]);
  }

  std::vector<Bounds> boxes_;
  int cells_[3];
  double low_[3], size_[3];
  std::vector<std::vector<int>> lists_;
};

}  // namespace mudline
