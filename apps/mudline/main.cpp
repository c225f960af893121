#include <dlfcn.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <CLI/CLI.hpp>
#include <Tpetra_Core.hpp>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <thread>

#include "commands.hpp"
#include "core/errors.hpp"
#include "core/foreign_library.hpp"
#include "core/guarded.hpp"
#include "core/log.hpp"
#include "core/run_error.hpp"

namespace {

using namespace mudline;

/// Parallelism is by ranks. A threaded OpenBLAS would take all cores for the small dense blocks of a sparse
/// factorisation and spin on them: slower alone, and much slower beside anything else. Whoever wants its threads says
/// so in the environment.
void keep_blas_serial() {
  if (std::getenv("OPENBLAS_NUM_THREADS") != nullptr || std::getenv("OMP_NUM_THREADS") != nullptr) return;
  if (void* set = dlsym(RTLD_DEFAULT, "openblas_set_num_threads")) reinterpret_cast<void (*)(int)>(set)(1);
}

/// A factorisation takes large blocks of memory and gives them back, many times a second. Kept in the process they need
/// not be cleared by the system each time, which cost 6 % of a run. Whoever tunes malloc does so in the environment.
void keep_freed_memory() {
#ifdef __GLIBC__
  if (std::getenv("MALLOC_TRIM_THRESHOLD_") != nullptr || std::getenv("MALLOC_MMAP_THRESHOLD_") != nullptr) return;
  mallopt(M_MMAP_THRESHOLD, 256 << 20);  // [bytes] larger ones go back to the system at once
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

void add_deck_options(CLI::App& command, cli::DeckOptions& deck) {
  command.add_option("deck", deck.decks, "deck, then overlays that replace single parameters of it")->required();
  command.add_option("--set", deck.settings, "replace one parameter: --set \"stages/push/duration=2.0\"")
      ->allow_extra_args(false);
}

void add_mesh_parts_option(CLI::App& command, std::string& file) {
  command.add_option("--mesh-parts", file, "take the mesh from this file of `mudline split`, each rank its own part");
}

/// Commands that read no deck do without MPI, whose start takes most of a second, unless a launcher started several of
/// them.
bool needs_mpi(const std::vector<std::string>& words) {
  for (const char* launched : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(launched) != nullptr) return true;
  const auto given = [&](const char* word) { return std::find(words.begin(), words.end(), word) != words.end(); };
  if (given("--help") || given("-h")) return false;
  return given("run") || given("check") || given("point") || given("split");
}

/// Input errors are those of all ranks alike. Foreign code may throw one where the others do not: then they do not come
/// here within the time, and wait for this rank somewhere else.
bool all_ranks_come() {
  MPI_Request barrier;
  MPI_Ibarrier(MPI_COMM_WORLD, &barrier);
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  for (int come = 0; std::chrono::steady_clock::now() < until;) {
    MPI_Test(&barrier, &come, MPI_STATUS_IGNORE);
    if (come != 0) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

/// A misspelt command gets a suggestion; the library would only say that a command is missing.
void require_command(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.empty() || word[0] == '-') continue;
    if (std::find(names.begin(), names.end(), word) == names.end())
      throw InputError("unknown command '" + word + "'" + suggestion(word, names));
    return;
  }
}

int dispatch(int argc, char** argv, bool root) {
  CLI::App app{"mudline: large-deformation dynamics of saturated porous media"};
  app.require_subcommand(1);
  app.set_help_all_flag("--help-all", "help of all commands");
  app.footer(
      "examples:\n"
      "  mudline run inputs/penetration/cone_indentation.xml\n"
      "  mpirun -np 4 mudline run base.xml fine.xml --set \"stages/push/duration=0.02\"\n"
      "  mudline explain \"modified cam clay\"");
  bool verbose = false, quiet = false;
  app.add_flag("-v,--verbose", verbose, "print more: every Newton iteration");
  app.add_flag("-q,--quiet", quiet, "print warnings and errors only");
  app.fallthrough();

  cli::RunCommand run;
  auto* run_command = app.add_subcommand("run", "run a deck");
  add_deck_options(*run_command, run.deck);
  add_mesh_parts_option(*run_command, run.mesh_parts);
  auto* restart = run_command->add_flag("--restart", run.restart,
                                        "continue from the checkpoint that an earlier run of this deck left");
  run_command
      ->add_flag("--accept-changes", run.accept_changes,
                 "go on although the model differs from that of the checkpoint, or results of before it are missing")
      ->needs(restart);
  run_command->add_flag("--overwrite", run.overwrite, "replace results of another deck that has the same result name")
      ->excludes(restart);
  run_command->add_option("--steps", run.steps, "stop after so many steps, with a checkpoint")
      ->check(CLI::Range(1, 1000000000));
  run_command->footer(
      "exit codes: 0 done, 2 input error, 3 no convergence (last state saved), 4 stopped by a signal (saved), 1 "
      "anything else\n"
      "example: mudline run deck.xml --set \"solver/residual tolerance=1e-8\"");

  cli::PointCommand point;
  auto* point_command =
      app.add_subcommand("point", "run the material-point tests of a deck: oedometer, triaxial, simple shear, ...");
  add_deck_options(*point_command, point.deck);
  point_command->add_flag("--conformance", point.conformance,
                          "instead check that the deck's skeleton laws keep to the rules for laws");
  point_command->add_option("--png", point.png,
                            "draw all tests into this PNG file: q-p', q and u over axial strain, e over log p'");
  point_command->footer("example: mudline point inputs/point/mcc_triaxial.xml --png triaxial.png");

  cli::CheckCommand check;
  auto* check_command = app.add_subcommand("check", "read a deck and its mesh and report errors, without running");
  add_deck_options(*check_command, check.deck);
  add_mesh_parts_option(*check_command, check.mesh_parts);
  check_command
      ->add_flag("--each", check.each,
                 "every file is a deck of its own, and no overlay: one line each on standard output")
      ->excludes("--mesh-parts");
  check_command->footer("example: mudline check deck.xml");

  cli::SplitCommand split;
  auto* split_command =
      app.add_subcommand("split", "make a deck's mesh and cut it into a file of parts, one for each rank of a run");
  add_deck_options(*split_command, split.deck);
  split_command->add_option("--ranks", split.ranks, "parts to cut it into")->required()->check(CLI::Range(1, 1000000));
  split_command->add_option("-o,--output", split.output, "the file; by default the deck's name with .RANKS.parts.h5");
  split_command->footer(
      "example: mudline split deck.xml --ranks 256\n"
      "         mpirun -np 256 mudline run deck.xml --mesh-parts deck.256.parts.h5");

  std::string kind, plugin;
  bool markdown = false, xsd = false;
  auto* list_command = app.add_subcommand("list", "list what a deck's \"type\" may name");
  list_command->add_option("kind", kind, "only this kind: material, physics, boundary condition, ...");
  list_command->add_flag("--markdown", markdown, "the whole parameter reference as markdown");
  list_command->add_flag("--xsd", xsd, "an XML schema for editors");
  list_command->add_option("--plugin", plugin, "load this plugin first");
  list_command->footer("example: mudline list \"boundary condition\"");

  std::string name;
  auto* explain_command = app.add_subcommand("explain", "parameters of a type or a section");
  explain_command->add_option("name", name, "e.g. \"modified cam clay\"")->required();
  explain_command->add_option("--plugin", plugin, "load this plugin first");
  explain_command->footer("example: mudline explain \"generalised alpha\"");

  std::string template_name;
  auto* template_command =
      app.add_subcommand("template", "print a commented deck of a physics, or the section of any type");
  template_command->add_option("name", template_name, "e.g. biot")->required();
  template_command->footer("example: mudline template biot > my_deck.xml");

  auto* report_command = app.add_subcommand("report", "one HTML page of a result: histories, field pictures, balances");
  report_command->allow_extras();
  report_command->footer("example: mudline report results/cone_indentation -o cone.html");

  auto* sweep_command =
      app.add_subcommand("sweep", "run a deck for several values of something, gather and plot the results");
  sweep_command->allow_extras();
  sweep_command->footer("example: mudline sweep inputs/cpt/backbone.xml --jobs 2");

  auto* version_command = app.add_subcommand("version", "version, compiler and libraries");

  // These commands' options belong to their scripts, which have a help of their own.
  for (const char* script : {"report", "sweep"})
    if (argc > 1 && std::string(argv[1]) == script)
      return cli::become_script(script, std::vector<std::string>(argv + 2, argv + argc));
  try {
    require_command(app, argc, argv);
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (!root) return error.get_exit_code() == 0 ? 0 : 2;
    if (error.get_exit_code() == 0) return app.exit(error);
    std::cerr << "error: " << last_line(error.what()) << " (see mudline --help)" << std::endl;
    return 2;
  }
  log::configure(cli::rank(), quiet ? log::Level::quiet : verbose ? log::Level::debug : log::Level::normal);
  if (*run_command) return cli::run(run);
  if (*split_command) return cli::split(split);
  if (*point_command) return cli::point(point);
  if (*check_command) return cli::check(check);
  if (*list_command) return cli::list(kind, markdown, xsd, plugin);
  if (*explain_command) return cli::explain(name, plugin);
  if (*template_command) return cli::print_template(template_name);
  if (*version_command) return cli::version();
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  keep_blas_serial();
  keep_freed_memory();
  setenv("HWLOC_HIDE_ERRORS", "2", 0);  // in a container without /sys MPI's hwloc prints a line of its own in every run
  std::unique_ptr<Tpetra::ScopeGuard> scope;
  int ranks = 1;
  if (needs_mpi({argv + 1, argv + argc})) {
    int own_count = 1;  // the command line is ours: Kokkos would answer --help with its own options
    scope = std::make_unique<Tpetra::ScopeGuard>(&own_count, &argv);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  }
  const int rank = cli::rank();
  const mudline::ExitGuard guard(rank, ranks);
  try {
    return dispatch(argc, argv, rank == 0);
  } catch (const mudline::InputError& error) {
    if (ranks > 1 && !all_ranks_come()) mudline::end_with_error(error.what(), 2);
    if (rank == 0) std::cerr << "error: " << error.what() << std::endl;
    return 2;
  } catch (const mudline::RunError& error) {
    if (rank == 0) std::cerr << "error: " << error.what() << std::endl;
    return 1;
  } catch (...) {
    const std::string what = mudline::what_was_thrown();
    if (ranks > 1) mudline::end_with_error(what, 1);  // not foreseen, and maybe on this rank only
    std::cerr << "error: " << what << std::endl;
    return 1;
  }
}
