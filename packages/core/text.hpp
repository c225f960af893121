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

/// What `text` holds that no name or value may: "" or "the byte 0xe9, which is not UTF-8", "the control character
/// 0x1b". `lines`: line breaks and tabs may stand in it. `place`, where given: how many bytes stand before that.
std::string unfit(const std::string& text, bool lines = false, std::size_t* place = nullptr);

/// The beginning of a text, "abc ...", where it has more than so many bytes.
std::string beginning(const std::string& text, std::size_t bytes);

/// A message as a terminal may show it: control characters and what is not UTF-8 as "\\x1b", and of a very long one the
/// beginning and the end.
std::string printable(const std::string& message);

/// `text` as the value or content of an XML element or attribute.
std::string xml_escaped(const std::string& text);

}  // namespace mudline
