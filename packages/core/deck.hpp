#pragma once

#include <Teuchos_ParameterList.hpp>

#include <memory>
#include <string>
#include <vector>

#include "core/section.hpp"

namespace mudline {

/// A Teuchos XML deck with the line of every entry. Overlays replace single parameters of what came before.
/// Every rank reads the same text (rank 0 reads the file; the caller broadcasts), so every rank throws alike.
class Deck {
 public:
  /// Parses XML text of Teuchos' ParameterList format (types double, int, bool, string, Array(double), Array(int),
  /// Array(string)). Later files replace single parameters of earlier ones and merge sections; the folder of the first
  /// one is the deck's. Throws InputError with file:line for malformed XML, bad types or values, duplicated entries.
  void overlay(const std::string& xml_text, const std::string& file_name);

  /// "stages/push/duration=2.0": replaces or adds one parameter; its type is that of the replaced value where the text
  /// fits it, else inferred (bool, int, double, {a, b} array, string). Missing sections of the path are added. Throws
  /// InputError "--set <assignment>: ..." when malformed or when it would replace a section.
  void set(const std::string& assignment);

  /// Replaces what is written with variables, reads the section "functions" (tables, expressions, constants) and
  /// returns the root section. Throws InputError for errors in them, and for a section that only set() made and that
  /// looks like a misspelling.
  Section root();

  const Teuchos::ParameterList& list() const { return *list_; }
  /// The deck written back as Teuchos XML (for the result file), overlays and settings applied.
  std::string to_xml() const;

 private:
  std::shared_ptr<Teuchos::ParameterList> list_ = std::make_shared<Teuchos::ParameterList>("deck");
  std::shared_ptr<Sources> sources_ = std::make_shared<Sources>();
  std::string folder_;
};

}  // namespace mudline
