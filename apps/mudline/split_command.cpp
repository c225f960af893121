#include <Tpetra_Core.hpp>

#include <cstdio>

#include "commands.hpp"
#include "core/errors.hpp"
#include "core/log.hpp"
#include "simulation/branch.hpp"
#include "simulation/model.hpp"
#include "simulation/output/mesh_parts_file.hpp"
#include "simulation/plugin.hpp"

namespace mudline::cli {

int split(const SplitCommand& command) {
  if (Tpetra::getDefaultComm()->getSize() > 1)
    throw InputError("split makes the whole mesh on one process: start it without mpirun");
  Deck deck = read_deck(command.deck);
  Branch::take(deck);  // they have the mesh of the deck's own run
  const Section root = deck.root();
  root.allow_sections([] {
    std::vector<std::string> known = deck_sections();
    known.push_back("tests");
    return known;
  }());
  Registries registries;
  register_all(registries);
  load_plugins(root.section("plugins"), registries);
  const std::string path = !command.output.empty()
                               ? command.output
                               : result_name(command.deck) + "." + std::to_string(command.ranks) + ".parts.h5";
  const MeshPartsReport report = write_mesh_parts(mesh_recipe(root, registries), command.ranks, path);
  char shares[100];
  std::snprintf(shares, sizeof shares, "%.2f times the mean of the elements, %.2f times that of the nodes",
                report.element_share, report.node_share);
  log::info(path + ": " + std::to_string(report.elements) + " elements and " + std::to_string(report.nodes) +
            " nodes in " + std::to_string(command.ranks) + (command.ranks == 1 ? " part" : " parts") + "; at most " +
            shares);
  return 0;
}

}  // namespace mudline::cli
