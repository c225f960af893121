#include <Tpetra_Core.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "checks/deck_checks.hpp"
#include "checks/ground_profile.hpp"
#include "checks/penetration_watch.hpp"
#include "checks/plausibility.hpp"
#include "checks/stretch_watch.hpp"
#include "commands.hpp"
#include "core/deck.hpp"
#include "core/errors.hpp"
#include "core/foreign_library.hpp"
#include "core/log.hpp"
#include "core/text.hpp"
#include "core/told.hpp"
#include "discretisation/agree.hpp"
#include "discretisation/mesh_topology.hpp"
#include "integrator/overlap.hpp"
#include "materials/skeleton/umat_utilities.hpp"
#include "simulation/branch.hpp"
#include "simulation/checkpoint.hpp"
#include "simulation/old_results.hpp"
#include "simulation/plugin.hpp"
#include "simulation/result_start.hpp"
#include "simulation/run.hpp"
#include "simulation/run_start.hpp"
#include "simulation/trial_step.hpp"

namespace mudline::cli {

namespace {

/// A deck with everything that reading it needs; lives as long as the model.
struct Loaded {
  Deck deck;
  Registries registries;
  std::unique_ptr<Section> root;
  std::unique_ptr<Model> model;
  OutputSettings output;
  RunStart start;
  NodalView reference_pressure;  // of a result that the initial state is taken from
  std::unique_ptr<Plausibility> plausibility;
  bool has_state = true;  // false: it goes on, and the result of its initial state is gone
  Observers observers;
};

/// A branch and the deck that it is one of.
struct BranchOf {
  const Branch& branch;
  const Loaded& main;
};

/// Bodies of a deck whose result is gone stand where they stood in the run that it goes on, or is a branch of.
void keep_places(const BranchOf* of, const std::string& stem, const Section& root) {
  if (of) return ResultStart::keep_places(*of->main.root, root);
  const std::string checkpoint = stem + ".restart";
  if (!std::filesystem::exists(checkpoint)) return;
  Deck before;
  before.overlay(Checkpoint::origin_of(checkpoint, Tpetra::getDefaultComm()).deck, checkpoint);
  before.take_section("variables");  // its formulas are worked out
  ResultStart::keep_places(before.root(), root);
}

/// `of`: what the deck is a branch of; null: it is none.
std::unique_ptr<Loaded> load(const Deck& deck, const std::string& name, const std::string& mesh_parts,
                             const BranchOf* of = nullptr, bool restart = false) {
  const RCP<const Comm> comm = Tpetra::getDefaultComm();
  auto loaded = std::make_unique<Loaded>();
  loaded->deck = deck;
  register_all(loaded->registries);
  loaded->root = std::make_unique<Section>(loaded->deck.root());
  if (of) of->branch.check(of->main.deck, loaded->deck);
  if (loaded->root->has_section("tests"))
    loaded->root->fail("tests of material points are no part of a run; `mudline point` runs them", "tests");
  loaded->root->allow_parameters({});
  std::vector<std::string> known = deck_sections();
  known.push_back("tests");
  loaded->root->allow_sections(known);
  load_plugins(loaded->root->section("plugins"), loaded->registries);
  // the mesh decides whether places have two or three numbers, so errors of its section come first
  Geometry geometry{};
  agree(*comm, [&] { geometry = mesh_recipe(*loaded->root, loaded->registries).geometry(); });
  loaded->output =
      OutputSettings::read(loaded->root->section("output"), name, loaded->root->section("bodies").section_names());
  if (of) loaded->output.name = of->branch.result_name(of->main.output.name);
  ResultStart from_result(*loaded->root);
  const bool goes_on = of || (restart && has_results(*comm, loaded->output.stem()));
  if (from_result.given()) loaded->has_state = from_result.exists() || !goes_on;
  const bool takes_result = from_result.given() && loaded->has_state;
  if (takes_result) from_result.read(comm, geometry, *loaded->root);
  if (from_result.given() && !takes_result) keep_places(of, loaded->output.stem(), *loaded->root);
  loaded->model = std::make_unique<Model>(comm, *loaded->root, loaded->registries, MeshOrigin{mesh_parts});
  check_deck(*loaded->model, *loaded->root);
  if (takes_result) loaded->reference_pressure = from_result.apply(*loaded->model, loaded->deck);
  agree(*comm, [&] {
    loaded->start = of ? RunStart::at(of->main.output.stem(), of->branch.from())
                       : RunStart::read(loaded->root->section("start"), loaded->output.stem());
  });
  loaded->plausibility = std::make_unique<Plausibility>(*loaded->model, *loaded->root);
  loaded->observers = read_observers(loaded->root->section("output"), loaded->registries.observers, *loaded->model);
  const std::vector<std::string> unused = loaded->root->unused();
  if (!unused.empty()) loaded->root->fail("unknown parameter", unused.front());
  refuse_unused_functions(loaded->deck, *loaded->root);
  check_output(*loaded->model, loaded->output, *loaded->root);
  check_foreign_code();
  return loaded;
}

void describe(const Model& model) {
  const auto& dofs = *model.space().dofs();
  std::string text = std::to_string(model.mesh().num_global_elements()) + " elements, " +
                     std::to_string(model.mesh().num_global_nodes()) + " nodes, " +
                     std::to_string(dofs.owned()->getGlobalNumElements()) + " unknowns (";
  for (int f = 0; f < dofs.num_fields(); ++f) text += (f ? ", " : "") + dofs.field(f).name;
  log::info(text + ") on " + std::to_string(dofs.comm()->getSize()) +
            (dofs.comm()->getSize() == 1 ? " rank" : " ranks"));
}

ExitCode run_one(Loaded& loaded, const RunCommand& command) {
  const Comm& comm = *loaded.model->mesh().comm();
  if (!command.restart) agree(comm, [&] { loaded.start.find(loaded.root->section("start")); });
  // the folder is made before the run, so that a wrong one is an error of the deck
  agree(comm, [&] { loaded.output.make_folder(loaded.root->section("output")); });
  RunOptions options;
  options.restart = command.restart;
  options.accept_changes = command.accept_changes;
  options.overwrite = command.overwrite;
  options.start = loaded.start.checkpoint();
  options.reference_pressure = loaded.reference_pressure;
  options.maximum_steps = command.steps;
  const Origin origin{loaded.deck.to_xml(),
                      std::filesystem::weakly_canonical(std::filesystem::absolute(command.deck.decks.front())).string(),
                      std::string("mudline ") + MUDLINE_VERSION};
  const auto on_mesh = [&loaded, comm = loaded.model->mesh().comm()](std::shared_ptr<const RemeshedMesh> mesh) {
    return std::make_unique<Model>(comm, *loaded.root, loaded.registries, MeshOrigin{"", std::move(mesh)});
  };
  Observers watchers;
  watchers.push_back(std::make_unique<PenetrationWatch>(loaded.plausibility->usual()));
  watchers.push_back(std::make_unique<StretchWatch>(loaded.plausibility->usual()));
  for (auto& observer : loaded.observers) watchers.push_back(std::move(observer));
  Run run(std::move(loaded.model), on_mesh, loaded.output, origin, options, std::move(watchers));
  const ExitCode code = run.execute();
  warn_of_reported_errors();
  return code;
}

/// The deck's own run and its branches. All of them are read and checked before the first one begins.
class Family {
 public:
  Family(Deck deck, const std::string& name, std::string mesh_parts, bool restart = false)
      : mesh_parts_(std::move(mesh_parts)) {
    branches_ = Branch::take(deck);
    main_ = load(deck, name, mesh_parts_, nullptr, restart);
    for (const Branch& branch : branches_) load_branch(branch);
  }

