#include "simulation/observer.hpp"

#include "core/run_error.hpp"
#include "discretisation/agree.hpp"
#include "simulation/model.hpp"

namespace mudline {

Observers read_observers(const Section& output, const Registry<Observer>& types, const Model& model) {
  const Section section = output.section("observers");
  section.allow_parameters({});
  Observers result;
  for (const std::string& name : section.section_names()) {
    const Section entry = section.section(name);
    result.push_back(types.create(entry));
    result.back()->name = name;
    guarded(entry, "type", "the observer cannot be used", [&] { result.back()->bind(model, entry); });
  }
  return result;
}

void call(Observer& observer, const Model& model, const std::function<void(Observer&)>& action) {
  if (observer.name.empty()) return action(observer);
  std::string fault;
  try {
    action(observer);
  } catch (const InputError&) {
    throw;
  } catch (const RunError&) {
    throw;
  } catch (...) {
    fault = "observer '" + observer.name + "': " + fault_thrown();
  }
  fault = broadcast(*model.mesh().comm(), fault);
  if (!fault.empty()) throw RunError(fault);
}

}  // namespace mudline
