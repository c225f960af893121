#include "integrator/convergence.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/absolute_product.hpp"
#include "core/parameters.hpp"
#include "core/told.hpp"
#include "integrator/overlap.hpp"

namespace mudline {

namespace {

/// Relative rounding error of a sum of contributions, with that of the contributions themselves.
constexpr double rounding_unit = 1e-14;
/// Floor of what acts as a fraction of its largest value in the stage: late in a stage, when all rates have decayed,
/// tiny changes need not be resolved.
constexpr double floor_share = 1e-6;

}  // namespace

void StepTolerances::parameters(Parameters& p) {
  p.add("residual tolerance", residual, "-", open(0, 1),
        "forces and fluxes out of balance, relative to what acts in the step: the element contributions, before they "
        "cancel, of inertia, contact, rates, and of the changes of stresses and loads, per field");
  p.add("update tolerance", update, "-", open(0, 1),
        "last Newton update relative to the increment of the step, per field");
  p.add("linear tolerance", linear, "-", open(0, 1), "residual of the linear solves, relative, per field");
}

Convergence::Convergence(const Space& space, StateStore& store) : space_(space), store_(store) {
  acting_ = rounding_ = matrix_rounding_ = matrix_sizes_ = std::vector<double>(space.num_fields(), 0);
  double squares = 0;
  for (int node = 0; node < space.mesh().num_owned_nodes(); ++node)
    for (int i = 0; i < space.mesh().dimension(); ++i) squares += std::pow(space.mesh().coordinates()(node, i), 2);
  coordinate_norm_ = std::sqrt(sum_over_ranks(*space.dofs()->comm(), squares));
}

void Convergence::declare_state() {
  array_ = store_.declare(ArrayInfo::of_model("step measures",
                                              {{"acting", 1, "SI"}, {"value", 1, "SI"}, {"matrix", 1, "SI"}},
                                              space_.num_fields())
                              .not_shown());
}

void Convergence::begin_stage() {
  for (int f = 0; f < space_.num_fields(); ++f)
    for (const auto column : {most_acting, matrix}) of(store_.committed(), f, column) = 0;
}

void Convergence::begin_step(const StepTolerances& tolerances) {
  tolerances_ = tolerances;
  for (auto* sizes : {&matrix_rounding_, &matrix_sizes_}) std::fill(sizes->begin(), sizes->end(), 0.0);
  first_norms_.clear();
  observed_norms_.clear();
}

void Convergence::measure(const NodalView& acting, const NodalView& whole) {
  Vector sizes(space_.dofs()->owned());
  export_overlap(*space_.dofs(), acting, sizes);
  acting_ = owned_field_norms(*space_.dofs(), sizes);
  export_overlap(*space_.dofs(), whole, sizes);
  rounding_ = owned_field_norms(*space_.dofs(), sizes);
  for (std::size_t i = 0; i < rounding_.size(); ++i) rounding_[i] = rounding_unit * rounding_[i] + matrix_rounding_[i];
}

void Convergence::measure_rounding(const CrsMatrix& jacobian, const Vector& x) {
  matrix_rounding_ = owned_field_norms(*space_.dofs(), absolute_product(jacobian, x));
  Vector ones(space_.dofs()->owned());
  ones.putScalar(1);
  matrix_sizes_ = owned_field_norms(*space_.dofs(), absolute_product(jacobian, ones));
  for (int i = 0; i < space_.num_fields(); ++i) matrix_rounding_[i] *= rounding_unit * limit_matrix(i);
}

/// Factor that limits the size of the matrix to a million times the last one (that of a step a thousand times shorter).
/// At an iterate far from a solution the tangent of a law may be huge, and the rounding estimate from it would accept
/// any residual.
double Convergence::limit_matrix(int field) const {
  const double last = of(store_.committed(), field, matrix);
  return last > 0 ? std::min(1.0, 1e6 * last / matrix_sizes_[field]) : 1.0;
}

std::vector<double> Convergence::allowed(const std::vector<double>& least) const {
  std::vector<double> result;
  for (int i = 0; i < space_.num_fields(); ++i) {
    const double floor = floor_share * of(store_.committed(), i, most_acting);
    const double reference = std::max({acting_[i], least[i], floor});
    result.push_back(std::max(tolerances_.residual * reference + rounding_[i], 1e-300));
  }
  return result;
}

std::vector<double> Convergence::residual_ratios(const Vector& f) {
  norms_ = owned_field_norms(*space_.dofs(), f);
  // the initial imbalance of the step acts in it, also where no term has responded yet
  if (first_norms_.empty()) first_norms_ = norms_;
  limits_ = allowed(norms_ == first_norms_ ? norms_ : std::vector<double>(norms_.size(), 0.0));
  std::vector<double> ratios;
  for (std::size_t i = 0; i < norms_.size(); ++i) ratios.push_back(norms_[i] == 0 ? 0.0 : norms_[i] / limits_[i]);
  return ratios;
}

std::string Convergence::place_of_largest(const Vector& f) const {
  int field = 0;
  const auto ratio = [&](int i) { return norms_[i] == 0 ? 0.0 : norms_[i] / limits_[i]; };
  for (int i = 1; i < space_.num_fields(); ++i)
    if (ratio(i) > ratio(field)) field = i;
  const auto values = f.getLocalViewHost(Tpetra::Access::ReadOnly);
  const Mesh& mesh = space_.mesh();
  double largest = -1;
  int place = -1;
  for (int node = 0; node < mesh.num_owned_nodes(); ++node) {
    const int dof = space_.node_dof(field)(node);
    for (int c = 0; dof >= 0 && c < space_.field(field).components; ++c) {
      const double size = std::abs(values(dof + c, 0));
      if (!(size > largest)) continue;
      largest = size;
      place = node;
    }
  }
  const std::string where = "most of it in '" + space_.field(field).name + "'";
  const double most = max_over_ranks(*mesh.comm(), largest);
  if (!(most >= 0)) return where;  // a field without nodes: the motion of a body
  const int rank = mesh.comm()->getRank(),
            owner = static_cast<int>(min_over_ranks(*mesh.comm(), largest == most ? rank : mesh.comm()->getSize()));
  std::string at;
  for (int i = 0; i < mesh.dimension(); ++i) {
    const double x = owner == rank ? store_.trial().coordinates(place, i) : -HUGE_VAL;
    at += (i ? ", " : "") + told(max_over_ranks(*mesh.comm(), x), "%.4g");
  }
  return where + " at (" + at + ")";
}

std::vector<double> Convergence::update_ratios(const Vector& dx, const Vector& x) const {
  Vector increment(x, Teuchos::Copy);
  increment.update(-1, owned_part(*space_.dofs(), store_.committed().value), 1);
  const auto update = owned_field_norms(*space_.dofs(), dx), step = owned_field_norms(*space_.dofs(), increment),
             size = owned_field_norms(*space_.dofs(), x);
  std::vector<double> ratios;
  for (int i = 0; i < space_.num_fields(); ++i) {
    // displacements have the rounding of the coordinates, pressures that of the largest value so far
    const double place = space_.field(i).time_order == 2 ? coordinate_norm_ : 0.0;
    const double rounding = rounding_unit * std::max({size[i], of(store_.committed(), i, value), place});
    const double allowed = tolerances_.update * step[i] + rounding;
    ratios.push_back(update[i] == 0 ? 0.0 : update[i] / std::max(allowed, 1e-300));
  }
  return ratios;
}

bool Convergence::at_rounding() const {
  constexpr double share = 0.1;  // fraction of the bound, which rounding seldom reaches
  for (std::size_t i = 0; i < norms_.size(); ++i)
    if (!(norms_[i] <= share * rounding_[i])) return false;
  return true;
}

double Convergence::observe() {
  double before = 0;
  if (!observed_norms_.empty()) {
    const std::vector<double> limits = allowed(std::vector<double>(norms_.size(), 0.0));
    for (std::size_t i = 0; i < limits.size(); ++i) before = std::max(before, observed_norms_[i] / limits[i]);
  }
  observed_norms_ = norms_;
  return before;
}

void Convergence::accept(const Vector& x) {
  const std::vector<double> norms = owned_field_norms(*space_.dofs(), x);
  const State &old = store_.committed(), &now = store_.trial();
  for (int f = 0; f < space_.num_fields(); ++f) {
    const auto raise = [&](Column column, double size) { of(now, f, column) = std::max(of(old, f, column), size); };
    raise(most_acting, std::max(acting_[f], rounding_[f] / (floor_share * tolerances_.residual)));
    raise(value, norms[f]);
    if (matrix_sizes_[f] > 0) of(now, f, matrix) = matrix_sizes_[f] * limit_matrix(f);
  }
}

std::vector<double> Convergence::largest_norms() const {
  std::vector<double> result;
  for (int f = 0; f < space_.num_fields(); ++f) result.push_back(of(store_.trial(), f, value));
  return result;
}

}  // namespace mudline
