#pragma once

#include <Kokkos_Core.hpp>
#include <Tpetra_FECrsMatrix.hpp>

#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "algebra/dof_map.hpp"

namespace mudline {

/// Local overlap dofs of every element of one group: (element, dof). One group per element block and field combination.
using ElementDofs = Kokkos::View<const int**, Kokkos::LayoutRight>;

/// Writes element matrices into the local values of the matrix through precomputed offsets. Copied into kernels.
/// Constrained dofs: off-diagonal entries of their rows and columns are dropped, the diagonal is kept (a correctly
/// scaled, symmetric, AMG-friendly identity row; the residual is zero there).
struct MatrixScatter {
  Kokkos::View<double*> values;
  Kokkos::View<const std::uint32_t***, Kokkos::LayoutRight> offsets;  // (element, row dof, column dof)
  ElementDofs dofs;
  Kokkos::View<const char*> constrained;  // by overlap dof

  /// Adds the entry (a, b) of element e's matrix.
  KOKKOS_INLINE_FUNCTION void add(int e, int a, int b, double value) const {
    if (a != b && (constrained(dofs(e, a)) || constrained(dofs(e, b)))) return;
    accumulate(&values(offsets(e, a, b)), value);
  }
#ifdef KOKKOS_ENABLE_SERIAL
  static constexpr bool concurrent = !std::is_same_v<Kokkos::DefaultExecutionSpace, Kokkos::Serial>;
#else
  static constexpr bool concurrent = true;
#endif
  /// Atomic only where the execution space is concurrent.
  KOKKOS_INLINE_FUNCTION static void accumulate(double* target, double value) {
    if constexpr (concurrent)
      Kokkos::atomic_add(target, value);
    else
      *target += value;
  }
};

/// The sparse Jacobian: graph from element groups, built once; assembled any number of times.
class Assembler {
 public:
  explicit Assembler(RCP<const DofMap> dofs);

  /// Registers a group (before finalise); returns its id.
  int add_group(ElementDofs dofs);
  /// Builds graph, matrix and offsets. Collective.
  void finalise();

  /// Zeroes the matrix and opens it for scatter. `constrained` is by overlap dof and must agree across ranks.
  void begin(Kokkos::View<const char*> constrained);
  MatrixScatter scatter(int group) const;
  /// Exports shared rows; afterwards matrix() is complete. A zero diagonal of a constrained dof becomes 1. Collective.
  /// Every MatrixScatter must be out of scope.
  void end();

  RCP<const CrsMatrix> matrix() const { return matrix_; }
  const RCP<const DofMap>& dofs() const { return dofs_; }

 private:
  using FEMatrix = Tpetra::FECrsMatrix<>;
  void compute_offsets();
  RCP<const DofMap> dofs_;
  std::vector<ElementDofs> groups_;
  std::vector<Kokkos::View<std::uint32_t***, Kokkos::LayoutRight>> offsets_;
  RCP<FEMatrix> matrix_;
  Kokkos::View<const char*> constrained_;
};

}  // namespace mudline
