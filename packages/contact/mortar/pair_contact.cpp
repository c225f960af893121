#include "contact/mortar/pair_contact.hpp"

#include <algorithm>
#include <cmath>

#include "contact/two_surfaces.hpp"
#include "framework/surface_points.hpp"
#include "tensor/mat.hpp"

namespace mudline {

namespace column = pair_column;

namespace {

void add(const PairSums& from, PairSums& to) {
  for (int a = 0; a < side_multipliers; ++a) {
    to.length[a] += from.length[a];
    to.pressure[a] += from.pressure[a];
    to.gap[a] += from.gap[a];
    to.shear[a] += from.shear[a];
    to.slip[a] += from.slip[a];
    to.stretch[a] += from.stretch[a];
    for (int b = 0; b < side_multipliers; ++b) to.touching[a][b] += from.touching[a][b];
  }
  to.sliding += from.sliding;
  to.area += from.area;
  to.heat += from.heat;
  to.damped += from.damped;
  to.deepest = std::min(to.deepest, from.deepest);
}

/// Values at the corners of the linear field whose weighted integrals over the touching part are given; the mean where
/// that part is too short to determine a slope.
std::array<double, 2> corner_values(const Mat<double, side_multipliers>& mass, const double (&integrals)[2]) {
  const double whole = mass[0][0] + 2 * mass[0][1] + mass[1][1];
  if (!(whole > 0)) return {0, 0};
  const double determinant = mass[0][0] * mass[1][1] - mass[0][1] * mass[0][1];
  if (determinant < 1e-3 * whole * whole) {
    const double mean = (integrals[0] + integrals[1]) / whole;
    return {mean, mean};
  }
  return {(mass[1][1] * integrals[0] - mass[0][1] * integrals[1]) / determinant,
          (mass[0][0] * integrals[1] - mass[0][1] * integrals[0]) / determinant};
}

}  // namespace

void PairContact::declare_state(StateStore& store) {
  laws_.declare_state(store);
  const std::vector<StateVariable> columns = {{"gap", 1, "m"},
                                              {"pressure", 1, "Pa"},
                                              {"shear", 1, "Pa"},
                                              {"deepest", 1, "m"},
                                              {"force x", 1, "N", Transfer::total},
                                              {"force y", 1, "N", Transfer::total},
                                              {"slides", 1, "m", Transfer::total},
                                              {"area", 1, "m2", Transfer::total},
                                              {"misfit", 1, "N/m", Transfer::total},
                                              {"stretch", 1, "N/m", Transfer::total},
                                              {"slip", 1, "m", Transfer::value, 0.0}};
  const auto corners =
      std::make_shared<SurfacePoints>(slave_->mesh(), deck_.slave, SurfacePoints::At::corners, deck_.quadrature_degree);
  const auto on_corners = [&](const std::string& what, const std::vector<StateVariable>& variables) {
    return ArrayInfo::on_surface(name() + what, variables, corners).not_shown();
  };
  sides_ = store.declare(on_corners("/sides", columns).then_evaluated());
  multipliers_ =
      store.declare(on_corners("/multipliers", {{"normal", 1, "Pa", Transfer::value, 0.0}, {"shear", 1, "Pa"}}));
  penalties_ = deck_.declare_penalties(store, name() + "/", slave_->mesh(), deck_.slave);
  heat_ = store.declare(
      ArrayInfo::of_sum(name() + "/heat", {{"friction heat", 1, "J"}, {"damping heat", 1, "J"}}).not_shown());
}

void PairContact::sparsity(Assembler& assembler) {
  const auto& x = context_.space.mesh().coordinates();
  const auto& sides = slave_->sides();
  const double distance = deck_.reach > 0 ? deck_.reach : 1e300;
  master_->update(x);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto box = side_box(sides[s].node, sides[s].count, x);
    for (int m : master_->near(box, distance)) {
      const int pressures = laws_.pressure_nodes(sides[s]);
      std::vector<int> dofs(4 * nodes_ + pressures);
      int* to = context_.space.write_dofs(displacement_, sides[s].node, nodes_, dofs.data());
      to = context_.space.write_dofs(displacement_, master_->sides()[m].node, nodes_, to);
      context_.space.write_dofs(laws_.pressure(), sides[s].node, pressures, to);
      dofs_.add(s, m, std::move(dofs));
    }
  }
  dofs_.sparsity(assembler);
}

