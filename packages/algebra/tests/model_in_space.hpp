#pragma once

// The model problem of model_problem.hpp in space: a saturated elastic box cut into tetrahedra (six per cube), Taylor-
// Hood tet10/tet4, base fixed, rollers at the sides, drained top, loaded by gravity; trapezoidal rule in time.

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "algebra/tests/model_problem.hpp"
#include "algebra/tpetra_compat.hpp"
#include "tensor/vec.hpp"

namespace mudline::model {

class ProblemInSpace {
 public:
  using ElementMatrix = std::array<std::array<double, 34>, 34>;

  /// Settings::stiffness and permeability are taken at (x, z). `height`: height of the box, as a factor of its size.
  explicit ProblemInSpace(const Settings& settings, RCP<const Comm> comm, double height = 1)
      : settings_(settings), comm_(comm), height_(height) {
    number();
    assembler_ = std::make_unique<Assembler>(dofs_);
    group_ = assembler_->add_group(element_dofs_);
    assembler_->finalise();
  }

  Settings& settings() { return settings_; }
  const RCP<const DofMap>& dofs() const { return dofs_; }
  int num_elements() const { return static_cast<int>(elements_.size()); }
  Kokkos::View<const char*> constrained() const { return constrained_; }

  /// Stiffness per area of inclined walls against the top of the box [Pa/m], and the friction coefficient of the
  /// sliding contact.
  double contact = 0, friction = 0.3;

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
      for (int e = 0; e < num_elements(); ++e)
        for (int a = 4; a < 10; ++a) {  // corners carry -1/20 of the load each, mid-side nodes 1/5
          const int dof = element_dofs_(e, 3 * a + 2);
          if (!constrained_(dof)) values(dof, 0) -= 9.81 * settings_.density * volume() / 5;
        }
      for (int e = 0; e < num_elements(); ++e)
        for (int a = 0; a < 4; ++a) {
          const int dof = element_dofs_(e, 3 * a + 2);
          if (!constrained_(dof)) values(dof, 0) += 9.81 * settings_.density * volume() / 20;
        }
    }
    owned.doExport(overlap, *dofs_->import(), Tpetra::ADD);
    return owned;
  }

  BlockData block_data() const {
    BlockData data;
    const double nu = settings_.poisson, G = settings_.young / (2 * (1 + nu)), lambda = 2 * G * nu / (1 - 2 * nu);
    data.displacement = 0;
    data.coordinates = coordinates_;
    data.parents = parents_;
    data.constrained_modulus = lambda + 2 * G;
    data.drained_modulus = lambda + 2 * G / 3;
    data.inertia = mass_factor() * settings_.density;
    data.aspect_ratio = 2 * std::max(height_, 1 / height_);  // the tetrahedra of a cube have 2
    if (!settings_.fluid) return data;
    data.pressure = 1;
    data.coupling_u = 1;
    data.coupling_p = rate_factor();
    data.storage = rate_factor() * settings_.porosity / settings_.fluid_bulk;
    data.conduction = settings_.mobility;
    for (int i = dofs_->owned_begin(1); i < dofs_->owned_end(1); ++i)
      data.pressure_constrained.push_back(constrained_(i));
    pressure_matrices(data);
    return data;
  }

 private:
  using Barycentric = std::array<double, 4>;
  using Gradients = std::array<Vec<double, 3>, 4>;
  struct Tetrahedron {
    std::array<std::array<int, 3>, 10> nodes;  // positions on the grid of half cells
  };

  double mass_factor() const { return settings_.inertia ? 4 / (settings_.dt * settings_.dt) : 0; }
  double rate_factor() const { return settings_.inertia ? 2 / settings_.dt : 1 / settings_.dt; }
  double half_step(int direction) const {
    return 0.5 * settings_.size / settings_.cells * (direction == 2 ? height_ : 1.0);
  }
  double volume() const { return 8 * half_step(0) * half_step(1) * half_step(2) / 6; }
  int layers() const { return settings_.layers > 0 ? settings_.layers : settings_.cells; }
  int line() const { return 2 * settings_.cells + 1; }
  GlobalOrdinal id(int i, int j, int k) const { return (static_cast<GlobalOrdinal>(k) * line() + j) * line() + i; }

  static constexpr int edges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

  /// Gauss points of a cube collapsed to the tetrahedron: barycentric coordinates and weights that add up to 1.
  static const std::vector<std::pair<Barycentric, double>>& rule() {
    static const std::vector<std::pair<Barycentric, double>> points = [] {
      const double place[3] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
      const double weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
      std::vector<std::pair<Barycentric, double>> list;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          for (int k = 0; k < 3; ++k) {
            const double a = place[i], b = place[j] * (1 - a), c = place[k] * (1 - a - b);
            const double w = 6 * weight[i] * weight[j] * weight[k] * (1 - a) * (1 - a - b);
            list.push_back({{1 - a - b - c, a, b, c}, w});
          }
      return list;
    }();
    return points;
  }
  static std::array<double, 10> shape(const Barycentric& l) {
    std::array<double, 10> N{};
    for (int i = 0; i < 4; ++i) N[i] = l[i] * (2 * l[i] - 1);
    for (int e = 0; e < 6; ++e) N[4 + e] = 4 * l[edges[e][0]] * l[edges[e][1]];
    return N;
  }
  static std::array<Vec<double, 3>, 10> shape_gradient(const Barycentric& l, const Gradients& dl) {
    std::array<Vec<double, 3>, 10> dN{};
    for (int d = 0; d < 3; ++d) {
      for (int i = 0; i < 4; ++i) dN[i][d] = (4 * l[i] - 1) * dl[i][d];
      for (int e = 0; e < 6; ++e)
        dN[4 + e][d] = 4 * (l[edges[e][0]] * dl[edges[e][1]][d] + l[edges[e][1]] * dl[edges[e][0]][d]);
    }
    return dN;
  }
  /// Gradients of the barycentric coordinates [1/m]. The corners follow the cube's edges in some order of the
  /// directions, so that each coordinate changes once.
  Gradients barycentric_gradients(int e) const {
    Gradients dl{};
    for (int c = 0; c < 3; ++c)
      for (int d = 0; d < 3; ++d)
        if (elements_[e].nodes[c + 1][d] != elements_[e].nodes[c][d]) {
          dl[c + 1][d] += 0.5 / half_step(d);
          dl[c][d] -= 0.5 / half_step(d);
        }
    return dl;
  }

  ElementMatrix element_matrix(int e) const;
  void add_contact(int e, ElementMatrix& J) const;
  void pressure_matrices(BlockData& data) const;
  /// Distributes layers of cells over the ranks; the lower rank owns the nodes of a common face.
  void number();
  FieldLayout layout(const char* name, int components, int first, int first_owned, int last,
                     std::vector<int>& local) const;

  Settings settings_;
  RCP<const Comm> comm_;
  double height_;
  RCP<const DofMap> dofs_;
  std::vector<Tetrahedron> elements_;
  ElementDofs element_dofs_;
  Kokkos::View<const char*> constrained_;
  std::vector<double> coordinates_;
  std::vector<std::vector<GlobalOrdinal>> parents_;
  std::unique_ptr<Assembler> assembler_;
  int group_ = 0;
};

