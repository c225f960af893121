#pragma once

#include <string>

namespace mudline {

/// Confines this process, from now on, so that it changes nothing in the system: it writes no file outside of `folder`
/// ("": none at all), starts no program and opens no network connection, as far as the kernel knows how to enforce that
/// (Landlock, seccomp). Files may still be read. This cannot be undone; children inherit it. Open files stay open.
void confine_to(const std::string& folder);

/// Whether the kernel of this machine can keep a process from writing files outside of a folder.
bool can_confine_files();

/// A folder of this process alone among the system's temporary ones, removed with all that is in it.
class PrivateFolder {
 public:
  /// Throws std::runtime_error where none can be made.
  PrivateFolder();
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace mudline
