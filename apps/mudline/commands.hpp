#pragma once

#include <string>
#include <vector>

#include "core/deck.hpp"
#include "core/registry.hpp"

namespace mudline::cli {

/// Options that several commands share.
struct DeckOptions {
  std::vector<std::string> decks;     // base deck and overlays
  std::vector<std::string> settings;  // --set path=value
};

struct RunCommand {
  DeckOptions deck;
  std::string mesh_parts;  // file of `split`; "": the mesh is made
  bool restart = false;
  bool accept_changes = false;
  bool overwrite = false;
  bool dry_run = false;  // tell what the run would take, and write nothing
  int steps = 0;
};

struct CheckCommand {
  DeckOptions deck;
  std::string mesh_parts;
  bool each = false;  // every file is a deck of its own, not an overlay of the first
};

struct SplitCommand {
  DeckOptions deck;
  int ranks = 0;
  std::string output;  // "": named after the deck
};

struct MeshCommand {
  std::string result;  // results and a stage, 'results/pile@set-up'
  std::string output;
};

struct PointCommand {
  DeckOptions deck;
  bool conformance = false;  // check the laws instead of running the tests
  bool profile = false;      // the ground at the start of the run over the depth, instead of tests
  std::vector<double> at;    // [m] a place on the profile's line; empty: the middle of the mesh
  std::string png;           // picture of all tests, or of the profile; "" for none
};

/// Warns, at the end of a command, of the errors that UMATs have reported (STDB_ABQERR); any rank may have some.
void warn_of_reported_errors();

/// Rank in MPI_COMM_WORLD; 0 where the command runs without MPI.
int rank();
/// Reads the files on rank 0; every rank gets the text and the settings. A deck that is 'based on' one of the program's
/// own is laid over that.
Deck read_deck(const DeckOptions& options);
/// Names of the program's own decks, on which others may be based, and the file of one.
std::vector<std::string> base_decks();
std::string base_deck_file(const std::string& name);
/// Default name of the results, taken from the first deck's file.
std::string result_name(const DeckOptions& options);
/// Throws InputError for a function that no entry of the deck names, nor one that an overlay or a setting replaces.
void refuse_unused_functions(const Deck& deck, const Section& root);
/// Whether a deck is for `mudline point` alone: it has tests but nothing to mesh.
bool is_point_deck(const Deck& deck);
/// The documentation of all types and sections, with the types of a plugin ("": none).
std::vector<EntryDoc> documentation(const std::string& plugin);
/// A file or folder of the program's own: in the source tree, or in share/ of an installation. RunError where it is
/// not there.
std::string shared_file(const std::string& name);
/// The command line of a Python script of mudline: "report", "sweep", "new" or "import".
std::vector<std::string> script_command(const std::string& name, const std::vector<std::string>& arguments);
/// The words as exec takes them, with a null at the end; they point into `command`.
std::vector<char*> argv_of(std::vector<std::string>& command);

// Each returns the program's exit code; all collective over MPI_COMM_WORLD.
int run(const RunCommand& command);
int check(const CheckCommand& command);
int split(const SplitCommand& command);
int mesh(const MeshCommand& command);
int point(const PointCommand& command);
/// `mudline point --profile`.
int profile(const PointCommand& command);
/// Draws a picture with the report's script and waits for it. `kind`: its option, "--point" or "--ground". RunError.
void draw(const std::string& kind, const std::string& png, const std::vector<std::string>& files);
int check_point(const Deck& deck, const std::string& name);
int list(const std::string& kind, bool markdown, const std::string& schema, const std::string& plugin);
int explain(const std::string& name, const std::string& plugin);
int print_template(const std::string& name);
/// Replaces the process by the script, which has its own options; does not return.
int become_script(const std::string& name, const std::vector<std::string>& arguments);
int version();

}  // namespace mudline::cli
