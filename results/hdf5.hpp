// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The part of HDF5 that the result files need: groups, attributes and whole datasets, identifiers closed by
/// themselves.
///
/// A file is made in memory and written by whole_file.hpp: HDF5 never meets a disk that is full, which it does not survive. A file that is
/// read has been verified before (checksum.hpp): HDF5 never meets damaged bytes either, which it may follow without an end.
///
/// Files made through it hold no times and no addresses of memory: the same calls give the same bytes. Every
/// call that fails throws h5::Failure, which the public functions of this folder turn into core::Error or
/// into "no such file".
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <hdf5.h>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace fretwork::results::h5 {

class Failure : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// Keeps HDF5 from printing its own error stack during the life of the object: failures are reported by
/// exception.
class Quiet {
public:
  Quiet();
  ~Quiet();
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// An identifier and the call that closes it.
class Handle {
public:
  using Close = herr_t (*)(hid_t);
  /// @throws Failure if `id` is negative: `what` failed
  Handle(hid_t id, Close close, const std::string& what);
  ~Handle();
  Handle(Handle&& other) noexcept;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  [[nodiscard]] hid_t id() const { return id_; }

private:
  hid_t id_;
  Close close_;
};

/// Lengths of the dimensions of a dataset; none: a single value.
using Shape = std::vector<hsize_t>;
[[nodiscard]] std::size_t size_of(const Shape& shape);

/// Types that are stored as they are in memory.
template <class T> [[nodiscard]] hid_t type_of();
template <> hid_t type_of<double>();
template <> hid_t type_of<std::uint8_t>();
template <> hid_t type_of<std::int32_t>();
template <> hid_t type_of<std::int64_t>();
template <> hid_t type_of<std::uint64_t>();

/// A group of a file; the file itself is its root group. Names of children must not contain "/".
class Group {
public:
  /// Verifies the checksum first.
  /// @throws Failure if there is no such file, or it is not as it was written
  [[nodiscard]] static Group open_file(const std::filesystem::path& file);

  [[nodiscard]] Group create(const std::string& name) const;
  [[nodiscard]] Group open(const std::string& name) const;
  [[nodiscard]] bool has(const std::string& name) const;
  /// Names of all children, in alphabetical order.
  [[nodiscard]] std::vector<std::string> children() const;
  void set(const std::string& name, const std::string& text) const;
  template <class T> void set(const std::string& name, std::span<const T> values, const Shape& shape) const {
    set_values(name, type_of<T>(), values.data(), values.size(), shape);
  }
  void set(const std::string& name, double value) const { set<double>(name, {&value, 1}, {}); }
  void set(const std::string& name, std::int64_t value) const { set<std::int64_t>(name, {&value, 1}, {}); }
  [[nodiscard]] std::string text(const std::string& name) const;
  template <class T> [[nodiscard]] std::vector<T> values(const std::string& name) const {
    std::vector<T> out(attribute_size(name));
    get_values(name, type_of<T>(), out.data());
    return out;
  }
  [[nodiscard]] double number(const std::string& name) const { return single<double>(name); }
  [[nodiscard]] std::int64_t integer(const std::string& name) const { return single<std::int64_t>(name); }

  /// A dataset, the last index running fastest, with its units as an attribute (none where `units` is empty).
  /// Not compressed: modal motion shrinks by a tenth, and that costs more time than the transient it comes
  /// from.
  template <class T>
  void write(const std::string& name, std::span<const T> data, const Shape& shape,
             const std::string& units) const {
    write_values(name, type_of<T>(), data.data(), data.size(), shape, units);
  }
  [[nodiscard]] Shape shape(const std::string& name) const;
  template <class T> [[nodiscard]] std::vector<T> read(const std::string& name) const {
    std::vector<T> out(stored_size(name));
    read_values(name, type_of<T>(), out.data());
    return out;
  }

private:
  friend class MemoryFile;
  explicit Group(Handle handle) : handle_(std::move(handle)) {}
  void set_values(const std::string& name, hid_t type, const void* values, std::size_t count,
                  const Shape& shape) const;
  void write_values(const std::string& name, hid_t type, const void* values, std::size_t count,
                    const Shape& shape, const std::string& units) const;
  template <class T> [[nodiscard]] T single(const std::string& name) const {
    const std::vector<T> all = values<T>(name);
    if (all.size() != 1)
      throw Failure("attribute " + name + " is not a single value");
    return all[0];
  }
  /// Number of values of a dataset.
  /// @throws Failure where its shape promises more than the file holds
  [[nodiscard]] std::size_t stored_size(const std::string& name) const;
  [[nodiscard]] std::size_t attribute_size(const std::string& name) const;
  void get_values(const std::string& name, hid_t type, void* values) const;
  void read_values(const std::string& name, hid_t type, void* values) const;

  Handle handle_;
};

/// A new file, whose bytes lie in memory until they are written.
class MemoryFile {
public:
  MemoryFile();
  [[nodiscard]] const Group& root() const { return root_; }
  /// Writes the file with its checksum. The groups below the root must be closed.
  /// @throws Failure, core::Error (write_whole)
  void write(const std::filesystem::path& file) const;

private:
  Handle access_; ///< property list of the driver
  Group root_;
};

/// Makes an HDF5 file: `fill` is given its root.
/// @throws core::Error if the file cannot be made or written
void write_file(const std::filesystem::path& file, const std::function<void(const Group&)>& fill);

} // namespace fretwork::results::h5
