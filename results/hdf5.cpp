// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/hdf5.hpp"
#include "core/error.hpp"
#include "results/checksum.hpp"
#include "results/whole_file.hpp"
#include <cassert>
#include <fmt/format.h>
#include <utility>

namespace fretwork::results::h5 {
namespace {

constexpr std::size_t memory_increment = std::size_t{1} << 20; ///< bytes by which a file in memory grows

void check(herr_t status, const std::string& what) {
  if (status < 0)
    throw Failure(what);
}

Handle dataspace(const Shape& shape) {
  if (shape.empty())
    return {H5Screate(H5S_SCALAR), H5Sclose, "dataspace"};
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose, "dataspace"};
}

Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "text type");
  check(H5Tset_size(type.id(), H5T_VARIABLE),
        "text type"); // kept outside the object's header, which is limited to 64 kB
  check(H5Tset_cset(type.id(), H5T_CSET_UTF8), "text type");
  return type;
}

Handle properties_without_times(hid_t kind) {
  Handle properties(H5Pcreate(kind), H5Pclose, "property list");
  check(H5Pset_obj_track_times(properties.id(), false), "property list");
  return properties;
}

void set_text(hid_t object, const std::string& name, const std::string& text) {
  const Handle type = text_type(), space = dataspace({});
  const Handle attribute(H5Acreate2(object, name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose, "attribute " + name);
  const char* const start = text.c_str();
  check(H5Awrite(attribute.id(), type.id(), &start), "attribute " + name);
}

} // namespace

std::size_t size_of(const Shape& shape) {
  std::size_t count = 1;
  for (const hsize_t length : shape)
    count *= length;
  return count;
}

Quiet::Quiet() {
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Quiet::~Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

Handle::Handle(hid_t id, Close close, const std::string& what) : id_(id), close_(close) {
  if (id < 0)
    throw Failure(what);
}

Handle::~Handle() {
  if (id_ >= 0)
    close_(id_);
}

Handle::Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}

template <> hid_t type_of<double>() { return H5T_NATIVE_DOUBLE; }
template <> hid_t type_of<std::uint8_t>() { return H5T_NATIVE_UINT8; }
template <> hid_t type_of<std::int32_t>() { return H5T_NATIVE_INT32; }
template <> hid_t type_of<std::int64_t>() { return H5T_NATIVE_INT64; }
template <> hid_t type_of<std::uint64_t>() { return H5T_NATIVE_UINT64; }

Group Group::open_file(const std::filesystem::path& file) {
  if (const std::string refusal = checksum_refusal(file); !refusal.empty())
    throw Failure(refusal);
  return Group(Handle(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "open " + file.string()));
}

Group Group::create(const std::string& name) const {
  const Handle properties = properties_without_times(H5P_GROUP_CREATE);
  return Group(Handle(H5Gcreate2(handle_.id(), name.c_str(), H5P_DEFAULT, properties.id(), H5P_DEFAULT),
                      H5Gclose, "create group " + name));
}

Group Group::open(const std::string& name) const {
  return Group(Handle(H5Gopen2(handle_.id(), name.c_str(), H5P_DEFAULT), H5Gclose, "open group " + name));
}

