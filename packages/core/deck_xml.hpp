#pragma once

#include <Teuchos_ParameterList.hpp>

#include <string>

#include "core/section.hpp"

namespace mudline {

/// Reads XML text of Teuchos' ParameterList format into `list` and the line of every entry into `sources`. Throws
/// InputError "<file>:<line>: [<path>: ]<message>" for malformed XML, XML that is no ParameterList, bad types or
/// values, and anything given twice.
void read_xml(const std::string& text, const std::string& file, Teuchos::ParameterList& list, Sources& sources);

/// The list as XML text that read_xml takes back unchanged.
std::string write_xml(const Teuchos::ParameterList& list);

}  // namespace mudline
