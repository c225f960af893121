#pragma once

// Included by the .cpp files of this folder only: hdf5.h stays out of every other header.
#include <hdf5.h>
#include <mpi.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace mudline::h5 {

/// Owns one HDF5 identifier. An invalid one gives a std::runtime_error that says what could not be done.
class Handle {
 public:
  Handle() = default;
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& doing);
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

/// Throws std::runtime_error "cannot <doing>" when an HDF5 call failed.
void check(herr_t status, const std::string& doing);

// Files and groups. Collective.
Handle open_file(MPI_Comm comm, const std::string& path, bool writable);
/// The bytes of a small file that is made in memory by this process alone. std::runtime_error.
std::string file_image(const std::function<void(hid_t file)>& content);
Handle create_group(hid_t parent, const std::string& name);
Handle open_group(hid_t parent, const std::string& name);
Handle open_dataset(hid_t parent, const std::string& name);
/// Makes a link that leads to an object of another file; `file` is relative to the folder of the file that has the
/// link.
void link_to_file(hid_t parent, const std::string& name, const std::string& file, const std::string& object);
/// Brings everything to the disk. Closing does so too, but cannot say that it failed.
void flush(hid_t file, const std::string& path);
/// Names of the links in a group, sorted.
std::vector<std::string> names(hid_t group);

/// Turns a name into that of a link that needs no quoting in an XDMF reference: anything but letters of any language,
/// digits, '.', '-' becomes '_'.
std::string link_name(const std::string& name);

/// Escapes "/" in a name, which HDF5 would take for a group, and the reverse.
std::string escaped(const std::string& name);
std::string unescaped(const std::string& link);

/// Place of this rank's rows in a dataset.
struct Slab {
  hsize_t rows, columns;         // of the whole dataset; columns 0: one-dimensional
  hsize_t first = 0, count = 0;  // this rank's rows
};

/// Create a dataset and write every rank's rows, or read them. T: double, int, long long, unsigned char. Collective.
template <class T>
Handle write(hid_t parent, const std::string& name, const std::vector<T>& values, const Slab& slab);
template <class T>
std::vector<T> read(hid_t parent, const std::string& name, const Slab& slab);
/// Writes a whole dataset by this process alone; `columns` 0: one-dimensional.
template <class T>
void write_alone(hid_t parent, const std::string& name, const std::vector<T>& values, hsize_t columns = 0);
/// Reads the whole dataset on every rank.
template <class T>
std::vector<T> read_all(hid_t parent, const std::string& name);
/// Rows of a dataset in another file, all of them; `file` is relative to the folder of the file that refers to it.
struct Source {
  std::string file, dataset;  // empty: there are none, and a reader finds NaN, or 0 in a dataset of integers
  hsize_t rows;
};

/// Creates a virtual dataset: the rows of the sources one after the other, which stay where they are. `columns` 0:
/// one-dimensional. `order`: column of the sources for each of its own; empty: the same.
template <class T>
void write_virtual(hid_t parent, const std::string& name, const std::vector<Source>& sources, hsize_t columns,
                   const std::vector<int>& order = {});
/// Number of values in a dataset.
hsize_t size(hid_t parent, const std::string& name);

/// Texts are stored as datasets, because attributes are limited to 64 kB. Every rank gives the same text; rank 0's
/// bytes are written.
void write_text(hid_t parent, const std::string& name, const std::string& text, int rank);
std::string read_text(hid_t parent, const std::string& name);

/// Texts of variable length, one a row, as VTK reads them: said to be ASCII, though the bytes are UTF-8.
void write_texts(hid_t parent, const std::string& name, const std::vector<std::string>& texts);

// Small attributes; every rank gives the same value.
void set_attribute(hid_t object, const std::string& name, const std::string& text);
void set_attribute(hid_t object, const std::string& name, const std::vector<double>& values);
void set_attribute(hid_t object, const std::string& name, const std::vector<long long>& values);
void set_attribute(hid_t object, const std::string& name, long long value);
/// A text that is said to be ASCII, which readers of VTK's format insist on.
void set_ascii_attribute(hid_t object, const std::string& name, const std::string& text);
bool has_link(hid_t parent, const std::string& name);
bool has_attribute(hid_t object, const std::string& name);
std::string text_attribute(hid_t object, const std::string& name);
double number_attribute(hid_t object, const std::string& name);
long long integer_attribute(hid_t object, const std::string& name);

}  // namespace mudline::h5
