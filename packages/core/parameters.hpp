#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/function.hpp"
#include "core/range.hpp"
#include "core/section.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// The documentation of one parameter: the source of help texts, the reference, templates, the XSD, and errors.
struct ParameterDoc {
  std::string name;
  std::string type;  // double, int, bool, string, array of doubles, array of strings, function, choice, file
  std::string unit, range, default_text, doc;
  bool required;
  std::vector<std::string> choices;  // allowed words of a choice
  bool may_vary = false;             // a number that may be a function of the place instead
};

/// A number that the deck gives as a function of the place.
struct NumberOfPlace {
  std::string name, unit;
  Range range;
  Function function;
  double* number;  // the member that was declared; it keeps its default
};

/// Parameters of one object, declared once: the same call documents, validates, reads into the member.
///
///   void parameters(Parameters& p) {
///     p.add("Young's modulus", young_, "Pa", positive(), "Drained stiffness");  // the default is the member's value
///     p.required("Poisson's ratio", poisson_, "-", half_open(0, 0.5), "Drained");
///   }
///
/// Reading throws InputError for a wrong type, a value out of range or a missing required parameter;
/// finish() throws for entries nobody declared. Integers are accepted for doubles, never the reverse.
/// A name declared twice is a std::logic_error.
class Parameters {
 public:
  /// Reads and validates `section`.
  explicit Parameters(const Section& section);
  /// Collects documentation only; members keep their defaults.
  Parameters();

  void add(const std::string& name, double& member, const std::string& unit, Range range, const std::string& doc);
  void add(const std::string& name, int& member, const std::string& unit, Range range, const std::string& doc);
  void add(const std::string& name, bool& member, const std::string& doc);
  void add(const std::string& name, std::string& member, const std::string& doc);
  void add(const std::string& name, std::vector<double>& member, const std::string& unit, Range range,
           const std::string& doc);
  void add(const std::string& name, std::vector<std::string>& member, const std::string& doc);
  void add(const std::string& name, Vec<double, 2>& member, const std::string& unit, const std::string& doc);
  /// A point or a vector: as many numbers as the mesh has dimensions; in the plane the third stays 0.
  void add(const std::string& name, Point& member, const std::string& unit, const std::string& doc);
  void add(const std::string& name, Function& member, const std::string& unit, const std::string& doc);
  /// A function of the place, which is worked out once; one that depends on the time is refused.
  void add_of_place(const std::string& name, Function& member, const std::string& unit, const Range& range,
                    const std::string& doc);
  void required(const std::string& name, double& member, const std::string& unit, Range range, const std::string& doc);
  void required(const std::string& name, int& member, const std::string& unit, Range range, const std::string& doc);
  void required(const std::string& name, std::string& member, const std::string& doc);
  void required(const std::string& name, std::vector<double>& member, const std::string& unit, Range range,
                const std::string& doc);
  void required(const std::string& name, std::vector<std::string>& member, const std::string& doc);
  void required(const std::string& name, Vec<double, 2>& member, const std::string& unit, const std::string& doc);
  void required(const std::string& name, Point& member, const std::string& unit, const std::string& doc);
  void required(const std::string& name, Function& member, const std::string& unit, const std::string& doc);

  /// From here on a number (double) may also be a function of the place, which is added to `numbers`; null: no more.
  void let_vary(std::vector<NumberOfPlace>* numbers) { varying_ = numbers; }
  /// True when the deck gives this number as a function of the place.
  bool varies(const std::string& name) const;

  /// One of a fixed set of words.
  template <class Enum>
  void choice(const std::string& name, Enum& member, const std::vector<std::pair<std::string, Enum>>& words,
              const std::string& doc);

  /// A path to an existing file, made absolute (relative ones start at the deck's folder).
  void file(const std::string& name, std::string& member, const std::string& doc);
  void required_file(const std::string& name, std::string& member, const std::string& doc);

  /// A fixed sublist whose members are declared by T::parameters (absent in the deck: defaults, unless it has required
  /// ones).
  template <class T>
  void section(const std::string& name, T& member, const std::string& doc);

  /// Declares a sublist that somebody else reads (a collection or a pass-through list), so that it is no unknown entry.
  void passes_on(const std::string& name, const std::string& doc);

  /// True when the deck gives this parameter (always false when documenting).
  bool given(const std::string& name) const;
  bool documenting() const { return section_ == nullptr; }
  /// Dimension of the deck's mesh, 2 or 3; 3 when documenting.
  int dimension() const { return documenting() ? 3 : section_->dimension(); }
  const Section& deck() const { return *section_; }

  /// Throws for entries of the section that nobody declared, with a did-you-mean. Call after all declarations.
  void finish() const;

  const std::vector<ParameterDoc>& docs() const { return docs_; }
  /// Nested fixed sections in declaration order: name, doc, their parameters.
  struct SubsectionDoc {
    std::string name, doc;
    std::vector<ParameterDoc> parameters;
    std::vector<SubsectionDoc> sections;
    bool passed_on;
  };
  const std::vector<SubsectionDoc>& sections() const { return subsections_; }

 private:
  /// The function that an entry gives; it refuses values that are not finite or outside of `range`.
  Function function_in(const Teuchos::ParameterEntry& entry, const ParameterDoc& doc, const Range& range) const;
  /// The index into `words` that the deck gives, or `fallback`.
  std::size_t choose(const std::string& name, std::size_t fallback, const std::vector<std::string>& words,
                     const std::string& doc);
  void declare(ParameterDoc doc);
  /// The deck's entry; null when documenting or absent; an absent required one throws.
  const Teuchos::ParameterEntry* entry(const ParameterDoc& doc) const;
  /// Documents the parameter; lets `convert_entry` take the value when the deck gives one, and adds path and line to
  /// what it throws.
  template <class Read>
  void read(const ParameterDoc& doc, Read convert_entry);
  void number(const std::string& name, double& member, const std::string& unit, const Range& range,
              const std::string& doc, bool required);
  void point(const std::string& name, Point& member, const std::string& unit, const std::string& doc, bool required);
  template <class T>
  void value(const std::string& name, T& member, const std::string& unit, const Range& range,
             const std::string& range_text, const std::string& doc, bool required);
  void function(const std::string& name, Function& member, const std::string& unit, const std::string& doc,
                bool required);
  void path(const std::string& name, std::string& member, const std::string& doc, bool required);

  std::shared_ptr<Section> section_;
  std::vector<NumberOfPlace>* varying_ = nullptr;
  std::vector<ParameterDoc> docs_;
  std::vector<SubsectionDoc> subsections_;
};

template <class Enum>
void Parameters::choice(const std::string& name, Enum& member, const std::vector<std::pair<std::string, Enum>>& words,
                        const std::string& doc) {
  std::vector<std::string> names;
  std::size_t current = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    names.push_back(words[i].first);
    if (words[i].second == member) current = i;
  }
  member = words[choose(name, current, names, doc)].second;
}

template <class T>
void Parameters::section(const std::string& name, T& member, const std::string& doc) {
  if (documenting()) {
    Parameters inner;
    member.parameters(inner);
    subsections_.push_back({name, doc, inner.docs_, inner.subsections_, false});
    return;
  }
  Parameters inner(section_->section(name));
  member.parameters(inner);
  inner.finish();
  subsections_.push_back({name, doc, inner.docs_, inner.subsections_, false});
}

}  // namespace mudline
