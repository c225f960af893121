#include "physics/solid/stress_update.hpp"

#include <algorithm>
#include <vector>

#include "core/told.hpp"
#include "discretisation/mesh_topology.hpp"
#include "framework/element_loop.hpp"
#include "physics/mixture.hpp"
#include "physics/solid/point_surroundings.hpp"
#include "physics/solid/step_motion.hpp"

namespace mudline {

namespace {

/// Writes deformation gradient and rotation of a step as columns of Surroundings. Where the step inverts the element,
/// which is a failure, they are those of no motion. longer: share by which all lengths grow beyond the motion.
template <class C, int S, class T>
KOKKOS_INLINE_FUNCTION void write_motion(const PointFields<C, S, T>& at, const MidpointRule<C::dim>& motion, bool valid,
                                         double longer, double* row) {
  constexpr int D = C::dim;
  double *deformation = row + Surroundings::deformation, *rotation = row + Surroundings::rotation;
  for (int i = 0; i < 9; ++i) deformation[i] = rotation[i] = i % 4 == 0 ? 1.0 : 0.0;
  Mat<double, D> back, F;  // dx_n / dx_{n+1} = 1 - moved
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) back[i][j] = (i == j ? 1.0 : 0.0) - at.moved[i][j];
  const double det = determinant(back), hoop = 1 - at.hoop_moved;
  if (!valid || !(det > 0) || !(hoop > 0)) return;
  invert(back, det, F);
  const double stretch = 1 + longer;
  if constexpr (D == 2) deformation[8] = stretch / hoop;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      deformation[3 * i + j] = stretch * F[i][j];
      rotation[3 * i + j] = motion.rotation[i][j];
    }
}

/// Writes the law's input, and the void ratio of the end, at a point.
template <class C, int S>
struct PointStaging {
  ByMaterial<Mixture> mixtures;
  LawInput to;
  PointView stress, law, void_ratio_old, void_ratio;  // (point, component): committed, and trial void ratio
  PointView ratios_old, ratios;  // tensor of PermeabilityRatios: committed, trial; empty: all of ones

  /// from: row of the point's data; i: its row in the batch. False where the step inverts the point: the law sees no
  /// strain, and the step fails anyway. It is called, not inlined: one call serves all shapes of elements.
  [[gnu::noinline]] KOKKOS_FUNCTION bool stage(int from, int i, const PointFields<C, S, double>& at) const {
    MidpointRule<C::dim> motion;
    const Mixture& mixture = mixtures(from);
    const bool valid = find_motion(at, motion);
    const double swell = valid && to.dilatation.extent(0) > 0 ? to.dilatation(from, 0) : 0.0;
    motion.increment(&to.strain(i, 0));
    for (int c = 0; c < 3; ++c) to.strain(i, c) += swell / 3;
    if constexpr (S > 0)
      if (mixture.temperature >= 0)  // thermal strain is not part of the strain of the law
        for (int c = 0; c < 3; ++c) to.strain(i, c) -= mixture.grain_expansion / 3 * at.change[mixture.temperature];
    if (!valid)
      for (int c = 0; c < 6; ++c) to.strain(i, c) = 0;
    if (to.surroundings.extent(0) > 0) write_motion(at, motion, valid, ::expm1(swell / 3), &to.surroundings(i, 0));
    motion.rotate(&stress(from, 0), &to.stress_old(i, 0));
    for (std::size_t c = 0; c < to.state_old.extent(1); ++c) to.state_old(i, c) = law(from, c);
    const int material = static_cast<int>(mixtures.which(from, 0));
    for (std::size_t t = 0; t < to.tensors.extent(1) && to.tensors(material, t) >= 0; ++t)
      motion.rotate(&law(from, to.tensors(material, t)), &to.state_old(i, to.tensors(material, t)));
    if (ratios.extent(0) > 0) motion.rotate(&ratios_old(from, 0), &ratios(from, 0));
    to.void_ratio_old(i, 0) = void_ratio_old(from, 0);
    const double n = mixture.porosity(void_ratio_old(from, 0), at, 0, swell);
    void_ratio(from, 0) = n / (1 - n);
    void_ratio(from, 1) = void_ratio_old(from, 1);
    return valid;
  }
};

/// Stages the points of an element.
template <class Loop, class Staging>
struct ElementStaging {
  Loop loop;
  int first;  // element of the batch's first row
  Staging staging;

  /// Adds the number of inverted points.
  KOKKOS_FUNCTION void operator()(int e, int& inverted) const {
    const int points = loop.b.points;
    int next = 0;
    const auto stage = [&](const typename Loop::Fields& at) {
      if (!staging.stage(e * points + next, (e - first) * points + next, at)) ++inverted;
      ++next;
    };
    loop.template for_each_point<false, false, true>(
        e, [&](int, const typename Loop::Shape&, const typename Loop::Fields& at) { stage(at); });
    typename Loop::Fields still{};  // used from the point on where the element is folded: no motion
    still.volume_ratio = 1;
    inverted += points - next;
    while (next < points) stage(still);
  }
};

