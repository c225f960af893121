#include "checks/setup.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "integrator/overlap.hpp"
#include "physics/soil_points.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// The entry's value as type T, without marking it as read, so that unread entries are still found; null: it has
/// another type.
template <class T>
const T* value_of(const Teuchos::ParameterEntry& entry) {
  return entry.isType<T>() ? &Teuchos::any_cast<T>(entry.getAny(false)) : nullptr;
}

constexpr int moments = 200;  // number of times in a run at which a function of time is sampled

}  // namespace

void Span::add(double value) {
  low = std::min(low, value);
  high = std::max(high, value);
}

std::vector<double> Span::ends() const {
  if (!known()) return {};
  return low == high ? std::vector<double>{low} : std::vector<double>{low, high};
}

Setup::Setup(Model& model, const Section& deck) : model_(model), deck_(deck), begins_{0} {
  for (const auto& stage : model.stages())
    begins_.push_back(begins_.back() + (stage->type == Stage::Type::geostatic ? 0 : stage->duration));
  for (const Section& entry : entries("boundary conditions"))
    conditions_.push_back({entry.name(), word(entry, "type"), word(entry, "set"), entry});
  find_gravity();
  find_soil();
}

std::vector<Section> Setup::entries(const std::string& collection) const {
  std::vector<Section> result;
  const Section section = deck_.section(collection);
  for (const std::string& name : section.section_names()) result.push_back(section.section(name));
  return result;
}

bool Setup::acts(const std::string& condition, const Stage& stage) {
  return std::count(stage.conditions.begin(), stage.conditions.end(), condition) > 0;
}

std::vector<Setup::ConditionEntry> Setup::conditions(const Stage& stage) const {
  std::vector<ConditionEntry> result;
  for (const ConditionEntry& condition : conditions_)
    if (acts(condition.name, stage)) result.push_back(condition);
  return result;
}

double Setup::longest_extent() const {
  double longest = 0;
  for (int i = 0; i < dimension(); ++i) longest = std::max(longest, extent(i));
  return longest;
}

bool Setup::starts_geostatic(const Section& deck) {
  const Section physics = deck.section("physics");
  const std::vector<std::string> names = physics.section_names();
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return word(physics.section(name).section("initial state"), "type") == "geostatic";
  });
}

std::string Setup::word(const Section& section, const std::string& name, const std::string& fallback) {
  if (!section.has_parameter(name)) return fallback;
  const auto* text = value_of<std::string>(section.list().getEntry(name));
  return text ? *text : fallback;
}

std::optional<Function> Setup::function(const Section& section, const std::string& name) {
  if (!section.has_parameter(name)) return {};
  const Teuchos::ParameterEntry& entry = section.list().getEntry(name);
  if (const auto* number = value_of<double>(entry)) return Function(*number);
  if (const auto* number = value_of<int>(entry)) return Function(*number);
  const auto* text = value_of<std::string>(entry);
  if (!text) return {};
  try {
    return section.functions().resolve(*text);
  } catch (const InputError&) {
    return {};  // a word, not a number
  }
}

bool Setup::scales() const {
  const auto& materials = model_.soil()->materials;
  return gravity_ == 0 && std::all_of(materials.begin(), materials.end(),
                                      [](const auto& material) { return material->skeleton->state_size() == 0; });
}

Span Setup::given(const Section& section, const std::string& name, double from, double to,
                  const SetFigures* where) const {
  Span span;
  if (!section.has_parameter(name)) return span;
  const Teuchos::ParameterEntry& entry = section.list().getEntry(name);
  if (const auto* numbers = value_of<Teuchos::Array<double>>(entry))
    for (double number : *numbers) span.add(number);
  if (const auto* numbers = value_of<Teuchos::Array<int>>(entry))
    for (int number : *numbers) span.add(number);
  const auto value = function(section, name);
  if (!value) return span;
  Bounds box = mesh().bounds();
  if (where)
    for (int i = 0; i < dimension(); ++i)
      if (where->box[i].known()) {
        box.low[i] = where->box[i].low;
        box.high[i] = where->box[i].high;
      }
  const int corners = value->is_constant() ? 0 : 1 << dimension(), times = value->steady() ? 0 : moments;
  for (int corner = 0; corner <= corners; ++corner) {  // the last one is the middle
    Point x{};
    for (int i = 0; i < dimension(); ++i)
      x[i] = corner == corners ? 0.5 * (box.low[i] + box.high[i]) : corner >> i & 1 ? box.high[i] : box.low[i];
    for (int k = 0; k <= times; ++k) {
      const double found = (*value)(times > 0 ? from + (to - from) * k / times : from, x);
      if (std::isfinite(found)) span.add(found);
    }
  }
  return span;
}

