#pragma once

#include <Teuchos_Comm.hpp>
#include <Teuchos_RCP.hpp>

#include <string>

namespace mudline {

/// What a run's results say of where they come from.
struct Origin {
  std::string deck;       // as run, XML
  std::string deck_file;  // the first deck's, absolute
  std::string program;    // "mudline 0.12.0"
};

/// Makes room for the results of a new run under `stem`. Those of an earlier run of the same deck (the same file, or
/// the same content) go, with a line that says so. InputError when they are another deck's, or nobody knows whose,
/// unless `overwrite`. Collective.
void make_room(const Teuchos::RCP<const Teuchos::Comm<int>>& comm, const std::string& stem, const Origin& origin,
               bool overwrite);

}  // namespace mudline
