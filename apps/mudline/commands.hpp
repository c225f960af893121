#pragma once

#include <mpi.h>

#include <string>
#include <vector>

namespace mudline::cli {

/// Options that several commands share.
struct DeckOptions {
  std::vector<std::string> decks;   // base deck and overlays
  std::vector<std::string> settings;  // --set path=value
};

struct RunCommand {
  DeckOptions deck;
  bool restart = false;
  int steps = 0;
};

// Each returns the program's exit code; all collective over MPI_COMM_WORLD.
int run(const RunCommand& command);
int check(const DeckOptions& deck);
int list(const std::string& kind, bool markdown, bool xsd, const std::string& plugin);
int explain(const std::string& name, const std::string& plugin);
int print_template(const std::string& name);
int report(const std::vector<std::string>& arguments);
int version();

}  // namespace mudline::cli
