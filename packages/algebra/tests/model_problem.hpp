#pragma once

// The model problem of the linear solvers' tests and benchmark: a saturated elastic box in plane strain, T6/P3
// Taylor-Hood triangles, base fixed, rollers at the sides, drained top, loaded by gravity; trapezoidal rule in time.

#include <Teuchos_CommHelpers.hpp>

#include <array>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "algebra/assembler.hpp"
#include "algebra/linear_solver.hpp"
#include "tensor/vec.hpp"

namespace mudline::model {

struct Settings {
  int cells = 33;             // per side
  int layers = 0;             // of cells upwards, in space; 0: as many as per side
  double size = 10;           // [m]
  double young = 10e6;        // [Pa]
  double poisson = 0.3;       // [-]
  double density = 2000;      // density of the mixture [kg/m3]
  double porosity = 0.4;      // [-]
  double fluid_bulk = 2.2e9;  // [Pa]
  double mobility = 1e-8;     // k/gamma_w [m2/(Pa s)]
  double dt = 0.1;            // [s]
  bool inertia = true;
  bool fluid = true;  // false: displacement only
  bool drained_top = true;
  bool soil_held = false, drained_throughout = false;  // every displacement, every pressure prescribed
  std::function<double(double, double)> stiffness = [](double, double) { return 1.0; };     // factor at (x, y)
  std::function<double(double, double)> permeability = [](double, double) { return 1.0; };  // factor at (x, y)
  double skew = 0;  // an unsymmetric part added to the stress-strain matrix, as a factor of E
};

/// Six-point rule of degree 4 on the triangle, barycentric, weights summing to one.
struct Rule {
  std::array<Vec<double, 3>, 6> points;
  std::array<double, 6> weights;
};
inline Rule six_points() {
  Rule rule{};
  const double a[2] = {0.445948490915965, 0.091576213509771}, w[2] = {0.223381589678011, 0.109951743655322};
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < 3; ++i) {
      rule.points[3 * k + i] = {a[k], a[k], a[k]};
      rule.points[3 * k + i][i] = 1 - 2 * a[k];
      rule.weights[3 * k + i] = w[k];
    }
  return rule;
}

/// Position of an element's node on the grid of half cells.
using GridPoint = std::array<int, 2>;

class Problem {
 public:
  using ElementMatrix = std::array<std::array<double, 15>, 15>;

  explicit Problem(const Settings& settings, RCP<const Comm> comm) : settings_(settings), comm_(comm) {
    number();
    assembler_ = std::make_unique<Assembler>(dofs_);
    group_ = assembler_->add_group(element_dofs_);
    assembler_->finalise();
  }

  Settings& settings() { return settings_; }
  const RCP<const DofMap>& dofs() const { return dofs_; }
  int num_elements() const { return static_cast<int>(elements_.size()); }
  const ElementDofs& element_dofs() const { return element_dofs_; }
  Kokkos::View<const char*> constrained() const { return constrained_; }

  ElementMatrix element_matrix(int e) const;

  RCP<const CrsMatrix> assemble() {
    assembler_->begin(constrained_);
    {
      const MatrixScatter scatter = assembler_->scatter(group_);
      for (int e = 0; e < num_elements(); ++e) {
        const ElementMatrix matrix = element_matrix(e);
        const int size = static_cast<int>(element_dofs_.extent(1));
        for (int a = 0; a < size; ++a)
          for (int b = 0; b < size; ++b) scatter.add(e, a, b, matrix[a][b]);
      }
    }
    assembler_->end();
    return assembler_->matrix();
  }

