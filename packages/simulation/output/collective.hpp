#pragma once

#include <cstdint>
#include <string>

#include "algebra/raw_communicator.hpp"

namespace mudline {

/// The message of the lowest rank that has one, on every rank; "" when none has. Lets all ranks throw alike.
/// Collective.
std::string agreed_message(MPI_Comm comm, const std::string& message);

/// Throws RunError on every rank where the first one says that a file of the results is lost. Collective.
void end_where_lost(MPI_Comm comm, const std::string& lost);

/// Rank 0's text on every rank. Collective.
std::string broadcast(MPI_Comm comm, const std::string& text);

/// True on every rank when all ranks gave the same text. Collective.
bool same_everywhere(MPI_Comm comm, const std::string& text);

/// FNV-1a hash of 64 bits: the same on every machine, unlike std::hash.
std::uint64_t fingerprint(const void* data, std::size_t bytes, std::uint64_t start = 14695981039346656037ull);
/// That of a name, as the id of a row of a state array.
inline long long id_of(const std::string& name) {
  return static_cast<long long>(fingerprint(name.data(), name.size()));
}

}  // namespace mudline
