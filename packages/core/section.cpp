#include "core/section.hpp"

#include <algorithm>
#include <utility>

#include "core/entry.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"

namespace mudline {

namespace {

/// Visits all entries. In release 13.2, Teuchos' iterators give name and entry only through the list.
template <class Visit>
void for_each_entry(const Teuchos::ParameterList& list, Visit visit) {
  for (auto it = list.begin(); it != list.end(); ++it) visit(list.name(it), list.entry(it));
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Collects unused parameters only: Teuchos marks a section as used whenever something is put into it.
void collect_unused(const Teuchos::ParameterList& list, const std::string& path, std::vector<std::string>& unused) {
  for_each_entry(list, [&](const std::string& name, const Teuchos::ParameterEntry& entry) {
    if (entry.isList()) {
      collect_unused(Teuchos::any_cast<Teuchos::ParameterList>(entry.getAny(false)), join_path(path, name), unused);
    } else if (!entry.isUsed()) {
      unused.push_back(join_path(path, name));
    }
  });
}

}  // namespace

Section::Section(Teuchos::ParameterList& root, std::shared_ptr<const Sources> sources,
                 std::shared_ptr<const FunctionLibrary> functions, std::string folder,
                 std::shared_ptr<const ValuesWithUnits> quantities)
    : list_(&root),
      sources_(std::move(sources)),
      functions_(std::move(functions)),
      quantities_(std::move(quantities)),
      folder_(std::move(folder)) {
  if (!sources_) sources_ = std::make_shared<Sources>();
  if (!functions_) functions_ = std::make_shared<FunctionLibrary>();
}

const std::vector<std::optional<ValueWithUnit>>* Section::quantities(const std::string& name) const {
  if (!quantities_) return nullptr;
  const auto found = quantities_->find(join_path(path_, name));
  return found == quantities_->end() ? nullptr : &found->second;
}

std::string Section::name() const {
  const auto slash = path_.rfind('/');
  return slash == std::string::npos ? path_ : path_.substr(slash + 1);
}

bool Section::has_section(const std::string& name) const { return list_->isSublist(name); }

bool Section::has_parameter(const std::string& name) const {
  return list_->isParameter(name) && !list_->isSublist(name);
}

Section Section::section(const std::string& name) const {
  if (has_parameter(name))
    fail("expected a section (ParameterList), given " + describe_entry(list_->getEntry(name)), name);
  Section result;
  if (has_section(name)) {
    result.list_ = &list_->sublist(name);
    result.own_ = own_;
  } else {
    result.own_ = std::make_shared<Teuchos::ParameterList>(name);
    result.list_ = result.own_.get();
  }
  result.sources_ = sources_;
  result.functions_ = functions_;
  result.quantities_ = quantities_;
  result.path_ = join_path(path_, name);
  result.folder_ = folder_;
  return result;
}

Section Section::section_of_type(const std::string& name, const std::string& type) const {
  const Section result = section(name);
  if (!result.has_parameter("type")) result.list().set("type", type);
  return result;
}

std::vector<std::string> Section::section_names() const { return mudline::section_names(*list_); }

std::vector<std::string> Section::parameter_names() const {
  std::vector<std::string> names;
  for_each_entry(*list_, [&](const std::string& name, const Teuchos::ParameterEntry& entry) {
    if (!entry.isList()) names.push_back(name);
  });
  return names;
}

std::string Section::source(const std::string& entry) const {
  std::string path = join_path(path_, entry);
  // An entry that is not in the deck is reported at the section that should hold it.
  while (true) {
    const auto found = sources_->find(path);
    if (found != sources_->end()) return found->second;
    if (path.empty()) return "";
    const auto slash = path.rfind('/');
    path = slash == std::string::npos ? "" : path.substr(0, slash);
  }
}

void Section::fail(const std::string& message, const std::string& entry) const {
  // Where the type is missing, the object's other parameters are unknown, so look for a misspelt "type" first.
  const std::string missing = "required parameter 'type' is missing";
  const std::string misspelt =
      message.compare(0, missing.size(), missing) == 0 ? nearest("type", parameter_names()) : "";
  if (!misspelt.empty()) fail("unknown parameter (did you mean 'type'?)", misspelt);
  throw InputError(origin(entry) + message);
}

std::string Section::origin(const std::string& entry) const {
  std::string line;
  for (const std::string& part : {source(entry), join_path(path_, entry)})
    if (!part.empty()) line += part + ": ";
  return line;
}

void Section::allow_sections(const std::vector<std::string>& allowed) const {
  for (const std::string& name : section_names())
    if (!contains(allowed, name)) fail("unknown section" + suggestion(name, allowed), name);
}

void Section::allow_parameters(const std::vector<std::string>& allowed) const {
  for (const std::string& name : parameter_names())
    if (!contains(allowed, name)) fail("unknown parameter" + suggestion(name, allowed), name);
}

std::string Section::text(const std::string& name) const {
  if (!list_->isParameter(name)) fail("required parameter '" + name + "' is missing");
  const auto& entry = list_->getEntry(name);
  if (!entry.isType<std::string>()) fail("expected a string, given " + describe_entry(entry), name);
  return list_->get<std::string>(name);
}

std::vector<std::string> Section::unused() const {
  std::vector<std::string> result;
  collect_unused(*list_, path_, result);
  return result;
}

}  // namespace mudline
