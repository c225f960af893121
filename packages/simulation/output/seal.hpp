#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace mudline {

/// The first bytes of a file, which say what it is and hold the checksum of everything behind them: a bit that has
/// changed anywhere is found before the content is looked at. Rank 0's business; nothing here is collective.
constexpr std::size_t seal_size = 512;

/// Fills the file's first seal_size bytes, which its writer left free. `kind`: "checkpoint". Returns what went wrong,
/// "" when nothing did.
std::string write_seal(const std::string& path, const std::string& kind, int version);

/// Why the file is not what write_seal left, "" when it is.
std::string broken_seal(const std::string& path, const std::string& kind, int version);

/// FNV-1a of a whole file, by which a bit that has changed is found; nothing when it cannot be read.
std::optional<std::uint64_t> file_fingerprint(const std::string& path);

}  // namespace mudline
