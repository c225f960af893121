#pragma once

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <vector>

namespace mudline {

// What all ranks know together, from what each of them has: a number, or a list of as many numbers on every rank.
// Collective.

template <class T>
T over_ranks(const Teuchos::Comm<int>& comm, Teuchos::EReductionType how, const T& mine) {
  T all{};
  Teuchos::reduceAll(comm, how, 1, &mine, &all);
  return all;
}
template <class T>
std::vector<T> over_ranks(const Teuchos::Comm<int>& comm, Teuchos::EReductionType how, const std::vector<T>& mine) {
  std::vector<T> all(mine.size());
  if (!mine.empty()) Teuchos::reduceAll(comm, how, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}
template <class Numbers>
Numbers sum_over_ranks(const Teuchos::Comm<int>& comm, const Numbers& mine) {
  return over_ranks(comm, Teuchos::REDUCE_SUM, mine);
}
template <class Numbers>
Numbers min_over_ranks(const Teuchos::Comm<int>& comm, const Numbers& mine) {
  return over_ranks(comm, Teuchos::REDUCE_MIN, mine);
}
template <class Numbers>
Numbers max_over_ranks(const Teuchos::Comm<int>& comm, const Numbers& mine) {
  return over_ranks(comm, Teuchos::REDUCE_MAX, mine);
}
/// The lowest of the ranks that say `here`; the number of ranks where none does.
inline int first_rank(const Teuchos::Comm<int>& comm, bool here) {
  return min_over_ranks(comm, here ? comm.getRank() : comm.getSize());
}
inline bool on_any_rank(const Teuchos::Comm<int>& comm, bool here) { return first_rank(comm, here) < comm.getSize(); }

}  // namespace mudline
