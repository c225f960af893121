#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "core/deck.hpp"

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

struct PointCommand {
  DeckOptions deck;
  bool conformance = false;  // check the laws instead of running the tests
  std::string png;           // picture of all tests; "" for none
};

/// Rank 0 reads the files, every rank gets the text and the settings.
void read_deck(const DeckOptions& options, Deck& deck);
/// A deck for `mudline point` alone: tests, but nothing to mesh.
bool is_point_deck(const Section& root);
/// The command line of the report's Python script.
std::vector<std::string> report_command(const std::vector<std::string>& arguments);

// Each returns the program's exit code; all collective over MPI_COMM_WORLD.
int run(const RunCommand& command);
int check(const DeckOptions& deck);
int point(const PointCommand& command);
int check_point(const DeckOptions& deck);
int list(const std::string& kind, bool markdown, bool xsd, const std::string& plugin);
int explain(const std::string& name, const std::string& plugin);
int print_template(const std::string& name);
int report(const std::vector<std::string>& arguments);
int version();

}  // namespace mudline::cli