  /// Gravity on the momentum rows; nothing on the mass rows.
  Vector load() const {
    Vector overlap(dofs_->overlap()), owned(dofs_->owned());
    {
      const auto values = overlap.getLocalViewHost(Tpetra::Access::ReadWrite);
      const Rule rule = six_points();
      for (int e = 0; e < num_elements(); ++e)
        for (int q = 0; q < 6; ++q) {
          const auto N = shape(rule.points[q]);
          for (int a = 0; a < 6; ++a) {
            const int dof = element_dofs_(e, 2 * a + 1);
            if (!constrained_(dof)) values(dof, 0) -= 9.81 * settings_.density * N[a] * rule.weights[q] * area();
          }
        }
    }
    owned.doExport(overlap, *dofs_->import(), Tpetra::ADD);
    return owned;
  }

  BlockData block_data() const {
    BlockData data;
    const double c_m = mass_factor(), c_v = rate_factor(), nu = settings_.poisson;
    const double lambda = settings_.young * nu / ((1 + nu) * (1 - 2 * nu)), G = settings_.young / (2 * (1 + nu));
    data.displacement = 0;
    data.coordinates = coordinates_;
    data.parents = parents_;
    data.constrained_modulus = lambda + 2 * G;
    data.drained_modulus = lambda + G;
    data.inertia = c_m * settings_.density;
    if (!settings_.fluid) return data;
    data.pressure = 1;
    data.coupling_u = 1;
    data.coupling_p = c_v;
    data.storage = c_v * settings_.porosity / settings_.fluid_bulk;
    data.conduction = settings_.mobility;
    for (int i = dofs_->owned_begin(1); i < dofs_->owned_end(1); ++i)
      data.pressure_constrained.push_back(constrained_(i));
    pressure_matrices(data);
    return data;
  }

 private:
  double mass_factor() const { return settings_.inertia ? 4 / (settings_.dt * settings_.dt) : 0; }
  double rate_factor() const { return settings_.inertia ? 2 / settings_.dt : 1 / settings_.dt; }
  double step() const { return settings_.size / settings_.cells; }
  double area() const { return 0.5 * step() * step(); }

  static std::array<double, 6> shape(const Vec<double, 3>& l) {
    return {l[0] * (2 * l[0] - 1), l[1] * (2 * l[1] - 1), l[2] * (2 * l[2] - 1),
            4 * l[0] * l[1],       4 * l[1] * l[2],       4 * l[2] * l[0]};
  }
  static std::array<Vec<double, 2>, 6> shape_gradient(const Vec<double, 3>& l,
                                                      const std::array<Vec<double, 2>, 3>& dl) {
    std::array<Vec<double, 2>, 6> dN{};
    for (int i = 0; i < 3; ++i)
      for (int d = 0; d < 2; ++d) {
        dN[i][d] = (4 * l[i] - 1) * dl[i][d];
        dN[3 + i][d] = 4 * (l[i] * dl[(i + 1) % 3][d] + l[(i + 1) % 3] * dl[i][d]);
      }
    return dN;
  }

  /// Gradients of the barycentric coordinates; the triangles are the two halves of a square cell.
  std::array<Vec<double, 2>, 3> barycentric_gradients(int e) const {
    std::array<Vec<double, 2>, 3> x{}, dl{};
    for (int i = 0; i < 3; ++i)
      for (int d = 0; d < 2; ++d) x[i][d] = 0.5 * step() * elements_[e][i][d];
    for (int i = 0; i < 3; ++i) {
      const auto &p = x[(i + 1) % 3], &q = x[(i + 2) % 3];
      dl[i] = {(p[1] - q[1]) / (2 * area()), (q[0] - p[0]) / (2 * area())};
    }
    return dl;
  }

