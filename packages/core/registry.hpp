#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "core/guarded.hpp"
#include "core/parameters.hpp"

namespace mudline {

/// The documentation of one registered type, for `mudline list` and `mudline explain`.
struct EntryDoc {
  std::string kind, name, summary;
  std::vector<ParameterDoc> parameters;
  std::vector<Parameters::SubsectionDoc> sections;
};

namespace detail {
template <class T, class = void>
struct has_check : std::false_type {};
template <class T>
struct has_check<T, std::void_t<decltype(std::declval<T&>().check(std::declval<const Section&>()))>> : std::true_type {
};
}  // namespace detail

/// The types of one kind ("material", "integrator", ...) that a deck's "type" may name. No singleton: one instance,
/// passed by reference; packages and plugins fill it by a plain list of add calls.
///
/// A registered T is constructible from Context..., has `void parameters(Parameters&)`, and may have
/// `void check(const Section&)` for rules across parameters (it calls section.fail).
template <class Interface, class... Context>
class Registry {
 public:
  explicit Registry(std::string kind) : kind_(std::move(kind)) {}

  template <class T>
  void add(const std::string& name, const std::string& summary) {
    for (const auto& entry : entries_)
      if (entry.name == name) throw std::logic_error("the " + kind_ + " type '" + name + "' is registered twice");
    entries_.push_back({name, summary,
                        [](const Section& section, bool typed, Context... context) -> std::unique_ptr<Interface> {
                          auto object = std::make_unique<T>(context...);
                          Parameters p(section);
                          std::string type;
                          if (typed) p.required("type", type, "");
                          object->parameters(p);
                          p.finish();
                          if constexpr (detail::has_check<T>::value) object->check(section);
                          return object;
                        },
                        [](Parameters& p) {
                          if constexpr (std::is_default_constructible_v<T>) {
                            T object;
                            object.parameters(p);
                          } else {
                            T::document(p);
                          }
                        }});
  }

  /// Builds the object that section's "type" names and reads its parameters.
  /// Throws InputError for a missing or unknown type (with the known ones), for bad parameters, and for anything that
  /// the type, which may be a plugin's, throws.
  std::unique_ptr<Interface> create(const Section& section, Context... context) const {
    if (!section.has_parameter("type"))
      section.fail("required parameter 'type' is missing; known " + kind_ + " types: " + join(names()));
    const std::string type = section.text("type");
    for (const auto& entry : entries_)
      if (entry.name == type)
        return guarded(section, "type", "the " + kind_ + " cannot be made",
                       [&] { return entry.make(section, true, context...); });
    const std::string near = nearest(type, names());
    section.fail("unknown " + kind_ + " type '" + type + "'" + (near.empty() ? "" : " (did you mean '" + near + "'?)") +
                     "; known types: " + join(names()),
                 "type");
  }

  /// Builds the object of a section without "type": the section's name is that of a registered type.
  std::unique_ptr<Interface> create_by_name(const Section& section, Context... context) const {
    for (const auto& entry : entries_)
      if (entry.name == section.name())
        return guarded(section, "", "the " + kind_ + " cannot be made",
                       [&] { return entry.make(section, false, context...); });
    throw std::logic_error("there is no " + kind_ + " type '" + section.name() + "'");
  }

  const std::string& kind() const { return kind_; }
  bool contains(const std::string& name) const {
    for (const auto& entry : entries_)
      if (entry.name == name) return true;
    return false;
  }
  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& entry : entries_) result.push_back(entry.name);
    return result;
  }
  std::vector<EntryDoc> document() const {
    std::vector<EntryDoc> result;
    for (const auto& entry : entries_) {
      Parameters p;
      entry.describe(p);
      result.push_back({kind_, entry.name, entry.summary, p.docs(), p.sections()});
    }
    return result;
  }

 private:
  struct Entry {
    std::string name, summary;
    std::function<std::unique_ptr<Interface>(const Section&, bool typed, Context...)> make;
    std::function<void(Parameters&)> describe;
  };
  std::string kind_;
  std::vector<Entry> entries_;
};

}  // namespace mudline
