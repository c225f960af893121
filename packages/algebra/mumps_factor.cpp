#include "algebra/mumps_factor.hpp"

#include <dmumps_c.h>
#include <mpi.h>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include "algebra/node_ordering.hpp"
#include "algebra/raw_communicator.hpp"
#include "algebra/tpetra_compat.hpp"

namespace mudline {

namespace {

constexpr int job_start = -1, job_end = -2, job_analyse = 1, job_factor = 2, job_solve = 3;
constexpr int max_memory_relaxation = 1000;  // [%]

bool all_finite(const std::vector<double>& values, const Comm& comm) {
  const bool finite = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  const int here = finite ? 1 : 0;
  int everywhere = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, here, Teuchos::outArg(everywhere));
  return everywhere == 1;
}

std::string describe(int code, int detail, long long size) {
  switch (code) {
    case -5:
    case -7:
    case -13:
      return "the direct solver could not allocate its memory";
    case -6:
      return "the matrix is structurally singular (rank " + std::to_string(detail) + " of " + std::to_string(size) +
             "): an unknown has no equation";
    case -8:
    case -9:
    case -17:
    case -20:
      return "the direct solver ran out of workspace at " + std::to_string(max_memory_relaxation) + " % extra";
    case -10:
      return "the matrix is singular (pivot " + std::to_string(detail) + " of " + std::to_string(size) +
             " vanishes): check for rigid-body motion or a pressure without storage and drainage";
    default:
      return "the direct solver failed (MUMPS INFOG(1)=" + std::to_string(code) +
             ", INFOG(2)=" + std::to_string(detail) + ")";
  }
}

}  // namespace

/// The MUMPS instance and the arrays it points into. With one process, rank 0 holds all entries and the others none.
struct MumpsFactor::Instance {
  DMUMPS_STRUC_C id{};
  bool one_process = false, here = true;  // here: this rank takes part in the factorisation
  MPI_Comm ranks = MPI_COMM_SELF;
  std::vector<int> counts, offsets;  // entries of each rank, on the rank that gathers them
  std::vector<MUMPS_INT> rows, columns, order;
  std::vector<double> values;
  std::size_t local_values = 0;
  RCP<const Map> owned, on_root;
  RCP<const Import> to_root;
  RCP<Vector> root_vector;

  /// Runs a job; afterwards code() is the same on all ranks.
  void run(int job) {
    if (here) {
      id.job = job;
      dmumps_c(&id);
    }
    int outcome[2] = {id.infog[0], id.infog[1]};
    if (one_process) MPI_Bcast(outcome, 2, MPI_INT, 0, ranks);
    id.infog[0] = outcome[0];
    id.infog[1] = outcome[1];
  }
  int& control(int i) { return id.icntl[i - 1]; }  // numbered as in the manual
  int code() const { return id.infog[0]; }
  std::string outcome() const { return code() < 0 ? describe(code(), id.infog[1], id.n) : std::string(); }

  void take_graph(const CrsMatrix& matrix);
  void gather_graph();
  /// Sets the elimination order to the nested dissection of the nodes of the rows.
  void order_by_nodes(const std::vector<GlobalOrdinal>& node_of_row);
  void take_values(const CrsMatrix& matrix);
};

void MumpsFactor::Instance::take_graph(const CrsMatrix& matrix) {
  const auto local = matrix.getLocalMatrixHost();
  const Map& row_map = *matrix.getRowMap();
  const Map& column_map = *matrix.getColMap();
  const std::size_t entries = local_entries(matrix);
  rows.reserve(entries);
  columns.reserve(entries);
  for (std::size_t row = 0; row < local_rows(matrix); ++row) {
    const auto global_row = static_cast<MUMPS_INT>(row_map.getGlobalElement(static_cast<int>(row))) + 1;
    for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k) {
      rows.push_back(global_row);
      columns.push_back(static_cast<MUMPS_INT>(column_map.getGlobalElement(local.graph.entries(k))) + 1);
    }
  }
  local_values = entries;
  values.resize(entries);

  owned = matrix.getRowMap();
  const std::size_t here = owned->getComm()->getRank() == 0 ? owned->getGlobalNumElements() : 0;
  on_root = rcp(new Map(owned->getGlobalNumElements(), here, 0, owned->getComm()));
  to_root = rcp(new Import(owned, on_root));
  root_vector = rcp(new Vector(on_root));
}

void MumpsFactor::Instance::gather_graph() {
  int size = 0;
  MPI_Comm_size(ranks, &size);
  counts.resize(size);
  offsets.assign(size, 0);
  const int mine = static_cast<int>(rows.size());
  MPI_Gather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, ranks);
  if (here)
    for (int r = 1; r < size; ++r) offsets[r] = offsets[r - 1] + counts[r - 1];
  const std::size_t all = here ? offsets.back() + counts.back() : 0;
  for (std::vector<MUMPS_INT>* ids : {&rows, &columns}) {
    std::vector<MUMPS_INT> gathered(all);
    MPI_Gatherv(ids->data(), mine, MPI_INT, gathered.data(), counts.data(), offsets.data(), MPI_INT, 0, ranks);
    ids->swap(gathered);
  }
  values.resize(all);
}

