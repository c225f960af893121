#pragma once

#include <Teuchos_Comm.hpp>
#include <Teuchos_RCP.hpp>

#include <string>

namespace mudline {

/// The origin of a run's results, which is stored with them.
struct Origin {
  std::string deck;       // as run, XML
  std::string deck_file;  // the first deck's, absolute
  std::string program;    // "mudline 0.12.0"
};

/// Whether there are results under `stem`, or a part of them. Collective.
bool has_results(const Teuchos::Comm<int>& comm, const std::string& stem);

/// Makes room for the results of a new run under `stem`. Results of an earlier run of the same deck (the same file, or
/// the same content) are removed, and a line says so. InputError when they are those of another or an unknown deck,
/// unless `overwrite`. Collective.
void make_room(const Teuchos::RCP<const Teuchos::Comm<int>>& comm, const std::string& stem, const Origin& origin,
               bool overwrite);

}  // namespace mudline
