#include "simulation/output_settings.hpp"

#include <algorithm>
#include <filesystem>

#include "core/errors.hpp"
#include "core/text.hpp"

namespace mudline {

namespace {

void moving_probe(Parameters& p, ProbeSettings& probe) {
  p.required("point", probe.point, "m", "place at the start");
  p.required("moves with", probe.moves_with, "a body, whose point it is; or nothing: it stays where it is");
}

/// Refuses names whose files would not lie in the folder, or to which an .xdmf file cannot refer: it writes
/// "file:dataset" without quotes.
void check_name(const Section& section, const std::string& name) {
  constexpr std::size_t longest = 200;  // [bytes] file systems allow 255, with endings
  const std::string end =
      section.has_parameter("name") ? "" : "; it is the deck's own name, as none is given here for the results";
  const auto refuse = [&](const std::string& why) {
    section.fail("'" + beginning(name, longest) + "' " + why + end, "name");
  };
  if (trim(name).empty()) refuse("is no name for the files of the results");
  if (name != trim(name)) refuse("begins or ends with a blank");
  if (name == "." || name == ".." || name.find('/') != std::string::npos)
    refuse("is no name of files in output/folder; allowed: a name without '/'");
  if (name.find(':') != std::string::npos) refuse("contains ':', which separates file and dataset in the .xdmf");
  const std::string taken = ".results";  // "clay.results.csv" has the results of the run "clay"
  if (name.size() >= taken.size() && name.compare(name.size() - taken.size(), taken.size(), taken) == 0)
    refuse("ends with '.results', as the file of a run's results does");
  if (name.size() > longest) refuse("is too long; allowed: " + std::to_string(longest) + " bytes");
}

}  // namespace

void OutputSettings::parameters(Parameters& p) {
  p.add("folder", folder, "folder of the results, made if absent; relative to where the program is started");
  p.add("name", name, "name of the result files, without '/' and ':'; by default that of the deck");
  p.add("field interval", field_interval, "s", non_negative(),
        "time between two written fields; 0: only at the end of every stage");
  p.add("field steps", field_steps, "-", closed(0, 1e9), "fields are written every so many steps; 0: off");
  p.add("history steps", history_steps, "-", closed(1, 1e9), "a row of the history file every so many steps");
  p.add("checkpoint steps", checkpoint_steps, "-", closed(0, 1e9),
        "a checkpoint every so many steps; 0: at the end of stages only");
  p.add("error estimate", error_estimate,
        "estimates of the discretisation error: fields 'error/...', 'mesh/stress error' and an error beside every "
        "resistance and every pore pressure of a probe in the history");
  p.add("target error", target_error, "-", open(0, 1),
        "share of the energy of the stress's change that 'error/wanted size' aims at (with 'error estimate')");
  if (!p.documenting() && p.given("target error") && !error_estimate)
    p.deck().fail("has no effect without 'error estimate' = true", "target error");
  p.passes_on("probes",
              "named points: Array(double) of its coordinates for the nearest node that carries a field (pore "
              "pressure: the nearest cell corner), wherever it goes, with the soil or with the mesh; or a section with "
              "a point and what it moves with");
  p.passes_on(
      "filters",
      "named filters of bodies: mean pore pressures over a part of a body's surface; one named section each, see "
      "the section filter");
  p.passes_on("observers", "further outputs and watches, by name; see the observer types, which plugins bring");
}

OutputSettings OutputSettings::read(const Section& section, const std::string& deck_name,
                                    const std::vector<std::string>& bodies) {
  OutputSettings settings;
  settings.name = deck_name;
  Parameters p(section);
  settings.parameters(p);
  p.finish();
  check_name(section, settings.name);
  const Section probes = section.section("probes");
  Parameters reader(probes);
  for (const std::string& name : probes.parameter_names()) {
    Point point{};
    reader.required(name, point, "m", "position of the probe");
    settings.probes.push_back({name, point, true, ""});
  }
  for (const std::string& name : probes.section_names()) reader.passes_on(name, "a probe that is no node");
  reader.finish();
  for (const std::string& name : probes.section_names()) {
    ProbeSettings probe{name, {}, false, ""};
    const Section own = probes.section(name);
    Parameters moving(own);
    moving_probe(moving, probe);
    moving.finish();
    if (probe.moves_with == "nothing")
      probe.moves_with.clear();
    else if (std::find(bodies.begin(), bodies.end(), probe.moves_with) == bodies.end())
      own.fail("unknown body '" + probe.moves_with + "'" + suggestion(probe.moves_with, bodies), "moves with");
    settings.probes.push_back(probe);
  }
  const Section filters = section.section("filters");
  filters.allow_parameters({});
  for (const std::string& name : filters.section_names()) {
    FilterSettings filter;
    filter.name = name;
    Parameters own(filters.section(name));
    filter.parameters(own);
    own.finish();
    settings.filters.push_back(filter);
  }
  return settings;
}

void OutputSettings::make_folder(const Section& section) const {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    section.fail("the folder '" + folder + "' cannot be made" + (error ? ": " + error.message() : ""), "folder");
}

}  // namespace mudline
