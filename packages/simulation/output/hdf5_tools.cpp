#include "simulation/output/hdf5_tools.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <stdexcept>

namespace mudline::h5 {

namespace {

template <class T>
hid_t native();
template <>
hid_t native<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t native<int>() {
  return H5T_NATIVE_INT;
}
template <>
hid_t native<long long>() {
  return H5T_NATIVE_LLONG;
}
template <>
hid_t native<unsigned char>() {
  return H5T_NATIVE_UCHAR;
}

// HDF5 prints a stack for every failing call; mudline's exceptions say it in one line instead.
void silence() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

Handle parallel_access(MPI_Comm comm) {
  silence();
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "prepare parallel HDF5 access");
  check(H5Pset_fapl_mpio(access, comm, MPI_INFO_NULL), "use HDF5 with MPI");
  return access;
}

Handle collective_transfer() {
  Handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose, "prepare an HDF5 transfer");
  check(H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE), "prepare a collective HDF5 transfer");
  return transfer;
}

/// Memory and file selections of this rank's rows.
std::pair<Handle, Handle> selections(hid_t file_space, const Slab& slab) {
  const hsize_t columns = std::max<hsize_t>(slab.columns, 1);
  const hsize_t start[2] = {slab.first, 0}, count[2] = {slab.count, columns}, length = slab.count * columns;
  Handle memory(H5Screate_simple(1, &length, nullptr), H5Sclose, "describe data in memory");
  Handle file(H5Scopy(file_space), H5Sclose, "describe data in the file");
  if (slab.count == 0) {
    check(H5Sselect_none(memory), "select no data");
    check(H5Sselect_none(file), "select no data");
  } else {
    check(H5Sselect_hyperslab(file, H5S_SELECT_SET, start, nullptr, count, nullptr), "select rows in the file");
  }
  return {std::move(memory), std::move(file)};
}

Handle text_type(std::size_t size, H5T_cset_t characters = H5T_CSET_UTF8) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "describe a text");
  check(H5Tset_size(type, std::max<std::size_t>(size, 1)), "describe a text");  // HDF5 has no empty text
  check(H5Tset_strpad(type, H5T_STR_NULLPAD), "describe a text");
  check(H5Tset_cset(type, characters), "describe a text");
  return type;
}

/// Name of a source of a virtual dataset, in which "%" would begin a number.
std::string source_name(const std::string& name) {
  std::string result;
  for (char c : name) result += c == '%' ? "%%" : std::string(1, c);
  return result;
}

std::string trimmed(std::string text) {
  text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
  return text;
}

Handle scalar_space() { return Handle(H5Screate(H5S_SCALAR), H5Sclose, "describe one value"); }

void put_attribute(hid_t object, const std::string& name, hid_t type, hid_t space, const void* data) {
  if (has_attribute(object, name)) check(H5Adelete(object, name.c_str()), "replace attribute '" + name + "'");
  Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                   "create attribute '" + name + "'");
  check(H5Awrite(attribute, type, data), "write attribute '" + name + "'");
}

Handle open_attribute(hid_t object, const std::string& name) {
  return Handle(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, "find attribute '" + name + "'");
}

}  // namespace

Handle::Handle(hid_t id, herr_t (*close)(hid_t), const std::string& doing) : id_(id), close_(close) {
  if (id < 0) throw std::runtime_error("cannot " + doing);
}

void check(herr_t status, const std::string& doing) {
  if (status < 0) throw std::runtime_error("cannot " + doing);
}

Handle open_file(MPI_Comm comm, const std::string& path, bool writable) {
  const Handle access = parallel_access(comm);
  return Handle(H5Fopen(path.c_str(), writable ? H5F_ACC_RDWR : H5F_ACC_RDONLY, access), H5Fclose,
                "open '" + path + "' as an HDF5 file");
}

