#pragma once

#include <optional>
#include <string>
#include <vector>

namespace mudline {

/// `text` without white space at its ends.
std::string trim(const std::string& text);

/// The shortest text that reads back as the same number: "0.1", "1e-06".
std::string number_text(double value);
/// "(0.1, -2)": so many numbers, each as number_text() has it.
std::string tuple_text(const double* numbers, std::size_t count);

/// The whole of `text` as a number; it may be inf or nan, so that the caller can say so. Independent of the locale.
std::optional<double> parse_number(const std::string& text);
std::optional<int> parse_integer(const std::string& text);
/// Only "true" and "false".
std::optional<bool> parse_bool(const std::string& text);
/// "{a, b}" -> a, b (trimmed); "{}" -> nothing in it. No value when the braces are missing or an item is empty.
std::optional<std::vector<std::string>> parse_array(const std::string& text);

/// "materials" + "clay" -> "materials/clay"; the root's path is "".
std::string join_path(const std::string& parent, const std::string& name);

/// `text` as the value of an XML attribute.
std::string xml_escaped(const std::string& text);

}  // namespace mudline
