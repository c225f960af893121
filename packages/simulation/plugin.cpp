#include "simulation/plugin.hpp"

#include <filesystem>

#include "core/foreign_library.hpp"
#include "core/guarded.hpp"

namespace mudline {

namespace {

void declare(Parameters& p, std::vector<std::string>& files) {
  p.add("files", files, "shared libraries to load before the deck is read further; relative to the deck's folder");
}

/// The text with which a plugin says for what it was built (see MUDLINE_ABI). Throws where there is none.
std::string signature_of(const ForeignLibrary& library) {
  const auto signature = reinterpret_cast<const char* (*)()>(library.function("mudline_plugin_abi"));
  if (const char* text = signature()) return text;
  throw std::runtime_error("it names nothing");
}

/// Loads one library and lets it register.
void load_plugin(const Section& section, const std::string& given, const std::string& path, Registries& registries) {
  const std::string plugin = "plugin '" + given + "' ";
  const auto library = guarded(section, "files", plugin + "cannot be loaded", [&] { return ForeignLibrary(path); });
  const auto enter = reinterpret_cast<void (*)(Registries&)>(library.function("mudline_plugin_register"));
  if (!enter || !library.function("mudline_plugin_abi"))
    section.fail("'" + given + "' is no mudline plugin: it does not contain MUDLINE_PLUGIN", "files");
  const std::string signature =
      guarded(section, "files", plugin + "cannot tell what it was built for", [&] { return signature_of(library); });
  if (signature != MUDLINE_ABI)
    section.fail(plugin + "was built for \"" + signature + "\", this program is \"" + std::string(MUDLINE_ABI) +
                     "\"; rebuild the plugin",
                 "files");
  const OpenDescriptors before;
  guarded(section, "files", plugin + "cannot register", [&] { enter(registries); });
  check_foreign_code(&before);
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
    if (!std::filesystem::exists(path))
      section.fail("plugin '" + given + "' does not exist (looked for " + path.string() + ")", "files");
    load_plugin(section, given, std::filesystem::absolute(path), registries);
  }
}

}  // namespace mudline
