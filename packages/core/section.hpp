#pragma once

#include <Teuchos_ParameterList.hpp>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/function.hpp"
#include "core/unit.hpp"

namespace mudline {

/// The position of each entry of the deck: path "materials/clay/type" -> "deck.xml:12".
using Sources = std::map<std::string, std::string>;

/// One sublist of the deck, with its path and position for error messages. Cheap to copy; the deck owns the data.
/// Entries that are read are marked; unused() then finds the others.
class Section {
 public:
  /// `root` must outlive the section.
  Section(Teuchos::ParameterList& root, std::shared_ptr<const Sources> sources,
          std::shared_ptr<const FunctionLibrary> functions, std::string folder,
          std::shared_ptr<const ValuesWithUnits> quantities = nullptr);

  /// "materials/clay"; "" at the root.
  const std::string& path() const { return path_; }
  /// The user-given or fixed name of this sublist, "clay".
  std::string name() const;
  /// The deck's folder; relative files in the deck are relative to it.
  const std::string& folder() const { return folder_; }
  const FunctionLibrary& functions() const { return *functions_; }
  /// Dimension of the deck's mesh, 2 or 3: how many numbers a point has.
  int dimension() const { return functions_->dimension(); }
  Teuchos::ParameterList& list() const { return *list_; }

  bool has_section(const std::string& name) const;
  bool has_parameter(const std::string& name) const;
  /// The sublist; an absent one is an empty section with the right path.
  Section section(const std::string& name) const;
  /// The sublist, where a missing "type" is taken to be `type`.
  Section section_of_type(const std::string& name, const std::string& type) const;
  /// Names of all sublists in deck order.
  std::vector<std::string> section_names() const;
  /// Names of all parameters (not sublists) in deck order.
  std::vector<std::string> parameter_names() const;

  /// Throws InputError "<file>:<line>: <path>[/<entry>]: <message>"; the line is the entry's when known.
  [[noreturn]] void fail(const std::string& message, const std::string& entry = "") const;

  /// "<file>:<line>: <path>[/<entry>]: ", with which a message about the entry begins.
  std::string origin(const std::string& entry) const;

  /// The items of a value that is given with units; null: it has none.
  const std::vector<std::optional<ValueWithUnit>>* quantities(const std::string& name) const;

  /// Where `entry` (or this section) was written, "deck.xml:12"; of an absent one, where its section was.
  std::string source(const std::string& entry = "") const;

  /// Throws InputError for the first sublist whose name is not in `allowed`, with a suggestion.
  void allow_sections(const std::vector<std::string>& allowed) const;
  /// Throws InputError for the first parameter whose name is not in `allowed`, with a suggestion.
  void allow_parameters(const std::vector<std::string>& allowed) const;

  /// The text of a string parameter; fails with path and line if absent or of another type.
  std::string text(const std::string& name) const;

  /// Full paths, in deck order, of the parameters below this section that were never read.
  std::vector<std::string> unused() const;

 private:
  Section() = default;
  Teuchos::ParameterList* list_ = nullptr;
  std::shared_ptr<const Sources> sources_;
  std::shared_ptr<const FunctionLibrary> functions_;
  std::shared_ptr<const ValuesWithUnits> quantities_;  // null: none
  std::string path_, folder_;
  std::shared_ptr<Teuchos::ParameterList> own_;  // keeps an absent (empty) sublist alive
};

}  // namespace mudline
