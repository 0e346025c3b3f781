// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A file of HDF5 of the program, with some of its datasets and attributes replaced and a checksum that fits.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace fretwork::fuzz {

class Hdf5Edits {
public:
  /// Keeps the file's bytes and the places of its datasets and attributes.
  void load(const std::filesystem::path& file);
  /// Writes the file with edits of five bytes each: which place (the first and the last), what becomes of it, its type, its shape and values.
  void write(const std::filesystem::path& file, std::span<const std::uint8_t> edits) const;

private:
  struct Place {
    std::string object, attribute; ///< no attribute: a dataset
  };
  std::string bytes_;
  std::vector<Place> places_;
};

} // namespace fretwork::fuzz
