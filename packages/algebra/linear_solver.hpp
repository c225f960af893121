#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "algebra/dof_map.hpp"
#include "core/registry.hpp"

namespace mudline {

/// When a linear solve is exact enough: each field's residual is below the relative tolerance or below `enough`.
struct LinearTolerance {
  LinearTolerance(double relative, std::vector<double> enough = {}) : relative(relative), enough(std::move(enough)) {}
  double relative;             // bounds LinearReport::relative_residual
  std::vector<double> enough;  // by field: residual norm of its rows that suffices; empty: none
};

/// The outcome of one linear solve.
struct LinearReport {
  bool converged = false;
  int iterations = 0;            // Krylov iterations; 0 for a plain direct solve
  bool factored = false;         // a new factorisation or hierarchy was built for this solve
  double relative_residual = 0;  // true, of each field's rows against the largest term in them (||b_f||, ||A_fg x_g||);
                                 // the worst over the fields
  std::string reason;            // why it did not converge, one line
};

/// Data that a block preconditioner needs beyond the matrix. Filled by the physics; absent parts are null or zero.
struct BlockData {
  int displacement = -1, pressure = -1;  // field indices in the dof map; pressure -1: no pore fluid
  std::vector<double> coordinates;       // (owned displacement node, dimension) current coordinates [m]
  /// Owned displacement nodes that are not vertices: the global displacement node ids of the vertices whose mean they
  /// are (2 on an edge, 4 on a quadrangle, 8 in a hexahedron); empty for vertices. The linear subspace of p-multigrid.
  std::vector<std::vector<GlobalOrdinal>> parents;
  /// Flags by owned displacement node: 1 where a stiff contact acts on a side of the node; empty: nowhere.
  std::vector<char> joined;
  /// Pressure mass and Laplacian matrices on the pressure field map (no constraints applied):
  /// Q = int M/M_here Np^T Np dv, with M the mean of the constrained modulus M_here, as soft soil takes up more water
  /// under a pressure; L = int grad(Np)^T grad(Np) dv. Row map dofs.field_map(pressure), ids of the dof map.
  RCP<const CrsMatrix> pressure_mass, pressure_laplacian;
  std::vector<char> pressure_constrained;  // by owned pressure dof
  /// Longest edge over height of the most stretched element, relative to that of the equilateral one [-].
  double aspect_ratio = 1;
  /// Coefficients of the Jacobian [[c_m M + c_k K, -L c_p], [c_v L^T, c_s S + c_h H]], representative scalars:
  double constrained_modulus = 0;  // lambda + 2G of K [Pa], times c_k
  double drained_modulus = 0;      // lambda + G in the plane, lambda + 2/3 G in space [Pa], times c_k (fixed stress)
  double inertia = 0;              // c_m rho [kg/(m3 s2)]
  double coupling_u = 1;           // c_p alpha
  double coupling_p = 1;           // c_v alpha [1/s]
  double storage = 0;              // c_s / Q [1/(Pa s)]
  double conduction = 0;           // c_h k/gamma_w [m2/(Pa s)]
};

/// Solves A x = b for a sequence of matrices of one graph.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  /// Called once with the dof map before the first matrix. Returns "" or why this solver cannot treat these fields.
  virtual std::string prepare(RCP<const DofMap> dofs) = 0;
  /// New values of A. `block_data` is evaluated only when the solver needs it (a rebuild of its preconditioner).
  virtual void set_matrix(RCP<const CrsMatrix> matrix, const std::function<BlockData()>& block_data) = 0;
  /// Solves A x = b from x = 0.
  virtual LinearReport solve(const Vector& b, Vector& x, const LinearTolerance& tolerance) = 0;
  /// True when a looser tolerance saves work.
  virtual bool iterative() const { return false; }
  /// True when it holds factors of the very matrix that was set last: another right-hand side then costs a solve only.
  virtual bool exact() const { return false; }
  /// Forgets factorisations and hierarchies (after a remap, a failed step, a stage change).
  virtual void reset() = 0;
  /// Data that a restarted run needs to continue bit for bit; empty when there are none. A solver that cannot give them
  /// resets itself, so that both runs start afresh.
  virtual std::vector<double> memory() {
    reset();
    return {};
  }
  /// Restores the state that memory() gave. `matrix` has the graph of the matrices to come; its values may be
  /// overwritten. Collective.
  virtual void restore(RCP<CrsMatrix> matrix, const std::vector<double>& memory) {}
};

/// Registers "direct" and "block amg".
void register_linear_solvers(Registry<LinearSolver>& registry);

}  // namespace mudline