bool Group::has(const std::string& name) const {
  return H5Lexists(handle_.id(), name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Group::children() const {
  std::vector<std::string> names;
  const auto keep = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  check(H5Literate(handle_.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, keep, &names), "list a group");
  return names;
}

void Group::set(const std::string& name, const std::string& text) const {
  set_text(handle_.id(), name, text);
}

void Group::set_values(const std::string& name, hid_t type, const void* values, std::size_t count,
                       const Shape& shape) const {
  assert(size_of(shape) == count);
  const Handle space = dataspace(shape);
  const Handle attribute(H5Acreate2(handle_.id(), name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose, "attribute " + name);
  if (count > 0)
    check(H5Awrite(attribute.id(), type, values), "attribute " + name);
}

std::string Group::text(const std::string& name) const {
  const Handle attribute(H5Aopen(handle_.id(), name.c_str(), H5P_DEFAULT), H5Aclose, "attribute " + name);
  const Handle stored(H5Aget_type(attribute.id()), H5Tclose, "attribute " + name);
  if (H5Tis_variable_str(stored.id()) <= 0)
    throw Failure("attribute " + name + " is not a text");
  if (attribute_size(name) != 1)
    throw Failure("attribute " + name + " is not a single text");
  const Handle type = text_type();
  char* start = nullptr;
  check(H5Aread(attribute.id(), type.id(), &start), "attribute " + name);
  std::string out = start ? start : "";
  H5free_memory(start);
  return out;
}

std::size_t Group::attribute_size(const std::string& name) const {
  const Handle attribute(H5Aopen(handle_.id(), name.c_str(), H5P_DEFAULT), H5Aclose, "attribute " + name);
  const Handle space(H5Aget_space(attribute.id()), H5Sclose, "attribute " + name);
  return static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.id()));
}

void Group::get_values(const std::string& name, hid_t type, void* values) const {
  const Handle attribute(H5Aopen(handle_.id(), name.c_str(), H5P_DEFAULT), H5Aclose, "attribute " + name);
  if (H5Aget_storage_size(attribute.id()) > 0)
    check(H5Aread(attribute.id(), type, values), "attribute " + name);
}

void Group::write_values(const std::string& name, hid_t type, const void* values, std::size_t count,
                         const Shape& shape, const std::string& units) const {
  assert(size_of(shape) == count);
  const Handle properties = properties_without_times(H5P_DATASET_CREATE);
  const Handle space = dataspace(shape);
  const Handle data(
      H5Dcreate2(handle_.id(), name.c_str(), type, space.id(), H5P_DEFAULT, properties.id(), H5P_DEFAULT),
      H5Dclose, "dataset " + name);
  if (count > 0)
    check(H5Dwrite(data.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "dataset " + name);
  if (!units.empty())
    set_text(data.id(), "units", units);
}

Shape Group::shape(const std::string& name) const {
  const Handle data(H5Dopen2(handle_.id(), name.c_str(), H5P_DEFAULT), H5Dclose, "dataset " + name);
  const Handle space(H5Dget_space(data.id()), H5Sclose, "dataset " + name);
  const int dimensions = H5Sget_simple_extent_ndims(space.id());
  check(dimensions, "dataset " + name);
  Shape out(static_cast<std::size_t>(dimensions));
  check(H5Sget_simple_extent_dims(space.id(), out.data(), nullptr), "dataset " + name);
  return out;
}

std::size_t Group::stored_size(const std::string& name) const {
  const Handle data(H5Dopen2(handle_.id(), name.c_str(), H5P_DEFAULT), H5Dclose, "dataset " + name);
  const Handle type(H5Dget_type(data.id()), H5Tclose, "dataset " + name);
  const std::size_t stored = H5Dget_storage_size(data.id()) / H5Tget_size(type.id()); // nothing is compressed
  std::size_t count = 1;
  for (const hsize_t length : shape(name)) {
    if (length > 0 && count > stored / length)
      throw Failure("dataset " + name + " holds less than its shape says");
    count *= length;
  }
  return count;
}

void Group::read_values(const std::string& name, hid_t type, void* values) const {
  const Handle data(H5Dopen2(handle_.id(), name.c_str(), H5P_DEFAULT), H5Dclose, "dataset " + name);
  check(H5Dread(data.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "dataset " + name);
}

MemoryFile::MemoryFile()
    : access_(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "property list"), root_([&] {
        check(H5Pset_fapl_core(access_.id(), memory_increment, false), "file in memory");
        const Handle properties = properties_without_times(H5P_FILE_CREATE);
        return Group(Handle(H5Fcreate("in memory", H5F_ACC_TRUNC, properties.id(), access_.id()), H5Fclose,
                            "file in memory"));
      }()) {}

void MemoryFile::write(const std::filesystem::path& file) const {
  const hid_t id = root_.handle_.id();
  check(H5Fflush(id, H5F_SCOPE_GLOBAL), "file in memory");
  const ssize_t size = H5Fget_file_image(id, nullptr, 0);
  void* memory =
      nullptr; // the driver's handle is the place where it keeps its bytes: no copy of a large file
  check(size < 0 ? -1 : H5Fget_vfd_handle(id, access_.id(), &memory), "file in memory");
  const std::string_view content(*static_cast<const char* const*>(memory), static_cast<std::size_t>(size));
  write_whole(file, {user_block(content), content});
}

void write_file(const std::filesystem::path& file, const std::function<void(const Group&)>& fill) {
  const Quiet quiet;
  try {
    const MemoryFile memory;
    fill(memory.root());
    memory.write(file);
  } catch (const Failure& failure) {
    throw core::Error(fmt::format("{}: cannot be written ({}); check the memory that is left", file.string(),
                                  failure.what()));
  }
}

} // namespace fretwork::results::h5
