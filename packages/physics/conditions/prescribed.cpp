#include "physics/conditions/prescribed.hpp"

#include <algorithm>
#include <cmath>

#include "physics/soil.hpp"

namespace mudline {

namespace {

void require_component(const Section& section, const std::array<bool, axis_names.size()>& given) {
  if (std::none_of(given.begin(), given.end(), [](bool g) { return g; }))
    section.fail(section.dimension() == 3 ? "at least one of 'x', 'y' and 'z' must be given"
                                          : "at least one of 'x' and 'y' must be given");
}

}  // namespace

int conditioned_field(const Space& space, const Section& section, const std::string& name) {
  const int field = space.find(name);
  if (field < 0 || space.field(field).support == Support::apart)
    section.fail("this model has no field '" + name + "'" + suggestion(name, space.mesh_fields()),
                 section.has_parameter("field") ? "field" : "type");
  return field;
}

void Prescribed::declare_set(Parameters& p) { p.required("set", set_, "mesh set (sides or nodes) on which it acts"); }

void Prescribed::bind(const ConditionContext& context, const Section& section) {
  space_ = &context.space;
  field_ = conditioned_field(*space_, section, field_name());
  const Mesh& mesh = space_->mesh();
  require_set(mesh, section, "set", set_);
  nodes_ = mesh.nodes_of_set(set_);
  if (field_name() == "pore pressure" && mesh.has_side_set(set_)) exchange_ = std::make_unique<NodalExchange>(mesh);
  soil_ = context.shared.find<Soil>();
}

std::vector<char> Prescribed::nodes_that_bodies_may_seal() const {
  const Mesh& mesh = space_->mesh();
  const auto key = [](const Side& side) { return std::array<int, 3>{side.block, side.element, side.side}; };
  const auto sides_of = [&](const std::set<std::string>& sets) {
    std::set<std::array<int, 3>> sides;
    for (const std::string& name : sets)
      for (const Side& side : mesh.side_sets().at(name)) sides.insert(key(side));
    return sides;
  };
  const auto may_be_sealed = sides_of(may_be_sealed_), may_leak = sides_of(may_leak_);
  std::vector<double> reached(mesh.num_nodes()), others(mesh.num_nodes());
  for (const Side& side : mesh.side_sets().at(set_)) {
    const ElementBlock& block = mesh.blocks()[side.block];
    auto& count = may_be_sealed.count(key(side)) > may_leak.count(key(side)) ? reached : others;
    for (int local : side_nodes(block.shape, side.side)) count[block.nodes(side.element, local)] = 1;
  }
  for (const SoilBlock& b : soil_->blocks)
    for (int e = 0; e < b.elements && !b.sees_water; ++e)
      for (int a = 0; a < b.u.nodes; ++a) others[b.nodes(e, a)] = 1;
  exchange_->sum_shared(reached);
  exchange_->sum_shared(others);
  std::vector<char> flags(reached.size());
  for (std::size_t i = 0; i < flags.size(); ++i) flags[i] = reached[i] > 0 && others[i] == 0;
  return flags;
}

void Prescribed::set_closed(const ClosedSides& closed) {
  if (!exchange_) return;
  if (closed.may_be_sealed != may_be_sealed_ || closed.may_leak != may_leak_) {
    may_be_sealed_ = closed.may_be_sealed;
    may_leak_ = closed.may_leak;
    opens_.clear();
    if (soil_ && soil_->pressure == field_ && !may_be_sealed_.empty()) opens_ = nodes_that_bodies_may_seal();
  }
  open_.clear();
  if (!closed.possible) return;
  const Mesh& mesh = space_->mesh();
  std::vector<double> open_sides(mesh.num_nodes(), 0.0);
  for (const Side& side : mesh.side_sets().at(set_)) {
    if (closed.sides.count({side.block, side.element, side.side})) continue;
    const ElementBlock& block = mesh.blocks()[side.block];
    for (int local : side_nodes(block.shape, side.side)) open_sides[block.nodes(side.element, local)] += 1;
  }
  exchange_->sum_shared(open_sides);
  for (double sides : open_sides) open_.push_back(sides > 0);
}

void Prescribed::reactions(const NodalView& reaction, Report& shares) const {
  const Field& field = space_->field(field_);
  const bool vector = field.components == space_->mesh().dimension();
  for (int c = 0; c < field.components; ++c) {
    const std::string axis = vector                 ? std::string(" ") + axis_names[c]
                             : field.components > 1 ? " " + std::to_string(c)
                                                    : "";
    Quantity& share = shares["reaction/" + name + axis];
    share.unit = field.flux;
    for (int node : nodes_)
      if (space_->node_dof(field_)(node) >= 0) share.value += reaction(space_->node_dof(field_)(node) + c);
  }
}

void DisplacementCondition::parameters(Parameters& p) {
  declare_set(p);
  for (int i = 0; i < p.dimension(); ++i) {
    p.add(axis_names[i], component_[i], "m",
          "displacement since the last reset, a function of time and initial position; free when absent");
    given_[i] = p.given(axis_names[i]);
  }
}

void DisplacementCondition::check(const Section& section) { require_component(section, given_); }

void DisplacementCondition::prescribe(double, double t_end, const State&, Constraints& to) const {
  for_each_node([&](int dof, int node, const Point& x) {
    for (int i = 0; i < space_->mesh().dimension(); ++i)
      if (given_[i]) to.prescribe(dof + i, component_[i](t_end, x));
  });
}

void VelocityCondition::parameters(Parameters& p) {
  declare_set(p);
  for (int i = 0; i < p.dimension(); ++i) {
    p.add(axis_names[i], component_[i], "m/s", "velocity, a function of time and initial position; free when absent");
    given_[i] = p.given(axis_names[i]);
  }
  p.add("ramp time", ramp_time_, "s", non_negative(), "the velocity rises smoothly from zero over this time");
  p.add("start time", start_, "s", any(), "begin of the ramp");
}

void VelocityCondition::check(const Section& section) { require_component(section, given_); }

double VelocityCondition::ramp(double time) const {
  if (time <= start_) return ramp_time_ > 0 ? 0.0 : 1.0;
  if (ramp_time_ <= 0 || time >= start_ + ramp_time_) return 1.0;
  const double s = (time - start_) / ramp_time_;
  return s * s * (3 - 2 * s);
}

void VelocityCondition::prescribe(double t_old, double t_end, const State& committed, Constraints& to) const {
  // Three Gauss points integrate the cubic ramp exactly within a step.
  const double dt = t_end - t_old, place[3] = {-std::sqrt(0.6), 0, std::sqrt(0.6)},
               weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  for_each_node([&](int dof, int node, const Point& x) {
    for (int i = 0; i < space_->mesh().dimension(); ++i) {
      if (!given_[i]) continue;
      double change = 0;
      for (int q = 0; q < 3; ++q) {
        const double t = t_old + 0.5 * dt * (1 + place[q]);
        change += weight[q] * dt * ramp(t) * component_[i](t, x);
      }
      to.prescribe(dof + i, committed.value(dof + i) + change);
    }
  });
}

void FixedCondition::parameters(Parameters& p) {
  declare_set(p);
  std::vector<std::pair<std::string, Components>> words{
      {"x", Components::x}, {"y", Components::y}, {"x y", Components::xy}};
  if (p.dimension() == 3)
    words.insert(words.end(),
                 {{"z", Components::z}, {"x z", Components::xz}, {"y z", Components::yz}, {"x y z", Components::xyz}});
  components_ = words.back().second;
  p.choice("components", components_, words, "directions that are held; by default all");
}

void FixedCondition::prescribe(double, double, const State&, Constraints& to) const {
  for_each_node([&](int dof, int node, const Point&) {
    for (int i = 0; i < space_->mesh().dimension(); ++i)
      if (static_cast<int>(components_) & 1 << i) to.prescribe(dof + i, 0.0);
  });
}

void PorePressureCondition::parameters(Parameters& p) {
  declare_set(p);
  p.add("value", value_, "Pa", "pore pressure, compression positive; a function of time and initial position");
}

void PorePressureCondition::prescribe(double, double t_end, const State&, Constraints& to) const {
  for_each_open_node([&](int dof, int node, const Point& x) { give(to, dof, node, value_(t_end, x)); });
}

void HydrostaticCondition::parameters(Parameters& p) {
  declare_set(p);
  p.add("unit weight", unit_weight_, "N/m3", positive(), "of the water");
  p.required("water level", level_, "m",
             "height of the free water surface, counted against gravity, a function of time");
  p.choice("above the level", above_, {{"drained", Above::drained}, {"suction", Above::suction}, {"free", Above::free}},
           "drained: the pore pressure is zero there; suction: that of water at rest; free: nothing is prescribed, and "
           "the boundary is sealed unless another condition opens it");
}

void HydrostaticCondition::bind(const ConditionContext& context, const Section& section) {
  Prescribed::bind(context, section);
  const auto soil = context.shared.find<Soil>();
  if (soil && soil->excess)
    section.fail("pore pressures are in excess of water at rest, which a water level gives: use a 'pore pressure' of 0",
                 "type");
  if (soil)
    up_ = soil->up;
  else
    up_[space_->mesh().dimension() - 1] = 1;
}

void HydrostaticCondition::prescribe(double, double t_end, const State& committed, Constraints& to) const {
  for_each_open_node([&](int dof, int node, const Point& x) {
    double height = 0;
    for (int k = 0; k < space_->mesh().dimension(); ++k) height += up_[k] * committed.coordinates(node, k);
    const double pressure = unit_weight_ * (level_(t_end, x) - height);
    if (pressure < 0 && above_ == Above::free) return;
    give(to, dof, node, pressure > 0 || above_ == Above::suction ? pressure : 0.0);
  });
}

void ValueCondition::parameters(Parameters& p) {
  declare_set(p);
  p.required("field", name_, "name of the field");
  p.add("component", component_, "-", closed(0, 5), "component of the field, counted from 0");
  p.required("value", value_, "unit of the field", "prescribed value, a function of time and initial position");
}

void ValueCondition::bind(const ConditionContext& context, const Section& section) {
  Prescribed::bind(context, section);
  const Field& field = space_->field(field_);
  if (component_ >= field.components)
    section.fail("field '" + name_ + "' has " + std::to_string(field.components) + " component(s), counted from 0",
                 "component");
}

void ValueCondition::prescribe(double, double t_end, const State&, Constraints& to) const {
  for_each_open_node([&](int dof, int node, const Point& x) { give(to, dof + component_, node, value_(t_end, x)); });
}

}  // namespace mudline