  void pressure_matrices(BlockData& data) const {
    const auto mass = rcp(new CrsMatrix(dofs_->field_map(1), 9)),
               laplacian = rcp(new CrsMatrix(dofs_->field_map(1), 9));
    for (int e = 0; e < num_elements(); ++e) {
      const auto dl = barycentric_gradients(e);
      for (int a = 0; a < 3; ++a) {
        const GlobalOrdinal row = dofs_->overlap()->getGlobalElement(element_dofs_(e, 12 + a));
        for (int b = 0; b < 3; ++b) {
          const GlobalOrdinal column = dofs_->overlap()->getGlobalElement(element_dofs_(e, 12 + b));
          const double m = area() * (a == b ? 1.0 / 6 : 1.0 / 12);
          const double k = area() * (dl[a][0] * dl[b][0] + dl[a][1] * dl[b][1]);
          mass->insertGlobalValues(row, 1, &m, &column);
          laplacian->insertGlobalValues(row, 1, &k, &column);
        }
      }
    }
    mass->fillComplete();
    laplacian->fillComplete();
    data.pressure_mass = mass;
    data.pressure_laplacian = laplacian;
  }

  /// Distributes rows of cells over the ranks in strips; the lower strip owns the nodes of a common edge.
  void number();
  void number_field(bool vertices_only, FieldLayout& field, std::vector<int>& local, int first_line, int last_line,
                    int first_owned) const;

  Settings settings_;
  RCP<const Comm> comm_;
  RCP<const DofMap> dofs_;
  std::vector<std::array<GridPoint, 6>> elements_;
  ElementDofs element_dofs_;
  Kokkos::View<const char*> constrained_;
  std::vector<double> coordinates_;
  std::vector<std::vector<GlobalOrdinal>> parents_;
  std::unique_ptr<Assembler> assembler_;
  int group_ = 0;
};

inline Problem::ElementMatrix Problem::element_matrix(int e) const {
  ElementMatrix J{};
  const Settings& s = settings_;
  const auto dl = barycentric_gradients(e);
  const double x = 0.5 * step() * (elements_[e][0][0] + elements_[e][1][0] + elements_[e][2][0]) / 3;
  const double y = 0.5 * step() * (elements_[e][0][1] + elements_[e][1][1] + elements_[e][2][1]) / 3;
  const double young = s.young * s.stiffness(x, y), nu = s.poisson, mobility = s.mobility * s.permeability(x, y);
  const double lambda = young * nu / ((1 + nu) * (1 - 2 * nu)), G = young / (2 * (1 + nu));
  const Rule rule = six_points();
  for (int q = 0; q < 6; ++q) {
    const auto& l = rule.points[q];
    const double dv = rule.weights[q] * area();
    const auto N = shape(l);
    const auto dN = shape_gradient(l, dl);
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b) {
        const double dot = dN[a][0] * dN[b][0] + dN[a][1] * dN[b][1];
        for (int i = 0; i < 2; ++i) {
          J[2 * a + i][2 * b + i] += dv * (G * dot + mass_factor() * s.density * N[a] * N[b]);
          for (int j = 0; j < 2; ++j)
            J[2 * a + i][2 * b + j] += dv * (lambda * dN[a][i] * dN[b][j] + G * dN[a][j] * dN[b][i]);
        }
        J[2 * a][2 * b] += dv * s.skew * young * dN[a][0] * dN[b][1];
      }
    if (!s.fluid) continue;
    for (int a = 0; a < 6; ++a)
      for (int i = 0; i < 2; ++i)
        for (int b = 0; b < 3; ++b) {
          J[2 * a + i][12 + b] -= dv * dN[a][i] * l[b];
          J[12 + b][2 * a + i] += dv * rate_factor() * dN[a][i] * l[b];
        }
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        J[12 + a][12 + b] += dv * (rate_factor() * s.porosity / s.fluid_bulk * l[a] * l[b] +
                                   mobility * (dl[a][0] * dl[b][0] + dl[a][1] * dl[b][1]));
  }
  return J;
}

inline void Problem::number_field(bool vertices_only, FieldLayout& field, std::vector<int>& local, int first_line,
                                  int last_line, int first_owned) const {
  const int line = 2 * settings_.cells + 1;
  local.assign(static_cast<std::size_t>(line) * line, -1);
  const auto add_lines = [&](int from, int to) {
    for (int j = from; j <= to; ++j)
      for (int i = 0; i < line; ++i) {
        if (vertices_only && (i % 2 != 0 || j % 2 != 0)) continue;
        local[j * line + i] = static_cast<int>(field.node_ids.size());
        field.node_ids.push_back(static_cast<GlobalOrdinal>(j) * line + i);
      }
  };
  add_lines(first_owned, last_line);
  field.num_owned = static_cast<int>(field.node_ids.size());
  add_lines(first_line, first_owned - 1);
}

