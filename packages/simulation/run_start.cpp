#include "simulation/run_start.hpp"

#include <algorithm>
#include <filesystem>

#include "core/errors.hpp"

namespace mudline {

namespace fs = std::filesystem;

namespace {

const std::string ending = ".restart";

}  // namespace

std::string stage_checkpoint(const std::string& stem, const std::string& stage) { return stem + "@" + stage + ending; }

std::vector<std::string> checkpointed_stages(const std::string& stem) {
  std::vector<std::string> stages;
  std::error_code ignored;
  const fs::path place(stem);
  const std::string begin = place.filename().string() + "@";
  for (fs::directory_iterator file(place.has_parent_path() ? place.parent_path() : ".", ignored), end; file != end;
       file.increment(ignored)) {
    const std::string name = file->path().filename().string();
    if (name.size() < begin.size() + ending.size() || name.compare(0, begin.size(), begin) != 0 ||
        file->path().extension() != ending)
      continue;
    stages.push_back(name.substr(begin.size(), name.size() - begin.size() - ending.size()));
  }
  std::sort(stages.begin(), stages.end());
  return stages;
}

void RunStart::parameters(Parameters& p) {
  p.required("from", from_,
             "results and the stage after which the run goes on, 'results/pile@push'; relative to where the program is "
             "started. The deck describes the stages up to it as they were");
}

RunStart RunStart::read(const Section& section, const std::string& own_stem) {
  RunStart start;
  if (section.parameter_names().empty() && section.section_names().empty()) return start;
  Parameters p(section);
  start.parameters(p);
  p.finish();
  const std::string from = start.from_;
  start = named(section, "from", from);
  std::error_code ignored;
  if (fs::weakly_canonical(start.stem_, ignored) == fs::weakly_canonical(own_stem, ignored))
    section.fail("'" + start.stem_ + "' are the results of this run itself: give it another output/name", "from");
  return start;
}

RunStart RunStart::named(const std::string& from) {
  const std::size_t at = from.rfind('@');
  if (at == std::string::npos || at == 0 || at + 1 == from.size())
    throw InputError("expected results and a stage, 'results/pile@push', given '" + from + "'");
  return RunStart::at(from.substr(0, at), from.substr(at + 1));
}

RunStart RunStart::named(const Section& section, const std::string& entry, const std::string& from) {
  try {
    return named(from);
  } catch (const InputError& error) {
    section.fail(error.what(), entry);
  }
}

RunStart RunStart::at(const std::string& stem, const std::string& stage) {
  RunStart start;
  start.stem_ = stem;
  start.stage_ = stage;
  start.checkpoint_ = stage_checkpoint(stem, stage);
  return start;
}

bool RunStart::exists() const {
  std::error_code ignored;
  return fs::exists(checkpoint_, ignored);
}

std::string RunStart::missing() const {
  if (checkpoint_.empty() || exists()) return "";
  const std::vector<std::string> stages = checkpointed_stages(stem_);
  if (stages.empty()) return "there are no results '" + stem_ + "' with the end of a stage";
  return "the results '" + stem_ + "' have no end of a stage '" + stage_ + "'" + suggestion(stage_, stages);
}

void RunStart::find(const Section& section, const std::string& entry) const {
  if (const std::string why = missing(); !why.empty()) section.fail(why, entry);
}

}  // namespace mudline
