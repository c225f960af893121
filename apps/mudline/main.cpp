#include <dlfcn.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <CLI/CLI.hpp>
#include <Tpetra_Core.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <thread>

#include "algebra/blas_kernels.hpp"
#include "commands.hpp"
#include "core/errors.hpp"
#include "core/foreign_library.hpp"
#include "core/guarded.hpp"
#include "core/log.hpp"
#include "core/run_error.hpp"
#include "core/text.hpp"
#include "discretisation/geometry_commands.hpp"

namespace {

using namespace mudline;

/// Keeps OpenBLAS to one thread, because ranks do the work in parallel. A threaded OpenBLAS would take all cores for
/// the small dense blocks of a sparse factorisation and spin on them: slower alone, and much slower beside anything
/// else. Whoever wants its threads says so in the environment.
void keep_blas_serial() {
  if (std::getenv("OPENBLAS_NUM_THREADS") != nullptr || std::getenv("OMP_NUM_THREADS") != nullptr) return;
  if (void* set = dlsym(RTLD_DEFAULT, "openblas_set_num_threads")) reinterpret_cast<void (*)(int)>(set)(1);
}

/// A factorisation takes large blocks of memory and gives them back, many times a second. Blocks that stay in the
/// process need not be cleared by the system each time, which took 6 % of a run. Whoever tunes malloc does so in the
/// environment.
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

void add_commands_option(CLI::App& command) {
  command.add_flag_callback(
      "--allow-commands", [] { permit_commands(true); },
      "let geometry files (.geo) start programs and write files: only for files that you trust");
}

void add_mesh_parts_option(CLI::App& command, std::string& file) {
  command.add_option("--mesh-parts", file, "take the mesh from this file of `mudline split`, each rank its own part");
}

/// Whether a launcher such as mpirun started this process.
bool launched() {
  for (const char* rank : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(rank) != nullptr) return true;
  return false;
}

/// A process that nobody launched has no other to talk to. Open MPI would start a daemon for it, load the drivers of
/// all networks (one of which sleeps for 0.2 s) and look for devices, which took half of the CPU time of a start; and
/// it would give the core away in every look for messages. Without the daemon all processes that are alone would share
/// one session folder and take it away from each other, so they make none; they need no shared file pointers, which
/// would lie there. What the environment says of drivers and devices stays.
void start_alone() {
  constexpr const char* settings[][2] = {{"OMPI_MCA_ess_singleton_isolated", "1"},
                                         {"OMPI_MCA_orte_create_session_dirs", "0"},
                                         {"OMPI_MCA_pml", "ob1"},
                                         {"OMPI_MCA_btl", "self"},
                                         {"OMPI_MCA_osc", "sm"},
                                         {"OMPI_MCA_sharedfp", "individual"},
                                         {"HWLOC_COMPONENTS", "-pci,-linuxio,-opencl,-gl,-x86"}};
  for (const auto& [name, value] : settings) setenv(name, value, 0);
  setenv("OMPI_MCA_mpi_yield_when_idle", "0", 1);
}

/// Whether a command needs MPI, whose start takes a part of a second: those that read no deck do without it, unless a
/// launcher started several processes.
bool needs_mpi(const std::vector<std::string>& words) {
  if (launched()) return true;
  const auto among = [](const std::vector<std::string>& those, const std::string& word) {
    return std::find(those.begin(), those.end(), word) != those.end();
  };
  if (among(words, "--help") || among(words, "-h")) return false;
  const auto command =
      std::find_if(words.begin(), words.end(), [](const std::string& word) { return word.rfind('-', 0) != 0; });
  return command != words.end() && among({"run", "check", "point", "split", "mesh"}, *command);
}

/// Whether all ranks come here within some time. Input errors occur on all ranks alike, but foreign code may throw one
/// on a single rank, for which the others then wait elsewhere.
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

/// What to do about a command line that was refused: the option that was probably meant, or where the help is.
std::string advice(const CLI::App& app, int argc, char** argv) {
  for (const CLI::App* command : app.get_subcommands()) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command->get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (int i = 1; i < argc; ++i) {
      const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
      if (word.size() < 2 || word[0] != '-' || std::find(names.begin(), names.end(), word) != names.end()) continue;
      if (word == "-n" || word == "-np" || word == "--ranks")
        return "; ranks are those of the launcher: ./mudline -n 2 " + command->get_name() +
               ", or mpirun -n 2 mudline " + command->get_name();
      if (const std::string near = nearest(word, names); !near.empty()) return " (did you mean '" + near + "'?)";
    }
  }
  return " (see mudline --help)";
}

