#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "contact/contact_rule.hpp"
#include "contact/contact_surface.hpp"
#include "contact/side_box.hpp"
#include "framework/surface_points.hpp"

namespace mudline {

/// The points of a slave surface, its nodes or its Gauss points, in rows: those of a side follow each other, side after
/// side.
class SlavePoints : public ContactSurface {
 public:
  /// Collective.
  SlavePoints(const Mesh& mesh, const std::string& side_set, SideRule::At kind, int quadrature_degree);

  const ContactRule& rule(const SurfaceSide& side) const { return rules_.at(side.shape); }
  int first_row(std::size_t side) const { return first_row_[side]; }
  int end_row(std::size_t side) const { return first_row_[side + 1]; }
  int rows() const { return first_row_.back(); }
  /// The rows as places of state arrays.
  const std::shared_ptr<const SurfacePoints>& places() const { return places_; }
  Bounds box(std::size_t side, const ConstCoordinateView& x) const {
    return side_box(sides()[side].node, sides()[side].count, x);
  }
  /// Means of a quantity at the points, by local node, weighted by nearness and by `share` of the row. Collective.
  std::vector<double> nodal_mean(const std::function<double(int row)>& quantity,
                                 const std::function<double(int row)>& share) const;

 private:
  std::map<CellShape, ContactRule> rules_;  // of the sides
  std::vector<int> first_row_;              // (side) one more: number of rows
  std::shared_ptr<const SurfacePoints> places_;
};

}  // namespace mudline
