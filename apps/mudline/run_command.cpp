#include <Tpetra_Core.hpp>

#include <algorithm>

#include "commands.hpp"
#include "core/deck.hpp"
#include "core/log.hpp"
#include "core/text.hpp"
#include "discretisation/agree.hpp"
#include "simulation/plugin.hpp"
#include "simulation/run.hpp"

namespace mudline::cli {

namespace {

/// A deck with everything that reading it needs; lives as long as the model.
struct Loaded {
  Deck deck;
  Registries registries;
  std::unique_ptr<Section> root;
  std::unique_ptr<Model> model;
  OutputSettings output;
};

/// The nearest node of a probe far away would tell nothing of where the author looks. A point of a body may come into the
/// soil later.
void check_probes(const Loaded& loaded) {
  const auto box = loaded.model->mesh().bounds();
  const double slack = 1e-6 * std::max(box[1] - box[0], box[3] - box[2]);
  for (const ProbeSettings& probe : loaded.output.probes) {
    const auto& at = probe.point;
    for (int i = 0; probe.moves_with.empty() && i < 2; ++i)
      if (at[i] < box[2 * i] - slack || at[i] > box[2 * i + 1] + slack)
        loaded.root->section("output").section("probes").fail(
            std::string(i == 0 ? "x" : "y") + " = " + number_text(at[i]) + " lies outside the mesh, which reaches from " +
                number_text(box[2 * i]) + " to " + number_text(box[2 * i + 1]), probe.name);
  }
}

std::unique_ptr<Loaded> load(const Deck& deck, const std::string& name) {
  const RCP<const Comm> comm = Tpetra::getDefaultComm();
  auto loaded = std::make_unique<Loaded>();
  loaded->deck = deck;
  register_all(loaded->registries);
  loaded->root = std::make_unique<Section>(loaded->deck.root());
  if (loaded->root->has_section("tests"))
    loaded->root->fail("tests of material points are no part of a run; `mudline point` runs them", "tests");
  loaded->root->allow_parameters({});
  loaded->root->allow_sections(deck_sections());
  load_plugins(loaded->root->section("plugins"), loaded->registries);
  loaded->output = OutputSettings::read(loaded->root->section("output"), name, loaded->root->section("bodies").section_names());
  loaded->model = std::make_unique<Model>(comm, *loaded->root, loaded->registries);
  const std::vector<std::string> unused = loaded->root->unused();
  if (!unused.empty()) loaded->root->fail("unknown parameter", unused.front());
  check_probes(*loaded);
  return loaded;
}

void describe(const Model& model) {
  const auto& dofs = *model.space().dofs();
  std::string text = std::to_string(model.mesh().num_global_elements()) + " elements, " + std::to_string(model.mesh().num_global_nodes()) +
                     " nodes, " + std::to_string(dofs.owned()->getGlobalNumElements()) + " unknowns (";
  for (int f = 0; f < dofs.num_fields(); ++f) text += (f ? ", " : "") + dofs.field(f).name;
  log::info(text + ") on " + std::to_string(dofs.comm()->getSize()) + (dofs.comm()->getSize() == 1 ? " rank" : " ranks"));
}

}  // namespace

int run(const RunCommand& command) {
  const auto loaded = load(read_deck(command.deck), result_name(command.deck));
  describe(*loaded->model);
  // before the run, so that a wrong place is an error of the deck
  agree(*loaded->model->mesh().comm(), [&] { loaded->output.make_folder(loaded->root->section("output")); });
  catch_signals();
  RunOptions options;
  options.restart = command.restart;
  options.maximum_steps = command.steps;
  Run run(*loaded->model, loaded->output, loaded->deck.to_xml(), options);
  return static_cast<int>(run.execute());
}

int check(const DeckOptions& options) {
  const Deck deck = read_deck(options);
  if (is_point_deck(deck)) return check_point(deck, result_name(options));
  const auto loaded = load(deck, result_name(options));
  describe(*loaded->model);
  std::string stages;
  for (const auto& stage : loaded->model->stages()) stages += (stages.empty() ? "" : ", ") + stage->name;
  log::info("stages: " + stages);
  log::info("the deck is valid");
  return 0;
}

}  // namespace mudline::cli
