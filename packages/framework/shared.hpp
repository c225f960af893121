#pragma once

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <typeindex>

namespace mudline {

/// Objects that the physics of a model offer to each other, to conditions and to contacts, found by type (the soil, for
/// instance).
class Shared {
 public:
  /// Adds an object; std::logic_error if there is already one of its type.
  template <class T>
  void offer(std::shared_ptr<T> what) {
    if (!offered_.emplace(std::type_index(typeid(T)), std::move(what)).second)
      throw std::logic_error(std::string("two physics offer a ") + typeid(T).name());
  }
  /// The object of this type; null if none is offered.
  template <class T>
  std::shared_ptr<T> find() const {
    const auto found = offered_.find(std::type_index(typeid(T)));
    return found == offered_.end() ? nullptr : std::static_pointer_cast<T>(found->second);
  }

 private:
  std::map<std::type_index, std::shared_ptr<void>> offered_;
};

}  // namespace mudline