  Loaded& main() const { return *main_; }
  const std::vector<Branch>& branches() const { return branches_; }
  std::unique_ptr<Loaded> load_branch(const Branch& branch) const {
    Deck deck;  // a copy: the formulas of a deck that is read are replaced
    deck.overlay(branch.deck());
    deck.take_section("start");  // that of the deck's own run
    const BranchOf of{branch, *main_};
    return load(deck, main_->output.name, mesh_parts_, &of);
  }

 private:
  std::string mesh_parts_;
  std::vector<Branch> branches_;
  std::unique_ptr<Loaded> main_;
};

/// Tells what a deck describes: mesh, unknowns, physics, stages, and what the run stands on.
void tell(const Family& family) {
  const Loaded& loaded = family.main();
  describe(*loaded.model);
  loaded.plausibility->print();
  std::string stages;
  for (const auto& stage : loaded.model->stages()) stages += (stages.empty() ? "" : ", ") + stage->name;
  log::info("stages: " + stages);
  for (const Branch& branch : family.branches())
    log::info("branch '" + branch.name() + "' goes on from the end of stage '" + branch.from() + "'");
  if (const std::string& from = loaded.start.checkpoint(); !from.empty())
    log::info("it starts from " + from + (std::filesystem::exists(from) ? "" : ", which is not there yet"));
}

/// `mudline run --dry-run`: what the deck's own run takes, branches aside.
int dry_run(const Family& family) {
  // Newton iterations of a step, by which the time is estimated: few where steps are easy, many with contact and yield
  constexpr double fewest = 2, most = 6;
  tell(family);
  Loaded& loaded = family.main();
  const Model& model = *loaded.model;
  const double steps = expected_steps(model);
  const std::string stem = loaded.output.stem();
  log::info("results: " + stem + ".{vtkhdf,csv}" +
            (has_results(*model.mesh().comm(), stem) ? "; there are results of this name already" : ""));
  const TrialStep trial = try_first_step(*loaded.model);
  log::info(
      "memory: " + readable(trial.memory, "B", 3) + " after a step" +
      (model.mesh().comm()->getSize() > 1 ? ", at most " + readable(trial.largest_memory, "B", 3) + " on a rank" : ""));
  log::info("steps: about " + told(steps, "%.0f") +
            " in all stages, if none is cut and no contact asks for shorter ones");
  if (trial.iterations == 0) {
    log::info("time: not known" + (trial.failure.empty() ? "" : ", for no step can be begun: " + trial.failure));
    return 0;
  }
  const double iteration = trial.seconds / trial.iterations;
  log::info("first step of stage '" + trial.stage + "': " + std::to_string(trial.iterations) + " iterations, " +
            readable(trial.seconds, "s", 3) +
            (trial.failure.empty() ? "" : "; it did not converge from the state at the start: " + trial.failure));
  log::info("time: about " + readable(fewest * iteration * steps, "s", 3) + " at " + told(fewest, "%.0f") +
            " iterations a step, " + readable(most * iteration * steps, "s", 3) + " at " + told(most, "%.0f") +
            ", and what remeshing and output take");
  return 0;
}

}  // namespace

void warn_of_reported_errors() {
  const int errors = sum_over_ranks(*Tpetra::getDefaultComm(), take_reported_errors());
  if (errors > 0) log::warn("UMATs reported errors by STDB_ABQERR: " + std::to_string(errors));
}

int run(const RunCommand& command) {
  Family family(read_deck(command.deck), result_name(command.deck), command.mesh_parts, command.restart);
  if (command.dry_run) return dry_run(family);
  catch_signals();
  describe(*family.main().model);
  if (family.main().has_state) family.main().plausibility->print();
  const std::vector<std::string> told = family.main().plausibility->doubts();
  ExitCode code = run_one(family.main(), command);
  if (code != ExitCode::done) return static_cast<int>(code);
  for (const Branch& branch : family.branches()) {
    const auto loaded = family.load_branch(branch);
    if (command.steps > 0 && !std::filesystem::exists(loaded->start.checkpoint())) {
      log::info("branch '" + branch.name() + "' waits for the end of stage '" + branch.from() + "'");
      continue;
    }
    log::info("branch '" + branch.name() + "', from the end of stage '" + branch.from() + "'");
    for (const std::string& doubt : loaded->plausibility->doubts())
      if (loaded->has_state && std::find(told.begin(), told.end(), doubt) == told.end()) log::warn(doubt);
    const ExitCode end = run_one(*loaded, command);
    if (code == ExitCode::done) code = end;
    if (end == ExitCode::stopped) break;
  }
  return static_cast<int>(code);
}

namespace {

/// Reads and checks a deck. Null for one with tests at material points, which are checked. InputError.
std::unique_ptr<Family> checked(const DeckOptions& options, const std::string& mesh_parts) {
  const Deck deck = read_deck(options);
  if (!is_point_deck(deck)) return std::make_unique<Family>(deck, result_name(options), mesh_parts);
  check_point(deck, result_name(options));
  return nullptr;
}

int check_one(const DeckOptions& options, const std::string& mesh_parts) {
  const auto family = checked(options, mesh_parts);
  if (!family) return 0;
  tell(*family);
  log::info("the deck is valid");
  return 0;
}

/// Prints one line per deck, with its error if it has one. Returns 2 when any has. Doubts are warnings that begin with
/// the deck's name.
int check_each(const DeckOptions& options) {
  int code = 0;
  log::configure(rank(), log::Level::quiet);
  for (const std::string& path : options.decks) {
    std::string answer = path + ": the deck is valid";
    try {
      if (const auto family = checked({{path}, options.settings}, ""))
        for (const std::string& doubt : family->main().plausibility->doubts()) log::warn(path + ": " + doubt);
    } catch (const InputError& error) {
      answer = std::string("error: ") + error.what();
      code = 2;
    }
    if (rank() == 0) std::cout << printable(answer) << std::endl;
  }
  return code;
}

}  // namespace

int profile(const PointCommand& command) {
  const auto family = checked(command.deck, "");
  if (!family) throw InputError("a profile is that of a run's ground: the deck needs a mesh and stages, not tests");
  Loaded& loaded = family->main();
  const Model& model = *loaded.model;
  Point at = GroundProfile::middle(model);
  const std::size_t dimension = model.mesh().dimension();
  if (!command.at.empty() && command.at.size() != dimension)
    throw InputError("--at: expected " + std::to_string(dimension) + " numbers, given " +
                     std::to_string(command.at.size()));
  std::copy(command.at.begin(), command.at.end(), at.begin());
  const GroundProfile ground(model, at);
  loaded.output.make_folder(loaded.root->section("output"));
  const std::string path = loaded.output.stem() + "_ground.csv";
  ground.write(path);
  std::cout << "the ground at the start, along the vertical line through " << place_text(at, model.mesh().dimension())
            << "\n"
            << ground.table(24) << std::flush;
  log::info("all columns: " + path);
  if (!command.png.empty()) draw("--ground", command.png, {path});
  return 0;
}

int check(const CheckCommand& command) {
  return command.each ? check_each(command.deck) : check_one(command.deck, command.mesh_parts);
}

}  // namespace mudline::cli
