#include "physics/solid/stress_divergence.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "discretisation/agree.hpp"
#include "discretisation/mesh_topology.hpp"
#include "framework/element_loop.hpp"
#include "materials/guarded_law.hpp"
#include "physics/mixture.hpp"
#include "physics/soil_points.hpp"
#include "physics/solid/point_surroundings.hpp"
#include "tensor/mat.hpp"
#include "tensor/midpoint_rule.hpp"

namespace mudline {

namespace {

/// Evaluates the midpoint rule from the gradients at a point in the configuration of the end. Returns false where the
/// midpoint configuration is inverted.
template <class C, int S, class T>
KOKKOS_INLINE_FUNCTION bool find_motion(const PointFields<C, S, T>& at, MidpointRule<C::dim>& motion) {
  constexpr int D = C::dim;
  Mat<double, D> half, back, H;  // dx_{n+1/2} / dx_{n+1} = 1 - moved/2
  for (int i = 0; i < C::dim; ++i)
    for (int j = 0; j < C::dim; ++j) half[i][j] = (i == j ? 1.0 : 0.0) - 0.5 * at.moved[i][j];
  const double det = determinant(half), hoop = 1 - 0.5 * at.hoop_moved;
  const bool valid = det > 0 && hoop > 0;
  if (valid) invert(half, det, back);
  for (int i = 0; i < C::dim; ++i)
    for (int j = 0; j < C::dim; ++j) {
      H[i][j] = 0;
      if (valid)
        for (int k = 0; k < D; ++k) H[i][j] += at.moved[i][k] * back[k][j];
    }
  motion.evaluate(H, valid ? at.hoop_moved / hoop : 0.0, valid);
  return valid;
}

/// Total stress sigma' - alpha p from the point data. Its derivatives consist of the law's tangent D, which an
/// isotropic law gives for a strain increment in the axes of the end, and of the rotation of the stress with the
/// material.
struct TotalStress : PointLaw {
  static constexpr bool stresses = true, stands = true, rates = false;
  ByMaterial<Mixture> mixtures;
  PointView stress, stress_old;
  ConstPointView tangent;  // of the batch
  int first_row = 0;       // of the batch

  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION void operator()(int row, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    T pressure = 0.0;
    if constexpr (S > 0) {
      const Mixture& here = mixtures(row);
      if (here.pressure >= 0) pressure = here.alpha * at.value[here.pressure];
    }
    for (int i = 0; i < C::dim; ++i)
      for (int j = 0; j < C::dim; ++j) out.stress[i][j] = stress(row, six(i, j));
    out.hoop_stress = stress(row, 2);
    if constexpr (std::is_same_v<T, double>)
      change(row, at, out);
    else
      derivatives(row, at, out);
    for (int i = 0; i < C::dim; ++i) out.stress[i][i] -= pressure;
    out.hoop_stress -= pressure;
  }

 private:
  template <class C, int S>
  KOKKOS_INLINE_FUNCTION void change(int row, const PointFields<C, S, double>& at,
                                     PointBalance<C, S, double>& out) const {
    for (int i = 0; i < C::dim; ++i)
      for (int j = 0; j < C::dim; ++j) out.stress_change[i][j] = stress(row, six(i, j)) - stress_old(row, six(i, j));
    out.hoop_change = stress(row, 2) - stress_old(row, 2);
    out.pressure_change = 0;
    if constexpr (S > 0) {
      const Mixture& here = mixtures(row);
      if (here.pressure >= 0) out.pressure_change = -here.alpha * at.change[here.pressure];
    }
  }

