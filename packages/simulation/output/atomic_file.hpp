#pragma once

#include <string>

namespace mudline {

/// Writes `text` under a temporary name beside `path` and renames it: a reader finds the old file or the new one, never
/// a part. Returns what went wrong, "" when nothing did.
std::string write_atomically(const std::string& path, const std::string& text);

/// Renames `from` to `to`, replacing it. Returns what went wrong, "" when nothing did.
std::string rename_file(const std::string& from, const std::string& to);

/// Makes `to`, replacing it, another name of the file `from`, or a copy where the file system has no such names.
/// Returns what went wrong, "" when nothing did.
std::string link_file(const std::string& from, const std::string& to);

}  // namespace mudline
