#pragma once

// Includes hdf5.h; included by the .cpp files of this folder only.
#include <functional>
#include <string>

#include "simulation/output/hdf5_tools.hpp"

namespace mudline {

/// Upper estimate of a file's size, with which room on the disk is reserved beforehand: this rank's bytes, rank 0's
/// texts among them, and the number of datasets, groups and links of the file.
struct FileSize {
  std::size_t bytes = 0, objects = 0;
};

/// All ranks write an HDF5 file together under a temporary name beside `path`, which is renamed when it is complete on
/// disk: a reader finds the old file or the new one, after a crash too. Returns what went wrong, the same on every
/// rank, "" when nothing did; then nothing is left behind. HDF5 on MPI may hang or crash on a full disk, so it does not
/// begin where there is no room. Collective.
std::string write_whole(MPI_Comm comm, const std::string& path, const FileSize& size,
                        const std::function<void(hid_t file)>& content);

/// Like write_whole, with a seal (see seal.hpp) of this kind and version.
std::string write_whole_and_seal(MPI_Comm comm, const std::string& path, const FileSize& size, const std::string& kind,
                                 int version, const std::function<void(hid_t file)>& content);

}  // namespace mudline