inline void Problem::number() {
  const int n = settings_.cells, line = 2 * n + 1, ranks = comm_->getSize(), rank = comm_->getRank();
  const int first_row = n * rank / ranks, end_row = n * (rank + 1) / ranks;
  for (int j = first_row; j < end_row; ++j)
    for (int i = 0; i < n; ++i) {
      const int x = 2 * i, y = 2 * j;
      elements_.push_back({{{x, y}, {x + 2, y}, {x + 2, y + 2}, {x + 1, y}, {x + 2, y + 1}, {x + 1, y + 1}}});
      elements_.push_back({{{x, y}, {x + 2, y + 2}, {x, y + 2}, {x + 1, y + 1}, {x + 1, y + 2}, {x, y + 1}}});
    }
  const bool any = end_row > first_row;
  const int first_line = 2 * first_row, last_line = any ? 2 * end_row : -1;
  const int first_owned = any && first_row > 0 ? first_line + 1 : first_line;
  FieldLayout displacement{"displacement", 2, {}, 0}, pressure{"pore pressure", 1, {}, 0};
  std::vector<int> u_node, p_node;
  number_field(false, displacement, u_node, first_line, last_line, first_owned);
  number_field(true, pressure, p_node, first_line, last_line, first_owned);

  std::vector<FieldLayout> fields{displacement};
  if (settings_.fluid) fields.push_back(pressure);
  dofs_ = rcp(new DofMap(comm_, fields));

  Kokkos::View<char*> constrained("constrained", dofs_->num_overlap_dofs());
  for (std::size_t k = 0; k < displacement.node_ids.size(); ++k) {
    const int i = static_cast<int>(displacement.node_ids[k] % line),
              j = static_cast<int>(displacement.node_ids[k] / line);
    constrained(dofs_->dof(0, k)) = settings_.soil_held || i == 0 || i == line - 1 || j == 0;
    constrained(dofs_->dof(0, k) + 1) = settings_.soil_held || j == 0;
    if (static_cast<int>(k) >= displacement.num_owned) continue;
    coordinates_.push_back(0.5 * step() * i);
    coordinates_.push_back(0.5 * step() * j);
    // The diagonal of a cell runs from its lower left to its upper right corner.
    const int di = i % 2, dj = j % 2;
    if (di == 0 && dj == 0)
      parents_.push_back({});
    else
      parents_.push_back({GlobalOrdinal(j - dj) * line + (i - di), GlobalOrdinal(j + dj) * line + (i + di)});
  }
  if (settings_.fluid && settings_.drained_top)
    for (std::size_t k = 0; k < pressure.node_ids.size(); ++k)
      if (settings_.drained_throughout || pressure.node_ids[k] / line == line - 1) constrained(dofs_->dof(1, k)) = 1;
  constrained_ = constrained;

  const int size = settings_.fluid ? 15 : 12;
  Kokkos::View<int**, Kokkos::LayoutRight> element_dofs("element dofs", elements_.size(), size);
  for (std::size_t e = 0; e < elements_.size(); ++e)
    for (int a = 0; a < 6; ++a) {
      const int k = elements_[e][a][1] * line + elements_[e][a][0];
      for (int c = 0; c < 2; ++c) element_dofs(e, 2 * a + c) = dofs_->dof(0, u_node[k]) + c;
      if (settings_.fluid && a < 3) element_dofs(e, 12 + a) = dofs_->dof(1, p_node[k]);
    }
  element_dofs_ = element_dofs;
}

}  // namespace mudline::model