void PairContact::begin(const StepView& view) {
  const auto& sides = slave_->sides();
  const PointView& multipliers = view.trial->arrays[multipliers_];
  deck_.start_penalties(*slave_, context_.stiffness, view.trial->arrays[penalties_]);
  // the spring of friction starts unstretched from the stress that the step before left
  for (std::size_t row = 0; row < multipliers.extent(0); ++row)
    multipliers(row, 1) = view.committed->arrays[sides_](row, column::shear);
  const double longest = slave_->longest(view.x_old);
  capture_ = deck_.capture_distance > 0 ? deck_.capture_distance : longest;
  touch_ = 1e-9 * longest;
  master_->update(view.x_old);
  pairs_.clear();
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto box = side_box(sides[s].node, sides[s].count, view.x_old);
    for (int m : master_->near(box, 2 * capture_)) {
      pairs_.push_back({static_cast<int>(s), m, dofs_.row(s, m)});
    }
  }
}

PairCoordinates PairContact::coordinates(const Pair& pair, const ConstCoordinateView& x) const {
  return {side_coordinates(slave_->sides()[pair.slave], x), side_coordinates(master_->sides()[pair.master], x)};
}

PairLaw PairContact::law(const StepView& view, int slave) const {
  PairLaw result;
  static_cast<ContactPointLaw&>(result) = laws_.in_step(view, deck_.damping);
  result.penalty = view.trial->arrays[penalties_](slave, 0);
  result.touch = touch_;
  result.first_guess = predicting_;
  result.nodes = nodes_;
  result.geometry = context_.space.mesh().geometry();
  result.rule = rule_;
  result.capture = capture_;
  const SurfaceSide& side = slave_->sides()[slave];
  result.pressures = laws_.pressure_nodes(side);
  for (int a = 0; a < result.pressures; ++a)
    result.pore_pressure[a] = view.value_end(context_.space.node_dof(laws_.pressure())(side.node[a]));
  const PointView& multipliers = view.trial->arrays[multipliers_];
  for (int a = 0; a < side_multipliers; ++a) {
    result.pressure_old[a] = view.committed->arrays[sides_](side_multipliers * slave + a, column::pressure);
    const double end = 2 * a - 1;
    result.soil[a] = laws_.soil(*view.committed, side, &end);
    const double slip = view.committed->arrays[sides_](side_multipliers * slave + a, column::slip);
    result.slip_old[a] = laws_.friction() && laws_.friction()->reads_slip() ? slip : TouchingSoil::unknown;
    result.normal[a] = multipliers(side_multipliers * slave + a, 0);
    result.shear[a] = multipliers(side_multipliers * slave + a, 1);
  }
  return result;
}

void PairContact::write_side(const StepView& view, int slave, const PairSums& sums, const double (&force)[2]) const {
  const State& trial = *view.trial;
  const PointView &rows = trial.arrays[sides_], &multipliers = trial.arrays[multipliers_];
  const auto pressure = corner_values(sums.touching, sums.pressure), shear = corner_values(sums.touching, sums.shear);
  const auto slip = corner_values(sums.touching, sums.slip);
  const auto whole = mass(slave, trial.coordinates);
  for (int a = 0; a < side_multipliers; ++a) {
    const int row = side_multipliers * slave + a, first = side_multipliers * slave;
    rows(row, column::gap) = sums.length[a] > 0 ? sums.gap[a] / sums.length[a] : capture_;
    rows(row, column::pressure) = pressure[a];
    rows(row, column::shear) = shear[a];
    rows(row, column::deepest) = sums.deepest;
    rows(row, column::force_x) = 0.5 * force[0];
    rows(row, column::force_y) = 0.5 * force[1];
    rows(row, column::slides) = 0.5 * sums.sliding;
    rows(row, column::area) = 0.5 * sums.area;
    rows(row, column::misfit) =
        sums.pressure[a] - whole[a][0] * multipliers(first, 0) - whole[a][1] * multipliers(first + 1, 0);
    rows(row, column::stretch) = sums.stretch[a];
    rows(row, column::slip) = view.committed->arrays[sides_](row, column::slip) + std::max(0.0, slip[a]);
  }
}

