#include "simulation/plugin.hpp"

#include <dlfcn.h>

#include <cstring>
#include <filesystem>

namespace mudline {

namespace {
void declare(Parameters& p, std::vector<std::string>& files) {
  p.add("files", files, "shared libraries to load before the deck is read further; relative to the deck's folder");
}
}  // namespace

void document_plugins(Parameters& p) {
  std::vector<std::string> files;
  declare(p, files);
}

void load_plugins(const Section& section, Registries& registries) {
  std::vector<std::string> files;
  Parameters p(section);
  declare(p, files);
  p.finish();
  for (const std::string& given : files) {
    std::filesystem::path path(given);
    if (path.is_relative()) path = std::filesystem::path(section.folder()) / path;
    if (!std::filesystem::exists(path)) section.fail("plugin '" + given + "' does not exist (looked for " + path.string() + ")", "files");
    void* library = dlopen(std::filesystem::absolute(path).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) section.fail("plugin '" + given + "' cannot be loaded: " + dlerror(), "files");
    const auto abi = reinterpret_cast<const char* (*)()>(dlsym(library, "mudline_plugin_abi"));
    const auto enter = reinterpret_cast<void (*)(Registries&)>(dlsym(library, "mudline_plugin_register"));
    if (!abi || !enter) section.fail("'" + given + "' is no mudline plugin: it does not contain MUDLINE_PLUGIN", "files");
    if (std::strcmp(abi(), MUDLINE_ABI) != 0)
      section.fail("plugin '" + given + "' was built for \"" + abi() + "\", this program is \"" + std::string(MUDLINE_ABI) + "\"; rebuild the plugin", "files");
    try {
      enter(registries);
    } catch (const std::exception& error) {
      section.fail("plugin '" + given + "' cannot register: " + error.what(), "files");
    }
  }
}

}  // namespace mudline