inline ProblemInSpace::ElementMatrix ProblemInSpace::element_matrix(int e) const {
  ElementMatrix J{};
  const Settings& s = settings_;
  const Gradients dl = barycentric_gradients(e);
  const auto& first = elements_[e].nodes[0];
  const double x = half_step(0) * (first[0] + 1), z = half_step(2) * (first[2] + 1);
  const double young = s.young * s.stiffness(x, z), nu = s.poisson, mobility = s.mobility * s.permeability(x, z);
  const double lambda = young * nu / ((1 + nu) * (1 - 2 * nu)), G = young / (2 * (1 + nu));
  for (const auto& [l, weight] : rule()) {
    const double dv = weight * volume();
    const auto N = shape(l);
    const auto dN = shape_gradient(l, dl);
    for (int a = 0; a < 10; ++a)
      for (int b = 0; b < 10; ++b) {
        const double dot = dN[a][0] * dN[b][0] + dN[a][1] * dN[b][1] + dN[a][2] * dN[b][2];
        for (int i = 0; i < 3; ++i) {
          J[3 * a + i][3 * b + i] += dv * (G * dot + mass_factor() * s.density * N[a] * N[b]);
          for (int j = 0; j < 3; ++j)
            J[3 * a + i][3 * b + j] += dv * (lambda * dN[a][i] * dN[b][j] + G * dN[a][j] * dN[b][i]);
        }
      }
    if (!s.fluid) continue;
    for (int a = 0; a < 10; ++a)
      for (int i = 0; i < 3; ++i)
        for (int b = 0; b < 4; ++b) {
          J[3 * a + i][30 + b] -= dv * dN[a][i] * l[b];
          J[30 + b][3 * a + i] += dv * rate_factor() * dN[a][i] * l[b];
        }
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b)
        J[30 + a][30 + b] += dv * (rate_factor() * s.porosity / s.fluid_bulk * l[a] * l[b] +
                                   mobility * (dl[a][0] * dl[b][0] + dl[a][1] * dl[b][1] + dl[a][2] * dl[b][2]));
  }
  if (contact > 0) add_contact(e, J);
  return J;
}