std::string file_image(const std::function<void(hid_t file)>& content) {
  silence();
  constexpr std::size_t growth = 65536;  // [bytes]
  const std::string doing = "make an HDF5 file in memory";
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, doing);
  check(H5Pset_fapl_core(access, growth, 0), doing);
  const Handle file(H5Fcreate("image", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, doing);
  content(file);
  check(H5Fflush(file, H5F_SCOPE_GLOBAL), doing);
  std::string bytes(std::max<ssize_t>(H5Fget_file_image(file, nullptr, 0), 0), '\0');
  check(H5Fget_file_image(file, bytes.data(), bytes.size()) > 0 ? 0 : -1, doing);
  return bytes;
}

Handle create_group(hid_t parent, const std::string& name) {
  return Handle(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
                "create group '" + name + "'");
}

Handle open_group(hid_t parent, const std::string& name) {
  return Handle(H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose, "find group '" + name + "'");
}

Handle open_dataset(hid_t parent, const std::string& name) {
  return Handle(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, "find dataset '" + name + "'");
}

void link_to_file(hid_t parent, const std::string& name, const std::string& file, const std::string& object) {
  check(H5Lcreate_external(file.c_str(), object.c_str(), parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
        "link '" + name + "' to '" + file + "'");
}

void flush(hid_t file, const std::string& path) { check(H5Fflush(file, H5F_SCOPE_GLOBAL), "flush '" + path + "'"); }

std::vector<std::string> names(hid_t group) {
  std::vector<std::string> result;
  const auto append = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->push_back(name);
    return 0;
  };
  check(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, append, &result), "list a group");
  return result;
}

std::string link_name(const std::string& name) {
  std::string result = name;
  for (char& c : result)
    if (const auto byte = static_cast<unsigned char>(c); byte < 0x80 && !std::isalnum(byte) && c != '.' && c != '-')
      c = '_';
  return result;
}

std::string escaped(const std::string& name) {
  std::string result;
  for (char c : name) result += c == '/' ? "%2F" : c == '%' ? "%25" : std::string(1, c);
  return result;
}

std::string unescaped(const std::string& link) {
  std::string result;
  for (std::size_t i = 0; i < link.size(); ++i) {
    if (link[i] != '%') {
      result += link[i];
    } else {
      result += link.compare(i, 3, "%2F") == 0 ? '/' : '%';
      i += 2;
    }
  }
  return result;
}

