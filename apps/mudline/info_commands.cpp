#include <Trilinos_version.h>
#include <mpi.h>
#include <unistd.h>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <set>

#include "algebra/blas_kernels.hpp"
#include "checks/plausibility.hpp"
#include "commands.hpp"
#include "core/documentation.hpp"
#include "core/run_error.hpp"
#include "core/search_docs.hpp"
#include "discretisation/gmsh_library.hpp"
#include "simulation/plugin.hpp"

namespace mudline::cli {

std::vector<EntryDoc> documentation(const std::string& plugin) {
  Registries registries;
  register_all(registries);
  if (!plugin.empty()) {
    Teuchos::ParameterList list("plugins");
    list.set("files", Teuchos::Array<std::string>(1, std::filesystem::absolute(plugin).string()));
    load_plugins(Section(list, std::make_shared<Sources>(), std::make_shared<FunctionLibrary>(), ""), registries);
  }
  std::vector<EntryDoc> docs = document_all(registries);
  docs.push_back(Plausibility::document());
  return docs;
}

int rank() {
  int running = 0, result = 0;
  MPI_Initialized(&running);
  if (running != 0) MPI_Comm_rank(MPI_COMM_WORLD, &result);
  return result;
}

int list(const std::string& kind, bool markdown_wanted, const std::string& schema, const std::string& plugin) {
  const std::vector<EntryDoc> docs = documentation(plugin);
  std::vector<std::string> kinds;
  for (const EntryDoc& entry : docs)
    if (std::find(kinds.begin(), kinds.end(), entry.kind) == kinds.end()) kinds.push_back(entry.kind);
  const std::string wanted = kind == "material" ? "skeleton" : kind;
  if (!wanted.empty() && std::find(kinds.begin(), kinds.end(), wanted) == kinds.end())
    throw InputError("unknown kind '" + kind + "'" + suggestion(kind, kinds));
  if (rank() != 0) return 0;
  if (!schema.empty()) {
    std::cout << (schema == "xsd" ? xsd(docs) : relax_ng(docs));
    return 0;
  }
  if (markdown_wanted) {
    std::cout << "# Parameter reference\n\nWritten by `mudline list --markdown`; do not edit.\n\n";
    for (const EntryDoc& entry : docs) std::cout << markdown(entry) << "\n";
    return 0;
  }
  for (const std::string& k : kinds) {
    if (!wanted.empty() && k != wanted) continue;
    std::cout << k << "\n";
    for (const EntryDoc& entry : docs)
      if (entry.kind == k)
        std::cout << "  " << entry.name
                  << std::string(std::max<std::size_t>(2, 26 - std::min<std::size_t>(24, entry.name.size())), ' ')
                  << entry.summary << "\n";
  }
  return 0;
}

int explain(const std::string& name, const std::string& plugin) {
  const std::vector<EntryDoc> docs = documentation(plugin);
  bool found = false;
  for (const EntryDoc& entry : docs) {
    if (entry.name != name) continue;
    if (rank() == 0) std::cout << (found ? "\n" : "") << mudline::explain(entry);
    found = true;
  }
  if (found) return 0;
  const std::vector<std::string> lines = search_docs(docs, name);
  if (rank() == 0)
    for (const std::string& line : lines) std::cout << line << "\n";
  return 0;
}

std::string shared_file(const std::string& name) {
  std::vector<std::string> places;
  if (const char* given = std::getenv("MUDLINE_SCRIPTS")) places.push_back(given);
  const auto self = std::filesystem::read_symlink("/proc/self/exe");
  places.push_back((self.parent_path().parent_path() / "share/mudline").string());  // of an installed program, or none
  places.push_back(MUDLINE_SCRIPTS);
  for (const std::string& place : places)
    if (std::filesystem::exists(place + "/" + name)) return place + "/" + name;
  throw RunError("a part of mudline is not installed: " + name);
}

namespace {

/// The Python of an environment that is active and has what the scripts need; else the system's, for which the packages
/// are installed.
std::string python() {
  const bool environment = std::getenv("VIRTUAL_ENV") != nullptr || std::getenv("CONDA_PREFIX") != nullptr;
  if (environment && std::system("python3 -c 'import numpy, h5py, matplotlib' >/dev/null 2>&1") == 0) return "python3";
  return std::filesystem::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";
}

}  // namespace

std::vector<std::string> script_command(const std::string& name, const std::vector<std::string>& arguments) {
  std::vector<std::string> command{python(), shared_file(name + "/mudline_" + name + ".py")};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

std::vector<char*> argv_of(std::vector<std::string>& command) {
  std::vector<char*> argv;
  for (std::string& word : command) argv.push_back(word.data());
  argv.push_back(nullptr);
  return argv;
}

int become_script(const std::string& name, const std::vector<std::string>& arguments) {
  if (rank() != 0) return 0;
  std::vector<std::string> command = script_command(name, arguments);
  // a script that runs decks starts the same program
  setenv("MUDLINE_PROGRAM", std::filesystem::read_symlink("/proc/self/exe").c_str(), 0);
  const std::vector<char*> argv = argv_of(command);
  execvp(argv[0], argv.data());
  throw std::runtime_error("python3 cannot be started; install python3, python3-h5py and python3-matplotlib");
}

int version() {
  if (rank() != 0) return 0;
  const BlasKernels kernels = blas_kernels();
  std::cout << "mudline " << MUDLINE_VERSION << "\n"
            << "plugins: " << MUDLINE_ABI << "\n"
            << "gmsh:    " << (has_gmsh() ? "yes" : "no")
            << "\nblas:    " << (kernels.in_use.empty() ? "not OpenBLAS" : "OpenBLAS, kernels " + kernels.in_use)
            << (kernels.replaced.empty() ? "" : " (in place of " + kernels.replaced + ", which OpenBLAS picks here)")
            << std::endl;
  return 0;
}

}  // namespace mudline::cli
