#pragma once

// Names that differ between Trilinos 13.2 (getNode...) and 14+ (getLocal...); the only version switch in the code.
#include <Trilinos_version.h>

#include <vector>

#include "algebra/types.hpp"

namespace mudline {

#if TRILINOS_MAJOR_MINOR_VERSION < 140000

inline std::size_t local_size(const Map& map) { return map.getNodeNumElements(); }
inline Teuchos::ArrayView<const GlobalOrdinal> local_ids(const Map& map) { return map.getNodeElementList(); }
inline std::size_t local_rows(const CrsMatrix& matrix) { return matrix.getNodeNumRows(); }
inline std::size_t local_entries(const CrsMatrix& matrix) { return matrix.getNodeNumEntries(); }

#else

inline std::size_t local_size(const Map& map) { return map.getLocalNumElements(); }
inline Teuchos::ArrayView<const GlobalOrdinal> local_ids(const Map& map) { return map.getLocalElementList(); }
inline std::size_t local_rows(const CrsMatrix& matrix) { return matrix.getLocalNumRows(); }
inline std::size_t local_entries(const CrsMatrix& matrix) { return matrix.getLocalNumEntries(); }

#endif

/// Makes a map of the given global ids, in this order. Collective.
inline RCP<const Map> make_map(const std::vector<GlobalOrdinal>& ids, const RCP<const Comm>& comm) {
  const auto unknown_size = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return rcp(new Map(unknown_size, Teuchos::ArrayView<const GlobalOrdinal>(ids.data(), ids.size()), 0, comm));
}

/// Makes a map of `count` ids on this rank, dense from 0 over the ranks. Collective.
inline RCP<const Map> make_dense_map(std::size_t count, const RCP<const Comm>& comm) {
  return rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), count, 0, comm));
}

/// Amesos2/KLU2 returns wrong solutions, without an error, on several ranks in 13.2 (the next version known to be right
/// is 16.1); MueLu takes it as its coarse solver unless told otherwise.
constexpr bool parallel_klu2_is_wrong = TRILINOS_MAJOR_MINOR_VERSION < 160000;

}  // namespace mudline