int PairContact::residual(const StepView& view, const ResidualView& f) {
  beyond_reach_ = false;
  int failures = 0;
  correction_.clear();
  double heat = view.committed->arrays[heat_](0, 0), damped = view.committed->arrays[heat_](0, 1);
  PairForce side_force;
  auto pair = pairs_.begin();
  for (int s = 0; s < static_cast<int>(slave_->sides().size()); ++s) {
    PairSums sums;
    double force[2] = {0, 0};
    const PairLaw side_law = law(view, s);
    for (; pair != pairs_.end() && pair->slave == s; ++pair) {
      const PairCoordinates now = coordinates(*pair, view.x_end);
      if (!pair_segment(side_law, coordinates(*pair, view.x_old), now, false, side_force)) continue;
      if (pair->row < 0 && side_force.sums.area > 0) {
        beyond_reach_ = true;
        ++failures;
      }
      if (pair->row < 0) continue;
      add(side_force.sums, sums);
      if (side_force.sums.heat > 0 && temperature_ >= 0 && view.flow) add_heat(view, *pair, side_force);
      const double cancelled = side_law.penalty * side_force.sums.area * farthest(now.slave);
      for (int a = 0; a < 4 * nodes_; ++a) {
        f.add(dofs_.dofs()(pair->row, a), -side_force.f[a]);
        f.cancelled(dofs_.dofs()(pair->row, a), cancelled);
        if (side_force.damping[a] != 0) correction_.emplace_back(dofs_.dofs()(pair->row, a), side_force.damping[a]);
        if (a < 2 * nodes_) force[a % 2] += side_force.f[a];
      }
    }
    heat += sums.heat;
    damped += sums.damped;
    write_side(view, s, sums, force);
  }
  view.trial->arrays[heat_](0, 0) = heat;
  view.trial->arrays[heat_](0, 1) = damped;
  return failures;
}

void PairContact::add_heat(const StepView& view, const Pair& pair, const PairForce& force) {
  const auto& dofs = context_.space.node_dof(temperature_);
  for (int a = 0; a < side_multipliers; ++a) {
    correction_.emplace_back(dofs(slave_->sides()[pair.slave].node[a]), deck_.heat_share * force.heat[0][a] / view.dt);
    correction_.emplace_back(dofs(master_->sides()[pair.master].node[a]),
                             (1 - deck_.heat_share) * force.heat[1][a] / view.dt);
  }
}

void PairContact::correction(const StepView&, const ResidualView& f) {
  for (const auto& [dof, force] : correction_) f.add(dof, -force);
}

void PairContact::jacobian(const StepView& view, Assembler& assembler, double weight) {
  const MatrixScatter to = assembler.scatter(dofs_.group());
  PairForce force;
  for (const Pair& pair : pairs_) {
    if (pair.row < 0) continue;
    const PairLaw of_side = law(view, pair.slave);
    if (!pair_segment(of_side, coordinates(pair, view.x_old), coordinates(pair, view.x_end), true, force)) continue;
    if (!(force.sums.area > 0) && force.sums.damped == 0) continue;
    for (int a = 0; a < 4 * nodes_; ++a)
      for (int b = 0; b < 4 * nodes_ + of_side.pressures; ++b) to.add(pair.row, a, b, -weight * force.k[a][b]);
  }
}

