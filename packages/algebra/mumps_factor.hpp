#pragma once

#include <memory>
#include <string>
#include <vector>

#include "algebra/types.hpp"

namespace mudline {

/// LU factors of a sparse unsymmetric matrix by MUMPS, with the matrix distributed as Tpetra has it. All calls are
/// collective over the matrix' communicator; one that fails returns the reason, else "".
class MumpsFactor {
 public:
  /// Takes the graph of `matrix`, whose global ids are 0 .. N-1, and orders it (once per graph). On several ranks MUMPS
  /// adds up in the order in which messages arrive, so the last digits differ from run to run; with `one_process` rank
  /// 0 factors and solves alone, and they do not. `node_of_row`: for owned rows, see node_ordering.hpp; the order of
  /// elimination is then found on the nodes where rank 0 holds the graph. Empty: MUMPS finds one.
  MumpsFactor(const CrsMatrix& matrix, bool one_process, const std::vector<GlobalOrdinal>& node_of_row);
  ~MumpsFactor();
  MumpsFactor(const MumpsFactor&) = delete;
  MumpsFactor& operator=(const MumpsFactor&) = delete;

  /// Error of the analysis; "" if it went well.
  const std::string& analysis() const { return analysis_; }
  /// Factors the values of `matrix`, which has the graph given at construction.
  std::string factor(const CrsMatrix& matrix);
  /// x = A^-1 b with the matrix factored last. Not thread safe.
  void solve(const MultiVector& b, MultiVector& x) const;

 private:
  struct Instance;
  std::unique_ptr<Instance> instance_;
  std::string analysis_;
};

}  // namespace mudline