/// The tangent contact (n n^T + mu n t^T-like friction) at the top's nodes in a corner, the area shared among them.
inline void ProblemInSpace::add_contact(int e, ElementMatrix& J) const {
  for (int a = 0; a < 10; ++a) {
    const auto& node = elements_[e].nodes[a];
    const double x = half_step(0) * node[0], y = half_step(1) * node[1];
    if (node[2] != 2 * layers() || x > 0.3 * settings_.size || y > 0.3 * settings_.size) continue;
    const double tilt = 0.7 * x / (0.3 * settings_.size), area = 4 * half_step(0) * half_step(1) / 24;
    const double n[3] = {-std::sin(tilt), 0, std::cos(tilt)}, t[3] = {std::cos(tilt), 0, std::sin(tilt)};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) J[3 * a + i][3 * a + j] += contact * area * (n[i] + friction * t[i]) * n[j];
  }
}

inline void ProblemInSpace::pressure_matrices(BlockData& data) const {
  const auto mass = rcp(new CrsMatrix(dofs_->field_map(1), 27)),
             laplacian = rcp(new CrsMatrix(dofs_->field_map(1), 27));
  for (int e = 0; e < num_elements(); ++e) {
    const Gradients dl = barycentric_gradients(e);
    for (int a = 0; a < 4; ++a) {
      const GlobalOrdinal row = dofs_->overlap()->getGlobalElement(element_dofs_(e, 30 + a));
      for (int b = 0; b < 4; ++b) {
        const GlobalOrdinal column = dofs_->overlap()->getGlobalElement(element_dofs_(e, 30 + b));
        const double m = volume() * (a == b ? 1.0 / 10 : 1.0 / 20);
        const double k = volume() * (dl[a][0] * dl[b][0] + dl[a][1] * dl[b][1] + dl[a][2] * dl[b][2]);
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

inline FieldLayout ProblemInSpace::layout(const char* name, int components, int first, int first_owned, int last,
                                          std::vector<int>& local) const {
  FieldLayout field{name, components, {}, 0};
  const int step = components == 1 ? 2 : 1;  // the pressure is at the corners only
  local.assign(static_cast<std::size_t>(id(0, 0, 2 * layers() + 1)), -1);
  const auto add_levels = [&](int from, int to) {
    for (int k = from; k <= to; ++k) {
      if (k % step != 0) continue;
      for (int j = 0; j < line(); j += step)
        for (int i = 0; i < line(); i += step) {
          local[id(i, j, k)] = static_cast<int>(field.node_ids.size());
          field.node_ids.push_back(id(i, j, k));
        }
    }
  };
  add_levels(first_owned, last);
  field.num_owned = static_cast<int>(field.node_ids.size());
  add_levels(first, first_owned - 1);
  return field;
}

inline void ProblemInSpace::number() {
  const int n = settings_.cells, ranks = comm_->getSize(), rank = comm_->getRank(), end = line() - 1;
  const int first_cell = layers() * rank / ranks, end_cell = layers() * (rank + 1) / ranks;
  for (int k = first_cell; k < end_cell; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        std::array<int, 3> permutation{0, 1, 2};
        do {
          Tetrahedron t{};
          t.nodes[0] = {2 * i, 2 * j, 2 * k};
          for (int c = 0; c < 3; ++c) {
            t.nodes[c + 1] = t.nodes[c];
            t.nodes[c + 1][permutation[c]] += 2;
          }
          for (int e = 0; e < 6; ++e)
            for (int d = 0; d < 3; ++d) t.nodes[4 + e][d] = (t.nodes[edges[e][0]][d] + t.nodes[edges[e][1]][d]) / 2;
          elements_.push_back(t);
        } while (std::next_permutation(permutation.begin(), permutation.end()));
      }
  const int first = 2 * first_cell, last = 2 * end_cell, first_owned = first_cell > 0 ? first + 1 : 0;
  std::vector<int> u_node, p_node;
  std::vector<FieldLayout> fields{layout("displacement", 3, first, first_owned, last, u_node)};
  if (settings_.fluid) fields.push_back(layout("pore pressure", 1, first, first_owned, last, p_node));
  dofs_ = rcp(new DofMap(comm_, fields));

  Kokkos::View<char*> constrained("constrained", dofs_->num_overlap_dofs());
  const auto position = [&](GlobalOrdinal node) {
    return std::array<int, 3>{static_cast<int>(node % line()), static_cast<int>(node / line() % line()),
                              static_cast<int>(node / line() / line())};
  };
  for (std::size_t a = 0; a < fields[0].node_ids.size(); ++a) {
    const std::array<int, 3> at = position(fields[0].node_ids[a]);
    for (int d = 0; d < 3; ++d)
      constrained(dofs_->dof(0, static_cast<int>(a)) + d) =
          settings_.soil_held || at[2] == 0 || (d < 2 && (at[d] == 0 || at[d] == end));
    if (static_cast<int>(a) >= fields[0].num_owned) continue;
    for (int d = 0; d < 3; ++d) coordinates_.push_back(half_step(d) * at[d]);
    // Every edge runs from its end with smaller coordinates to that with larger ones.
    const int odd[3] = {at[0] % 2, at[1] % 2, at[2] % 2};
    parents_.emplace_back();
    if (odd[0] + odd[1] + odd[2] > 0)
      parents_.back() = {id(at[0] - odd[0], at[1] - odd[1], at[2] - odd[2]),
                         id(at[0] + odd[0], at[1] + odd[1], at[2] + odd[2])};
  }
  if (settings_.fluid && settings_.drained_top)
    for (std::size_t a = 0; a < fields[1].node_ids.size(); ++a)
      if (settings_.drained_throughout || position(fields[1].node_ids[a])[2] == 2 * layers())
        constrained(dofs_->dof(1, static_cast<int>(a))) = 1;
  constrained_ = constrained;

  Kokkos::View<int**, Kokkos::LayoutRight> element_dofs("element dofs", elements_.size(), settings_.fluid ? 34 : 30);
  for (std::size_t e = 0; e < elements_.size(); ++e)
    for (int a = 0; a < 10; ++a) {
      const auto& at = elements_[e].nodes[a];
      for (int c = 0; c < 3; ++c) element_dofs(e, 3 * a + c) = dofs_->dof(0, u_node[id(at[0], at[1], at[2])]) + c;
      if (settings_.fluid && a < 4) element_dofs(e, 30 + a) = dofs_->dof(1, p_node[id(at[0], at[1], at[2])]);
    }
  element_dofs_ = element_dofs;
}

}  // namespace mudline::model