void Setup::find_gravity() {
  for (const Section& entry : physics()) {
    if (!entry.has_parameter("gravity")) continue;
    Parameters(entry).add("gravity", gravity_vector_, "", "");
    gravity_entry_ = entry;
    const Span factor = given(entry, "gravity factor");
    gravity_ = length(gravity_vector_) * (factor.known() ? std::abs(factor.largest()) : 1.0);
  }
}

void Setup::find_soil() {
  const Soil& soil = *model_.soil();
  const State& state = model_.store().committed();
  constexpr int count = 8;
  std::vector<double> sums(count * soil.materials.size(), 0.0);
  for (const SoilBlock& b : soil.blocks) {
    const SoilPoints points(soil, b, state);
    for (int row = 0; row < b.elements * b.points; ++row) {
      const SoilMaterial& material = points.material(row);
      std::size_t k = 0;
      while (soil.materials[k].get() != &material) ++k;
      const SoilFigures f = points.figures(row);
      const double found[count] = {1,
                                   f.shear,
                                   f.modulus,
                                   f.density > 0 ? f.wave : 0,
                                   f.density,
                                   points.void_ratio(row),
                                   f.conductivity,
                                   f.consolidation};
      for (int i = 0; i < count; ++i) sums[count * k + i] += found[i];
    }
  }
  sums = sum_over_ranks(*mesh().comm(), sums);
  const auto means = [](const double* sum) {
    const double n = std::max(sum[0], 1.0);
    return SoilMeans{sum[0], sum[1] / n, sum[2] / n, sum[3] / n, sum[4] / n, sum[5] / n, sum[6] / n, sum[7] / n};
  };
  std::vector<double> total(count, 0.0);
  for (std::size_t k = 0; k < soil.materials.size(); ++k) {
    soils_[soil.materials[k]->name] = means(&sums[count * k]);
    for (int i = 0; i < count; ++i) total[i] += sums[count * k + i];
  }
  all_ = means(total.data());
}

const Setup::SetFigures& Setup::set(const std::string& name) const {
  const auto [place, fresh] = sets_.try_emplace(name);
  SetFigures& figures = place->second;
  if (!fresh || !mesh().has_set(name)) return figures;
  for (int node : mesh().nodes_of_set(name))
    for (int i = 0; i < dimension(); ++i) figures.box[i].add(mesh().place(node)[i]);
  std::vector<double> sums(8, 0.0);  // sums over sides: number, normals, size, lengths along the axes
  int order = 1;
  if (mesh().has_side_set(name))
    for (const Side& side : mesh().side_sets().at(name)) {
      const ElementBlock& block = mesh().blocks()[side.block];
      const std::vector<int> local = side_nodes(block.shape, side.side);
      const auto at = [&](int a) { return mesh().place(block.nodes(side.element, local[a])); };
      const int corners = num_corners(side_shape(block.shape, side.side));
      const Point across = at(corners == 4 ? 2 : 1) - at(0);
      const Point other = dimension() == 3 ? at(corners == 4 ? 3 : 2) - at(corners == 4 ? 1 : 0) : Point{0, 0, 1};
      const Point normal = cross(across, other);
      sums[0] += 1;
      for (int i = 0; i < 3; ++i) sums[1 + i] += normal[i];
      sums[4] += length(normal);
      for (int i = 0; i < 3; ++i) {
        Span reach;
        for (int a = 0; a < corners; ++a) reach.add(at(a)[i]);
        sums[5 + i] += reach.length();
      }
      order = std::max(order, mudline::order(block.shape));
    }
  const Comm& comm = *mesh().comm();
  sums = sum_over_ranks(comm, sums);
  for (int i = 0; i < dimension(); ++i)
    figures.box[i] = {min_over_ranks(comm, figures.box[i].low), max_over_ranks(comm, figures.box[i].high)};
  figures.order = static_cast<int>(max_over_ranks(comm, order));
  figures.sides = static_cast<int>(sums[0]);
  if (sums[4] > 0)
    for (int i = 0; i < 3; ++i) {
      figures.normal[i] = sums[1 + i] / sums[4];
      figures.side[i] = sums[5 + i] / sums[0];
    }
  return figures;
}

std::vector<Check<Setup>> setup_checks() {
  std::vector<Check<Setup>> all;
  for (const auto& group : {parameter_checks(), material_checks(), load_checks(), domain_checks()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

}  // namespace mudline
