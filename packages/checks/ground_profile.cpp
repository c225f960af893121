#include "checks/ground_profile.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>

#include "core/errors.hpp"
#include "core/run_error.hpp"
#include "core/text.hpp"
#include "core/told.hpp"
#include "physics/mixture.hpp"
#include "physics/soil_points.hpp"
#include "tensor/sym6.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The part of a position that is not height.
Point sideways(const Soil& soil, const Point& x) { return x - soil.height(x) * soil.up; }

/// Whether a vertical line through `foot`, which has no height, crosses an element.
bool crosses(const Soil& soil, const SoilBlock& b, const Mesh& mesh, int element, const Point& foot) {
  Bounds box = Bounds::nothing();
  for (int a = 0; a < b.u.nodes; ++a) box.enclose(sideways(soil, mesh.place(b.nodes(element, a))));
  for (int i = 0; i < 3; ++i) {
    const double slack = 1e-9 * (1 + box.high[i] - box.low[i]);
    if (foot[i] < box.low[i] - slack || foot[i] > box.high[i] + slack) return false;
  }
  return true;
}

int nearest_point(const Soil& soil, const SoilBlock& b, const State& state, int element, const Point& foot) {
  int best = 0;
  double least = 1e300;
  for (int q = 0; q < b.points; ++q) {
    const double d = length(sideways(soil, b.place(element, q, state.coordinates)) - foot);
    if (d < least * (1 - 1e-9)) best = q;
    least = std::min(least, d);
  }
  return best;
}

}  // namespace

Point GroundProfile::middle(const Model& model) {
  const Bounds& bounds = model.mesh().bounds();
  return 0.5 * (bounds.low + bounds.high);
}

GroundProfile::GroundProfile(const Model& model, const Point& at) {
  if (!model.soil()) throw InputError("the deck has no soil of which a profile could be made");
  const Soil& soil = *model.soil();
  const State& state = model.store().committed();
  Point beside = at;  // a line along sides of elements would cross those on both
  const Bounds& bounds = model.mesh().bounds();
  for (int i = 0; i < 3; ++i) {
    const double shift = 1e-7 * (bounds.high[i] - bounds.low[i]);
    beside[i] += at[i] + shift < bounds.high[i] ? shift : -shift;
  }
  const Point foot = sideways(soil, beside);
  for (int node = 0; node < model.mesh().num_nodes(); ++node)
    surface_ = std::max(surface_, soil.height(model.mesh().place(node)));
  for (const SoilBlock& b : soil.blocks)
    for (int e = 0; e < b.elements; ++e)
      if (crosses(soil, b, model.mesh(), e, foot)) add_row(soil, b, state, e, nearest_point(soil, b, state, e, foot));
  if (materials_.empty())
    throw InputError("the vertical line through " + place_text(at, model.mesh().dimension()) + " misses the soil");
  tidy();
}

GroundProfile::Column& GroundProfile::column(const std::string& name, const std::string& unit) {
  for (Column& column : columns_)
    if (column.name == name) return column;
  return columns_.emplace_back(Column{name, unit, std::vector<double>(materials_.size(), none)});
}