double PairContact::step_limit(const State& committed, double) const {
  return closing_limit(context_.space, *slave_, master_->sides(), deck_.advance_limit, committed);
}

void PairParameters::parameters(Parameters& p) {
  TwoSurfaceParameters::parameters(p);
  p.add("quadrature degree", quadrature_degree, "-", closed(1, 11),
        "Polynomial degree that the integration over a segment is exact for");
}

void PairContact::check(const Section& section) {
  name_ = section.name();
  const Space& space = context_.space;
  const Mesh& mesh = space.mesh();
  displacement_ = space.find("displacement");
  temperature_ = space.find("temperature");
  if (displacement_ < 0) section.fail("contact needs a model with the field 'displacement'", "type");
  check_two_sets(mesh, 2, section, deck_.slave, deck_.master);
  deck_.check(section);
  laws_.read(context_, section);
  check_heat_share(context_, section, laws_);
  laws_.check_linear(section, deck_.augmented(), false);
  slave_ = std::make_unique<ContactSurface>(mesh, deck_.slave);
  master_ = std::make_unique<MasterSurface>(mesh, deck_.master);
  nodes_ = order(mesh.blocks().front().shape) + 1;
  rule_ = line_quadrature(deck_.quadrature_degree);
  gap_tolerance_ = deck_.gap_tolerance > 0 ? deck_.gap_tolerance : 1e-6 * slave_->shortest(mesh.coordinates());
  capture_ = slave_->longest(mesh.coordinates());
  if (!context_.remeshed) check_overlap(section);
}

void PairContact::check_overlap(const Section& section) const {
  const Mesh& mesh = context_.space.mesh();
  const auto& x = mesh.coordinates();
  PairLaw look;
  look.nodes = nodes_;
  look.rule = rule_;
  look.capture = 4 * capture_;
  look.penalty = 1;
  double deepest = 0;
  master_->update(x);
  PairForce force;
  for (std::size_t s = 0; s < slave_->sides().size(); ++s) {
    const SurfaceSide& side = slave_->sides()[s];
    const auto box = side_box(side.node, side.count, x);
    for (int m : master_->near(box, look.capture)) {
      const PairCoordinates at = coordinates({static_cast<int>(s), m, 0}, x);
      if (pair_segment(look, at, at, false, force)) deepest = std::min(deepest, force.sums.closest);
    }
  }
  check_overlap_of_two(*slave_, section, deck_.slave, deepest);
}

Mat<double, side_multipliers> PairContact::mass(int slave, const ConstCoordinateView& x) const {
  const SurfaceSide& side = slave_->sides()[slave];
  Mat<double, side_multipliers> result{};
  for (std::size_t q = 0; q < rule_.weights.size(); ++q) {
    const double xi = rule_.points[q][0], shape[2] = {0.5 * (1 - xi), 0.5 * (1 + xi)};
    double N[max_line_nodes], dN[max_line_nodes];
    evaluate_line(nodes_, xi, N, dN);
    SideMap<2> map;
    map.compute(nodes_, N, dN, [&](int a, int i) { return x(side.node[a], i); });
    const double length = rule_.weights[q] * map.stretch;
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) result[a][b] += length * shape[a] * shape[b];
  }
  return result;
}

Misfit PairContact::misfit(const State& state) const {
  const PointView& rows = state.arrays[sides_];
  MisfitSums sums(slave_->mesh());
  for (std::size_t s = 0; s < slave_->sides().size(); ++s) {
    const auto whole = mass(static_cast<int>(s), state.coordinates);
    const double stiffness = state.arrays[penalties_](s, 0);
    for (int a = 0; a < side_multipliers; ++a) {
      const int row = side_multipliers * static_cast<int>(s) + a;
      sums.spring = std::max(sums.spring, rows(row, column::pressure) / stiffness);
      sums.add(slave_->sides()[s].node[a], whole[a][0] + whole[a][1], stiffness, rows(row, column::misfit),
               {rows(row, column::stretch)});
    }
  }
  return {*slave_, std::move(sums), laws_.tangential_factor()};
}