template <class T>
Handle write(hid_t parent, const std::string& name, const std::vector<T>& values, const Slab& slab) {
  const hsize_t dimensions[2] = {slab.rows, slab.columns};
  const Handle space(H5Screate_simple(slab.columns == 0 ? 1 : 2, dimensions, nullptr), H5Sclose,
                     "describe '" + name + "'");
  Handle dataset(H5Dcreate2(parent, name.c_str(), native<T>(), space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
                 "create dataset '" + name + "'");
  if (slab.rows > 0) {
    const auto [memory, file] = selections(space, slab);
    check(H5Dwrite(dataset, native<T>(), memory, file, collective_transfer(), values.data()),
          "write dataset '" + name + "'");
  }
  return dataset;
}

template <class T>
void write_alone(hid_t parent, const std::string& name, const std::vector<T>& values, hsize_t columns) {
  const hsize_t dimensions[2] = {values.size() / std::max<hsize_t>(columns, 1), columns};
  const Handle space(H5Screate_simple(columns == 0 ? 1 : 2, dimensions, nullptr), H5Sclose, "describe '" + name + "'");
  const Handle dataset(H5Dcreate2(parent, name.c_str(), native<T>(), space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       H5Dclose, "create dataset '" + name + "'");
  if (!values.empty())
    check(H5Dwrite(dataset, native<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "write dataset '" + name + "'");
}

template <class T>
std::vector<T> read(hid_t parent, const std::string& name, const Slab& slab) {
  const Handle dataset = open_dataset(parent, name);
  const Handle space(H5Dget_space(dataset), H5Sclose, "describe '" + name + "'");
  std::vector<T> values(slab.count * std::max<hsize_t>(slab.columns, 1));
  if (slab.rows > 0) {
    const auto [memory, file] = selections(space, slab);
    check(H5Dread(dataset, native<T>(), memory, file, collective_transfer(), values.data()),
          "read dataset '" + name + "'");
  }
  return values;
}

template <class T>
std::vector<T> read_all(hid_t parent, const std::string& name) {
  std::vector<T> values(size(parent, name));
  const Handle dataset = open_dataset(parent, name);
  if (!values.empty())
    check(H5Dread(dataset, native<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "read dataset '" + name + "'");
  return values;
}

template <class T>
void write_virtual(hid_t parent, const std::string& name, const std::vector<Source>& sources, hsize_t columns,
                   const std::vector<int>& order) {
  const std::string doing = "describe '" + name + "'";
  const int dimensions = columns == 0 ? 1 : 2;
  hsize_t whole[2] = {0, columns};
  for (const Source& source : sources) whole[0] += source.rows;
  const Handle space(H5Screate_simple(dimensions, whole, nullptr), H5Sclose, doing);
  const Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, doing);
  const T missing = std::numeric_limits<T>::has_quiet_NaN ? std::numeric_limits<T>::quiet_NaN() : T(0);
  check(H5Pset_fill_value(layout, native<T>(), &missing), doing);
  hsize_t first = 0;
  for (const Source& source : sources) {
    if (source.rows == 0) continue;
    const hsize_t there[2] = {source.rows, columns};
    const Handle rows(H5Screate_simple(dimensions, there, nullptr), H5Sclose, doing);
    // without a new order all columns at once, else one after the other
    for (std::size_t c = 0; c < std::max<std::size_t>(order.size(), 1) && !source.file.empty(); ++c) {
      const hsize_t width = order.empty() ? columns : 1;
      const hsize_t to[2] = {first, order.empty() ? 0 : c}, from[2] = {0, order.empty() ? 0 : hsize_t(order[c])};
      const hsize_t count[2] = {source.rows, width};
      check(H5Sselect_hyperslab(space, H5S_SELECT_SET, to, nullptr, count, nullptr), doing);
      check(H5Sselect_hyperslab(rows, H5S_SELECT_SET, from, nullptr, count, nullptr), doing);
      check(H5Pset_virtual(layout, space, source_name(source.file).c_str(), source_name(source.dataset).c_str(), rows),
            doing);
    }
    first += source.rows;
  }
  check(H5Sselect_all(space), doing);
  const Handle dataset(H5Dcreate2(parent, name.c_str(), native<T>(), space, H5P_DEFAULT, layout, H5P_DEFAULT), H5Dclose,
                       "create dataset '" + name + "'");
}

hsize_t size(hid_t parent, const std::string& name) {
  const Handle dataset = open_dataset(parent, name);
  const Handle space(H5Dget_space(dataset), H5Sclose, "describe '" + name + "'");
  return H5Sget_simple_extent_npoints(space);
}

template Handle write(hid_t, const std::string&, const std::vector<double>&, const Slab&);
template Handle write(hid_t, const std::string&, const std::vector<int>&, const Slab&);
template Handle write(hid_t, const std::string&, const std::vector<long long>&, const Slab&);
template Handle write(hid_t, const std::string&, const std::vector<unsigned char>&, const Slab&);
template void write_alone(hid_t, const std::string&, const std::vector<double>&, hsize_t);
template void write_alone(hid_t, const std::string&, const std::vector<long long>&, hsize_t);
template void write_alone(hid_t, const std::string&, const std::vector<unsigned char>&, hsize_t);
template void write_virtual<double>(hid_t, const std::string&, const std::vector<Source>&, hsize_t,
                                    const std::vector<int>&);
template void write_virtual<int>(hid_t, const std::string&, const std::vector<Source>&, hsize_t,
                                 const std::vector<int>&);
template void write_virtual<long long>(hid_t, const std::string&, const std::vector<Source>&, hsize_t,
                                       const std::vector<int>&);
template void write_virtual<unsigned char>(hid_t, const std::string&, const std::vector<Source>&, hsize_t,
                                           const std::vector<int>&);
template std::vector<double> read(hid_t, const std::string&, const Slab&);
template std::vector<int> read(hid_t, const std::string&, const Slab&);
template std::vector<long long> read(hid_t, const std::string&, const Slab&);
template std::vector<double> read_all(hid_t, const std::string&);
template std::vector<int> read_all(hid_t, const std::string&);
template std::vector<long long> read_all(hid_t, const std::string&);

void write_text(hid_t parent, const std::string& name, const std::string& text, int rank) {
  const Handle type = text_type(text.size()), space = scalar_space();
  const Handle dataset(H5Dcreate2(parent, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
                       "create text '" + name + "'");
  if (rank == 0)
    check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()), "write text '" + name + "'");
}

std::string read_text(hid_t parent, const std::string& name) {
  const Handle dataset = open_dataset(parent, name);
  const Handle stored(H5Dget_type(dataset), H5Tclose, "describe text '" + name + "'");
  std::string text(H5Tget_size(stored), '\0');
  const Handle type = text_type(text.size());
  check(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), "read text '" + name + "'");
  return trimmed(text);
}

void write_texts(hid_t parent, const std::string& name, const std::vector<std::string>& texts) {
  const std::string doing = "create texts '" + name + "'";
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, doing);
  check(H5Tset_size(type, H5T_VARIABLE), doing);
  const hsize_t rows = texts.size();
  const Handle space(H5Screate_simple(1, &rows, nullptr), H5Sclose, doing);
  const Handle dataset(H5Dcreate2(parent, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
                       doing);
  std::vector<const char*> bytes;
  for (const std::string& text : texts) bytes.push_back(text.c_str());
  if (rows > 0) check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()), doing);
}

