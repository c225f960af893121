#pragma once

#include <string>

namespace mudline {

// Pieces of decks for tests.

inline std::string section_xml(const std::string& name, const std::string& body) {
  return "<ParameterList name=\"" + name + "\">\n" + body + "</ParameterList>\n";
}

inline std::string integers_parameter(const std::string& name, const std::string& values) {
  return "<Parameter name=\"" + name + "\" type=\"Array(int)\" value=\"{" + values + "}\"/>\n";
}

inline std::string number_parameter(const std::string& name, double value) {
  return "<Parameter name=\"" + name + "\" type=\"double\" value=\"" + std::to_string(value) + "\"/>\n";
}

inline std::string text_parameter(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"string\" value=\"" + value + "\"/>\n";
}

inline std::string array_parameter(const std::string& name, const std::string& values) {
  return "<Parameter name=\"" + name + "\" type=\"Array(double)\" value=\"{" + values + "}\"/>\n";
}

}  // namespace mudline