/// First columns of the tensor variables of each material's law: (material, number of the tensor), -1: no more.
Kokkos::View<int**> tensor_columns(const Soil& soil) {
  std::vector<std::vector<int>> columns;
  std::size_t most = 0;
  for (const auto& material : soil.materials) {
    std::vector<int>& own = columns.emplace_back();
    int column = 0;
    for (const StateVariable& v : material->skeleton->state_variables()) {
      if (v.components == 6) own.push_back(column);
      column += v.components;
    }
    most = std::max(most, own.size());
  }
  Kokkos::View<int**> result("tensors", columns.size(), most);
  Kokkos::deep_copy(result, -1);
  for (std::size_t k = 0; k < columns.size(); ++k)
    for (std::size_t t = 0; t < columns[k].size(); ++t) result(k, t) = columns[k][t];
  return result;
}

}  // namespace

StressUpdate::StressUpdate(const Soil& soil, const SoilBlock& block, const StepView& view, Tangent tangent,
                           const PointView& all)
    : soil_(soil),
      block_(block),
      view_(view),
      points_(soil, block, *view.committed),
      level_(end_level(view, block)),
      wanted_(tangent) {
  const int rows = elements_of_batch() * block.points;
  const std::size_t state_size = view.committed->arrays[block.law].extent(1);
  input_.strain = PointView("strain", rows, 6);
  input_.stress_old = PointView("rotated stress", rows, 6);
  input_.void_ratio_old = PointView("void ratio", rows, 1);
  input_.state_old = PointView("rotated state", rows, state_size);
  tangent_ = wanted_ == Tangent::all ? all : PointView("tangent", wanted_ == Tangent::batch ? rows : 0, 36);
  failed_ = Kokkos::View<int*>("failed", rows);
  input_.tensors = tensor_columns(soil);
  for (int k : block.made_of)
    if (soil.materials[k]->skeleton->wants_surroundings() && input_.surroundings.extent(0) == 0)
      input_.surroundings = PointView("surroundings", rows, Surroundings::size);
}

int StressUpdate::stage_motion(int first, int last) {
  return with_moving_element(soil_.geometry, block_, [&](auto coordinates, auto shapes) {
    using Loop = ElementLoop<decltype(coordinates), decltype(shapes)>;
    const State &old = *view_.committed, &now = *view_.trial;
    using Staging = PointStaging<decltype(coordinates), Loop::S>;
    const Staging staging{mixtures_of(soil_, block_, old),
                          input_,
                          old.arrays[block_.stress],
                          old.arrays[block_.law],
                          old.arrays[block_.void_ratio],
                          now.arrays[block_.void_ratio],
                          block_.permeability >= 0 ? old.arrays[block_.permeability] : PointView(),
                          block_.permeability >= 0 ? now.arrays[block_.permeability] : PointView()};
    int inverted = 0;
    Kokkos::parallel_reduce("kinematics", Kokkos::RangePolicy<>(first, last),
                            ElementStaging<Loop, Staging>{{block_, level_}, first, staging}, inverted);
    return inverted;
  });
}

int StressUpdate::run(int first, int last) {
  int failures = stage_motion(first, last);
  if (input_.surroundings.extent(0) > 0) write_surroundings(soil_, block_, view_, first, last, input_.surroundings);
  const int count = (last - first) * block_.points, row = first * block_.points;
  if (failures > 0 && failure_.empty())
    failure_ = "material '" + points_.material(row).name + "': the motion turns elements inside out";
  for (int begin = 0, end = 0; begin < count; begin = end) {  // runs of points of the same material
    const SoilMaterial& material = points_.material(row + begin);
    while (end < count && &points_.material(row + end) == &material) ++end;
    failures += run_law(material, row, begin, end);
  }
  return failures;
}

int StressUpdate::run_law(const SoilMaterial& material, int row, int begin, int end) {
  const PointView stress = view_.trial->arrays[block_.stress], law = view_.trial->arrays[block_.law];
  const int count = end - begin, from = row + begin;
  const auto part = [&](const PointView& rows, int start) {
    return PointView(rows.data() + start * rows.extent(1), count, rows.extent(1));
  };
  SkeletonWorkset w;
  w.points = count;
  w.time = view_.time_end;
  w.dt = view_.flow ? view_.dt : 0.0;
  w.want_tangent = wanted_ != Tangent::none;
  w.stress_old = part(input_.stress_old, begin);
  w.strain = part(input_.strain, begin);
  w.void_ratio_old = part(input_.void_ratio_old, begin);
  w.state_old = part(input_.state_old, begin);
  w.stress = part(stress, from);
  w.state = part(law, from);
  if (w.want_tangent) w.tangent = part(tangent_, wanted_ == Tangent::all ? from : begin);
  w.failed = Kokkos::View<int*>(failed_.data() + begin, count);
  w.plane = soil_.geometry != Geometry::space;
  w.increment = view_.increment;
  w.strength_factor = soil_.strength_factor(view_.time_end - view_.increment.stage_start);
  if (material.skeleton->wants_surroundings()) w.surroundings = part(input_.surroundings, begin);
  LawFailure failure;
  const int failures = evaluate_guarded(*material.skeleton, w, failure);
  if (failure.point >= 0 && failure_.empty()) {
    failure_ = describe(material, row, begin + failure.point, failure);
    law_is_broken_ = !failure.refused;
  }
  return failures;
}

std::string StressUpdate::describe(const SoilMaterial& material, int row, int point, const LawFailure& failure) const {
  const int e = (row + point) / block_.points, q = (row + point) % block_.points;
  return "the law of material '" + material.name + "' fails at " +
         place_text(block_.place(e, q, view_.x_end), soil_.space->mesh().dimension()) + ": " + failure.reason + " (" +
         increment_text(&input_.stress_old(point, 0), &input_.strain(point, 0)) + ")";
}

}  // namespace mudline