/// A command of the program: its options, and what it does with them.
struct Command {
  CLI::App* options;
  std::function<int()> act;
};

Command run_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("run", "run a deck");
  const auto run = std::make_shared<cli::RunCommand>();
  add_deck_options(*command, run->deck);
  add_mesh_parts_option(*command, run->mesh_parts);
  add_commands_option(*command);
  CLI::Option* restart = command->add_flag(
      "--restart", run->restart,
      "continue from the checkpoint that an earlier run of this deck left; start where there are no results");
  command
      ->add_flag("--accept-changes", run->accept_changes,
                 "go on although the model differs from that of the checkpoint, or results of before it are missing")
      ->needs(restart);
  command->add_flag("--overwrite", run->overwrite, "replace results of another deck that has the same result name")
      ->excludes(restart);
  command->add_option("--steps", run->steps, "stop after so many steps, with a checkpoint")
      ->check(CLI::Range(1, 1000000000));
  command
      ->add_flag(
          "--dry-run", run->dry_run,
          "check the deck and try its first step; tell mesh, unknowns, memory, steps and time, and write nothing")
      ->excludes("--restart", "--accept-changes", "--overwrite", "--steps");
  command->footer(
      "exit codes: 0 done, 2 input error, 3 no convergence (last state saved), 4 stopped by a signal (saved), 1 "
      "anything else\n"
      "example: mudline run deck.xml --set \"solver/residual tolerance=1e-8\"");
  return {command, [run] { return cli::run(*run); }};
}

Command point_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("point", "run the material-point tests of a deck: oedometer, triaxial, simple shear, ...");
  const auto point = std::make_shared<cli::PointCommand>();
  add_deck_options(*command, point->deck);
  command->add_flag("--conformance", point->conformance,
                    "instead check that the deck's skeleton laws keep to the rules for laws");
  command->add_flag("--profile", point->profile,
                    "instead print the ground of a run's deck at its start over the depth: stresses, K0, OCR, s_u, "
                    "G/s_u, e, and all numbers of the laws into a CSV file");
  command->add_option("--at", point->at, "a place on the profile's vertical line, such as --at 3 0")->expected(2, 3);
  command->add_option("--png", point->png,
                      "draw into this PNG file: of all tests q-p', q and u over axial strain, e over log p'; or the "
                      "profile");
  command->footer("example: mudline point inputs/point/mcc_triaxial.xml --png triaxial.png");
  return {command, [point] { return cli::point(*point); }};
}

Command check_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("check", "read a deck and its mesh and report errors, without running");
  const auto check = std::make_shared<cli::CheckCommand>();
  add_deck_options(*command, check->deck);
  add_mesh_parts_option(*command, check->mesh_parts);
  add_commands_option(*command);
  command
      ->add_flag("--each", check->each,
                 "every file is a deck of its own, and no overlay: one line each on standard output")
      ->excludes("--mesh-parts");
  command->footer("example: mudline check deck.xml");
  return {command, [check] { return cli::check(*check); }};
}

Command split_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("split", "make a deck's mesh and cut it into a file of parts, one for each rank of a run");
  const auto split = std::make_shared<cli::SplitCommand>();
  add_deck_options(*command, split->deck);
  add_commands_option(*command);
  command->add_option("--ranks", split->ranks, "parts to cut it into")->required()->check(CLI::Range(1, 1000000));
  command->add_option("-o,--output", split->output, "the file; by default the deck's name with .RANKS.parts.h5");
  command->footer(
      "example: mudline split deck.xml --ranks 256\n"
      "         mpirun -np 256 mudline run deck.xml --mesh-parts deck.256.parts.h5");
  return {command, [split] { return cli::split(*split); }};
}

