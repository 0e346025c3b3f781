// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdf5_edits.hpp"
#include "results/checksum.hpp"
#include <array>
#include <fstream>
#include <hdf5.h>
#include <iterator>
#include <limits>

namespace fretwork::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t edit_bytes = 5;
constexpr hsize_t huge = hsize_t{1} << 33; ///< its square is no size
constexpr hsize_t most_values = 4096;      ///< of a dataset that is given values
enum Change : std::uint8_t { removed, replaced, changes };
enum Type : std::uint8_t { real, integer, small, text, types };

std::string whole(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void save(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

hid_t type_of(std::uint8_t kind) {
  if (kind == text) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, H5T_VARIABLE);
    return type;
  }
  return H5Tcopy(kind == real ? H5T_NATIVE_DOUBLE : kind == integer ? H5T_NATIVE_INT64 : H5T_NATIVE_UINT8);
}

/// No, one, two or three dimensions; some without a value, some whose size overflows (no values are written then).
std::vector<hsize_t> shape_of(std::uint8_t detail) {
  static const std::array<std::vector<hsize_t>, 14> shapes{
      {{}, {0}, {1}, {2}, {3}, {12}, {100}, {2, 2}, {2, 3}, {3, 2}, {0, 3}, {2, 2, 6}, {4096}, {huge, huge}}};
  return shapes[detail % shapes.size()];
}

double value_of(std::uint8_t detail, std::size_t i) {
  static const std::array values{
      0.0, 1.0, -1.0, 2.0, 1e300, std::numeric_limits<double>::quiet_NaN(), 2147483648.0, 1e-320};
  return values[(detail / 14 + i * (detail % 3)) % values.size()];
}

/// The values in memory for H5Dwrite or H5Awrite with the type of the object.
struct Values {
  std::vector<double> reals;
  std::vector<std::int64_t> integers;
  std::vector<std::uint8_t> bytes;
  std::vector<const char*> texts;

  const void* fill(std::uint8_t type, std::uint8_t detail, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const double value = value_of(detail, i);
      reals.push_back(value);
      integers.push_back(value > -1e18 && value < 1e18 ? static_cast<std::int64_t>(value) : -7);
      bytes.push_back(static_cast<std::uint8_t>(detail + i));
      texts.push_back(detail % 2 == 0 ? "" : "{\"a\": [1, 2]}");
    }
    return type == text      ? static_cast<const void*>(texts.data())
           : type == real    ? static_cast<const void*>(reals.data())
           : type == integer ? static_cast<const void*>(integers.data())
                             : bytes.data();
  }
};

hsize_t count_of(const std::vector<hsize_t>& shape) {
  hsize_t count = 1;
  for (const hsize_t length : shape)
    count = length >= huge ? huge : count * length;
  return count;
}

template <class Create, class Write>
void make(const std::vector<hsize_t>& shape, std::uint8_t type, std::uint8_t detail, Create create,
          Write write, herr_t (*end)(hid_t)) {
  const hid_t kind = type_of(type);
  const hid_t space = shape.empty() ? H5Screate(H5S_SCALAR)
                                    : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
  if (const hid_t object = create(kind, space); object >= 0) {
    if (const hsize_t count = count_of(shape); count > 0 && count <= most_values) {
      Values values;
      write(object, kind, values.fill(type, detail, count));
    }
    end(object);
  }
  H5Sclose(space);
  H5Tclose(kind);
}

} // namespace

void Hdf5Edits::load(const fs::path& file) {
  bytes_ = whole(file);
  const hid_t root = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const auto visit = [](hid_t parent, const char* name, const H5O_info_t* info, void* places) -> herr_t {
    auto& all = *static_cast<std::vector<Place>*>(places);
    if (info->type == H5O_TYPE_DATASET)
      all.push_back({name, ""});
    const hid_t object = H5Oopen(parent, name, H5P_DEFAULT);
    for (hsize_t i = 0; i < info->num_attrs; ++i) {
      std::array<char, 256> attribute{};
      H5Aget_name_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC, i, attribute.data(), attribute.size(),
                         H5P_DEFAULT);
      all.push_back({name, attribute.data()});
    }
    H5Oclose(object);
    return 0;
  };
  H5Ovisit(root, H5_INDEX_NAME, H5_ITER_INC, visit, &places_);
  H5Fclose(root);
}

void Hdf5Edits::write(const fs::path& file, std::span<const std::uint8_t> edits) const {
  save(file, bytes_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t root = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  for (; edits.size() >= edit_bytes; edits = edits.subspan(edit_bytes)) {
    const Place& place = places_[(edits[0] * 256u + edits[4]) % places_.size()];
    const auto type = static_cast<std::uint8_t>(edits[2] % types);
    const auto shape = shape_of(edits[3]);
    const bool again = edits[1] % changes == replaced;
    if (place.attribute.empty()) {
      H5Ldelete(root, place.object.c_str(), H5P_DEFAULT);
      if (again)
        make(
            shape, type, edits[3],
            [&](hid_t kind, hid_t space) {
              return H5Dcreate2(root, place.object.c_str(), kind, space, H5P_DEFAULT, H5P_DEFAULT,
                                H5P_DEFAULT);
            },
            [](hid_t object, hid_t kind, const void* values) {
              H5Dwrite(object, kind, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
            },
            H5Dclose);
      continue;
    }
    const hid_t object = H5Oopen(root, place.object.c_str(), H5P_DEFAULT);
    if (object < 0)
      continue; // taken away before
    H5Adelete(object, place.attribute.c_str());
    if (again)
      make(
          shape, type, edits[3],
          [&](hid_t kind, hid_t space) {
            return H5Acreate2(object, place.attribute.c_str(), kind, space, H5P_DEFAULT, H5P_DEFAULT);
          },
          [](hid_t attribute, hid_t kind, const void* values) { H5Awrite(attribute, kind, values); },
          H5Aclose);
    H5Oclose(object);
  }
  H5Fclose(root);
  std::string changed = whole(file);
  changed.replace(0, results::user_block_bytes,
                  results::user_block(std::string_view(changed).substr(results::user_block_bytes)));
  save(file, changed);
}

} // namespace fretwork::fuzz