void MumpsFactor::Instance::order_by_nodes(const std::vector<GlobalOrdinal>& node_of_row) {
  Tpetra::Vector<GlobalOrdinal> nodes(owned), all(on_root);
  {
    const auto values = nodes.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t row = 0; row < node_of_row.size(); ++row) values(row, 0) = node_of_row[row];
  }
  all.doImport(nodes, *to_root, Tpetra::INSERT);
  if (!here) return;
  const auto values = all.getLocalViewHost(Tpetra::Access::ReadOnly);
  order = nested_dissection(rows, columns, {values.data(), values.data() + values.extent(0)});
  id.perm_in = order.data();
  control(7) = 1;  // the ordering is given
}

void MumpsFactor::Instance::take_values(const CrsMatrix& matrix) {
  const auto local = matrix.getLocalMatrixHost().values;
  if (one_process)
    MPI_Gatherv(local.data(), static_cast<int>(local_values), MPI_DOUBLE, values.data(), counts.data(), offsets.data(),
                MPI_DOUBLE, 0, ranks);
  else
    std::copy_n(local.data(), local_values, values.begin());
}

MumpsFactor::MumpsFactor(const CrsMatrix& matrix, bool one_process, const std::vector<GlobalOrdinal>& node_of_row)
    : instance_(std::make_unique<Instance>()) {
  Instance& mumps = *instance_;
  mumps.take_graph(matrix);
  const Comm& comm = *mumps.owned->getComm();
  mumps.ranks = raw_communicator(comm);
  mumps.one_process = one_process && comm.getSize() > 1;
  mumps.here = !mumps.one_process || comm.getRank() == 0;
  if (mumps.one_process) mumps.gather_graph();
  mumps.id.par = 1;
  mumps.id.sym = 0;
  mumps.id.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(mumps.one_process ? MPI_COMM_SELF : mumps.ranks));
  mumps.run(job_start);
  for (const int silent : {1, 2, 3}) mumps.control(silent) = -1;
  mumps.control(4) = 0;
  mumps.control(5) = 0;  // assembled matrix
  const bool central = mumps.one_process || comm.getSize() == 1;
  mumps.control(18) = central ? 0 : 3;  // entries on rank 0, or distributed
  mumps.control(6) = 0;                 // no permutation of columns, as with distributed entries
  mumps.control(28) = 1;                // sequential analysis
  mumps.control(7) = 7;                 // ordering chosen by MUMPS
  if (central && !node_of_row.empty()) mumps.order_by_nodes(node_of_row);
  mumps.control(14) = 30;  // workspace beyond the estimate [%]
  mumps.id.n = static_cast<MUMPS_INT>(mumps.owned->getGlobalNumElements());
  (central ? mumps.id.nnz : mumps.id.nnz_loc) = static_cast<MUMPS_INT8>(mumps.rows.size());
  (central ? mumps.id.irn : mumps.id.irn_loc) = mumps.rows.data();
  (central ? mumps.id.jcn : mumps.id.jcn_loc) = mumps.columns.data();
  (central ? mumps.id.a : mumps.id.a_loc) = mumps.values.data();
  mumps.run(job_analyse);
  analysis_ = mumps.outcome();
}

MumpsFactor::~MumpsFactor() { instance_->run(job_end); }

std::string MumpsFactor::factor(const CrsMatrix& matrix) {
  Instance& mumps = *instance_;
  if (!analysis_.empty()) return analysis_;
  mumps.take_values(matrix);
  if (!all_finite(mumps.values, *mumps.owned->getComm())) return "the matrix holds a value that is not finite";
  mumps.run(job_factor);
  // Pivoting may need more room than the analysis foresaw.
  const auto needs_room = [&] {
    const int code = mumps.code();
    return code == -8 || code == -9 || code == -17 || code == -20;
  };
  while (needs_room() && mumps.control(14) < max_memory_relaxation) {
    mumps.control(14) *= 2;
    mumps.run(job_factor);
  }
  return mumps.outcome();
}

void MumpsFactor::solve(const MultiVector& b, MultiVector& x) const {
  Instance& mumps = *instance_;
  mumps.root_vector->doImport(*b.getVector(0), *mumps.to_root, Tpetra::INSERT);
  {
    const auto values = mumps.root_vector->getLocalViewHost(Tpetra::Access::ReadWrite);
    mumps.id.rhs = values.data();
    mumps.id.nrhs = 1;
    mumps.id.lrhs = mumps.id.n;
    mumps.run(job_solve);
    mumps.id.rhs = nullptr;
  }
  x.getVectorNonConst(0)->doExport(*mumps.root_vector, *mumps.to_root, Tpetra::INSERT);
}

}  // namespace mudline
