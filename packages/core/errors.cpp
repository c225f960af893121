#include "core/errors.hpp"

#include <algorithm>

#include "core/text.hpp"

namespace mudline {

namespace {

/// Removes differences that the edit distance ignores: case, and '_' or '-' for ' '.
std::string normalised(const std::string& text) {
  std::string result = lower_case(text);
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c == '_' || c == '-'; }, ' ');
  return result;
}

/// Number of insertions, deletions, substitutions and swaps of neighbours that turn a into b (optimal string alignment
/// distance).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, previous[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        current[j] = std::min(current[j], before[j - 2] + 1);
    }
    std::swap(before, previous);
    std::swap(previous, current);
  }
  return previous[b.size()];
}

std::size_t common_prefix(const std::string& a, const std::string& b) {
  const auto shorter = static_cast<std::ptrdiff_t>(std::min(a.size(), b.size()));
  return static_cast<std::size_t>(std::mismatch(a.begin(), a.begin() + shorter, b.begin()).first - a.begin());
}

}  // namespace

std::string nearest(const std::string& given, const std::vector<std::string>& candidates) {
  const std::string word = normalised(given);
  std::string best;
  std::size_t best_distance = 0, best_prefix = 0;
  for (const std::string& candidate : candidates) {
    const std::string other = normalised(candidate);
    // A third of the letters may differ, but never all of them: "x" is no typo of "y".
    const std::size_t length = std::max(word.size(), other.size());
    const std::size_t limit = std::min(std::max<std::size_t>(1, length / 3), length - std::min<std::size_t>(1, length));
    if (length - std::min(word.size(), other.size()) > limit) continue;
    const std::size_t distance = edit_distance(word, other);
    if (distance > limit) continue;
    // Typos rarely hit the first letters, so the longest common prefix wins among equals ("sinn": sin, not sign).
    const std::size_t prefix = common_prefix(word, other);
    if (best.empty() || distance < best_distance || (distance == best_distance && prefix > best_prefix)) {
      best = candidate;
      best_distance = distance;
      best_prefix = prefix;
    }
  }
  return best;
}

std::string suggestion(const std::string& given, const std::vector<std::string>& candidates) {
  if (candidates.empty()) return "; none is allowed here";
  std::string near = nearest(given, candidates);
  const std::string word = normalised(given);
  constexpr std::size_t shortest = 4;  // of a word that may be a part of a longer name
  for (const std::string& candidate : candidates)
    if (near.empty() && word.size() >= shortest && normalised(candidate).find(word) != std::string::npos)
      near = candidate;
  return near.empty() ? "; allowed: " + join(candidates) : " (did you mean '" + near + "'?)";
}

std::string join(const std::vector<std::string>& items, const std::string& separator) {
  std::string result;
  for (std::size_t i = 0; i < items.size(); ++i) result += (i == 0 ? "" : separator) + items[i];
  return result;
}

}  // namespace mudline
