#include "contact/deformable_target.hpp"

#include <algorithm>

namespace mudline {

namespace {

/// Columns of a point.
namespace place_column {
enum : int { piece, at, normal = at + 2 };
}

/// What a point sees of a deformable target, see PointAction. The motions are those of ClosestPoint.
template <class T, int D>
struct SurfaceSeen {
  static constexpr int motions = ClosestPoint::motions, most_dofs = D * max_target_nodes;

  SurfaceSeen(const DeformableTarget& target_, const PointInStep& point, const TargetPlace& place)
      : target(target_),
        nodes(target.nodes(place.piece)),
        closest(target.closest(place, point.place, point.x)),
        gap(number(closest.gap, closest.gap_slope) - point.old.offset) {
    for (int i = 0; i < D; ++i) normal[i] = number(closest.normal[i], closest.normal_slope[i]);
    if constexpr (D == 2) along = {-1.0 * normal[1], normal[0]};
  }

  /// The gap at the start is that of the state. A film flows where it grows: there it is measured anew.
  void look_back(const PointInStep& point) {
    gap_old = point.old.gap;
    if (!point.film.flows) return;
    TargetPlace start;
    const bool found = target.find(point.candidates, point.place_old, point.outward, point.capture, point.x_old, start);
    gap_old = found ? target.closest(start, point.place_old, point.x_old).gap - point.old.offset : point.capture;
  }
  void start(const PointInStep& point, ContactMotion<T, D>& motion) const {
    // from the closest point's material to the point, at the start of the step
    Vec<T, D> apart = constant<T, D>(point.place_old);
    for (int a = 0; a < nodes.count; ++a) {
      const Point there = place_of(point.x_old, nodes.node[a]);
      const T weight = number(closest.weight[a], closest.weight_slope[a]);
      for (int i = 0; i < D; ++i) apart[i] -= weight * there[i];
    }
    if (point.old.shift == 0) motion.opened = dot(apart, normal) - point.old.offset;
    if constexpr (D == 2) {
      motion.travel = -1.0 * dot(along, apart);
      motion.shear_old = T(point.old.shear.shear[0]);
    } else {
      const double* const from = point.old_columns + place_column::normal;
      motion.travel = normal * dot(normal, apart) - apart;
      motion.shear_old = transported(constant<T, 3>(point.old.shear.shear), constant<T, 3>(from), normal);
    }
    motion.slid = D == 3 && point.old.shear.slides;
  }
  Tangential<T, D> sliding() const {
    Vec<T, D> displacement;
    for (int i = 0; i < D; ++i) displacement[i] = unknown<T>(0.0, i);
    if constexpr (D == 2)
      return dot(along, displacement);
    else
      return displacement - normal * dot(normal, displacement);
  }
  Vec<T, D> traction(const Tangential<T, D>& shear) const {
    if constexpr (D == 2)
      return along * shear;
    else
      return shear;
  }
  void forces(const Vec<T, D>& force, T* f) const {
    for (int a = 0; a < nodes.count; ++a) {
      const T weight = number(closest.weight[a], closest.weight_slope[a]);
      for (int i = 0; i < D; ++i) f[D * a + i] = -1.0 * weight * force[i];
    }
  }
  void spread(const T& number, double* column) const {
    const double* const d = number.d;
    for (int a = 0; a < nodes.count; ++a)
      for (int j = 0; j < D; ++j) {
        column[D * a + j] = -closest.weight[a] * d[j];
        if (D == 2) column[D * a + j] += d[2] * closest.turn[a] * closest.normal[j];
      }
  }

  double weight(int dof) const { return closest.weight[dof / D]; }
  static double rounding(double weight) { return std::abs(weight); }

  /// A number with its derivatives by the motions.
  static T number(double value, const double* slope) {
    T result(value);
    if constexpr (!std::is_same_v<T, double>) std::copy_n(slope, motions, result.d);
    return result;
  }

  const DeformableTarget& target;
  TargetNodes nodes;
  ClosestPoint closest;
  T gap;               // [m] counted
  double gap_old = 0;  // [m] counted
  Vec<T, D> normal, along;
};

}  // namespace

void DeformableTarget::bind(const Space& space, int displacement) {
  space_ = &space;
  displacement_ = displacement;
  for (const MasterSurface::MasterSide& side : sides())
    for (int a = 0; a < side.count; ++a) {
      std::vector<int>& around = corners_[side.node[a]];
      if (!around.empty()) continue;
      for (int corner : corners_around(side.shape, a)) around.push_back(side.node[corner]);
    }
}

int* DeformableTarget::write_dofs(int piece, int* to) const {
  const TargetNodes of_piece = nodes(piece);
  return space_->write_dofs(displacement_, of_piece.node, of_piece.count, to);
}

std::vector<StateVariable> DeformableTarget::columns() const {
  std::vector<StateVariable> result;
  for (const char* name : {"piece", "place 1", "place 2", "normal x", "normal y", "normal z"})
    if (axes_ == 3 || result.size() < 2) result.push_back({name, 1, "-", Transfer::nearest});
  return result;
}

void DeformableTarget::write(const TargetPlace& place, const ContactPoint& point, double* columns) const {
  columns[place_column::piece] = place.piece;
  std::copy_n(place.at, axes_ - 1, columns + place_column::at);
  if (axes_ == 3) std::copy_n(point.normal.data(), 3, columns + place_column::normal);
}

std::vector<VertexShare> DeformableTarget::vertices(const double* columns) const {
  const int piece = old_piece(columns);
  if (piece < 0) return {};
  double weight[max_target_nodes];
  weights(piece, columns + place_column::at, weight);
  const TargetNodes of_piece = nodes(piece);
  std::vector<VertexShare> result;
  for (int a = 0; a < of_piece.count; ++a) {
    const std::vector<int>& around = corners_.at(of_piece.node[a]);
    for (int vertex : around) result.push_back({vertex, weight[a] / static_cast<double>(around.size())});
  }
  return result;
}

ContactPoint DeformableTarget::act(const PointInStep& point, const TargetPlace& place, SideAction& to) const {
  return axes_ == 2 ? act_on<SurfaceSeen, 2>(*this, point, place, to) : act_on<SurfaceSeen, 3>(*this, point, place, to);
}

void DeformableTarget::old_forces(const double* columns, const Point& force, double* on_target) const {
  double weight[max_target_nodes];
  const int piece = old_piece(columns);
  weights(piece, columns + place_column::at, weight);
  for (int a = 0; a < nodes(piece).count; ++a)
    for (int i = 0; i < axes_; ++i) on_target[axes_ * a + i] = -weight[a] * force[i];
}

}  // namespace mudline
