#pragma once

#include <string>
#include <vector>

#include "core/registry.hpp"

namespace mudline {

/// Text for the terminal: name, kind, summary, an aligned table of the parameters; nested sections indented below.
std::string explain(const EntryDoc& entry);

/// One Markdown chapter (a second-level heading) with the same content.
std::string markdown(const EntryDoc& entry);

/// Commented Teuchos XML with the defaults, ready to be filled in: required parameters have an empty value and say so;
/// optional ones without default are commented out. `indent` is the number of spaces before each line.
/// The list is called `name`, or like the entry's kind when that is empty.
std::string xml_template(const EntryDoc& entry, int indent = 0, const std::string& name = "");

/// An XML schema (XSD 1.0) for editors: the structure and types of a deck. The documented parameter names and type
/// words are offered for completion; others stay valid, since names of collections are free.
std::string xsd(const std::vector<EntryDoc>& entries);

/// A RELAX NG schema for editors and checks, from the declarations: which sections and parameters may stand where,
/// their types, and the words of choices. Names of one's own are free, as are sections that others read and that are
/// not documented. Nothing is required, so that overlays are valid too.
std::string relax_ng(const std::vector<EntryDoc>& entries);

}  // namespace mudline