Command mesh_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("mesh", "write the mesh in which a run ended a stage, for Gmsh and for other decks");
  const auto mesh = std::make_shared<cli::MeshCommand>();
  command->add_option("result", mesh->result, "results and the stage: results/pile@set-up")->required();
  command->add_option("-o,--output", mesh->output, "the file, of Gmsh's format 2.2")->required();
  command->footer("example: mudline mesh results/pile@set-up -o installed_pile.msh");
  return {command, [mesh] { return cli::mesh(*mesh); }};
}

Command list_command(CLI::App& app) {
  struct Options {
    std::string kind, plugin;
    bool markdown = false, xsd = false, rng = false;
  };
  CLI::App* command = app.add_subcommand("list", "list what a deck's \"type\" may name");
  const auto list = std::make_shared<Options>();
  command->add_option("kind", list->kind, "only this kind: material, physics, boundary condition, ...");
  command->add_flag("--markdown", list->markdown, "the whole parameter reference as markdown");
  CLI::Option* xsd =
      command->add_flag("--xsd", list->xsd, "an XML schema for editors: its names are offered, any is valid");
  command->add_flag("--rng", list->rng, "a RELAX NG schema, by which an editor marks what the program would refuse")
      ->excludes(xsd);
  command->add_option("--plugin", list->plugin, "load this plugin first");
  command->footer("example: mudline list \"boundary condition\"");
  return {command, [list] {
            return cli::list(list->kind, list->markdown, list->xsd ? "xsd" : list->rng ? "rng" : "", list->plugin);
          }};
}

Command explain_command(CLI::App& app) {
  struct Options {
    std::string name, plugin;
  };
  CLI::App* command = app.add_subcommand("explain", "parameters of a type or a section");
  const auto explain = std::make_shared<Options>();
  command->add_option("name", explain->name, "e.g. \"modified cam clay\"")->required();
  command->add_option("--plugin", explain->plugin, "load this plugin first");
  command->footer("example: mudline explain \"generalised alpha\"");
  return {command, [explain] { return cli::explain(explain->name, explain->plugin); }};
}

Command template_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("template",
                         "print a whole deck (of a physics, or what `new` stands on), or the section of "
                         "any type");
  const auto name = std::make_shared<std::string>();
  command->add_option("name", *name, "e.g. biot")->required();
  command->footer("example: mudline template biot > my_deck.xml");
  return {command, [name] { return cli::print_template(*name); }};
}

/// A command that is a script: its options belong to that, which has a help of its own.
Command script_command(CLI::App& app, const std::string& script, const std::string& what, const std::string& example,
                       const std::vector<std::string>& words) {
  CLI::App* command = app.add_subcommand(script, what);
  command->allow_extras();
  command->footer("example: mudline " + script + " " + example);
  return {command, [script, words] { return cli::become_script(script, words); }};
}

std::vector<Command> all_commands(CLI::App& app, const std::vector<std::string>& words_after) {
  return {run_command(app),
          point_command(app),
          check_command(app),
          split_command(app),
          mesh_command(app),
          list_command(app),
          explain_command(app),
          template_command(app),
          script_command(app, "report", "one HTML page of a result: histories, field pictures, balances",
                         "results/cone_indentation -o cone.html", words_after),
          script_command(app, "sweep", "run a deck for several values of something, gather and plot the results",
                         "inputs/cpt/backbone.xml --jobs 2", words_after),
          script_command(app, "new", "write a deck from a few numbers: an anchor, a pile, a cone, ...",
                         "pile --diameter \"0.5 m\" --depth \"6 m\"", words_after),
          script_command(app, "import", "write the mesh of an Abaqus or I-DEAS file as one that decks read",
                         "part.inp -o part.msh", words_after),
          {app.add_subcommand("version", "version, compiler and libraries"), [] { return cli::version(); }}};
}

/// Refuses arguments that are not UTF-8, because results and reports, which contain them, are.
void require_text(int argc, char** argv) {
  for (int i = 1; i < argc; ++i)
    if (const std::string bad = unfit(argv[i], true); !bad.empty())
      throw InputError("argument " + std::to_string(i) + ", '" + beginning(argv[i], 200) + "', holds " + bad);
}