  /// d sigma' = D (de - [W, e]) + [W, sigma'] for a further displacement with strain de and rotation W.
  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION void derivatives(int row, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    constexpr int D = C::dim;
    using Rule = MidpointRule<D>;
    Rule motion;
    find_motion(at, motion);
    const double* stiffness = &tangent(row - first_row, 0);
    const auto put = [&](int way, const double* e, const double(&turn)[Rule::spins]) {
      double turned[6], by[6];
      Rule::stress_rotation_rate(turn, &stress(row, 0), turned);
      for (int a = 0; a < Rule::components; ++a) {
        const int k = Rule::place(a);
        by[k] = turned[k];
        for (int b = 0; b < Rule::components; ++b) by[k] += stiffness[6 * k + Rule::place(b)] * e[Rule::place(b)];
      }
      for (int i = 0; i < C::dim; ++i)
        for (int j = 0; j < C::dim; ++j) out.stress[i][j].d[way] = by[six(i, j)];
      out.hoop_stress.d[way] = by[2];
    };
    double e[6], turn[Rule::spins];
    for (int j = 0; j < C::dim; ++j)
      for (int m = 0; m < D; ++m) {
        motion.variation(j, m, e, turn);
        put(D * j + m, e, turn);
      }
    if constexpr (C::hoop) {
      motion.hoop_variation(e, turn);
      put(D * D, e, turn);
    }
    if constexpr (S > 0) {
      const Mixture& here = mixtures(row);
      if (here.temperature < 0) return;
      const double expansion = here.grain_expansion;  // thermal expansion of the skeleton [1/K]
      const double warmer[6] = {-expansion / 3, -expansion / 3, -expansion / 3, 0, 0, 0};
      for (double& t : turn) t = 0;
      put(LawDirections<C, S, TotalStress>::value + here.temperature, warmer, turn);
    }
  }
};

/// Input of the laws at the points of a batch: (row of the batch, component).
struct LawInput {
  PointView strain, stress_old, void_ratio_old, state_old;  // tensors rotated with the material
  Kokkos::View<int**> tensors;  // first columns of the tensor variables of each material's law; -1: no more
  PointView surroundings;       // if a law asks for them, else empty
};

/// Writes deformation gradient and rotation of a step as columns of Surroundings. Where the step inverts the element,
/// which is a failure, they are those of no motion.
template <class C, int S, class T>
KOKKOS_INLINE_FUNCTION void write_motion(const PointFields<C, S, T>& at, const MidpointRule<C::dim>& motion, bool valid,
                                         double* row) {
  constexpr int D = C::dim;
  double *deformation = row + Surroundings::deformation, *rotation = row + Surroundings::rotation;
  for (int i = 0; i < 9; ++i) deformation[i] = rotation[i] = i % 4 == 0 ? 1.0 : 0.0;
  Mat<double, D> back, F;  // dx_n / dx_{n+1} = 1 - moved
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) back[i][j] = (i == j ? 1.0 : 0.0) - at.moved[i][j];
  const double det = determinant(back), hoop = 1 - at.hoop_moved;
  if (!valid || !(det > 0) || !(hoop > 0)) return;
  invert(back, det, F);
  if constexpr (D == 2) deformation[8] = 1 / hoop;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      deformation[3 * i + j] = F[i][j];
      rotation[3 * i + j] = motion.rotation[i][j];
    }
}

/// Writes the law's input, and the void ratios of the end, for the points of an element.
template <class Loop>
struct Staging {
  Loop loop;
  int first;  // element of the batch's first row
  ByMaterial<Mixture> mixtures;
  LawInput to;
  PointView stress, law, void_ratio_old, void_ratio;  // (point, component): committed, and trial void ratio

  /// Adds the number of inverted points.
  KOKKOS_FUNCTION void operator()(int e, int& inverted) const {
    int next = 0;
    if (loop.template for_each_point<false>(e,
                                            [&](int q, const typename Loop::Shape&, const typename Loop::Fields& at) {
                                              stage(e, q, at, inverted);
                                              next = q + 1;
                                            })) {
      typename Loop::Fields still{};  // used from the folded point on: no motion
      still.volume_ratio = 1;
      inverted += loop.b.points - next;
      for (; next < loop.b.points; ++next) stage(e, next, still, inverted);
    }
  }

