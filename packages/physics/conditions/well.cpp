#include "physics/conditions/well.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "algebra/raw_communicator.hpp"
#include "physics/conditions/fluid_supply.hpp"
#include "tensor/vec.hpp"

namespace mudline {

std::string shares_of_line(const std::vector<double>& points, std::vector<double>& shares) {
  const std::size_t count = points.size() / 3;
  const auto place = [&](std::size_t i) { return Point{points[3 * i], points[3 * i + 1], points[3 * i + 2]}; };
  shares.assign(count, 1.0);
  if (count == 0) return "it has no nodes with a pore pressure";
  if (count == 1) return "";
  const auto farthest = [&](const Point& from) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < count; ++i)
      if (length(place(i) - from) > length(place(best) - from)) best = i;
    return place(best);
  };
  const Point begin = farthest(place(0)), end = farthest(begin);
  const double all = length(end - begin);
  const Point along = 1 / all * (end - begin);
  std::vector<double> at(count);
  for (std::size_t i = 0; i < count; ++i) {
    at[i] = dot(place(i) - begin, along);
    constexpr double tolerance = 1e-6;  // of the length
    if (length(place(i) - begin - at[i] * along) > tolerance * all) return "its nodes do not lie on a straight line";
  }
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return at[i] < at[j]; });
  for (std::size_t k = 0; k < count; ++k) {
    const double low = at[order[k > 0 ? k - 1 : k]], high = at[order[k + 1 < count ? k + 1 : k]];
    shares[order[k]] = (high - low) / (2 * all);
  }
  return "";
}

void Well::parameters(Parameters& p) {
  p.required("set", set_, "mesh set: one point, or nodes or sides along a straight line");
  p.required(
      "discharge", discharge_, "m3/s",
      "water that enters the soil along the whole well, of what is modelled: in plane strain per metre of depth, in "
      "axial symmetry of the whole circumference; negative: it is pumped out; a function of time");
}

void Well::bind(const ConditionContext& context, const Section& section) {
  const std::shared_ptr<const Soil> soil = supplied_soil(context, section);
  const Space& space = context.space;
  const Mesh& mesh = space.mesh();
  require_set(mesh, section, "set", set_);
  shares_.clear();
  std::vector<double> own;
  for (const int node : mesh.nodes_of_set(set_)) {
    const int dof = space.node_dof(soil->pressure)(node);
    if (dof < 0 || node >= mesh.num_owned_nodes()) continue;
    shares_.push_back({dof, 0.0});
    const Point x = mesh.place(node);
    own.insert(own.end(), x.begin(), x.end());
  }
  std::size_t first = 0;
  const std::vector<double> all = all_gather(*mesh.comm(), own, &first);
  std::vector<double> shares;
  const std::string problem = shares_of_line(all, shares);
  if (!problem.empty()) section.fail("a well is a point or a straight line; set '" + set_ + "': " + problem, "set");
  for (std::size_t i = 0; i < shares_.size(); ++i) shares_[i].share = shares[first / 3 + i];
}

int Well::residual(const StepView& view, const ResidualView& f) {
  if (!view.flow) return 0;
  const double discharge = discharge_(view.balance.time, {0, 0, 0});
  for (const Share& s : shares_) f.add(s.dof, -s.share * discharge);
  return 0;
}

}  // namespace mudline