int dispatch(int argc, char** argv, bool root) {
  require_text(argc, argv);
  CLI::App app{"mudline: large-deformation dynamics of saturated porous media", "mudline"};
  app.require_subcommand(1);
  app.set_help_all_flag("--help-all", "help of all commands");
  app.set_version_flag("--version", "mudline " MUDLINE_VERSION, "version; more by the command 'version'");
  app.footer(
      "examples:\n"
      "  mudline run inputs/penetration/cone_indentation.xml\n"
      "  mpirun -np 4 mudline run base.xml fine.xml --set \"stages/push/duration=0.02\"\n"
      "  mudline explain \"modified cam clay\"");
  bool verbose = false, quiet = false;
  app.add_flag("-v,--verbose", verbose, "print more: every Newton iteration");
  app.add_flag("-q,--quiet", quiet, "print warnings and errors only");
  app.fallthrough();
  const std::vector<Command> commands =
      all_commands(app, std::vector<std::string>(argv + std::min(argc, 2), argv + argc));

  if (argc == 1) {
    if (root) std::cout << app.help();
    return 0;
  }
  for (const Command& command : commands)  // a script reads its own arguments, its --help too
    if (command.options->get_allow_extras() && command.options->get_name() == argv[1]) return command.act();
  try {
    require_command(app, argc, argv);
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (!root) return error.get_exit_code() == 0 ? 0 : 2;
    if (error.get_exit_code() == 0) return app.exit(error);
    std::cerr << "error: " << printable(last_line(error.what())) << advice(app, argc, argv) << std::endl;
    return 2;
  }
  log::configure(cli::rank(), quiet ? log::Level::quiet : verbose ? log::Level::debug : log::Level::normal);
  for (const Command& command : commands)
    if (*command.options && !command.options->get_allow_extras()) return command.act();
  return 1;
}

/// The program's exit code after its output was flushed; a failure where a full disk or a closed terminal refused the
/// output.
int after_output(int code) {
  if (std::cout.flush() && std::fflush(stdout) == 0) return code;
  std::cerr << "error: the text for the standard output could not be written; is the disk full?" << std::endl;
  return code == 0 ? 1 : code;
}

}  // namespace

/// Replaces MPI_Abort for all libraries, as MPI's profiling interface allows: an abort with the code 0 would look like
/// a complete run.
extern "C" int MPI_Abort(MPI_Comm comm, int code) {
  if (const char* library = mudline::foreign_caller())
    mudline::end_with_error(
        "the library '" + std::string(library) + "' ended the program (a call of MPI_Abort) while it was being called",
        1);
  return PMPI_Abort(comm, code == 0 ? 1 : code);
}

int main(int argc, char** argv) {
  try {
    use_best_blas_kernels(argv);
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << std::endl;
    return 1;
  }
  keep_blas_serial();
  keep_freed_memory();
  setenv("HWLOC_HIDE_ERRORS", "2", 0);  // in a container without /sys MPI's hwloc prints a line of its own in every run
  std::unique_ptr<Tpetra::ScopeGuard> scope;
  int ranks = 1;
  if (needs_mpi({argv + 1, argv + argc})) {
    if (!launched()) start_alone();
    int own_count = 1;  // the command line is ours: Kokkos would answer --help with its own options
    scope = std::make_unique<Tpetra::ScopeGuard>(&own_count, &argv);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  }
  const int rank = cli::rank();
  const mudline::ExitGuard guard(rank, ranks);
  try {
    return after_output(dispatch(argc, argv, rank == 0));
  } catch (const mudline::InputError& error) {
    if (ranks > 1 && !all_ranks_come()) mudline::end_with_error(printable(error.what()), 2);
    if (rank == 0) std::cerr << "error: " << printable(error.what()) << std::endl;
    return 2;
  } catch (const mudline::RunError& error) {
    if (rank == 0) std::cerr << "error: " << printable(error.what()) << std::endl;
    return 1;
  } catch (...) {
    const std::string what = mudline::what_was_thrown();
    if (ranks > 1) mudline::end_with_error(printable(what), 1);  // this error may be on this rank only
    std::cerr << "error: " << printable(what) << std::endl;
    return 1;
  }
}
