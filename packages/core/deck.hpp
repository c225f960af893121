#pragma once

#include <Teuchos_ParameterList.hpp>

#include <memory>
#include <string>
#include <vector>

#include "core/section.hpp"

namespace mudline {

/// A Teuchos XML deck with the line of every entry. Overlays replace single parameters of what came before.
/// Every rank reads the same text (rank 0 reads the file; the caller broadcasts), so every rank throws alike. Copies
/// share their entries; overlay() on an empty deck makes one of its own.
class Deck {
 public:
  /// Parses XML text of Teuchos' ParameterList format (types double, int, bool, string, Array(double), Array(int),
  /// Array(string)). Later files replace single parameters of earlier ones and merge sections; the folder of the first
  /// one is the deck's. Throws InputError with file:line for malformed XML, bad types or values, duplicated entries.
  void overlay(const std::string& xml_text, const std::string& file_name);
  /// Lays the entries of another deck over this one in the same way.
  void overlay(const Deck& over);
  /// Lays this deck over `base`; the folder stays that of this one.
  void base_on(const Deck& base);

  /// Removes a text at the root of the deck and returns it; "": it is not given. InputError where it is no text.
  std::string take_text(const std::string& name);
  /// Removes a section at the root of the deck and returns its entries as a deck; empty where it is not given. The
  /// variables that they name count as used. InputError where it is a parameter.
  Deck take_section(const std::string& name);

  /// "stages/push/duration=2.0": replaces or adds one parameter; its type is that of the replaced value where the text
  /// fits it, else inferred (bool, int, double, {a, b} array, string). Missing sections of the path are added. Throws
  /// InputError "--set <assignment>: ..." when malformed or when it would replace a section.
  void set(const std::string& assignment);

  /// Replaces what is written with variables, reads the section "functions" (tables, expressions, constants) and
  /// returns the root section. Throws InputError for errors in them, and for a section that only set() made and that
  /// looks like a misspelling.
  Section root();

  const Teuchos::ParameterList& list() const { return *list_; }
  /// What other entries have replaced, and sections that were taken out: what they name is not superfluous.
  const Teuchos::ParameterList& elsewhere() const { return elsewhere_; }
  /// Where an entry was written, "deck.xml:12"; of one that is not given, where the innermost section around it was.
  std::string position(const std::string& path = "") const;
  /// The deck written back as Teuchos XML (for the result file), overlays and settings applied.
  std::string to_xml() const;

 private:
  std::shared_ptr<Teuchos::ParameterList> list_ = std::make_shared<Teuchos::ParameterList>("deck");
  std::shared_ptr<Sources> sources_ = std::make_shared<Sources>();
  Teuchos::ParameterList elsewhere_;
  std::string folder_;
};

}  // namespace mudline
