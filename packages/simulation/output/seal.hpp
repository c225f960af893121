#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace mudline {

/// Number of bytes of a seal. A seal is the start of a file: it says what the file is and holds the checksum of
/// everything after it, so that a changed bit is found before the content is read. For rank 0; nothing here is
/// collective.
constexpr std::size_t seal_size = 512;

/// Fills the file's first seal_size bytes, which its writer must have left free. `kind`: "checkpoint". Returns what
/// went wrong, "" when nothing did.
std::string write_seal(const std::string& path, const std::string& kind, int version);

/// Why the file is not what write_seal left, "" when it is.
std::string broken_seal(const std::string& path, const std::string& kind, int version);

/// FNV-1a hash of a whole file, which finds a changed bit; empty when the file cannot be read.
std::optional<std::uint64_t> file_fingerprint(const std::string& path);

}  // namespace mudline
