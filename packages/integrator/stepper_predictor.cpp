// The first guess of a step whose prescribed unknowns move.
#include "integrator/overlap.hpp"
#include "integrator/stepper.hpp"

namespace mudline {

bool Stepper::predict(Vector& x) {
  Vector old(map()), moved(map());
  {
    auto start = old.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (int i = 0; i < space_.dofs()->num_owned_dofs(); ++i) start(i, 0) = store_.committed().value(i);
  }
  moved.update(1, x, -1, old, 0);
  if (moved.norm2() == 0) return false;
  // The columns of prescribed unknowns are not in the matrix: their product with the change is differenced. The fraction is
  // small enough for the elements next to the moving nodes, large enough against rounding.
  constexpr double fraction = 1e-3;
  Vector f(map()), shifted(map()), part(old, Teuchos::Copy), correction(map());
  part.update(fraction, moved, 1);
  if (!residual(part, shifted) || !residual(old, f) || !jacobian(old)) return false;
  f.update(1 / fraction, shifted, 1 - 1 / fraction);
  if (!solve(f, correction)) return false;
  x.update(-1, correction, 1);
  return true;
}

}  // namespace mudline