void set_attribute(hid_t object, const std::string& name, const std::string& text) {
  put_attribute(object, name, text_type(text.size()), scalar_space(), text.c_str());
}

void set_attribute(hid_t object, const std::string& name, const std::vector<double>& values) {
  const hsize_t count = values.size();
  if (count == 1) return put_attribute(object, name, H5T_NATIVE_DOUBLE, scalar_space(), values.data());
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, "describe attribute '" + name + "'");
  put_attribute(object, name, H5T_NATIVE_DOUBLE, space, values.data());
}

void set_attribute(hid_t object, const std::string& name, const std::vector<long long>& values) {
  const hsize_t count = values.size();
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, "describe attribute '" + name + "'");
  put_attribute(object, name, H5T_NATIVE_LLONG, space, values.data());
}

void set_attribute(hid_t object, const std::string& name, long long value) {
  put_attribute(object, name, H5T_NATIVE_LLONG, scalar_space(), &value);
}

void set_ascii_attribute(hid_t object, const std::string& name, const std::string& text) {
  put_attribute(object, name, text_type(text.size(), H5T_CSET_ASCII), scalar_space(), text.c_str());
}

bool has_link(hid_t parent, const std::string& name) { return H5Lexists(parent, name.c_str(), H5P_DEFAULT) > 0; }

bool has_attribute(hid_t object, const std::string& name) { return H5Aexists(object, name.c_str()) > 0; }

std::string text_attribute(hid_t object, const std::string& name) {
  const Handle attribute = open_attribute(object, name);
  const Handle stored(H5Aget_type(attribute), H5Tclose, "describe attribute '" + name + "'");
  std::string text(H5Tget_size(stored), '\0');
  check(H5Aread(attribute, text_type(text.size()), text.data()), "read attribute '" + name + "'");
  return trimmed(text);
}

double number_attribute(hid_t object, const std::string& name) {
  double value = 0;
  check(H5Aread(open_attribute(object, name), H5T_NATIVE_DOUBLE, &value), "read attribute '" + name + "'");
  return value;
}

long long integer_attribute(hid_t object, const std::string& name) {
  long long value = 0;
  check(H5Aread(open_attribute(object, name), H5T_NATIVE_LLONG, &value), "read attribute '" + name + "'");
  return value;
}

}  // namespace mudline::h5
