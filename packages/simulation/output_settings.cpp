#include "simulation/output_settings.hpp"

#include <filesystem>

namespace mudline {

void OutputSettings::parameters(Parameters& p) {
  p.add("folder", folder, "folder of the results, made if absent; relative to where the program is started");
  p.add("name", name, "name of the result files; by default that of the deck");
  p.add("field interval", field_interval, "s", non_negative(), "time between two written fields; 0: only at the end of every stage");
  p.add("field steps", field_steps, "-", closed(0, 1e9), "fields are written every so many steps; 0: off");
  p.add("history steps", history_steps, "-", closed(1, 1e9), "a row of the history file every so many steps");
  p.add("checkpoint steps", checkpoint_steps, "-", closed(0, 1e9), "a checkpoint every so many steps; 0: at the end of stages only");
  p.passes_on("probes", "named points, Array(double) of two coordinates each; of every field the history has the value at the nearest node that carries it (pore pressure: the nearest cell corner)");
}

OutputSettings OutputSettings::read(const Section& section, const std::string& deck_name) {
  OutputSettings settings;
  settings.name = deck_name;
  Parameters p(section);
  settings.parameters(p);
  p.finish();
  const Section probes = section.section("probes");
  Parameters reader(probes);
  for (const std::string& name : probes.parameter_names()) {
    std::array<double, 2> point{};
    reader.required(name, point, "m", "position of the probe");
    settings.probes.emplace_back(name, point);
  }
  reader.finish();
  return settings;
}

void OutputSettings::make_folder(const Section& section) const {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    section.fail("the folder '" + folder + "' cannot be made" + (error ? ": " + error.message() : ""), "folder");
}

}  // namespace mudline
