#pragma once

// Brings hdf5.h; included by the .cpp files of this folder only.
#include <functional>
#include <string>

#include "simulation/output/hdf5_tools.hpp"

namespace mudline {

/// All ranks write an HDF5 file together under a temporary name beside `path`, which is renamed when it is complete on disk: a
/// reader, or whoever comes after a crash, finds the old file or the new one. Returns what went wrong, the same on every
/// rank, "" when nothing did; then nothing is left behind. Collective.
std::string write_whole(MPI_Comm comm, const std::string& path, const std::function<void(hid_t file)>& content);

}  // namespace mudline