Augmentation PairContact::augment(const StepView& view, int count) {
  if (!deck_.augmented()) return {};
  const State& trial = *view.trial;
  const Misfit rest = misfit(trial);
  if (const auto end = end_of_augmentation(name_, deck_, gap_tolerance_, rest, count, *context_.space.mesh().comm()))
    return *end;
  const ShapeMass masses = [&](const std::vector<double>& values, std::vector<double>& product,
                               std::vector<double>& lengths) {
    for (std::size_t s = 0; s < slave_->sides().size(); ++s) {
      const auto whole = mass(static_cast<int>(s), trial.coordinates);
      const int* node = slave_->sides()[s].node;
      for (int a = 0; a < side_multipliers; ++a) {
        product[node[a]] += whole[a][0] * values[node[0]] + whole[a][1] * values[node[1]];
        lengths[node[a]] += whole[a][0] + whole[a][1];
      }
    }
  };
  const std::vector<double> normal = in_shapes(*slave_, rest.normal, masses);
  const std::vector<double> shear =
      laws_.friction() ? in_shapes(*slave_, rest.shear[0], masses) : std::vector<double>();
  const PointView& multipliers = trial.arrays[multipliers_];
  for (std::size_t s = 0; s < slave_->sides().size(); ++s)
    for (int a = 0; a < side_multipliers; ++a) {
      const int node = slave_->sides()[s].node[a];
      multipliers(side_multipliers * s + a, 0) += normal[node];
      if (laws_.friction()) multipliers(side_multipliers * s + a, 1) += shear[node];
    }
  return {true, ""};
}

void PairContact::histories(const StepView& view, Report& values) {
  const State& state = *view.committed;
  const PointView& rows = state.arrays[sides_];
  SlaveSums here;
  here.heat = state.arrays[heat_](0, 0);
  here.damped = state.arrays[heat_](0, 1);
  for (std::size_t row = 0; row < rows.extent(0); ++row) {
    here.force[0] += rows(row, column::force_x);
    here.force[1] += rows(row, column::force_y);
    here.area += rows(row, column::area);
    here.slides += rows(row, column::slides);
    here.deepest = std::max(here.deepest, -rows(row, column::deepest));
  }
  const Comm& comm = *context_.space.mesh().comm();
  const SlaveSums all = report_slave(comm, 2, name(), deck_, here, values);
  const auto [gap, stretch, spring] = misfit(state).largest(comm);
  if (deck_.augmented()) values[name() + "/weighted gap"] = {"m", gap};
  if (!laws_.friction()) return;
  if (deck_.augmented()) values[name() + "/stretch"] = {"m", stretch};
  values[name() + "/sliding length"] = {"m", all.slides};
  values[name() + "/friction heat"] = {"J", all.heat};
}

std::vector<double> PairContact::nodal_mean(const State& state, int column) const {
  const int nodes = context_.space.mesh().num_nodes();
  std::vector<double> weighted(nodes, 0.0), weights(nodes, 0.0);
  for (std::size_t s = 0; s < slave_->sides().size(); ++s) {
    const SurfaceSide& side = slave_->sides()[s];
    for (int a = 0; a < side.count; ++a) {
      const PointView& rows = state.arrays[sides_];
      const int first = side_multipliers * static_cast<int>(s);
      weighted[side.node[a]] += a < 2 ? rows(first + a, column) : 0.5 * (rows(first, column) + rows(first + 1, column));
      weights[side.node[a]] += 1;
    }
  }
  return slave_->mean(std::move(weighted), std::move(weights));
}

std::vector<double> PairContact::nodal_pressure(const State& state) const {
  return nodal_mean(state, column::pressure);
}

std::vector<double> PairContact::nodal_shear(const State& state) const {
  return laws_.friction() ? nodal_mean(state, column::shear) : std::vector<double>();
}

}  // namespace mudline