  KOKKOS_FUNCTION void stage(int e, int q, const typename Loop::Fields& at, int& inverted) const {
    MidpointRule<Loop::D> motion;
    const int from = e * loop.b.points + q, i = (e - first) * loop.b.points + q;
    const Mixture& mixture = mixtures(from);
    const bool valid = find_motion(at, motion);
    if (!valid) ++inverted;  // the law sees no strain; the step fails anyway
    motion.increment(&to.strain(i, 0));
    if constexpr (Loop::S > 0)
      if (mixture.temperature >= 0)  // thermal strain is not part of the strain of the law
        for (int c = 0; c < 3; ++c) to.strain(i, c) -= mixture.grain_expansion / 3 * at.change[mixture.temperature];
    if (!valid)
      for (int c = 0; c < 6; ++c) to.strain(i, c) = 0;
    if (to.surroundings.extent(0) > 0) write_motion(at, motion, valid, &to.surroundings(i, 0));
    motion.rotate(&stress(from, 0), &to.stress_old(i, 0));
    for (std::size_t c = 0; c < to.state_old.extent(1); ++c) to.state_old(i, c) = law(from, c);
    const int material = static_cast<int>(mixtures.which(from, 0));
    for (std::size_t t = 0; t < to.tensors.extent(1) && to.tensors(material, t) >= 0; ++t)
      motion.rotate(&law(from, to.tensors(material, t)), &to.state_old(i, to.tensors(material, t)));
    to.void_ratio_old(i, 0) = void_ratio_old(from, 0);
    const double n = mixture.porosity(void_ratio_old(from, 0), at);
    void_ratio(from, 0) = n / (1 - n);
    void_ratio(from, 1) = void_ratio_old(from, 1);
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

/// Runs the laws over batches of elements: computes strains from the motion and writes stress, state and void ratio of
/// the trial state.
class StressUpdate {
 public:
  enum class Tangent { none, batch, all };
  /// `tangent`: for which points the tangent is stored; `all`: array for the tangents of all points.
  StressUpdate(const Soil& soil, const SoilBlock& block, const StepView& view, Tangent tangent,
               const PointView& all = PointView());
  /// Runs elements [first, last); returns the number of failed points (failure of the law, or an inverted
  /// configuration).
  int run(int first, int last);
  /// d stress / d strain of the last batch: (point of the batch, 36); empty unless that is wanted.
  const PointView& tangent() const { return tangent_; }
  const LoopLevel& level() const { return level_; }
  /// The first failure with material, position, stress and strain increment; "" if there is none.
  const std::string& failure() const { return failure_; }
  /// Whether that failure is an error of the law: a result that is not finite, or an exception.
  bool law_is_broken() const { return law_is_broken_; }

 private:
  int stage_motion(int first, int last);
  /// Runs the law of one material on points [begin, end) of a batch whose first point is this row of the block.
  int run_law(const SoilMaterial& material, int row, int begin, int end);
  std::string describe(const SoilMaterial& material, int row, int point, const LawFailure& failure) const;

  const Soil& soil_;
  const SoilBlock& block_;
  const StepView& view_;
  const SoilPoints points_;
  LoopLevel level_;
  Tangent wanted_;
  LawInput input_;
  PointView tangent_;
  Kokkos::View<int*> failed_;
  std::string failure_;
  bool law_is_broken_ = false;
};

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
  return with_element(soil_.geometry, block_, [&](auto coordinates, auto shapes) {
    using Loop = ElementLoop<decltype(coordinates), decltype(shapes)>;
    const State &old = *view_.committed, &now = *view_.trial;
    const Staging<Loop> staging{{block_, level_},
                                first,
                                mixtures_of(soil_, block_, old),
                                input_,
                                old.arrays[block_.stress],
                                old.arrays[block_.law],
                                old.arrays[block_.void_ratio],
                                now.arrays[block_.void_ratio]};
    int inverted = 0;
    Kokkos::parallel_reduce("kinematics", Kokkos::RangePolicy<>(first, last), staging, inverted);
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

TotalStress total_stress(const Soil& soil, const SoilBlock& b, const StepView& view) {
  return {
      {}, mixtures_of(soil, b, *view.committed), view.trial->arrays[b.stress], view.committed->arrays[b.stress], {}};
}

}  // namespace

int StressDivergence::residual(const StepView& view, const ResidualView& f) {
  const int batch = elements_of_batch();
  int failures = 0;
  failure_.clear();
  kept_ = false;
  tangents_.resize(soil_->blocks.size());
  for (std::size_t k = 0; k < soil_->blocks.size(); ++k) {
    const SoilBlock& b = soil_->blocks[k];
    PointView& all = tangents_[k];
    const std::size_t points = static_cast<std::size_t>(b.elements) * b.points;
    if (keeps_ && all.extent(0) != points)
      all = PointView(Kokkos::view_alloc(Kokkos::WithoutInitializing, "tangents"), points, 36);
    using Tangent = StressUpdate::Tangent;
    StressUpdate update(*soil_, b, view, keeps_ ? Tangent::all : Tangent::none, all);
    for (int first = 0; first < b.elements; first += batch)
      failures += update.run(first, std::min(first + batch, b.elements));
    if (failure_.empty()) failure_ = update.failure();
    add_residual(soil_->geometry, b, update.level(), total_stress(*soil_, b, view), f);
  }
  kept_ = keeps_ && failures == 0;
  return failures;
}

void StressDivergence::jacobian(const StepView& view, Assembler& assembler, double weight) {
  const int batch = elements_of_batch();
  std::string broken;
  for (std::size_t k = 0; k < soil_->blocks.size(); ++k) {
    const SoilBlock& b = soil_->blocks[k];
    TotalStress law = total_stress(*soil_, b, view);
    const MatrixScatter to = assembler.scatter(b.group);
    if (kept_) {
      law.tangent = tangents_[k];
      add_tangent(soil_->geometry, b, end_level(view, b), law, to, weight);
      law.tangent = tangents_[k] = PointView();  // frees memory for the linear solve
      continue;
    }
    StressUpdate update(*soil_, b, view, StressUpdate::Tangent::batch);
    for (int first = 0; first < b.elements; first += batch) {
      const int last = std::min(first + batch, b.elements);
      update.run(first, last);
      if (broken.empty() && update.law_is_broken()) broken = update.failure();
      law.tangent = update.tangent();
      law.first_row = first * b.points;
      add_tangent(soil_->geometry, b, update.level(), law, to, weight, first, last);
    }
  }
  kept_ = false;                                          // stored tangents serve one matrix only
  if (!broken.empty()) throw std::runtime_error(broken);  // after all element matrices, so that the ranks stay in step
}

std::string StressDivergence::hint(const StepView&) const { return broadcast(*soil_->space->dofs()->comm(), failure_); }

void StressDivergence::take_evaluated(const State& evaluated, State& committed) {
  for (const SoilBlock& b : soil_->blocks)
    for (int handle : {b.stress, b.law}) Kokkos::deep_copy(committed.arrays[handle], evaluated.arrays[handle]);
}

}  // namespace mudline
