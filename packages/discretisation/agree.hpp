#pragma once

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <exception>
#include <stdexcept>
#include <string>

#include "algebra/over_ranks.hpp"
#include "core/errors.hpp"

namespace mudline {

/// Returns on every rank the text of the lowest rank that has one; "" where none has. Collective.
inline std::string broadcast(const Teuchos::Comm<int>& comm, std::string text) {
  const int first = first_rank(comm, !text.empty());
  if (first == comm.getSize()) return "";
  int length = static_cast<int>(text.size());
  Teuchos::broadcast(comm, first, 1, &length);
  text.resize(length);
  Teuchos::broadcast(comm, first, length, text.data());
  return text;
}

/// Runs `action` on every rank; when it throws anywhere, every rank throws the error of the lowest such rank, so that
/// an error that only one rank can see (a missing file, a bad mesh) ends all ranks alike. Collective; the action itself
/// must not communicate.
template <class Action>
void agree(const Teuchos::Comm<int>& comm, Action&& action) {
  std::string message;
  std::exception_ptr other;  // a programming error or exhausted memory; the rank that threw it rethrows its own type
  bool failed = false;
  try {
    action();
  } catch (const InputError& error) {
    message = error.what();
    failed = true;
  } catch (const std::exception& error) {
    message = error.what();
    other = std::current_exception();
    failed = true;
  }
  const int first = first_rank(comm, failed);
  if (first == comm.getSize()) return;

  int header[2] = {static_cast<int>(message.size()), other ? 1 : 0};
  Teuchos::broadcast(comm, first, 2, header);
  message.resize(header[0]);
  Teuchos::broadcast(comm, first, header[0], message.data());
  if (header[1] == 0) throw InputError(message);
  if (first == comm.getRank()) std::rethrow_exception(other);
  throw std::runtime_error(message);
}

}  // namespace mudline