void GroundProfile::add_row(const Soil& soil, const SoilBlock& b, const State& state, int element, int point) {
  const int row = element * b.points + point;
  const SoilPoints points(soil, b, state);
  const SoilMaterial& material = points.material(row);
  materials_.push_back(material.name);
  for (Column& column : columns_) column.values.push_back(none);
  const double* stress = points.stress(row);
  double vertical = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) vertical -= soil.up[i] * stress[six(i, j)] * soil.up[j];
  const double horizontal = 0.0 - 0.5 * (sym6::trace(stress) + vertical);  // 0 without stress, not -0
  const double height = soil.height(b.place(element, point, state.coordinates));
  add("depth", "m", surface_ - height);
  add("height", "m", height);
  add("vertical effective stress", "Pa", vertical);
  add("horizontal effective stress", "Pa", horizontal);
  add("K0", "-", vertical > 0 ? horizontal / vertical : none);
  if (const int place = place_of_scalar(b, soil.pressure); place >= 0) {
    const double pressure = b.scalar_at(element, point, place, state.value);
    add("pore pressure", "Pa", pressure);
    if (soil.dries()) add("saturation", "-", material.retention.saturation(pressure));
  }
  const SoilState found = points.soil_state(row);
  const double shear = points.moduli(row).shear;
  if (found.overconsolidation_ratio) add("overconsolidation ratio", "-", *found.overconsolidation_ratio);
  if (const auto s = found.undrained_strength) {
    add("undrained strength", "Pa", *s);
    add("strength ratio", "-", vertical > 0 ? *s / vertical : none);
    add("rigidity index", "-", *s > 0 ? shear / *s : none);
  }
  add("shear modulus", "Pa", shear);
  if (points.void_ratio(row) > 0) add("void ratio", "-", points.void_ratio(row));
  if (b.porous()) add("hydraulic conductivity", "m/s", points.conductivity(row));
  int component = 0;
  for (const StateVariable& variable : material.skeleton->state_variables()) {
    const bool known = variable.name == "undrained strength" || variable.name == "void ratio";
    if (variable.components == 1 && !known) add(variable.name, variable.unit, points.law(row)[component]);
    component += variable.components;
  }
}

void GroundProfile::tidy() {
  std::vector<std::size_t> order(materials_.size());
  std::iota(order.begin(), order.end(), 0);
  const std::vector<double> height = column("height", "m").values;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return height[a] > height[b]; });
  const auto sorted = [&](auto values) {
    const auto old = values;
    for (std::size_t i = 0; i < order.size(); ++i) values[i] = old[order[i]];
    return values;
  };
  materials_ = sorted(materials_);
  for (Column& column : columns_) column.values = sorted(column.values);
  const auto empty = [](const Column& column) {
    return std::none_of(column.values.begin(), column.values.end(), [](double value) { return std::isfinite(value); });
  };
  columns_.erase(std::remove_if(columns_.begin(), columns_.end(), empty), columns_.end());
}

void GroundProfile::write(const std::string& path) const {
  std::ofstream file(path);
  for (const Column& column : columns_) file << csv_cell(column.name + " [" + column.unit + "]") << ",";
  file << "material\n";
  for (std::size_t row = 0; row < materials_.size(); ++row) {
    for (const Column& column : columns_)
      file << (std::isfinite(column.values[row]) ? number_text(column.values[row]) : "") << ",";
    file << csv_cell(materials_[row]) << "\n";
  }
  file.close();
  if (!file) throw RunError("the file " + path + " cannot be written");
}

std::string GroundProfile::table(int rows) const {
  struct Shown {
    const char *column, *head;
    double scale;
  };
  const Shown shown[] = {{"depth", "depth m", 1},
                         {"vertical effective stress", "s'_v kPa", 1e-3},
                         {"pore pressure", "u kPa", 1e-3},
                         {"K0", "K0", 1},
                         {"overconsolidation ratio", "OCR", 1},
                         {"undrained strength", "s_u kPa", 1e-3},
                         {"strength ratio", "s_u/s'_v", 1},
                         {"rigidity index", "G/s_u", 1},
                         {"void ratio", "e", 1},
                         {"hydraulic conductivity", "k m/s", 1}};
  const auto cell = [](const std::string& text) {
    return std::string(text.size() < 10 ? 10 - text.size() : 1, ' ') + text;
  };
  const auto of_column = [&](const char* name) {
    return std::find_if(columns_.begin(), columns_.end(), [&](const Column& column) { return column.name == name; });
  };
  std::string text;
  for (const Shown& one : shown)
    if (of_column(one.column) != columns_.end()) text += cell(one.head);
  text += "  material\n";
  const std::size_t count = materials_.size(), last = std::min<std::size_t>(count, std::max(rows, 2)) - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const std::size_t row = last > 0 ? i * (count - 1) / last : 0;
    for (const Shown& one : shown) {
      const auto column = of_column(one.column);
      if (column == columns_.end()) continue;
      text += cell(std::isfinite(column->values[row]) ? told(one.scale * column->values[row], "%.4g") : "-");
    }
    text += "  " + printable(materials_[row]) + "\n";
  }
  return text;
}

}  // namespace mudline
